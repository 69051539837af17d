'use strict';
(() => {  // one scope for all scripts; main.js ends it
// The trace's facts: columns of integers (facts.h), decoded into arrays that the other scripts index.

let data = null;  // set once by main.js, before anything is shown
const byId = id => document.getElementById(id);

/** Bytes of an element's text: base64 of a zlib stream. */
async function inflate(element) {
  const text = atob(element.textContent.trim()), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  element.remove();
  const stream = new DecompressionStream('deflate'), writer = stream.writable.getWriter();
  writer.write(bytes);
  writer.close();
  return new Uint8Array(await new Response(stream.readable).arrayBuffer());
}

function decode(bytes, at, count) {
  const numbers = new Int32Array(count);
  for (let i = 0; i < count; ++i) {
    let number = 0, shift = 0, byte;
    do {
      number |= ((byte = bytes[at++]) & 127) << shift;
      shift += 7;
    } while (byte & 128);
    numbers[i] = (number >>> 1) ^ -(number & 1);
  }
  return numbers;
}

/** Starts of the lists whose lengths are `counts`, and the end of the last one. */
function starts(counts) {
  const all = new Int32Array(counts.length + 1);
  counts.forEach((count, i) => { all[i + 1] = all[i] + count; });
  return all;
}

/** An impulse of its upper bits; NaN: not recorded. */
const bits = new Int32Array(1), asFloat = new Float32Array(bits.buffer);
const floatOf = steps => steps === 0 ? NaN : ((bits[0] = (steps - 1) << 11), asFloat[0]);

function unpack(bytes) {
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const data = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let at = 4 + length;
  const columns = data.columns.map(([count, size]) => decode(bytes, (at += size) - size, count));
  const next = () => columns.shift(), several = count => Array.from({ length: count }, next);
  const frames = data.frames.length, q = data.quantum, fine = q / 256;

  data.shapes = Object.entries(data.header.shapes).map(([name, shape]) => ({ ...shape, name }));
  const bodies = data.shapes.length, poses = starts(next()), poseBody = next(), pose = several(7), lastPose = new Int32Array(bodies * 7);
  data.poseOf = new Int32Array(frames * bodies).fill(-1);  // frame * bodies + body -> pose
  data.pose = new Float32Array(poseBody.length * 7);       // position, rotation w, x, y, z
  for (let frame = 0; frame < frames; ++frame)
    for (let i = poses[frame], body = 0; i < poses[frame + 1]; ++i, ++body) {
      data.poseOf[frame * bodies + (body += poseBody[i])] = i;
      for (let k = 0; k < 7; ++k) data.pose[7 * i + k] = (lastPose[7 * body + k] += pose[k][i]) * (k < 3 ? q : 1 / data.units);
    }

  // frame -> records of pairs -> manifolds -> points
  const contacts = data.contacts = { first: starts(next()), pair: next(), state: next() }, separation = next();
  Object.assign(contacts, { stages: next(), manifolds: starts(next()), separation: new Float64Array(separation.length),
    before: new Int32Array(separation.length).fill(-1),  // the pair's record in the frame before; -1: none
    age: new Float32Array(separation.length).fill(NaN), away: new Float32Array(separation.length).fill(NaN) });  // as in `find`, frames
  const normal = several(3), manifolds = data.manifolds = { axis: next(), type: next(), triangle: next(), first: starts(next()) };
  manifolds.normal = new Float32Array(normal[0].length * 3);
  const point = several(7), count = point[0].length, points = data.points = { id: new Int32Array(count), position: new Float64Array(3 * count),
    separation: new Float64Array(count), impulse: new Float32Array(count), friction: new Float32Array(count) };
  const last = data.pairs.map(() => ({ points: [], normal: new Int32Array(3), frame: -2, record: -1, touched: -1, since: 0, away: NaN }));
  for (let frame = 0; frame < frames; ++frame)
    for (let record = contacts.first[frame]; record < contacts.first[frame + 1]; ++record) {
      const known = last[contacts.pair[record]];
      if (known.frame === frame - 1) contacts.before[record] = known.record;
      Object.assign(known, { frame, record });
      const touches = contacts.manifolds[record] < contacts.manifolds[record + 1], away = known.touched < 0 ? NaN : frame - known.touched;
      if (touches && known.touched !== frame - 1) [known.since, known.away] = [frame, away - 1];
      if (touches) known.touched = frame;
      contacts.age[record] = touches ? frame - known.since : NaN;
      contacts.away[record] = touches ? known.away : away;
      let place = 0, deepest = 2147483647;
      for (let m = contacts.manifolds[record]; m < contacts.manifolds[record + 1]; ++m) {
        for (let k = 0; k < 3; ++k) manifolds.normal[3 * m + k] = (known.normal[k] += normal[k][m]) / data.units;
        for (let i = manifolds.first[m]; i < manifolds.first[m + 1]; ++i, ++place) {
          const now = known.points[place] ??= place ? known.points[place - 1].slice() : new Int32Array(7);
          for (let k = 0; k < 7; ++k) now[k] += point[k][i];
          for (let k = 0; k < 3; ++k) points.position[3 * i + k] = now[k] * q;
          points.separation[i] = now[3] * fine;
          points.impulse[i] = floatOf(now[4]);
          points.friction[i] = floatOf(now[5]);
          points.id[i] = now[6];
          deepest = Math.min(deepest, now[3]);
        }
      }
      contacts.separation[record] = ((place && deepest) + separation[record] | 0) * fine;
    }
  return data;
}

/** Calls `look(point, manifold)` for the points of a record of a pair, in order. */
function eachPoint(record, look) {
  for (let m = data.contacts.manifolds[record]; m < data.contacts.manifolds[record + 1]; ++m)
    for (let i = data.manifolds.first[m]; i < data.manifolds.first[m + 1]; ++i) look(i, m);
}
const recordsOf = frame => Array.from({ length: data.contacts.first[frame + 1] - data.contacts.first[frame] }, (_, i) => data.contacts.first[frame] + i);
/** The frame's record of a pair; -1: none. */
const recordOf = (pair, frame) => data.contacts.pair.subarray(0, data.contacts.first[frame + 1]).indexOf(pair, data.contacts.first[frame]);
const stagesOf = record => data.contacts.stages[record] ? data.stages[data.contacts.stages[record] - 1] : {};
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
  return data.texts[id[point]] ? data.texts[id[point]] + (same ? '~' + same : '') : '#' + (point - first + 1);
}

/** Totals of each frame for the timeline: overlap (m), points, impulse (N s); and the deepest point. */
function totals() {
  const column = () => new Float64Array(data.frames.length), all = { overlap: column(), points: column(), impulse: column(), worst: column().fill(-1) };
  data.frames.forEach((_, frame) => recordsOf(frame).forEach(record => eachPoint(record, i => {
    ++all.points[frame];
    all.impulse[frame] += data.points.impulse[i] || 0;
    if (-data.points.separation[i] <= all.overlap[frame]) return;
    all.overlap[frame] = -data.points.separation[i];
    all.worst[frame] = i;
  })));
  return all;
}

// ---- Numbers in words: three digits, units always, a minus sign

const digits = value => (Math.abs(value) >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(3)))).replace('-', '\u2212');
const metres = value => {
  const [factor, unit] = Math.abs(value) >= 1 || value === 0 ? [1, ' m'] : Math.abs(value) >= 1e-4 ? [1e3, ' mm'] : [1e6, ' \u00b5m'];
  return digits(value * factor) + unit;
};
const newtonSeconds = value => digits(value) + ' N s';
const gapRow = separation => separation > 0 ? ['gap', metres(separation)] : ['overlap', metres(-separation || 0)];
const vectorText = v => '(' + Array.from(v, x => digits(Math.abs(x) < 5e-4 ? 0 : Number(x.toFixed(3)))).join(', ') + ')';
