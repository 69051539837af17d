// cannon-es: its narrow phase is asked directly. A contact has `ni` from `bi` to `bj`, and `ri` and `rj` from
// the bodies' positions to the points on their surfaces.

import * as CANNON from "cannon-es";
import { add, addPoint, answer, dot, halfExtents, isAsked, isCentered, leftOut, sub, triangles, versionOf } from "./trace.mjs";

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

await answer("cannon-es", versionOf("cannon-es"), (frame, shapes, asked) => {
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
