// Steps a scene when `contactscope versus --rollout` asks: src/versus/README.md. Metres, kilograms, seconds.

import { Recorder } from "../../src/recorder/contactscope.mjs";
import { add, dot, halfExtents, isCentered, isWhole, placed, requestLines, scaled, sub, triangles, turned, write } from "./trace.mjs";

/** Whether the program was called to step a scene, and not to find contacts. */
export const isRollout = process.argv[2] === "rollout";

/** Ends the program: it steps nothing, or not this. */
export function refuse(why) {
  process.stderr.write(why + "\n");
  process.exit(3);
}

/** The product of two quaternions w, x, y, z. */
export const product = ([w, x, y, z], [ow, ox, oy, oz]) => [
  w * ow - x * ox - y * oy - z * oz, w * ox + x * ow + y * oz - z * oy,
  w * oy - x * oz + y * ow + z * ox, w * oz + x * oy - y * ox + z * ow,
];
export const conjugate = ([w, x, y, z]) => [w, -x, -y, -z];

/**
 * The moments of an inertia of three rows, and the turn w, x, y, z of the axes about which they are, by rotations of
 * Jacobi. Where the axes are those of the shape the turn is none.
 */
function principalAxes(rows) {
  const m = rows.map((row) => [...row]);
  const size = m[0][0] + m[1][1] + m[2][2];
  let turn = [1, 0, 0, 0];
  for (let sweep = 0; sweep < 60; ++sweep) {
    let [p, q] = [0, 1];
    for (const [i, k] of [[0, 2], [1, 2]]) if (Math.abs(m[i][k]) > Math.abs(m[p][q])) [p, q] = [i, k];
    if (Math.abs(m[p][q]) < 1e-12 * size) break;
    const angle = 0.5 * Math.atan2(2 * m[p][q], m[q][q] - m[p][p]);
    const c = Math.cos(angle), s = Math.sin(angle);
    for (let k = 0; k < 3; ++k) [m[k][p], m[k][q]] = [c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]];
    for (let k = 0; k < 3; ++k) [m[p][k], m[q][k]] = [c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]];
    // New axis p is c p - s q: a turn from p to -q.
    const half = [Math.cos(angle / 2), 0, 0, 0];
    const axis = 3 - p - q, way = (p + 1) % 3 === q ? -1 : 1;
    half[1 + axis] = way * Math.sin(angle / 2);
    turn = product(turn, half);
  }
  return { moments: [m[0][0], m[1][1], m[2][2]], turn };
}

/** The constant velocities from a pose to the next. */
function going(from, to, step) {
  let [w, x, y, z] = product(to.quat_wxyz, conjugate(from.quat_wxyz));
  if (w < 0) [w, x, y, z] = [-w, -x, -y, -z];
  const sine = Math.hypot(x, y, z), angle = 2 * Math.atan2(sine, w);
  return {
    velocity: scaled(sub(to.position, from.position), 1 / step),
    spin: sine > 0 ? scaled([x, y, z], angle / sine / step) : [0, 0, 0],
  };
}

/** A shape of a request, recorded; its number. */
function recorded(recorder, name, shape) {
  const { type, vertices, radius = 0 } = shape;
  switch (type) {
    case "sphere":
      return vertices[0].every((x) => x === 0) ? recorder.sphere(name, radius) : recorder.capsule(name, vertices[0], vertices[0], radius);
    case "capsule":
      return recorder.capsule(name, ...vertices, radius);
    case "plane":
      return recorder.plane(name, shape.half_space.normal, shape.half_space.offset);
    case "mesh":
      return recorder.mesh(name, vertices, triangles(shape));
    case "box":
      if (isCentered(shape)) return recorder.box(name, ...halfExtents(shape).half);
  }
  return recorder.hull(name, vertices);  // no engine steps the other types
}

/**
 * Answers a request for a rollout. `make(pieces, gravity, step)` makes a world of the pieces {name, shape, pose, isDynamic,
 * isScripted, friction, restitution, and of dynamic ones mass, center (of mass, in the shape's frame), moments and the
 * turn of their axes, inertiaDiagonal in those of the shape, velocity (of the centre), spin}. It returns {motion(piece), which is {pose, velocity, spin};
 * drive(piece, {pose, next, velocity, spin}), of a scripted one before each step; and step(), which returns
 * manifolds as contacts() of answer() does, with the poses from before it}. `doubles`: the engine computes in double.
 */
export async function rollOut(engine, version, make, doubles = false) {
  const [header, ...frames] = requestLines().map((line) => JSON.parse(line));
  const start = frames[0], step = header.world.time_step;
  const pieces = Object.entries(header.shapes).map(([name, shape]) => {
    const piece = { name, shape, pose: start.poses[name], friction: shape.friction ?? 0, restitution: shape.restitution ?? 0 };
    const body = start.solver.bodies[name];
    piece.isDynamic = body !== undefined;
    piece.isScripted = !piece.isDynamic && frames[1]?.poses[name] !== undefined;
    if (piece.isDynamic) {
      const { position, quat_wxyz } = piece.pose;
      piece.center = turned(conjugate(quat_wxyz), sub(body.center_of_mass, position));
      Object.assign(piece, { mass: body.mass, velocity: body.velocity, spin: body.angular_velocity },
                    principalAxes(body.inertia), { inertiaDiagonal: body.inertia.map((row, i) => row[i]) });
    }
    return piece;
  });
  const world = await make(pieces, header.world.gravity, step);
  const recorder = new Recorder({ write }, header.scenario, { engine, version, doubles, zUp: header.up === "z", posesAt: "before_step" });
  const numbers = new Map(pieces.map(({ name, shape }) => [name, recorded(recorder, name, shape)]));
  frames.forEach((asked, i) => recorder.frame(asked.time, () => {
    for (const piece of pieces) {
      const number = numbers.get(piece.name);
      if (piece.isScripted) {
        const pose = asked.poses[piece.name], next = (frames[i + 1] ?? asked).poses[piece.name];
        world.drive(piece, { pose, next, ...going(pose, next, step) });
        piece.pose = pose;
      }
      if (piece.isDynamic) {
        const motion = world.motion(piece);
        const length = Math.hypot(...motion.pose.quat_wxyz);
        piece.pose = { ...motion.pose, quat_wxyz: motion.pose.quat_wxyz.map((x) => x / length) };
        recorder.body(number, piece.mass, placed(piece.pose, piece.center), motion.velocity, motion.spin);
      }
      recorder.pose(number, piece.pose.position, piece.pose.quat_wxyz);
    }
    for (const manifold of world.step())
      if (isWhole(engine, asked.frame, manifold))
        recorder.manifold(numbers.get(manifold.a), numbers.get(manifold.b), manifold.normal, manifold.points.map(
          ({ on_a: onA, on_b: onB, impulse, ...point }) => ({ ...point, onA, onB, impulse: impulse?.normal, friction: impulse?.friction })));
  }));
  recorder.stop();
}

/** An impulse on b, split along a normal from a to b. */
export function impulseOf(onB, normal) {
  const along = dot(onB, normal);
  return { normal: along, friction: add(onB, scaled(normal, -along)) };
}
