/**
 * Records the contacts of a physics engine as a trace for contactscope.
 *
 * Node 18 or later, or a browser, without packages; copy this file next to the program. The bytes are those that
 * contactscope.h writes for the same calls; `doubles` is set unless an option says otherwise.
 *
 *     import { Recorder } from "./contactscope.mjs";
 *
 *     const recorder = new Recorder("run.jsonl", "mine/stack", { engine: "my engine", version: "1.0" });
 *     const floor = recorder.plane("floor", [0, 1, 0], 0);
 *     const crate = recorder.box("crate", 0.5, 0.5, 0.5);
 *     while (running) {
 *       recorder.frame(time, () => {
 *         recorder.pose(crate, body.position, body.quaternion);  // every shape in this frame
 *         recorder.manifold(floor, crate, normal, [{ position, separation }]);  // every pair in contact
 *       });
 *     }
 *     recorder.stop();
 *
 * `contactscope render run.jsonl` draws the trace, `contactscope lint run.jsonl` checks it.
 *
 * Conventions: metres, world space. Normals are unit and point from a to b. A negative separation is an overlap.
 * Impulses are newton seconds and act on b, unless the recorder is told otherwise.
 *
 * Each frame is written when it ends, so a crash loses no earlier frame. Wrong arguments throw a TypeError or a
 * RangeError before anything is recorded of them. Arguments are copied, so an engine may reuse its vectors.
 *
 * MIT License; the text is in contactscope.h.
 *
 * @typedef {ArrayLike<number> | { x: number, y: number, z: number }} Vector  Three numbers: an array, a typed array,
 *   or a vector of Rapier, cannon-es, three.js or Babylon.js.
 * @typedef {ArrayLike<number> | { w: number, x: number, y: number, z: number }} Quaternion  Unit. Arrays are in the
 *   order w, x, y, z; `quaternion.toArray()` of three.js has another order, so pass the quaternion itself.
 * @typedef {Iterable<Vector> | ArrayLike<number>} Vectors  A list of vectors, or all of their numbers in one array.
 * @typedef {{ write(text: string): unknown }} Sink  Receives whole lines; `process.stdout` is one.
 *
 * @typedef {object} Point  A contact point.
 * @property {Vector} position  Metres, world.
 * @property {number} separation  Metres; negative: overlap.
 * @property {Vector | null} [onA]  The point on the surface of a, metres, world. Both sides or none.
 * @property {Vector | null} [onB]  The point on the surface of b, metres, world.
 * @property {number | null} [impulse]  Along the normal, over the step, newton seconds.
 * @property {Vector | null} [friction]  Newton seconds, a vector perpendicular to the normal; for points with `impulse`.
 * @property {number | bigint | null} [id]  Identifies the point across frames, 0 to 2^64 - 1.
 * @property {boolean} [idle]  A speculative point that the solver did not act on.
 *
 * @typedef {object} Options
 * @property {string | null} [engine]
 * @property {string | null} [version]
 * @property {boolean} [doubles]  True, the default: the engine computes in double, write 17 digits; false: in float,
 *   write 9, as for Rapier, Jolt, PhysX and Havok.
 * @property {boolean} [zUp]  z points up, else y.
 * @property {"contacts" | "before_step" | "after_step"} [posesAt]  Time of the poses: that of the contacts, or before
 *   or after their step.
 * @property {number} [forceStep]  Above 0: impulses are forces in newtons over a step of this many seconds.
 * @property {boolean} [frictionOnA]  Friction acts on a, not on b.
 *
 * @typedef {[number, number, number]} Triple
 * @typedef {[number, number, number, number]} Turn  w, x, y, z
 * @typedef {{ place: Triple, turn: Turn }} Pose
 * @typedef {{ position: Triple, separation: number, sides: Triple[] | null, impulse: number | null, friction: Triple,
 *   id: bigint | null, idle: boolean }} Checked
 */

// Not imported by name: a browser has no files, and bundlers leave a variable name alone.
const fileModule = "node:fs";
const files = globalThis.process?.versions?.node ? await import(/* @vite-ignore */ /* webpackIgnore: true */ fileModule) : null;

