// cannon-es: its narrow phase is asked directly. A contact has `ni` from `bi` to `bj`, and `ri` and `rj` from
// the bodies' positions to the points on their surfaces.

import * as CANNON from "cannon-es";
import { impulseOf, isRollout, refuse, rollOut } from "./rollout.mjs";
import { add, addPoint, answer, dot, halfExtents, isAsked, isCentered, leftOut, placed, sub, triangles, turned, versionOf } from "./trace.mjs";

const vec = ([x, y, z]) => new CANNON.Vec3(x, y, z);
const numbers = ({ x, y, z }) => [x, y, z];
const world = new CANNON.World({ gravity: new CANNON.Vec3(0, 0, 0) });

/** [shape, offset, orientation] of what a body is made of. */
function partsOf(shape) {
  switch (shape.type) {
    case "sphere":
      return [[new CANNON.Sphere(shape.radius), vec(shape.vertices[0])]];
    case "plane": {  // through its origin, and it looks along +z
      const { normal, offset } = shape.half_space;
      const turn = new CANNON.Quaternion();
      turn.setFromVectors(new CANNON.Vec3(0, 0, 1), vec(normal));
      return [[new CANNON.Plane(), vec(normal.map((x) => x * offset)), turn]];
    }
    case "mesh":
      return [[new CANNON.Trimesh(shape.vertices.flat(), triangles(shape).flat())]];
    case "box":
      if (isCentered(shape)) return [[new CANNON.Box(vec(halfExtents(shape).half))]];
  }
  if (shape.type === "sdf" || shape.type === "capsule" || (shape.radius ?? 0) > 0) return null;
  return [[new CANNON.ConvexPolyhedron({ vertices: shape.vertices.map(vec), faces: shape.faces })]];
}

const made = new Map();
function bodyOf(name, shape) {
  if (made.has(name)) return made.get(name);
  const parts = partsOf(shape);
  let body = null;
  if (parts === null) leftOut(name, `cannon-es has no ${shape.type} like it`);
  else {
    body = new CANNON.Body({ mass: 1 });
    for (const part of parts) body.addShape(...part);
    body.shapeName = name;
    world.addBody(body);
  }
  made.set(name, body);
  return body;
}

/** Steps the pieces; a body of cannon-es has its centre of mass at its origin. */
function worldOf(pieces, gravity, step) {
  world.gravity.set(...gravity);
  const bodies = new Map(), materials = new Map();
  const surfaceOf = ({ friction, restitution }) => {
    const key = `${friction} ${restitution}`;
    if (!materials.has(key)) {
      const material = Object.assign(new CANNON.Material(key), { surface: { friction, restitution } });
      for (const other of [...materials.values(), material])
        world.addContactMaterial(new CANNON.ContactMaterial(material, other, {
          friction: Math.sqrt(friction * other.surface.friction),
          restitution: Math.max(restitution, other.surface.restitution) }));
      materials.set(key, material);
    }
    return materials.get(key);
  };
  const place = (body, { pose, center = [0, 0, 0] }) => {
    const [w, x, y, z] = pose.quat_wxyz;
    body.position.set(...placed(pose, center));
    body.quaternion.set(x, y, z, w);
  };
  for (const piece of pieces) {
    const parts = partsOf(piece.shape);
    if (parts === null) refuse(`cannon-es has no ${piece.shape.type} like '${piece.name}'`);
    const body = new CANNON.Body({
      mass: piece.isDynamic ? piece.mass : 0, material: surfaceOf(piece), allowSleep: false, linearDamping: 0, angularDamping: 0,
      type: piece.isDynamic ? CANNON.Body.DYNAMIC : piece.isScripted ? CANNON.Body.KINEMATIC : CANNON.Body.STATIC });
    const center = vec(piece.center ?? [0, 0, 0]);
    for (const [shape, offset = new CANNON.Vec3(), ...turn] of parts) body.addShape(shape, offset.vsub(center), ...turn);
    place(body, piece);
    if (piece.isDynamic) {
      body.velocity.set(...piece.velocity);
      body.angularVelocity.set(...piece.spin);
    }
    body.shapeName = piece.name;
    world.addBody(body);
    if (piece.isDynamic) {
      // It takes the box around a shape for the shape, and knows no other axes than the shape's.
      body.inertia.set(...piece.inertiaDiagonal);
      body.invInertia.set(...piece.inertiaDiagonal.map((x) => 1 / x));
      body.updateInertiaWorld(true);
    }
    bodies.set(piece, body);
  }
  return {
    motion(piece) {
      const body = bodies.get(piece), { x, y, z, w } = body.quaternion, quat_wxyz = [w, x, y, z];
      return { pose: { position: sub(numbers(body.position), turned(quat_wxyz, piece.center)), quat_wxyz },
               velocity: numbers(body.velocity), spin: numbers(body.angularVelocity) };
    },
    drive(piece, { pose, velocity, spin }) {
      const body = bodies.get(piece);
      place(body, { pose });
      body.velocity.set(...velocity);
      body.angularVelocity.set(...spin);
      body.aabbNeedsUpdate = true;
    },
    step() {
      const before = new Map([...bodies].map(([, body]) => [body, numbers(body.position)]));
      world.step(step);
      const manifolds = [];
      for (const { bi, bj, ni, ri, rj, multiplier } of world.contacts) {
        const normal = numbers(ni);
        const on_a = add(before.get(bi), numbers(ri)), on_b = add(before.get(bj), numbers(rj));
        addPoint(manifolds, bi.shapeName, bj.shapeName, normal,
                 { position: on_b, separation: dot(normal, sub(on_b, on_a)), on_a, on_b,
                   impulse: impulseOf(normal.map((x) => x * multiplier * step), normal) });
      }
      return manifolds;
    },
  };
}

if (isRollout) await rollOut("cannon-es", versionOf("cannon-es"), worldOf, true);
else await answer("cannon-es", versionOf("cannon-es"), (frame, shapes, asked) => {
  for (const [name, pose] of Object.entries(frame.poses)) {
    const body = bodyOf(name, shapes[name]);
    if (body === null) continue;
    const [w, x, y, z] = pose.quat_wxyz;
    body.position.set(...pose.position);
    body.quaternion.set(x, y, z, w);
    body.aabbNeedsUpdate = true;
  }
  const first = [], second = [];
  for (const [a, b] of asked) {
    if (!made.get(a) || !made.get(b)) continue;
    first.push(made.get(a));
    second.push(made.get(b));
  }
  const contacts = [];
  world.narrowphase.getContacts(first, second, world, contacts, [], [], []);
  const manifolds = [];
  for (const { bi, bj, ni, ri, rj } of contacts) {
    const [a, b] = [bi.shapeName, bj.shapeName];
    if (!isAsked(asked, a, b)) continue;
    const normal = numbers(ni);
    const on_a = add(numbers(bi.position), numbers(ri)), on_b = add(numbers(bj.position), numbers(rj));
    addPoint(manifolds, a, b, normal, { position: on_b, separation: dot(normal, sub(on_b, on_a)), on_a, on_b });
  }
  return manifolds;
});
