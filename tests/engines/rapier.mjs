// Rapier: a world is made of each frame, because contacts of bodies that were moved by hand are not always
// worked out again; the contacts that a step without gravity begins with are read from its narrow phase. The manifold's
// own normal points from its first collider to its second; `flipped` says that the first one is the second that was
// asked for. Points are in the colliders' frames.

import RAPIER from "@dimforge/rapier3d-compat";
import { isRollout, refuse, rollOut } from "./rollout.mjs";
import { add, answer, dot, halfExtents, isCentered, leftOut, placed, scaled, segmentOf, stands, sub, triangles, turnBetween,
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
/** An id of two features: a number for the recorder, else a text. */
function idOf(fid1, fid2) {
  const f1 = feature(fid1), f2 = feature(fid2);
  if (!f1 || !f2) return {};
  return { id: isRollout ? (BigInt(fid1 >>> 0) << 32n) | BigInt(fid2 >>> 0) : `a:${f1} b:${f2}` };
}

/** The manifolds of two colliders, which are on bodies with these poses. */
function manifoldsOf(world, [a, one, poseA], [b, other, poseB]) {
  const manifolds = [];
  world.contactPair(one, other, (manifold, flipped) => {
    const toA = onBody(one, poseA), toB = onBody(other, poseB);
    const [first, second, toFirst, toSecond] = flipped ? [b, a, toB, toA] : [a, b, toA, toB];
    const n1 = numbers(manifold.localNormal1());
    const normal = sub(toFirst(n1), toFirst([0, 0, 0]));
    const points = [];
    for (let i = 0; i < manifold.numContacts(); ++i) {
      const on_a = toFirst(numbers(manifold.localContactPoint1(i)));
      const on_b = toSecond(numbers(manifold.localContactPoint2(i)));
      // Of a contact that it keeps from the step before contactDist() is still that of then; it solves what the points say.
      points.push({ position: scaled(add(on_a, on_b), 0.5), separation: dot(sub(on_b, on_a), normal), on_a, on_b,
                    ...idOf(manifold.contactFid1(i), manifold.contactFid2(i)) });
    }
    manifolds.push({ a: first, b: second, normal, points });
  });
  return manifolds;
}

const version = versionOf("@dimforge/rapier3d-compat");
if (isRollout) {
  await rollOut("Rapier", version, (pieces, gravity, step) => {
    const xyz = ([x, y, z]) => ({ x, y, z });
    const world = new RAPIER.World(xyz(gravity));
    world.timestep = step;
    const made = new Map(), names = new Map();
    for (const piece of pieces) {
      const description = descriptionOf(piece.name, piece.shape);
      if (description === null) refuse(`Rapier has no ${piece.shape.type} like '${piece.name}'`);
      // It multiplies frictions.
      description.setDensity(0).setFriction(Math.sqrt(piece.friction)).setRestitution(piece.restitution)
        .setFrictionCombineRule(RAPIER.CoefficientCombineRule.Multiply)
        .setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Max);
      const kind = piece.isDynamic ? RAPIER.RigidBodyDesc.dynamic()
        : piece.isScripted ? RAPIER.RigidBodyDesc.kinematicPositionBased() : RAPIER.RigidBodyDesc.fixed();
      const [w, x, y, z] = piece.pose.quat_wxyz;
      kind.setTranslation(...piece.pose.position).setRotation({ w, x, y, z }).setCanSleep(false);
      if (piece.isDynamic) {
        const [tw, tx, ty, tz] = piece.turn;
        kind.setAdditionalMassProperties(piece.mass, xyz(piece.center), xyz(piece.moments), { w: tw, x: tx, y: ty, z: tz })
          .setLinvel(...piece.velocity).setAngvel(xyz(piece.spin));
      }
      const body = world.createRigidBody(kind);
      const collider = world.createCollider(description, body);
      made.set(piece, { body, collider });
      names.set(collider.handle, piece);
    }
    return {
      motion(piece) {
        const { body } = made.get(piece), q = body.rotation();
        return { pose: { position: numbers(body.translation()), quat_wxyz: [q.w, q.x, q.y, q.z] },
                 velocity: numbers(body.linvel()), spin: numbers(body.angvel()) };
      },
      drive(piece, { next }) {
        const { body } = made.get(piece), [w, x, y, z] = next.quat_wxyz;
        body.setNextKinematicTranslation(xyz(next.position));
        body.setNextKinematicRotation({ w, x, y, z });
      },
      step() {
        const before = new Map(pieces.map((piece) => [piece, piece.pose]));
        world.step();
        const manifolds = [];
        for (const piece of pieces) {
          const one = made.get(piece).collider;
          world.contactPairsWith(one, (other) => {
            const partner = names.get(other.handle);
            if (pieces.indexOf(partner) < pieces.indexOf(piece)) return;
            manifolds.push(...manifoldsOf(world, [piece.name, one, before.get(piece)],
                                          [partner.name, other, before.get(partner)]));
          });
        }
        return manifolds;
      },
    };
  });
} else {
  await answer("Rapier", version, (frame, shapes, asked) => {
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
      if (!made.get(a) || !made.get(b)) continue;
      manifolds.push(...manifoldsOf(world, [a, made.get(a), frame.poses[a]], [b, made.get(b), frame.poses[b]]));
    }
    world.free();
    return manifolds;
  });
}
