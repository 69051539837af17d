// Expressions over the records of pairs, in the words of `find` and `shrink`: overlap > 5 mm and normal_turn > 20 deg

const UNITS = { m: 1, cm: 0.01, mm: 1e-3, um: 1e-6, nm: 1e-9, deg: 1, rad: 180 / Math.PI, s: 1, ms: 1e-3, N: 1, Ns: 1 };

// A record of -1 is a pair that is not in the frame: it has no contacts.
const manifoldsOf = record => Array.from({ length: data.contacts.manifolds[record + 1] - data.contacts.manifolds[record] || 0 }, (_, i) => data.contacts.manifolds[record] + i);
const normalsOf = record => manifoldsOf(record).map(m => data.manifolds.normal.subarray(3 * m, 3 * m + 3));
const textOf = (record, column) => data.texts[column[manifoldsOf(record)[0]]] ?? '';
/** A list with one entry for each point of a record. */
const ofPoints = (record, value) => manifoldsOf(record).flatMap(m => Array.from(
  { length: data.manifolds.first[m + 1] - data.manifolds.first[m] }, (_, i) => value(data.manifolds.first[m] + i, m)));
const beforeOf = (record, frame, pair) => record < 0 ? recordOf(pair, frame - 1) : data.contacts.before[record];
/** From the frame before; unknown in the first frame. */
const changeOf = compare => (record, frame, pair) => frame ? compare(record, beforeOf(record, frame, pair)) : NaN;
const differenceOf = (name, limit = value => value) => changeOf((now, then) => limit(QUANTITIES[name](now) - QUANTITIES[name](then)));
/** Number of ids of a record that another one does not have. */
function idsOnlyIn(record, other) {
  const ids = of => ofPoints(of, (i, m) => data.texts[data.points.id[i]] && data.manifolds.triangle[m] + ' ' + data.texts[data.points.id[i]]).filter(Boolean), left = ids(other);
  return ids(record).filter(id => !left.includes(id) || !left.splice(left.indexOf(id), 1)).length;
}
const chord = (a, b, sign = 1) => Math.hypot(...Array.from(a, (x, k) => x - sign * b[k]));
const degrees = halfChord => 2 * Math.asin(Math.min(1, halfChord)) * 180 / Math.PI;
/** The larger change of the two bodies' poses. */
const ofPoses = change => (record, frame, pair) => {
  const all = data.pairs[pair].slice(0, 2).map(body => [poseOf(body, frame - 1), poseOf(body, frame)]).filter(([then, now]) => then && now);
  return frame && all.length ? Math.max(...all.map(([then, now]) => change(then, now))) : NaN;
};

/** Values of a record: lengths in metres, angles in degrees, impulses in newton seconds. data.quantities has the words of `find`. */
const QUANTITIES = {
  points: record => ofPoints(record, i => i).length,
  manifolds: record => manifoldsOf(record).length,
  separation: record => data.contacts.separation[record] ?? NaN,
  overlap: record => Math.max(0, ...ofPoints(record, i => -data.points.separation[i])),
  touching: record => data.contacts.state[record] || 0,
  axis: record => textOf(record, data.manifolds.axis),
  type: record => textOf(record, data.manifolds.type),
  ids: record => ofPoints(record, i => data.texts[data.points.id[i]]).join(', '),
  normal_x: record => normalsOf(record)[0]?.[0] ?? NaN,
  normal_y: record => normalsOf(record)[0]?.[1] ?? NaN,
  normal_z: record => normalsOf(record)[0]?.[2] ?? NaN,
  impulse: record => ofPoints(record, i => data.points.impulse[i] || 0).reduce((sum, one) => sum + one, 0),
  a: (record, frame, pair) => namesOf(pair)[0],
  b: (record, frame, pair) => namesOf(pair)[1],
  label: (record, frame, pair) => namesOf(pair)[2],
  frame: (record, frame) => data.frames[frame],
  time: (record, frame) => data.times[frame],
  age: record => data.contacts.age[record] ?? NaN,
  away: (record, frame, pair) => {
    if (record >= 0) return data.contacts.away[record];
    for (let then = frame - 1; then >= 0; --then) if (manifoldsOf(recordOf(pair, then)).length) return frame - then;
    return NaN;
  },
  normal_turn: changeOf((now, then) => normalsOf(now).length && normalsOf(then).length
    ? degrees(Math.max(...normalsOf(now).map(a => Math.min(...normalsOf(then).map(b => chord(a, b))))) / 2) : NaN),
  overlap_change: differenceOf('overlap'),
  impulse_change: differenceOf('impulse'),
  points_gained: differenceOf('points', gain => Math.max(0, gain)),
  points_lost: differenceOf('points', gain => Math.max(0, -gain)),
  ids_gained: changeOf(idsOnlyIn),
  ids_lost: changeOf((now, then) => idsOnlyIn(then, now)),
  motion: ofPoses((then, now) => chord(then.subarray(0, 3), now)),
  turn: ofPoses((then, now) => 2 * degrees(Math.min(chord(then.subarray(3), now.subarray(3)), chord(then.subarray(3), now.subarray(3), -1)) / 2)),
};
/** A quantity of the pair in the frame before. Its age is not known there. */
const previousOf = name => (record, frame, pair) =>
  frame && name !== 'age' && name !== 'away' ? QUANTITIES[name](beforeOf(record, frame, pair), frame - 1, pair) : NaN;

