// Rapier: a world is made of each frame, because contacts of bodies that were moved by hand are not always
// worked out again; the contacts that a step without gravity begins with are read from its narrow phase. The manifold's own normal points from its first collider to its second; `flipped` says that the
// first one is the second that was asked for. Points are in the colliders' frames.

import RAPIER from "@dimforge/rapier3d-compat";
import { add, answer, halfExtents, isCentered, leftOut, placed, scaled, segmentOf, stands, sub, triangles, turnBetween,
         versionOf } from "./trace.mjs";

await RAPIER.init();
const numbers = ({ x, y, z }) => [x, y, z];

function colliderOf(shape) {
  const flat = () => new Float32Array(shape.vertices.flat());
  switch (shape.type) {
    case "sphere":
      return RAPIER.ColliderDesc.ball(shape.radius).setTranslation(...shape.vertices[0]);
    case "capsule": {
      const { middle, length, direction } = segmentOf(shape);
      const [w, x, y, z] = turnBetween([0, 1, 0], direction);
      return RAPIER.ColliderDesc.capsule(length / 2, shape.radius)
        .setTranslation(...middle).setRotation({ w, x, y, z });
    }
    case "plane": {  // through the origin of the collider
      const { normal, offset } = shape.half_space;
      return new RAPIER.ColliderDesc(new RAPIER.HalfSpace({ x: normal[0], y: normal[1], z: normal[2] }))
        .setTranslation(...scaled(normal, offset));
    }
    case "mesh":
      return RAPIER.ColliderDesc.trimesh(flat(), new Uint32Array(triangles(shape).flat()));
    case "box":
      if (isCentered(shape)) return RAPIER.ColliderDesc.cuboid(...halfExtents(shape).half);
  }
  if (shape.type === "sdf" || (shape.radius ?? 0) > 0) return null;
  return RAPIER.ColliderDesc.convexHull(flat());
}

/** Descriptions of what collides, by name; null of what Rapier does not have. */
const described = new Map();
function descriptionOf(name, shape) {
  if (!described.has(name)) {
    described.set(name, colliderOf(shape));
    if (described.get(name) === null) leftOut(name, `Rapier has no ${shape.type} like it`);
  }
  return described.get(name);
}

// A collider's own pose on its body is put behind that of the body.
const onBody = (collider, pose) => {
  const at = collider.translationWrtParent(), q = collider.rotationWrtParent();
  return (point) => placed(pose, placed({ position: numbers(at), quat_wxyz: [q.w, q.x, q.y, q.z] }, point));
};

const kinds = { 1: "v", 2: "e", 3: "f" };
const feature = (fid) => (kinds[fid >>> 30] ? `${kinds[fid >>> 30]}${fid & 0x3fffffff}` : null);

await answer("Rapier", versionOf("@dimforge/rapier3d-compat"), (frame, shapes, asked) => {
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  const made = new Map();
  for (const [name, pose] of Object.entries(frame.poses)) {
    const description = descriptionOf(name, shapes[name]);
    if (description === null) continue;
    const [w, x, y, z] = pose.quat_wxyz;
    const body = world.createRigidBody(
      (stands(shapes[name]) ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic())
        .setTranslation(...pose.position).setRotation({ w, x, y, z }));
    made.set(name, world.createCollider(description, body));
  }
  world.step();
  const manifolds = [];
  for (const [a, b] of asked) {
    const one = made.get(a), other = made.get(b);
    if (!one || !other) continue;
    world.contactPair(one, other, (manifold, flipped) => {
      const first = flipped ? b : a, second = flipped ? a : b;
      const toFirst = onBody(made.get(first), frame.poses[first]);
      const toSecond = onBody(made.get(second), frame.poses[second]);
      const n1 = numbers(manifold.localNormal1());
      const normal = sub(toFirst(n1), toFirst([0, 0, 0]));
      const points = [];
      for (let i = 0; i < manifold.numContacts(); ++i) {
        const on_a = toFirst(numbers(manifold.localContactPoint1(i)));
        const on_b = toSecond(numbers(manifold.localContactPoint2(i)));
        const f1 = feature(manifold.contactFid1(i)), f2 = feature(manifold.contactFid2(i));
        points.push({ position: scaled(add(on_a, on_b), 0.5), separation: manifold.contactDist(i), on_a, on_b,
                      ...(f1 && f2 ? { id: `a:${f1} b:${f2}` } : {}) });
      }
      manifolds.push({ a: first, b: second, normal, points });
    });
  }
  world.free();
  return manifolds;
});