const kOptions = ["engine", "version", "doubles", "zUp", "posesAt", "forceStep", "frictionOnA"];
const kPointKeys = ["position", "separation", "onA", "onB", "impulse", "friction", "id", "idle"];
const kBoxFaces = "[[0,4,6,2],[1,3,7,5],[0,1,5,4],[2,6,7,3],[0,2,3,1],[4,5,7,6]]";

/** A trace. */
export class Recorder {
  #digits;
  #zUp;
  /** @type {Sink | null} */ #sink;
  /** @type {number | null} */ #file = null;
  /** @type {string | null} */ #head;  // until it is written
  /** @type {string[]} */ #names = [];  // by shape, as JSON
  #taken = new Set();
  /** @type {(string | null)[]} */ #shapes = [];  // by shape: entry without closing brace; null: a compound, or written
  /** @type {Map<number, number>} */ #margins = new Map();  // metres, by shape
  /** @type {Map<number, { compound: number, pose: Pose }>} */ #parts = new Map();  // by shape
  /** @type {Set<number>} */ #compounds = new Set();
  /** @type {Set<string>} */ #notes = new Set();
  #number = 0;
  /** @type {number | null} */ #time = null;  // of the frame that has begun
  /** @type {Map<number, Pose>} */ #poses = new Map();
  /** @type {{ a: number, b: number, triangle: number, normal: Triple, points: Checked[] }[]} */ #manifolds = [];
  /** @type {{ shape: number, mass: number, vectors: Triple[] }[]} */ #bodies = [];
  /** @type {[number, number, boolean] | null} */ #solver = null;

  /**
   * @param {string | URL | Sink} target  A file, replaced if it exists (Node only), or an object with `write(text)`.
   * @param {string} scenario  GROUP/IDEA, the folder of its pictures.
   * @param {Options} [options]
   */
  constructor(target, scenario, options = {}) {
    onlyKeys(options, kOptions, "options");
    const { engine, version, doubles = true, zUp = false, posesAt = "contacts", forceStep = 0, frictionOnA = false } = options;
    if (!["contacts", "before_step", "after_step"].includes(posesAt))
      throw new RangeError(`posesAt is ${shown(posesAt)}; pass "contacts", "before_step" or "after_step"`);
    const step = scalar(forceStep, "forceStep");
    if (typeof scenario !== "string") throw new TypeError(`scenario is ${shown(scenario)}; pass a text such as "mine/stack"`);
    this.#digits = doubles ? 17 : 9;
    this.#zUp = zUp;
    let head = `{"schema":"contactscope.trace/1","scenario":${quoted(scenario)}` +
      `,"scalar":"${doubles ? "double" : "float"}","up":"${zUp ? "z" : "y"}"`;
    if (engine != null) head += `,"engine":${quoted(String(engine))}`;
    if (version != null) head += `,"version":${quoted(String(version))}`;
    if (posesAt !== "contacts") head += `,"poses_at":"${posesAt}"`;
    if (step > 0 || frictionOnA)
      head += `,"impulses":{"unit":"${step > 0 ? "N" : "N s"}","on":"${frictionOnA ? "a" : "b"}"` +
        (step > 0 ? `,"step":${printed(step, 17)}}` : "}");
    this.#head = head;
    if (typeof (/** @type {any} */ (target))?.write === "function") {
      this.#sink = /** @type {Sink} */ (target);
    } else if (typeof target !== "string" && !(target instanceof URL)) {
      throw new TypeError(`the target is ${shown(target)}; pass a file name, or an object with write(text)`);
    } else if (files === null) {
      throw new TypeError("a browser has no files; pass an object with write(text), such as { write: (text) => lines.push(text) }");
    } else {
      const file = this.#file = files.openSync(target, "w");
      this.#sink = { write: (text) => files.writeFileSync(file, text) };
    }
  }

