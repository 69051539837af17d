// Expressions over the records of pairs, in the words of `find` and `shrink`: overlap > 5 mm and normal_turn > 20 deg

const UNITS = { m: 1, cm: 0.01, mm: 1e-3, um: 1e-6, deg: 1, rad: 180 / Math.PI, s: 1, ms: 1e-3, Ns: 1 };

const firstManifold = (record, value) => {
  const m = data.contacts.manifolds[record];
  return m < data.contacts.manifolds[record + 1] ? value(m) : NaN;
};
const normalOf = record => firstManifold(record, m => data.manifolds.normal.subarray(3 * m, 3 * m + 3)) || [NaN, NaN, NaN];
/** A list with one entry for each point of a record. */
const ofPoints = (record, value) => {
  const all = [];
  eachPoint(record, i => all.push(value(i)));
  return all;
};
const idsOf = record => ofPoints(record, i => data.texts[data.points.id[i]]);
const sumOf = (record, column) => ofPoints(record, i => column[i] || 0).reduce((sum, one) => sum + one, 0);
/** From the frame before; unknown where the pair has no record there. */
const changeOf = compare => record => data.contacts.before[record] < 0 ? NaN : compare(record, data.contacts.before[record]);
const differenceOf = name => changeOf((now, then) => QUANTITIES[name](now) - QUANTITIES[name](then));

/** Values of a record: lengths in metres, angles in degrees, impulses in newton seconds. */
const QUANTITIES = {
  points: record => data.manifolds.first[data.contacts.manifolds[record + 1]] - data.manifolds.first[data.contacts.manifolds[record]],
  manifolds: record => data.contacts.manifolds[record + 1] - data.contacts.manifolds[record],
  separation: record => data.contacts.separation[record],
  overlap: record => Math.max(0, -data.contacts.separation[record]),
  touching: record => data.contacts.state[record],
  axis: record => firstManifold(record, m => data.texts[data.manifolds.axis[m]]),
  type: record => firstManifold(record, m => data.texts[data.manifolds.type[m]]),
  ids: record => idsOf(record).join(' '),
  normal_x: record => normalOf(record)[0],
  normal_y: record => normalOf(record)[1],
  normal_z: record => normalOf(record)[2],
  impulse: record => sumOf(record, data.points.impulse),
  friction_impulse: record => sumOf(record, data.points.friction),
  a: record => namesOf(data.contacts.pair[record])[0],
  b: record => namesOf(data.contacts.pair[record])[1],
  frame: (record, frame) => data.frames[frame],
  time: (record, frame) => data.times[frame],
  normal_turn: changeOf((now, then) => {
    const [a, b] = [normalOf(now), normalOf(then)];
    return Math.acos(Math.min(1, Math.max(-1, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]))) * 180 / Math.PI;
  }),
  points_change: differenceOf('points'),
  overlap_change: differenceOf('overlap'),
  impulse_change: differenceOf('impulse'),
  new_ids: changeOf((now, then) => idsOf(now).filter(id => !idsOf(then).includes(id)).length),
};

const isTrue = value => typeof value === 'string' ? value !== '' : !Number.isNaN(value) && value !== 0;
const known = (a, b) => typeof a === typeof b && !Number.isNaN(a) && !Number.isNaN(b);
// By precedence, the weakest first. Operands are functions of (record, frame).
const LEVELS = [
  { or: (a, b) => (...of) => Number(isTrue(a(...of)) || isTrue(b(...of))) },
  { and: (a, b) => (...of) => Number(isTrue(a(...of)) && isTrue(b(...of))) },
  Object.fromEntries(Object.entries({ '==': (a, b) => a === b, '!=': (a, b) => a !== b, '<': (a, b) => a < b, '<=': (a, b) => a <= b, '>': (a, b) => a > b, '>=': (a, b) => a >= b })
    .map(([name, holds]) => [name, (a, b) => (...of) => Number(known(a(...of), b(...of)) && holds(a(...of), b(...of)))])),
  { '+': (a, b) => (...of) => a(...of) + b(...of), '-': (a, b) => (...of) => a(...of) - b(...of) },
  { '*': (a, b) => (...of) => a(...of) * b(...of), '/': (a, b) => (...of) => a(...of) / b(...of) },
];
const NOT_LEVEL = 2;

/** The function of (record, frame) that a text stands for. Throws Error with what is wrong. */
function parseExpression(text) {
  const tokens = [...text.matchAll(/\s*("[^"]*"|'[^']*'|[\d.]+(?:e[+-]?\d+)?|\w+|[=!<>]=|&&|\|\||\S)/gi)]
    .map(([, token]) => ({ '&&': 'and', '||': 'or', '!': 'not' })[token] || token);
  let at = 0;
  const take = token => tokens[at] === token && ++at;
  const need = (token, where) => { if (!take(token)) throw new Error("'" + token + "' is missing " + where); };
  function level(depth) {
    if (depth === LEVELS.length) return term();
    if (depth === NOT_LEVEL && take('not')) {
      const inner = level(depth);
      return (...of) => Number(!isTrue(inner(...of)));
    }
    let left = level(depth + 1);
    while (at < tokens.length && Object.hasOwn(LEVELS[depth], tokens[at])) left = LEVELS[depth][tokens[at++]](left, level(depth + 1));
    return left;
  }
  function term() {
    const token = tokens[at++];
    if (token === undefined) throw new Error('a quantity is missing at the end');
    if (token === '(' || token === 'abs') {
      if (token === 'abs') need('(', 'after abs');
      const inner = level(0);
      need(')', 'at the end');
      return token === '(' ? inner : (...of) => Math.abs(inner(...of));
    }
    if (token === '-') {
      const inner = term();
      return (...of) => -inner(...of);
    }
    if (/^["']/.test(token)) return () => token.slice(1, -1);
    if (/^[\d.]/.test(token)) {
      const number = Number(token) * (Object.hasOwn(UNITS, tokens[at]) ? UNITS[tokens[at++]] : 1);
      if (Number.isNaN(number)) throw new Error("'" + token + "' is not a number");
      return () => number;
    }
    if (Object.hasOwn(QUANTITIES, token)) return QUANTITIES[token];
    throw new Error("'" + token + "' is not a quantity; known: " + Object.keys(QUANTITIES).join(', '));
  }
  const whole = level(0);
  if (at < tokens.length) throw new Error(tokens[at] === '=' ? "compare with '==', not '='" : "unexpected '" + tokens[at] + "'");
  return whole;
}

/** All [frame, record] for which the expression is true. */
function findRecords(text) {
  const expression = parseExpression(text);
  return data.frames.flatMap((_, frame) => recordsOf(frame).filter(record => isTrue(expression(record, frame))).map(record => [frame, record]));
}
