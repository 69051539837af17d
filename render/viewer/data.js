'use strict';
(() => {  // one scope for all scripts; main.js ends it
// The trace's facts: integers (facts.h), decoded into arrays that the other scripts index.

let data = null;  // set by main.js, before anything is shown
const byId = id => document.getElementById(id);

const takeText = id => {
  const element = byId(id);
  element.remove();
  return element.textContent.trim();
};
/** Bytes of a text: a zlib stream, each 13 bits of it as two of 91 characters (viewer.cpp). */
async function inflate(text) {
  const digits = new TextEncoder().encode(text).map(code => code - (code > 60 ? 36 : 35)), bytes = new Uint8Array((text.length >> 1) * 13 + (text.length & 1) * 6 >> 3);
  for (let i = 0, at = 0, bits = 0, count = 0; at < bytes.length; i += 2) {
    bits |= (digits[i] + 91 * (digits[i + 1] || 0)) << count;
    for (count += 13; count >= 8; count -= 8, bits >>>= 8) bytes[at++] = bits;
  }
  const stream = new DecompressionStream('deflate'), writer = stream.writable.getWriter();
  writer.write(bytes);
  writer.close();
  return new Uint8Array(await new Response(stream.readable).arrayBuffer());
}

const CONTEXTS = 33, SLOTS = 32, FIELD_SLOTS = CONTEXTS * SLOTS + 4 * 33;  // as in facts.h
/** `size` last values, and then the bits of their last differences. */
const lastOf = size => new Int32Array(2 * size);

/** The coder of facts.h, backwards: read(field, last, k) is the next integer, which is also written to last[k]. Signed integers, since others would be floats. */
function reader(bytes, at, fields) {
  const zeros = new Uint16Array(fields * FIELD_SLOTS).fill(32768), part = new Int32Array([-1, 0]), RANGE = 0, CODE = 1, SIGN = 1 << 31;  // of [0, 1), times 2^32
  for (let i = 0; i < 4; ++i) part[CODE] = part[CODE] << 8 | bytes[at++];
  return (field, last, k = 0) => {
    const slots = field * FIELD_SLOTS, size = last.length >> 1, context = slots + last[size + k] * SLOTS;
    let range = part[RANGE], code = part[CODE], node = 0, left = -1, upper = 0, rest = 0, zigzag = 1;
    last[size + k] = 0;
    for (let slot = context; ;) {
      const zero = zeros[slot], bound = Math.imul(range >>> 16, zero), one = (code ^ SIGN) >= (bound ^ SIGN) ? 1 : 0;
      code = code - (one ? bound : 0) | 0;
      range = one ? range - bound | 0 : bound;
      zeros[slot] = one ? zero - (zero >> 5) : zero + (65536 - zero >> 5);
      for (; range >>> 24 === 0; range <<= 8) code = code << 8 | bytes[at++];
      if (left >= 0) {  // one of the upper bits
        zigzag = 2 * zigzag + one;
        --left;
      } else if (node || one) {  // the number of bits
        node = 2 * node + one;
        if (node < 32) {
          slot = context + node;
          continue;
        }
        left = node - 32;  // bits after the first one
        last[size + k] = left + 1;
        upper = slots + CONTEXTS * SLOTS + 4 * left;
        rest = Math.max(0, left - 2);
      } else {
        left = rest = -1;  // no difference
      }
      if (left <= rest) break;
      slot = upper + (zigzag & 3 | (zigzag < 2 ? 0 : 2));
    }
    while (left > 0) {
      const some = Math.min(left, 16);
      range >>>= some;
      const digits = (code >>> 0) / range | 0;
      code = code - Math.imul(digits, range) | 0;
      zigzag = zigzag << some | digits;
      left -= some;
      for (; range >>> 24 === 0; range <<= 8) code = code << 8 | bytes[at++];
    }
    part[RANGE] = range;
    part[CODE] = code;
    return left < 0 ? last[k] : last[k] += (zigzag >>> 1) ^ -(zigzag & 1);
  };
}

const bits = new Int32Array(1), asFloat = new Float32Array(bits.buffer);
/** An impulse of its upper bits; NaN: not recorded. */
const impulseOf = steps => steps === 0 ? NaN : ((bits[0] = (steps - 1) << 13), asFloat[0]);
/** Multiples of a step, or the upper bits of so many. */
const fineOf = steps => Math.abs(steps) < 2048 ? steps : ((bits[0] = (Math.abs(steps) + (137 << 11)) << 12), Math.sign(steps) * asFloat[0]);

/** Posts what is the same in all frames, then all other facts. */
async function unpack(text, post) {
  const bytes = await inflate(text), length = new DataView(bytes.buffer).getUint32(0, true);
  data = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  data.forms = data.forms.map(form => JSON.parse(form));
  data.shapes = Object.entries(data.header.shapes).map(([name, shape]) => ({ ...shape, name }));
  post(data);
  const all = contactsOf(data, reader(bytes, 4 + length, data.fields.FIELDS));
  Object.assign(data, all);
  all.totals = totals();
  post(all, Object.values(all).flatMap(one => one.buffer || Object.values(one).map(list => list.buffer)));
}
/** All that changes from frame to frame. */
function contactsOf(data, read) {
  const { POSES, POSE_BODY, POSE, PAIRS, PAIR, STEADY, LAYOUT_SIZE, LAYOUT, SEPARATION, NORMAL, POINT, SAME, INTEGER, TEXT, SCALAR, PLACE, UNIT, FIELDS } = data.fields;
  const { counts, quantum, unit, units, place: step, fine } = data, frames = data.frames.length, bodies = data.shapes.length, single = Array.from({ length: FIELDS }, () => lastOf(1)), lastPose = data.shapes.map(() => lastOf(7));
  const next = (field, predicted = 0) => ((single[field][0] = predicted), read(field, single[field]));
  const listOf = (size, kind = Int32Array) => new kind(size);
  data.poseOf = listOf(frames * bodies).fill(-1);   // frame * bodies + body -> pose
  data.pose = listOf(7 * counts.poses, Float64Array);  // position, rotation w, x, y, z
  // frame -> records of pairs -> manifolds -> points
  const contacts = data.contacts = { first: listOf(frames + 1), pair: listOf(counts.records), state: listOf(counts.records), manifolds: listOf(counts.records + 1),
    separation: listOf(counts.records, Float64Array), stages: listOf(counts.records),  // 1 + index of a form
    values: listOf(counts.records),                     // the first of the stages' values
    before: listOf(counts.records).fill(-1),            // the pair's record in the frame before; -1: none
    age: listOf(counts.records, Float32Array).fill(NaN), away: listOf(counts.records, Float32Array).fill(NaN) };  // as in `find`, frames
  const manifolds = data.manifolds = { axis: listOf(counts.manifolds), type: listOf(counts.manifolds), triangle: listOf(counts.manifolds), first: listOf(counts.manifolds + 1),
    normal: listOf(3 * counts.manifolds, Float64Array) };
  const points = data.points = { id: listOf(counts.points), position: listOf(3 * counts.points, Float64Array), separation: listOf(counts.points, Float64Array),
    impulse: listOf(counts.points, Float32Array), friction: listOf(counts.points, Float32Array) };
  const values = data.values = listOf(counts.values), last = data.pairs.map((_, pair) => ({ follower: lastOf(1).fill(pair + 1, 0, 1), steady: lastOf(1), gap: lastOf(1),
    layout: [], normals: [], points: [], leaves: new Map(), frame: -2, record: -1, touched: -1, since: 0, away: NaN }));
  const kinds = data.forms.map(form => leavesOf(form));
  let pose = 0, record = 0, manifold = 0, point = 0, value = 0, previous = 0;
  for (let frame = 0; frame < frames; ++frame) {
    for (let left = next(POSES), body = 0; left > 0; --left, ++body, ++pose) {
      body = next(POSE_BODY, body);
      data.poseOf[frame * bodies + body] = pose;
      for (let k = 0; k < 7; ++k) data.pose[7 * pose + k] = read(POSE + k, lastPose[body], k) * (k < 3 ? quantum : 1 / units);
    }
    for (let left = next(PAIRS, single[PAIRS][0]); left > 0; --left, ++record) {
      previous = contacts.pair[record] = read(PAIR, last[previous].follower);
      const known = last[previous];
      if (!read(STEADY, known.steady)) {
        known.layout.length = next(LAYOUT_SIZE, known.layout.length);
        for (let i = 0; i < known.layout.length; ++i) known.layout[i] = next(LAYOUT, known.layout[i] || 0);
      }
      const state = known.layout[0], form = known.layout[1], count = known.layout[2], seen = form ? { [INTEGER]: [], [TEXT]: [], [SCALAR]: [], [PLACE]: [], [UNIT]: [] } : null;
      contacts.state[record] = state;
      if (known.frame === frame - 1) contacts.before[record] = known.record;
      Object.assign(known, { frame, record });
      const touches = count > 0, away = known.touched < 0 ? NaN : frame - known.touched;
      if (touches && known.touched !== frame - 1) [known.since, known.away] = [frame, away - 1];
      if (touches) known.touched = frame;
      contacts.age[record] = touches ? frame - known.since : NaN;
      contacts.away[record] = touches ? known.away : away;
      let place = 0, deepest = 2147483647, at = 3;  // of the layout
      for (let m = 0; m < count; ++m, ++manifold) {
        const normal = known.normals[m] ??= m ? known.normals[m - 1].slice() : lastOf(3);
        for (let k = 0; k < 3; ++k) manifolds.normal[3 * manifold + k] = read(NORMAL + k, normal, k) * unit;
        manifolds.axis[manifold] = known.layout[at++];
        manifolds.type[manifold] = known.layout[at++];
        manifolds.triangle[manifold] = known.layout[at++];
        if (form) seen[UNIT].push(normal.slice(0, 3));
        for (let left = known.layout[at++]; left > 0; --left, ++place, ++point) {
          const now = known.points[place] ??= place ? known.points[place - 1].slice() : lastOf(6);
          for (let k = 0; k < 6; ++k) read(POINT + k, now, k);
          for (let k = 0; k < 3; ++k) points.position[3 * point + k] = now[k] * step;
          points.separation[point] = fineOf(now[3]) * fine;
          points.impulse[point] = impulseOf(now[4]);
          points.friction[point] = impulseOf(now[5]);
          points.id[point] = known.layout[at++];
          deepest = Math.min(deepest, now[3]);
          if (form) seen[PLACE].push(now.slice(0, 3));
          if (form) seen[SCALAR].push(now.slice(3, 4));
        }
        manifolds.first[manifold + 1] = point;
      }
      if (place) known.gap[0] = deepest;
      contacts.separation[record] = fineOf(read(SEPARATION, known.gap)) * fine;
      contacts.manifolds[record + 1] = manifold;
      contacts.stages[record] = form;
      contacts.values[record] = value;
      if (!form) continue;
      if (!known.leaves.has(form)) known.leaves.set(form, []);
      const rows = known.leaves.get(form);
      kinds[form - 1].forEach((kind, i) => {
        rows[i] ??= lastOf(4);
        const size = kind >= PLACE ? 3 : 1, same = kind >= SCALAR ? read(SAME, rows[i], 3) : 0;
        for (let k = 0; k < size && !same; ++k) read(kind + k, rows[i], k);
        const now = same ? seen[kind][same - 1] : rows[i].slice(0, size);
        if (!same) seen[kind].push(now);
        values.set(now, value);
        value += size;
      });
    }
    contacts.first[frame + 1] = record;
  }
  return { poseOf: data.poseOf, pose: data.pose, contacts, manifolds, points, values };
}

const failureOf = error => ({ error: 'its facts cannot be unpacked (' + error.message + ')' });
/** Promises of what unpack() posts. It runs next to the page, which starts WebGL meanwhile, unless no worker is allowed. */
function unpacked(text, script) {
  const done = [], parts = [0, 1].map(i => new Promise((resolve, reject) => { done[i] = { resolve, reject }; }));
  const post = part => part.error ? done.forEach(({ reject }) => reject(new Error(part.error))) : done[part.header ? 0 : 1].resolve(part);
  const here = () => unpack(text, post).catch(error => post(failureOf(error)));
  try {
    const worker = new Worker(URL.createObjectURL(new Blob([script])));
    Object.assign(worker, { onmessage: event => post(event.data), onerror: here });
    worker.postMessage(text);
  } catch {
    here();
  }
  return parts;
}

/** The kinds of the values in a form, in their order. */
const leavesOf = form => typeof form === 'number' ? [form] : typeof form === 'object' && form ? Object.values(form).flatMap(leavesOf) : [];

/** Calls `look(point, manifold)` for the points of a record of a pair, in order. */
function eachPoint(record, look) {
  for (let m = data.contacts.manifolds[record]; m < data.contacts.manifolds[record + 1]; ++m)
    for (let i = data.manifolds.first[m]; i < data.manifolds.first[m + 1]; ++i) look(i, m);
}
const recordsOf = frame => Array.from({ length: data.contacts.first[frame + 1] - data.contacts.first[frame] }, (_, i) => data.contacts.first[frame] + i);
/** The frame's five deepest records. */
const deepestOf = frame => recordsOf(frame).sort((a, b) => data.contacts.separation[a] - data.contacts.separation[b]).slice(0, 5);
/** The frame's record of a pair; -1: none. */
const recordOf = (pair, frame) => data.contacts.pair.subarray(0, data.contacts.first[frame + 1]).indexOf(pair, data.contacts.first[frame]);
/** The stages of a record, from their form and values. */
function stagesOf(record) {
  let at = data.contacts.values[record];
  const triple = step => [0, 1, 2].map(() => data.values[at++] * step);
  const { INTEGER, TEXT, SCALAR, PLACE, UNIT } = data.fields;
  const of = { [INTEGER]: () => data.values[at++], [TEXT]: () => data.texts[data.values[at++]], [SCALAR]: () => fineOf(data.values[at++]) * data.fine,
    [PLACE]: () => triple(data.place), [UNIT]: () => triple(data.unit) };
  const fill = form => typeof form === 'number' ? of[form]() : Array.isArray(form) ? form.map(fill)
    : form && typeof form === 'object' ? Object.fromEntries(Object.entries(form).map(([name, inner]) => [name, fill(inner)])) : form;
  return data.contacts.stages[record] ? fill(data.forms[data.contacts.stages[record] - 1]) : {};
}
const namesOf = pair => [data.shapes[data.pairs[pair][0]].name, data.shapes[data.pairs[pair][1]].name, data.pairs[pair][2]];
const pairName = pair => namesOf(pair).slice(0, 2).join(' and ') + (data.pairs[pair][2] && ' (' + data.pairs[pair][2] + ')');
const positionOf = point => data.points.position.subarray(3 * point, 3 * point + 3);
/** A body's pose in a frame; null without one. */
const poseOf = (body, frame) => {
  const i = data.poseOf[frame * data.shapes.length + body];
  return i < 0 ? null : data.pose.subarray(7 * i, 7 * i + 7);
};
/** Metres per second, from the poses of this frame and the one before; zero where one is missing. */
function velocityOf(body, frame) {
  const now = poseOf(body, frame), then = frame ? poseOf(body, frame - 1) : null, time = data.times[frame] - data.times[frame - 1];
  return [0, 1, 2].map(k => now && then && time > 0 ? (now[k] - then[k]) / time : 0);
}
/** Names a point of a pair in any frame: its id, or its place in the list where ids are missing; and a number where they are double. */
function pointKey(point, record) {
  const first = data.manifolds.first[data.contacts.manifolds[record]], { id } = data.points, same = id.subarray(first, point).filter(one => one === id[point]).length;
  return data.texts[id[point]] ? data.texts[id[point]] + (same ? '~' + same : '') : '#' + (point - first);
}
/** As lint names it. */
function pointName(point, m, record) {
  const manifold = m - data.contacts.manifolds[record];
  return 'point ' + (point - data.manifolds.first[m]) + (manifold ? ' of manifold ' + manifold : '');
}

/** Totals of each frame for the timeline: overlap (m), points, impulse (N s); and the deepest point. */
function totals() {
  const column = () => new Float64Array(data.frames.length), all = { overlap: column(), points: column(), impulse: Float64Array.from(data.impulses), worst: column().fill(-1) };
  data.frames.forEach((_, frame) => recordsOf(frame).forEach(record => eachPoint(record, i => {
    ++all.points[frame];
    if (-data.points.separation[i] <= all.overlap[frame]) return;
    all.overlap[frame] = -data.points.separation[i];
    all.worst[frame] = i;
  })));
  return all;
}

// ---- Numbers in words: three digits, units always, a minus sign

const digits = value => (Math.abs(value) >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(3)))).replace('-', '\u2212');
/** Three digits, or those that are certain (facts.cpp). */
const metres = value => {
  if (!Number.isFinite(value) || value === 0) return value === 0 ? '0 mm' : '';
  const least = Math.ceil(Math.log10(data.fine)), last = Math.max(Math.floor(Math.log10(Math.abs(value))) - 2, least);
  const rounded = Math.round(value / 10 ** last) * 10 ** last, size = Math.abs(rounded) || 10 ** least;
  const [power, unit] = size >= 1 ? [0, ' m'] : size >= 0.99e-4 ? [3, ' mm'] : size >= 0.99e-7 ? [6, ' \u00b5m'] : [9, ' nm'];
  const more = size >= 10 ** (last + 3) * (1 - 1e-9) ? 1 : 0;  // 9.996 is 10.0
  return ((rounded ? '' : '< ') + ((rounded || size) * 10 ** power).toFixed(Math.max(0, -last - more - power))).replace('-', '\u2212') + unit;
};
const newtonSeconds = value => digits(value) + ' N s';
const gapRow = separation => separation > 0 ? ['gap', metres(separation)] : ['overlap', metres(-separation || 0)];
/** Thousandths, or fewer where positions are coarser. */
const vectorText = v => {
  const decimals = Math.min(3, Math.max(0, -Math.ceil(Math.log10(data.place))));
  return '(' + Array.from(v, x => String(Number(x.toFixed(decimals)) || 0).replace('-', '\u2212')).join(', ') + ')';
};