  /** Ends the frame that has begun, and closes the file; an object with write() stays open. */
  stop() {
    if (this.#sink === null) return;
    if (this.#time !== null) this.endFrame();
    this.#writeHead();
    if (this.#file !== null) files?.closeSync(this.#file);
    this.#sink = this.#file = null;
  }

  // Shapes, in local coordinates, metres; add them at any time. Each returns the number of the shape. Duplicate names
  // get a numeric suffix, and null a name.

  /** @param {string | null} name @param {number} halfX @param {number} halfY @param {number} halfZ */
  box(name, halfX, halfY, halfZ) {
    /** @type {Triple} */
    const half = numbers([halfX, halfY, halfZ], 3, "half extents");
    const corners = Array.from({ length: 8 }, (_, i) => half.map((h, k) => (i >> k & 1 ? h : -h)));
    return this.#solid(name, "box", corners, `,"faces":${kBoxFaces}`);
  }

  /** @param {string | null} name @param {number} radius */
  sphere(name, radius) {
    return this.#solid(name, "sphere", [[0, 0, 0]], `,"faces":[],"radius":${printed(scalar(radius, "radius"), 17)}`);
  }

  /** @param {string | null} name @param {Vector} start @param {Vector} end @param {number} radius */
  capsule(name, start, end, radius) {
    return this.#solid(name, "capsule", [start, end], `,"faces":[],"radius":${printed(scalar(radius, "radius"), 17)}`);
  }

  /** Readers compute the faces of the convex hull. @param {string | null} name @param {Vectors} vertices */
  hull(name, vertices) {
    return this.#solid(name, "hull", vectors(vertices));
  }

  /**
   * Centred on the origin, along axis 0, 1 or 2 (x, y, z). Written as a hull with 64 sides and its corners on the
   * round surface; the error is up to 0.12 % of the radius.
   * @param {string | null} name @param {number} axis @param {number} halfLength @param {number} radius
   */
  cylinder(name, axis, halfLength, radius) {
    return this.#turned(name, "cylinder", axis, halfLength, radius, radius);
  }

  /**
   * The same with its tip at +halfLength.
   * @param {string | null} name @param {number} axis @param {number} halfLength @param {number} radius
   */
  cone(name, axis, halfLength, radius) {
    return this.#turned(name, "cone", axis, halfLength, radius, 0);
  }

  /**
   * @param {string | null} name @param {Vectors} vertices
   * @param {Iterable<ArrayLike<number>> | ArrayLike<number>} triangles  Three indices per triangle, in lists of three or
   *   in one array, counter-clockwise seen from outside.
   */
  mesh(name, vertices, triangles) {
    const corners = vectors(vertices);
    const faces = inThrees(triangles, "triangles");
    for (const face of faces.map((one) => listOf(one, "a triangle")))
      if (face.length !== 3 || face.some((/** @type {unknown} */ i) => !Number.isInteger(i) || !corners[Number(i)]))
        throw new RangeError(`triangle [${face}] of mesh ${shown(name)} is not three indices of its ${corners.length} vertices`);
    return this.#solid(name, "mesh", corners, `,"faces":[${faces.map((face) => `[${face}]`)}]`);
  }

  /** Solid where normal . x <= offset. @param {string | null} name @param {Vector} normal @param {number} offset */
  plane(name, normal, offset) {
    const half = `{"normal":${this.#list(numbers(normal, 3, "normal"))},"offset":${this.#text(scalar(offset, "offset"))}}`;
    return this.#solid(name, "plane", [], `,"faces":[],"half_space":${half}`);
  }

  /**
   * The first height is at the origin, neighbours are `spacing` metres from each other. Columns run along +x, rows
   * along -z if y is up and along +y if z is up.
   * @param {string | null} name @param {Iterable<ArrayLike<number>>} rows @param {number} spacing
   */
  heightField(name, rows, spacing) {
    const heights = listOf(rows, "rows").map((row) => listOf(row, "a row").map((height) => scalar(height, "a height")));
    const columns = heights[0]?.length ?? 0, gap = scalar(spacing, "spacing");
    if (heights.length < 2 || columns < 2 || heights.some((row) => row.length !== columns))
      throw new RangeError(`height field ${shown(name)} needs two or more rows of the same length, two or more`);
    const vertices = [], triangles = [];
    for (const [y, row] of heights.entries())
      for (const [x, height] of row.entries()) {
        vertices.push(this.#zUp ? [x * gap, y * gap, height] : [x * gap, height, -y * gap]);
        if (y + 1 === heights.length || x + 1 === columns) continue;
        const i = y * columns + x;
        triangles.push([i, i + 1, i + columns + 1], [i, i + columns + 1, i + columns]);
      }
    return this.mesh(name, vertices, triangles);
  }

  /**
   * For engines that add a margin to convex shapes: moves the surface of a hull, cylinder or cone outwards and rounds
   * its edges. Call it before the first frame with the shape.
   * @param {number} shape @param {number} margin  Metres.
   */
  margin(shape, margin) {
    this.#margins.set(this.#known(shape), scalar(margin, "margin"));
  }

  /** A body made of shapes at fixed poses. Call pose() for the compound, not for its parts. @param {string | null} name */
  compound(name) {
    const number = this.#add(name, null);
    this.#compounds.add(number);
    return number;
  }

  /** @param {number} compound @param {number} shape @param {Vector} position @param {Quaternion} [quaternion] */
  part(compound, shape, position, quaternion = kUnturned) {
    if (compound === shape) throw new RangeError("a compound cannot be a part of itself");
    this.#parts.set(this.#known(shape), { compound: this.#known(compound), pose: poseOf(position, quaternion) });
  }

  /** Prints to the standard error what is not recorded, and why; repeated texts once. @param {string} text */
  note(text) {
    if (!this.#notes.has(text)) console.error(`contactscope: ${text}`);
    this.#notes.add(text);
  }

  /**
   * beginFrame() and endFrame() around a function; what was recorded before an error is kept.
   * @template T @param {number} time  Seconds. @param {() => T} work  Not async: the frame ends when it returns.
   */
  frame(time, work) {
    if (typeof work !== "function") throw new TypeError(`frame(time, work) needs a function, not ${shown(work)}`);
    this.beginFrame(time);
    try {
      const result = work();
      if (typeof (/** @type {any} */ (result))?.then === "function")
        throw new TypeError("the function of frame() is async; call beginFrame(time) and endFrame() around it instead");
      return result;
    } finally {
      this.endFrame();
    }
  }

  /** @param {number} time  Seconds. */
  beginFrame(time) {
    const seconds = scalar(time, "time");
    if (this.#sink === null) throw new TypeError("the recording has stopped; make a new Recorder");
    if (this.#time !== null) this.endFrame();
    this.#writeHead();
    this.#time = seconds;
    this.#poses = new Map();
    this.#manifolds = [];
    this.#bodies = [];
    this.#solver = null;
  }

  /**
   * A shape without a pose is absent from this frame.
   * @param {number} shape @param {Vector} position  Metres, world. @param {Quaternion} [quaternion]  Not turned by default.
   */
  pose(shape, position, quaternion = kUnturned) {
    this.#begun();
    this.#poses.set(this.#known(shape), poseOf(position, quaternion));
  }

  /**
   * A pair may have several manifolds. If b was created before a, the pair is written swapped, with its normal,
   * friction and sides.
   * @param {number} a @param {number} b @param {Vector} normal @param {Iterable<Point>} points
   * @param {number} [triangle]  Its index in the mesh, or -1.
   */
  manifold(a, b, normal, points, triangle = -1) {
    this.#begun();
    this.#known(a), this.#known(b);
    if (a === b) throw new RangeError("a manifold is of two shapes");
    const swapped = a > b, direction = numbers(normal, 3, "normal"), face = integer(triangle, "triangle");
    const kept = listOf(points, "points").map((point) => checked(point, swapped));
    if (kept.length === 0) return;
    this.#manifolds.push({ a: Math.min(a, b), b: Math.max(a, b), triangle: face,
                           normal: swapped ? negated(direction) : direction, points: kept });
  }

  /**
   * @param {number} shape @param {number} mass  Kilograms.
   * @param {Vector} centerOfMass  Metres, world. @param {Vector} velocity  Of the centre of mass, m/s.
   * @param {Vector} angularVelocity  rad/s, world.
   */
  body(shape, mass, centerOfMass, velocity, angularVelocity) {
    this.#begun();
    this.#bodies.push({ shape: this.#known(shape), mass: scalar(mass, "mass"),
                        vectors: [numbers(centerOfMass, 3, "centerOfMass"), numbers(velocity, 3, "velocity"),
                                  numbers(angularVelocity, 3, "angularVelocity")] });
  }

  /**
   * Solver settings of this step, for frames with bodies; 0 for those the engine does not have.
   * @param {number} iterations @param {number} [substeps] @param {boolean} [warmStart]
   */
  solver(iterations, substeps = 0, warmStart = false) {
    this.#begun();
    this.#solver = [integer(iterations, "iterations"), integer(substeps, "substeps"), Boolean(warmStart)];
  }

  endFrame() {
    this.#begun();
    const poses = new Map(this.#poses);
    for (const [shape, { compound, pose }] of [...this.#parts].sort(([one], [other]) => one - other)) {
      const whole = poses.get(compound);
      if (whole !== undefined) poses.set(shape, composed(whole, pose));
    }
    const texts = [];
    for (const [shape, { place, turn }] of [...poses].sort(([one], [other]) => one - other))
      if (!this.#compounds.has(shape))
        texts.push(`${this.#names[shape]}:{"position":${this.#list(place)},"quat_wxyz":${this.#list(turn)}}`);
    const line = `{"frame":${this.#number},"time":${this.#text(Number(this.#time))}${this.#newShapes()}` +
      `,"poses":{${texts}}${this.#pairs()}${this.#solved()}`;
    this.#time = null;
    this.#number += 1;
    this.#write(line);
  }

  // Text of the file

  /** @param {number} value */
  #text(value) {
    return inJson(value, this.#digits);
  }

  /** @param {number[]} values */
  #list(values) {
    return "[" + values.map((value) => inJson(value, this.#digits)).join(",") + "]";
  }

  /** @param {string} line */
  #write(line) {
    this.#sink?.write(line + "}\n");
  }

  #writeHead() {
    if (this.#head === null) return;
    const line = this.#head + this.#newShapes();
    this.#head = null;
    this.#write(line);
  }

  #begun() {
    if (this.#time === null)
      throw new TypeError("no frame has begun; call beginFrame(time) first, or use recorder.frame(time, () => { ... })");
  }

  /** @param {number} shape */
  #known(shape) {
    if (!Number.isInteger(shape) || shape < 0 || shape >= this.#names.length)
      throw new RangeError(`there is no shape ${shown(shape)}; pass the number that box(), hull() ... returned`);
    return shape;
  }

  /** @param {string | null | undefined} name @param {string | null} entry */
  #add(name, entry) {
    const base = name == null ? "shape" : String(name);
    let key = quoted(base);
    for (let number = 2; this.#taken.has(key); ++number) key = quoted(`${base} ${number}`);
    this.#taken.add(key);
    this.#names.push(key);
    this.#shapes.push(entry);
    return this.#names.length - 1;
  }

  /** @param {string | null} name @param {string} type @param {Vector[]} vertices */
  #solid(name, type, vertices, rest = "") {
    const corners = vertices.map((vertex) => this.#list(numbers(vertex, 3, "vertex")));
    return this.#add(name, `{"type":"${type}","vertices":[${corners}]${rest}`);
  }

  /**
   * @param {string | null} name @param {string} type @param {number} axis @param {number} halfLength
   * @param {number} radius  At -halfLength. @param {number} top  At +halfLength.
   */
  #turned(name, type, axis, halfLength, radius, top) {
    if (![0, 1, 2].includes(axis)) throw new RangeError(`axis ${shown(axis)} is not 0, 1 or 2`);
    const half = scalar(halfLength, "halfLength");
    scalar(radius, "radius");
    const cosine = 0.99518472667219688624, sine = 0.09801714032956060199;  // of 1/64 turn
    /** @type {number[][][]} */
    const rings = [[], []];
    for (let i = 0, x = 1, y = 0; i < 64; ++i) {
      for (const [k, around] of [radius, top].entries()) {
        const corner = [0, 0, 0];
        corner[axis] = k ? half : -half;
        corner[(axis + 1) % 3] = around * x;
        corner[(axis + 2) % 3] = around * y;
        rings[k].push(corner);
      }
      [x, y] = [cosine * x - sine * y, sine * x + cosine * y];
    }
    const tip = [0, 1, 2].map((k) => (k === axis ? half : 0));
    return this.#solid(name, type, [...rings[0], ...(top > 0 ? rings[1] : [tip])]);
  }

  /** Shapes that are not in the file yet. */
  #newShapes() {
    const entries = [];
    for (const [shape, entry] of this.#shapes.entries()) {
      if (entry === null) continue;
      const margin = this.#margins.get(shape) ?? 0, part = this.#parts.get(shape);
      entries.push(`${this.#names[shape]}:${entry}` + (margin > 0 ? `,"margin":${this.#text(margin)}` : "") +
        (part ? `,"body":${this.#names[part.compound]}}` : "}"));
      this.#shapes[shape] = null;
    }
    return `,"shapes":{${entries}}`;
  }

  #pairs() {
    const place = (/** @type {{ points: Checked[] }} */ manifold) => manifold.points[0].position;
    this.#manifolds.sort((m, n) => m.a - n.a || m.b - n.b || m.triangle - n.triangle ||
      byNumbers(place(m), place(n)) || byNumbers(m.normal, n.normal));
    /** @type {Map<string, string[]>} */
    const pairs = new Map();
    for (const { a, b, triangle, normal, points } of this.#manifolds) {
      const pair = `{"a":${this.#names[a]},"b":${this.#names[b]}`, manifolds = pairs.get(pair) ?? [];
      manifolds.push(`{"normal":${this.#list(normal)}` + (triangle >= 0 ? `,"triangle":${triangle}` : "") +
        `,"points":[${points.map((point) => this.#point(point))}]}`);
      pairs.set(pair, manifolds);
    }
    return `,"pairs":[${[...pairs].map(([pair, manifolds]) => `${pair},"manifolds":[${manifolds}]}`)}]`;
  }

  /** @param {Checked} point */
  #point({ position, separation, sides, impulse, friction, id, idle }) {
    return `{"position":${this.#list(position)},"separation":${this.#text(separation)}` + (id !== null ? `,"id":"${id}"` : "") +
      (impulse !== null ? `,"impulse":{"normal":${this.#text(impulse)},"friction":${this.#list(friction)}}` : "") +
      (sides !== null ? `,"on_a":${this.#list(sides[0])},"on_b":${this.#list(sides[1])}` : "") + (idle ? ',"active":false}' : "}");
  }

