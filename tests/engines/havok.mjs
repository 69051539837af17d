// Havok: a world is made of each frame, and each event of its step is a point with a place and an outward
// normal on either body. Its bodies are kept apart by a little more than they say.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { isRollout, refuse, rollOut } from "./rollout.mjs";
import { addPoint, answer, dot, halfExtents, isAsked, leftOut, scaled, stands, sub, triangles, turnBetween, versionOf } from "./trace.mjs";

const load = createRequire(import.meta.url)("@babylonjs/havok");
const hk = await load({
  wasmBinary: readFileSync(new URL("node_modules/@babylonjs/havok/lib/umd/HavokPhysics.wasm", import.meta.url)),
});
const kHalf = 1000;  // metres that a plane reaches, which Havok has none of
const eventTypes = hk.EventType.COLLISION_STARTED.value | hk.EventType.COLLISION_CONTINUED.value;

function inMemory(numbers, view) {
  const at = hk._malloc(numbers.length * 4);
  new view(hk.HEAPU8.buffer, at, numbers.length).set(numbers);
  return at;
}

function shapeOf(shape) {
  switch (shape.type) {
    case "sphere":
      return hk.HP_Shape_CreateSphere(shape.vertices[0], shape.radius)[1];
    case "capsule":
      return hk.HP_Shape_CreateCapsule(shape.vertices[0], shape.vertices[1], shape.radius)[1];
    case "plane": {  // a box below it
      const { normal, offset } = shape.half_space;
      const [w, x, y, z] = turnBetween([0, 1, 0], normal), side = 2 * kHalf;
      return hk.HP_Shape_CreateBox(scaled(normal, offset - kHalf), [x, y, z, w], [side, side, side])[1];
    }
    case "mesh": {
      const corners = triangles(shape).flat();
      return hk.HP_Shape_CreateMesh(inMemory(shape.vertices.flat(), Float32Array), shape.vertices.length,
                                    inMemory(corners, Int32Array), corners.length / 3)[1];
    }
    case "box": {
      const { half, middle } = halfExtents(shape);
      return hk.HP_Shape_CreateBox(middle, [0, 0, 0, 1], scaled(half, 2))[1];
    }
  }
  if (shape.type === "sdf" || (shape.radius ?? 0) > 0) return null;
  return hk.HP_Shape_CreateConvexHull(inMemory(shape.vertices.flat(), Float32Array), shape.vertices.length)[1];
}

const known = new Map();
function knownShape(name, shape) {
  if (!known.has(name)) {
    known.set(name, shapeOf(shape));
    if (known.get(name) === null) leftOut(name, `Havok has no ${shape.type} like it`);
  }
  return known.get(name);
}

/** What the last step found, each event a point. */
function manifoldsOf(world, names) {
  const manifolds = [];
  for (let event = hk.HP_World_GetCollisionEvents(world)[1]; event;
       event = hk.HP_World_GetNextCollisionEvent(Number(world[0]), event)) {
    const [, one, other] = hk.HP_Event_AsCollision(event)[1];
    const [on_a, on_b] = [one[3], other[3]], normal = one[4];
    addPoint(manifolds, names.get(one[0][0]), names.get(other[0][0]), normal,
             { position: on_b, separation: dot(normal, sub(on_b, on_a)), on_a, on_b });
  }
  return manifolds;
}