/** Gives each finding the indices of its frame and of all frames of its marks, in all and by body or pair, and each frame the causes at bodies and pairs. */
function nameFindings() {
  const indices = new Map(data.frames.map((frame, index) => [frame, index])), pairs = new Map(data.pairs.map(([a, b], pair) => [Math.min(a, b) + ' ' + Math.max(a, b), pair]));
  data.named = data.frames.map(() => new Map());
  data.findings.forEach(finding => { finding.marked = data.frames.map(() => []); });
  for (const finding of data.findings) {
    const both = [finding.a, finding.b].filter(Boolean).map(name => data.shapes.findIndex(shape => shape.name === name));
    Object.assign(finding, { index: indices.get(finding.frame) ?? -1, places: [], at: new Map(), body: both[0] ?? -1, pair: -1 });
    for (let i = 0; i < (finding.marks || []).length; i += 3) {
      const [frame, ...both] = finding.marks.slice(i, i + 3), index = indices.get(frame), key = both.sort((a, b) => a - b).join(' ');
      if (index === undefined) continue;
      finding.places.push(index);
      finding.marked[index].push({ key, at: finding.where[i / 3], normal: (finding.normals || [])[i / 3], step: (finding.steps || [])[i / 3], from: (finding.from || [])[i / 3] });
      finding.at.set(key, (finding.at.get(key) || new Set()).add(index));
      // A pair that the trace never has is known from here on.
      if (both[0] >= 0 && !pairs.has(key)) pairs.set(key, data.pairs.push([...both, '', '']) - 1);
      const named = data.named[index];
      if (!named.has(key)) named.set(key, { pair: pairs.get(key) ?? -1, causes: [] });
      named.get(key).causes.push(finding.cause);
    }
    if (both.length > 1) finding.pair = pairs.get([...both].sort((a, b) => a - b).join(' ')) ?? -1;
    finding.where_words = finding.index < 0 ? '' : 'frame ' + finding.frame + ', ' + (finding.pair >= 0 ? pairName(finding.pair) : [finding.a, finding.b].filter(Boolean).join(' and '));
  }
}
/** What findings about a pair or its bodies are filed under. */
function namesInLint(pair) {
  const [a, b] = data.pairs[pair].slice(0, 2).sort((a, b) => a - b);
  return [a + ' ' + b, '-1 ' + a, '-1 ' + b];
}
/** The number of findings about a pair or its bodies in a frame, of this cause or any. */
const lintOf = cause => (record, frame, pair) => {
  return namesInLint(pair).flatMap(key => data.named[frame].get(key)?.causes || []).filter(one => !cause || one === cause).length;
};

/** The word or name that is meant, as the command line has it: up to a third of the letters are wrong. */
function nearest(word, candidates) {
  const distance = other => [...other].reduce((row, letter, i) => [...word].reduce((next, own, k) =>
    [...next, Math.min(row[k] + (own !== letter), row[k + 1] + 1, next[k] + 1)], [i + 1]), Array.from({ length: word.length + 1 }, (_, k) => k)).pop();
  const near = word.length > 64 ? [] : candidates.map(other => [distance(other), other]).filter(([far, other]) => far <= Math.floor(Math.max(word.length, other.length) / 3));
  return near.sort((a, b) => a[0] - b[0]).map(([, other]) => other)[0];
}