  #solved() {
    if (this.#solver === null && this.#bodies.length === 0) return "";
    const [iterations, substeps, warmStart] = this.#solver ?? [0, 0, false];
    this.#bodies.sort((one, other) => one.shape - other.shape);
    const bodies = this.#bodies.map(({ shape, mass, vectors: [center, velocity, spin] }) =>
      `${this.#names[shape]}:{"mass":${this.#text(mass)},"center_of_mass":${this.#list(center)}` +
      `,"velocity":${this.#list(velocity)},"angular_velocity":${this.#list(spin)}}`);
    const warm = warmStart ? ',"warm_start":true' : "";
    return `,"solver":{"iterations":${iterations},"substeps":${substeps}${warm},"bodies":{${bodies}}}`;
  }
}

const kUnturned = [1, 0, 0, 0];

/** A value as it stands in an error. @param {unknown} value */
function shown(value) {
  if (typeof value === "string") return JSON.stringify(value);
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return "an array";
  if (typeof value !== "object" || value === null) return String(value);
  return `an object with ${Object.keys(value).join(", ") || "no keys"}`;
}

/** @param {object} given @param {string[]} known @param {string} what */
function onlyKeys(given, known, what) {
  if (typeof given !== "object" || given === null)
    throw new TypeError(`${what}: ${shown(given)} is not an object with keys of ${known.join(", ")}`);
  for (const key in given)
    if (!known.includes(key)) throw new TypeError(`${what}: there is no key "${key}"; the keys are ${known.join(", ")}`);
}

