// Reads a request of `contactscope versus` and writes the answer: src/versus/README.md. Lengths in metres.

import { readFileSync, writeSync } from "node:fs";

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** A vector turned by a quaternion w, x, y, z. */
export function turned([w, x, y, z], v) {
  const t = scaled(cross([x, y, z], v), 2);
  return add(add(v, scaled(t, w)), cross([x, y, z], t));
}
export const placed = (pose, v) => add(turned(pose.quat_wxyz, v), pose.position);

/** Half the extents and the middle of a box's vertices, which lie along its own axes. */
export function halfExtents(shape) {
  const range = (axis) => {
    const values = shape.vertices.map((v) => v[axis]);
    return [Math.min(...values), Math.max(...values)];
  };
  const ranges = [0, 1, 2].map(range);
  return {
    half: ranges.map(([low, high]) => (high - low) / 2),
    middle: ranges.map(([low, high]) => (high + low) / 2),
  };
}

export const isCentered = (shape) => halfExtents(shape).middle.every((m) => Math.abs(m) < 1e-9);

/** Bodies of these are not moved by any engine. */
export const stands = (shape) => ["mesh", "plane"].includes(shape.type);

/** The segment of a capsule: its middle, its length and the direction of it, +y where it has none. */
export function segmentOf(shape) {
  const [from, to] = shape.vertices, along = sub(to, from), length = Math.sqrt(dot(along, along));
  const direction = length > 0 ? scaled(along, 1 / length) : [0, 1, 0];
  return { middle: scaled(add(from, to), 0.5), length, direction };
}

/** w, x, y, z of the shortest turn from one direction to another, both unit. */
export function turnBetween(from, to) {
  const w = 1 + dot(from, to);
  // Half a turn about anything across.
  if (w < 1e-9) return Math.abs(from[2]) < 0.9 ? turnBetweenOpposite(from, [0, 0, 1]) : [0, 1, 0, 0];
  const axis = cross(from, to), length = Math.hypot(w, ...axis);
  return [w, ...axis].map((x) => x / length);
}
const turnBetweenOpposite = (from, across) => {
  const axis = cross(from, across), length = Math.hypot(...axis);
  return [0, ...axis.map((x) => x / length)];
};

/** Adds a point to the manifold of its pair and normal, for engines that tell point by point. */
export function addPoint(manifolds, a, b, normal, point) {
  const same = manifolds.find((m) => m.a === a && m.b === b && dot(m.normal, normal) > 0.99999);
  if (same === undefined) manifolds.push({ a, b, normal, points: [point] });
  else same.points.push(point);
}

/** Each face as triangles around its first vertex. */
export function triangles(shape) {
  return shape.faces.flatMap((f) => f.slice(2).map((last, i) => [f[0], f[i + 1], last]));
}

/** What cannot be given to an engine is said once, on standard error. */
const said = new Set();
export function leftOut(name, why) {
  if (!said.has(name)) process.stderr.write(`'${name}' is left out: ${why}\n`);
  said.add(name);
}

/** What stands on the standard input. */
export const requestLines = () => readFileSync(0, "utf8").split("\n").filter((line) => line.trim() !== "");

/** Writes a text on the standard output, whole: a pipe takes a piece at a time. */
export function write(text) {
  let rest = Buffer.from(text);
  while (rest.length > 0) {
    try {
      rest = rest.subarray(writeSync(1, rest));
    } catch (error) {
      if (error.code !== "EAGAIN") throw error;
    }
  }
}

/** Whether a manifold can be written: it has points and a unit normal. */
export function isWhole(engine, frame, { a, b, normal, points }) {
  if (points.length === 0) return false;
  if (Math.abs(dot(normal, normal) - 1) < 1e-3) return true;
  leftOut(`${a}-${b}`, `${engine} has no normal of it in frame ${frame}`);
  return false;
}

/** Manifolds {a, b, ...} as the pairs of a frame. */
function pairsOf(engine, frame, manifolds) {
  const pairs = [];
  for (const { a, b, ...manifold } of manifolds.filter((one) => isWhole(engine, frame, one))) {
    let pair = pairs.find((p) => p.a === a && p.b === b);
    if (pair === undefined) pairs.push((pair = { a, b, manifolds: [] }));
    pair.manifolds.push(manifold);
  }
  return pairs;
}

/**
 * Answers a request. `contacts(frame, shapes)` is called for each frame with its poses by name; it returns
 * manifolds {a, b, normal, points: [{position, separation, on_a, on_b, id}]}, the normal from a to b.
 */
export async function answer(engine, version, contacts) {
  const lines = requestLines();
  const header = JSON.parse(lines[0]);
  const send = (value) => write(JSON.stringify(value) + "\n");
  send({ ...header, engine, version });
  const shapes = { ...header.shapes };
  for (const line of lines.slice(1)) {
    const frame = JSON.parse(line);
    Object.assign(shapes, frame.shapes ?? {});
    const asked = frame.pairs.map(({ a, b }) => [a, b]);
    const manifolds = await contacts(frame, shapes, asked);
    const pairs = pairsOf(engine, frame.frame, manifolds);
    send({ frame: frame.frame, time: frame.time, poses: frame.poses, pairs });
  }
}

/** Whether a pair is among those that were asked for, in either order. */
export const isAsked = (asked, a, b) =>
  asked.some(([x, y]) => (x === a && y === b) || (x === b && y === a));

/** The version of an installed package, as its package.json says. */
export function versionOf(name) {
  const file = new URL(`node_modules/${name}/package.json`, import.meta.url);
  return `npm ${name} ${JSON.parse(readFileSync(file, "utf8")).version}`;
}