const isTrue = value => typeof value === 'string' ? value !== '' : !Number.isNaN(value) && value !== 0;
const known = (a, b) => typeof a === typeof b && !Number.isNaN(a) && !Number.isNaN(b);
// By precedence, the weakest first. Operands are functions of (record, frame, pair).
const LEVELS = [
  { or: (a, b) => (...of) => Number(isTrue(a(...of)) || isTrue(b(...of))) },
  { and: (a, b) => (...of) => Number(isTrue(a(...of)) && isTrue(b(...of))) },
  Object.fromEntries(Object.entries({ '==': (a, b) => a === b, '!=': (a, b) => a !== b, '<': (a, b) => a < b, '<=': (a, b) => a <= b, '>': (a, b) => a > b, '>=': (a, b) => a >= b })
    .map(([name, holds]) => [name, (a, b) => (...of) => Number(known(a(...of), b(...of)) && holds(a(...of), b(...of)))])),
  { '+': (a, b) => (...of) => a(...of) + b(...of), '-': (a, b) => (...of) => a(...of) - b(...of) },
  { '*': (a, b) => (...of) => a(...of) * b(...of), '/': (a, b) => (...of) => a(...of) / b(...of) },
];
const NOT_LEVEL = 2;

/** What other engines call the quantities. */
const MEANT = { depth: 'overlap', penetration: 'overlap', penetration_depth: 'overlap', distance: 'separation', dist: 'separation', gap: 'separation', contacts: 'points', force: 'impulse', normal: 'normal_turn' };

/** The function of (record, frame, pair) that a text stands for. Throws Error with what is wrong. */
function parseExpression(text) {
  const tokens = [...text.matchAll(/\s*("[^"]*"|'[^']*'|[\d.]+(?:e[+-]?\d+)?|[a-z_][\w.]*|[=!<>]=|&&|\|\||\S)/gi)]
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
      if (tokens[at - 1] === 'N') need('s', 'after N');
      if (Number.isNaN(number)) throw new Error("'" + token + "' is not a number");
      return () => number;
    }
    if (token.split('.')[0] === 'lint') {
      const cause = token.slice(5), causes = [...new Set(data.findings.map(finding => finding.cause))];
      if (cause && !causes.includes(cause)) throw new Error("no finding has the cause '" + cause + "'; there is " + causes.join(', '));
      return lintOf(cause);
    }
    const name = token.replace(/^previous\./, ''), isPrevious = name !== token;
    if (!Object.hasOwn(data.quantities, name)) {
      const words = Object.keys(data.quantities), near = MEANT[name.toLowerCase()] || nearest(name, [...words, 'lint']);
      throw new Error("'" + token + "' is not a quantity; " + (near ? "did you mean '" + near + "'?" : 'known: ' + words.join(', ') + '; or a name of a body'));
    }
    if (isPrevious && data.quantities[name]) throw new Error("'" + name + "' is a change from the frame before; leave out 'previous.'");
    return isPrevious ? previousOf(name) : QUANTITIES[name];
  }
  const whole = level(0);
  if (at < tokens.length) throw new Error(tokens[at] === '=' ? "compare with '==', not '='" : "unexpected '" + tokens[at] + "'");
  return whole;
}

/** The bodies that a text names: this one, or those with the text in their names. */
function bodiesNamed(text) {
  const plain = text.trim().toLowerCase(), all = data.shapes.map((shape, body) => [shape.name.toLowerCase(), body]), of = fits => all.filter(([name]) => fits(name)).map(([, body]) => body);
  const same = of(name => name === plain);
  return !plain || Object.hasOwn(data.quantities, plain) ? [] : same.length ? same : of(name => name.includes(plain));
}
/** The two bodies that a text names, as 'crate, floor' or 'crate-floor'; null if it does not. */
function pairNamed(text) {
  const plain = text.trim().toLowerCase(), names = data.shapes.map(shape => shape.name.toLowerCase());
  for (const [body, name] of names.entries()) {
    const other = plain.startsWith(name) ? names.indexOf(plain.slice(name.length).replace(/^\s*(,|-|and\b)?\s*/, '')) : -1;
    if (other >= 0) return [body, other];
  }
  return null;
}
/** All [frame, record, pair] for which the expression is true. A pair that has just left the trace, or that a finding names, has the record -1. */
function findRecords(text) {
  const two = pairNamed(text), isOfTwo = (record, frame, pair) => Number(two.every(body => data.pairs[pair].slice(0, 2).includes(body)));
  const expression = two ? isOfTwo : parseExpression(text), pairsOf = frame => frame < 0 ? [] : recordsOf(frame).map(record => data.contacts.pair[record]);
  return data.frames.flatMap((_, frame) => {
    const here = new Set(pairsOf(frame)), gone = new Set([...pairsOf(frame - 1), ...[...data.named[frame].values()].map(({ pair }) => pair)].filter(pair => pair >= 0 && !here.has(pair)));
    return [...recordsOf(frame).map(record => [frame, record, data.contacts.pair[record]]), ...[...gone].map(pair => [frame, -1, pair])]
      .filter(([frame, record, pair]) => isTrue(expression(record, frame, pair)));
  });
}