/** @param {unknown} value @param {string} what @returns {number} */
function scalar(value, what) {
  if (typeof value !== "number") throw new TypeError(`${what} is ${shown(value)}; pass a number`);
  return value;
}

/** @param {unknown} value @param {string} what @returns {number} */
function integer(value, what) {
  if (!Number.isInteger(value)) throw new TypeError(`${what} is ${shown(value)}; pass a whole number`);
  return /** @type {number} */ (value);
}

/** @param {any} value  A Vector or a Quaternion. @param {number} count @param {string} what @returns {any} */
function numbers(value, count, what) {
  const isList = Array.isArray(value) || ArrayBuffer.isView(value);
  const keys = count === 3 ? "x, y, z" : "w, x, y, z";
  if (!isList && typeof value?.x !== "number") throw new TypeError(`${what} is ${shown(value)}; pass [${keys}] or {${keys}}`);
  const { w, x, y, z } = value, list = isList ? Array.from(/** @type {any} */ (value)) : w === undefined ? [x, y, z] : [w, x, y, z];
  if (list.length !== count) throw new RangeError(`${what} has ${list.length} numbers, not ${count}`);
  for (const number of list) scalar(number, `a number of ${what}`);
  return list;
}

/** @param {any} values @param {string} what @returns {any[]} */
function listOf(values, what) {
  if (typeof values?.[Symbol.iterator] === "function" && typeof values !== "string") return Array.from(values);
  throw new TypeError(`${what}: ${shown(values)} is not a list; pass an array`);
}