/** Steps the pieces. */
function worldOf(pieces, gravity, step) {
  const world = hk.HP_World_Create()[1], names = new Map(), bodies = new Map();
  hk.HP_World_SetGravity(world, gravity);
  hk.HP_World_SetIdealStepTime(world, step);
  hk.HP_World_SetSpeedLimit(world, 1e4, 1e3);
  const xyzw = ([w, x, y, z]) => [x, y, z, w];
  for (const piece of pieces) {
    const shape = knownShape(piece.name, piece.shape);
    if (shape === null) refuse(`Havok has no ${piece.shape.type} like '${piece.name}'`);
    hk.HP_Shape_SetMaterial(shape, [piece.friction, piece.friction, piece.restitution,
                                    hk.MaterialCombine.GEOMETRIC_MEAN, hk.MaterialCombine.MAXIMUM]);
    const body = hk.HP_Body_Create()[1];
    hk.HP_Body_SetShape(body, shape);
    hk.HP_Body_SetMotionType(body, piece.isDynamic ? hk.MotionType.DYNAMIC
      : piece.isScripted ? hk.MotionType.KINEMATIC : hk.MotionType.STATIC);
    hk.HP_Body_SetQTransform(body, [piece.pose.position, xyzw(piece.pose.quat_wxyz)]);
    hk.HP_Body_SetEventMask(body, eventTypes);
    if (piece.isDynamic) {
      // Moments are those of one kilogram.
      hk.HP_Body_SetMassProperties(body, [piece.center, piece.mass, scaled(piece.moments, 1 / piece.mass), xyzw(piece.turn)]);
      hk.HP_Body_SetLinearDamping(body, 0);
      hk.HP_Body_SetAngularDamping(body, 0);
    }
    hk.HP_World_AddBody(world, body, false);
    hk.HP_Body_SetActivationControl(body, hk.ActivationControl.ALWAYS_ACTIVE);
    if (piece.isDynamic) {
      hk.HP_Body_SetLinearVelocity(body, piece.velocity);
      hk.HP_Body_SetAngularVelocity(body, piece.spin);
    }
    names.set(body[0], piece.name);
    bodies.set(piece, body);
  }
  return {
    motion(piece) {
      const body = bodies.get(piece), [position, [x, y, z, w]] = hk.HP_Body_GetQTransform(body)[1];
      return { pose: { position, quat_wxyz: [w, x, y, z] }, velocity: hk.HP_Body_GetLinearVelocity(body)[1],
               spin: hk.HP_Body_GetAngularVelocity(body)[1] };
    },
    drive(piece, { next }) {
      hk.HP_Body_SetTargetQTransform(bodies.get(piece), [next.position, xyzw(next.quat_wxyz)]);
    },
    step() {
      hk.HP_World_Step(world, step);
      return manifoldsOf(world, names);
    },
  };
}

if (isRollout) await rollOut("Havok", versionOf("@babylonjs/havok"), worldOf);
else await answer("Havok", versionOf("@babylonjs/havok"), (frame, shapes, asked) => {
  const world = hk.HP_World_Create()[1];
  hk.HP_World_SetGravity(world, [0, 0, 0]);
  const names = new Map(), bodies = [];
  for (const [name, pose] of Object.entries(frame.poses)) {
    const shape = knownShape(name, shapes[name]);
    if (shape === null) continue;
    const body = hk.HP_Body_Create()[1];
    const still = stands(shapes[name]);
    const [w, x, y, z] = pose.quat_wxyz;
    hk.HP_Body_SetShape(body, shape);
    hk.HP_Body_SetMotionType(body, still ? hk.MotionType.STATIC : hk.MotionType.DYNAMIC);
    hk.HP_Body_SetQTransform(body, [pose.position, [x, y, z, w]]);
    hk.HP_Body_SetMassProperties(body, [[0, 0, 0], still ? 0 : 1, [1, 1, 1], [0, 0, 0, 1]]);
    hk.HP_Body_SetEventMask(body, eventTypes);
    hk.HP_World_AddBody(world, body, false);
    names.set(body[0], name);
    bodies.push(body);
  }
  hk.HP_World_Step(world, 1 / 60);
  const manifolds = manifoldsOf(world, names).filter(({ a, b }) => isAsked(asked, a, b));
  for (const body of bodies) {
    hk.HP_World_RemoveBody(world, body);
    hk.HP_Body_Release(body);
  }
  hk.HP_World_Release(world);
  return manifolds;
});