/** Lists of three numbers from such lists, or from one of all. @param {any} values @param {string} what @returns {any[]} */
function inThrees(values, what) {
  const list = listOf(values, what);
  if (typeof list[0] !== "number") return list.map((one) => (ArrayBuffer.isView(one) ? listOf(one, what) : one));
  if (list.length % 3 !== 0) throw new RangeError(`${what}: ${list.length} numbers are not three for each`);
  return Array.from({ length: list.length / 3 }, (_, i) => list.slice(3 * i, 3 * i + 3));
}

/** @param {Vectors} values @returns {Triple[]} */
const vectors = (values) => inThrees(values, "vertices").map((vertex) => numbers(vertex, 3, "vertex"));

/** @param {Vector} position @param {Quaternion} quaternion @returns {Pose} */
const poseOf = (position, quaternion) => ({ place: numbers(position, 3, "position"), turn: numbers(quaternion, 4, "quaternion") });

/** @param {Triple} vector @returns {Triple} */
const negated = ([x, y, z]) => [-x, -y, -z];

/** @param {Triple} one @param {Triple} other */
function byNumbers(one, other) {
  for (let k = 0; k < 3; ++k) {
    const order = Number(one[k] > other[k]) - Number(one[k] < other[k]);
    if (order !== 0) return order;
  }
  return 0;
}

/**
 * A point as it is written: a copy, its sides and friction swapped with the pair.
 * @param {Point} point @param {boolean} swapped @returns {Checked}
 */
function checked(point, swapped) {
  onlyKeys(point, kPointKeys, "a point");
  const { onA, onB, impulse, friction, id } = point;
  if ((onA == null) !== (onB == null)) throw new TypeError("a point has onA and onB, or none of them");
  if (id != null && typeof id !== "bigint" && !Number.isSafeInteger(id))
    throw new TypeError(`id is ${shown(id)}; pass a whole number up to 2^53, or a BigInt`);
  const number = id == null ? null : BigInt(id);
  if (number !== null && (number < 0n || number >> 64n)) throw new RangeError(`id ${number} is not within 0 to 2^64 - 1`);
  const sides = onA == null ? null : [numbers(onA, 3, "onA"), numbers(onB, 3, "onB")];
  const sliding = numbers(friction ?? [0, 0, 0], 3, "friction");
  return { position: numbers(point.position, 3, "position"), separation: scalar(point.separation, "separation"),
           sides: swapped && sides ? sides.reverse() : sides, impulse: impulse == null ? null : scalar(impulse, "impulse"),
           friction: swapped ? negated(sliding) : sliding, id: number, idle: Boolean(point.idle) };
}

/** A JSON string; lone surrogates become question marks. @param {string} text */
function quoted(text) {
  const escaped = text.replace(/\p{Surrogate}/gu, "?").replace(/[\0-\x1f"\\]/g, (c) =>
    c < " " ? "\\u" + c.charCodeAt(0).toString(16).padStart(4, "0") : "\\" + c);
  return `"${escaped}"`;
}

// Doubles below the power of ten that they stand for, of which contactscope.h writes the power.
const kPowers = [1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
const kRoundPowers = new Set(kPowers.filter((power) => power.toExponential(16)[0] === "9"));

/**
 * `value` with `count` significant digits, halves rounded away from zero; null if it is not finite.
 * @param {number} value @param {number} count
 */
function inJson(value, count) {
  if (!Number.isFinite(value)) return "null";  // JSON has no nan or infinity; readers report where it is
  const size = Math.abs(value);
  if (size >= 1e9 || (size < 1e-10 && size > 0)) return printed(value, count);
  if (Number.isInteger(size)) return String(value === 0 ? 0 : value);
  const text = value.toPrecision(size < 1 && kRoundPowers.has(size) ? 15 : count);
  if (text.includes("e")) {
    const [digits, power] = text.split("e");
    return (value < 0 ? "-" : "") + withPoint(digits.replace(/[-.]/g, ""), Number(power));
  }
  if (!text.includes(".")) return text;
  let end = text.length;
  while (text[end - 1] === "0") --end;
  return text.slice(0, text[end - 1] === "." ? end - 1 : end);
}

/** Digits, the first of which counts 10^power. @param {string} digits @param {number} power */
function withPoint(digits, power) {
  if (power < 0) return "0." + "0".repeat(-power - 1) + digits.replace(/0+$/, "");
  const fraction = digits.slice(power + 1).replace(/0+$/, "");
  return digits.slice(0, power + 1).padEnd(power + 1, "0") + (fraction ? "." + fraction : "");
}

/** What "%.*g" of C gives: halves are rounded to even. @param {number} value @param {number} count */
function printed(value, count) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "nan" : value > 0 ? "inf" : "-inf";
  const size = Math.abs(value), sign = value < 0 || Object.is(value, -0) ? "-" : "";
  if (size === 0) return sign + "0";
  const apart = (/** @type {number} */ places) => size.toExponential(places).replace(".", "").split("e");
  let [digits, power] = apart(count - 1);
  if (size >= 1e-10 && size < 1e19) {  // others are never halfway
    const [exact, exactPower] = apart(100);
    const isHalf = /^50*$/.test(exact.slice(count)), isEven = Number(exact[count - 1]) % 2 === 0;
    if (isHalf && isEven) [digits, power] = [exact.slice(0, count), exactPower];
  }
  const tens = Number(power);
  if (tens >= -4 && tens < count) return sign + withPoint(digits, tens);
  const fraction = digits.slice(1).replace(/0+$/, "");
  return `${sign}${digits[0]}${fraction ? "." : ""}${fraction}e${tens < 0 ? "-" : "+"}${String(Math.abs(tens)).padStart(2, "0")}`;
}

/**
 * World pose of a part of a compound. The order of the operations is that of contactscope.h.
 * @param {Pose} whole @param {Pose} part @returns {Pose}
 */
function composed({ place, turn: p }, { place: v, turn: q }) {
  const at = (/** @type {number} */ k) => 1 + k % 3;
  const t = [0, 1, 2].map((k) => 2 * (p[at(k + 1)] * v[(k + 2) % 3] - p[at(k + 2)] * v[(k + 1) % 3]));
  const moved = [0, 1, 2].map((k) =>
    v[k] + p[0] * t[k] + p[at(k + 1)] * t[(k + 2) % 3] - p[at(k + 2)] * t[(k + 1) % 3] + place[k]);
  return { place: /** @type {Triple} */ (moved), turn: [
    p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
    p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]] };
}
