// PhysX 5: a scene is made of each frame, and its contact reports are read. The normal points from shape 1 of a
// pair to shape 0, and the points are on shape 1.

import { readFileSync } from "node:fs";
import { impulseOf, isRollout, refuse, rollOut } from "./rollout.mjs";
import { addPoint, answer, halfExtents, isAsked, isCentered, leftOut, scaled, segmentOf, stands, triangles, turnBetween,
         versionOf } from "./trace.mjs";

// The module was built for browsers alone, and asks whether it is in one.
const node = globalThis.process;
globalThis.process = undefined;
globalThis.window = globalThis;
globalThis.document = { currentScript: null };
const { default: PhysX } = await import("physx-js-webidl");
const px = await PhysX({
  wasmBinary: readFileSync(new URL("node_modules/physx-js-webidl/physx-js-webidl.wasm", import.meta.url)),
});
globalThis.process = node;

const top = px.PxTopLevelFunctions.prototype;
const foundation = top.CreateFoundation(top.PHYSICS_VERSION, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
const scale = new px.PxTolerancesScale();
const physics = top.CreatePhysics(top.PHYSICS_VERSION, foundation, scale);
const material = physics.createMaterial(0.5, 0.5, 0);
const dispatcher = top.DefaultCpuDispatcherCreate(0);
const cooking = new px.PxCookingParams(scale);
const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE);
const all = new px.PxFilterData(1, 1, 0, 0);

const vec = ([x, y, z]) => new px.PxVec3(x, y, z);
const numbers = (v) => [v.x, v.y, v.z];
const transform = (position, [w, x, y, z]) => new px.PxTransform(vec(position), new px.PxQuat(x, y, z, w));

// Capsules lie along x, and planes look along it.
const fromX = (to) => turnBetween([1, 0, 0], to);

function pointsOf(shape) {
  const points = new px.PxArray_PxVec3();
  for (const vertex of shape.vertices) points.pushBack(vec(vertex));
  return points;
}

/** [geometry, position, rotation] in the frame of the shape; null of what PhysX does not have. */
function geometryOf(shape) {
  switch (shape.type) {
    case "sphere":
      return [new px.PxSphereGeometry(shape.radius), shape.vertices[0], [1, 0, 0, 0]];
    case "capsule": {
      const { middle, length, direction } = segmentOf(shape);
      if (length === 0) return [new px.PxSphereGeometry(shape.radius), middle, [1, 0, 0, 0]];
      return [new px.PxCapsuleGeometry(shape.radius, length / 2), middle, fromX(direction)];
    }
    case "plane": {
      const { normal, offset } = shape.half_space;
      return [new px.PxPlaneGeometry(), scaled(normal, offset), fromX(normal)];
    }
    case "mesh": {
      const points = pointsOf(shape), corners = triangles(shape).flat();
      const indices = new px.PxArray_PxU32(corners.length);
      corners.forEach((index, i) => indices.set(i, index));
      const desc = new px.PxTriangleMeshDesc();
      desc.points.count = points.size();
      desc.points.stride = 12;
      desc.points.data = points.begin();
      desc.triangles.count = corners.length / 3;
      desc.triangles.stride = 12;
      desc.triangles.data = indices.begin();
      return [new px.PxTriangleMeshGeometry(top.CreateTriangleMesh(cooking, desc)), [0, 0, 0], [1, 0, 0, 0]];
    }
    case "box":
      if (isCentered(shape))
        return [new px.PxBoxGeometry(...halfExtents(shape).half), [0, 0, 0], [1, 0, 0, 0]];
  }
  if (shape.type === "sdf" || (shape.radius ?? 0) > 0) return null;
  const points = pointsOf(shape), desc = new px.PxConvexMeshDesc();
  desc.points.count = points.size();
  desc.points.stride = 12;
  desc.points.data = points.begin();
  desc.flags = new px.PxConvexFlags(px.PxConvexFlagEnum.eCOMPUTE_CONVEX);
  const mesh = top.CreateConvexMesh(cooking, desc);
  return mesh ? [new px.PxConvexMeshGeometry(mesh), [0, 0, 0], [1, 0, 0, 0]] : null;
}

const known = new Map();
function knownGeometry(name, shape) {
  if (!known.has(name)) {
    known.set(name, geometryOf(shape));
    if (known.get(name) === null) leftOut(name, `PhysX has no ${shape.type} like it`);
  }
  return known.get(name);
}

let manifolds = [], names = new Map();
const kMostPoints = 64;
const buffer = new px.PxArray_PxContactPairPoint(kMostPoints);
const events = new px.PxSimulationEventCallbackImpl();
for (const unused of ["onConstraintBreak", "onWake", "onSleep", "onTrigger"]) events[unused] = () => {};
events.onContact = (headerPointer, pairsPointer, count) => {
  const arrays = px.NativeArrayHelpers.prototype;
  for (let i = 0; i < count; ++i) {
    const pair = arrays.getContactPairAt(px.wrapPointer(pairsPointer, px.PxContactPair), i);
    const [a, b] = [0, 1].map((k) => names.get(pair.get_shapes(k).ptr));
    const found = pair.extractContacts(buffer.begin(), kMostPoints);
    for (let k = 0; k < found; ++k) {
      const point = buffer.get(k), normal = scaled(numbers(point.normal), -1);
      // An impulse is on shape 0.
      addPoint(manifolds, a, b, normal,
               { position: numbers(point.position), separation: point.separation,
                 ...(isRollout ? { impulse: impulseOf(scaled(numbers(point.impulse), -1), normal) } : {}) });
    }
  }
};

// Every pair is looked at, and its contacts are told.
const pairFlags = ["eSOLVE_CONTACT", "eDETECT_DISCRETE_CONTACT", "eNOTIFY_TOUCH_FOUND", "eNOTIFY_TOUCH_PERSISTS",
                   "eNOTIFY_CONTACT_POINTS"].reduce((sum, name) => sum | px.PxPairFlagEnum[name], 0);
const filter = new px.PassThroughFilterShaderImpl();
filter.filterShader = () => {
  filter.outputPairFlags = pairFlags;
  return px.PxFilterFlagEnum.eDEFAULT;
};

function sceneWith(gravity) {
  const desc = new px.PxSceneDesc(scale);
  desc.gravity = vec(gravity);
  desc.cpuDispatcher = dispatcher;
  desc.simulationEventCallback = events;
  top.setupPassThroughFilterShader(desc, filter);
  return physics.createScene(desc);
}

/** Steps the pieces. */
function worldOf(pieces, gravity, step) {
  const scene = sceneWith(gravity);
  const actors = new Map(), combine = px.PxCombineModeEnum;
  for (const piece of pieces) {
    const geometry = knownGeometry(piece.name, piece.shape);
    if (geometry === null) refuse(`PhysX has no ${piece.shape.type} like '${piece.name}'`);
    // It multiplies frictions.
    const surface = physics.createMaterial(Math.sqrt(piece.friction), Math.sqrt(piece.friction), piece.restitution);
    surface.setFrictionCombineMode(combine.eMULTIPLY);
    surface.setRestitutionCombineMode(combine.eMAX);
    const at = transform(piece.pose.position, piece.pose.quat_wxyz);
    const moves = piece.isDynamic || piece.isScripted;
    const actor = moves ? physics.createRigidDynamic(at) : physics.createRigidStatic(at);
    const shape = physics.createShape(geometry[0], surface, true, flags);
    shape.setLocalPose(transform(geometry[1], geometry[2]));
    shape.setSimulationFilterData(all);
    actor.attachShape(shape);
    names.set(shape.ptr, piece.name);
    if (piece.isScripted) actor.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eKINEMATIC, true);
    if (piece.isDynamic) {
      actor.setCMassLocalPose(transform(piece.center, piece.turn));
      actor.setMass(piece.mass);
      actor.setMassSpaceInertiaTensor(vec(piece.moments));
      actor.setLinearDamping(0);
      actor.setAngularDamping(0);
      actor.setSleepThreshold(0);
      actor.setLinearVelocity(vec(piece.velocity));
      actor.setAngularVelocity(vec(piece.spin));
    }
    scene.addActor(actor);
    actors.set(piece, actor);
  }
  return {
    motion(piece) {
      const actor = actors.get(piece), { p, q } = actor.getGlobalPose();
      return { pose: { position: numbers(p), quat_wxyz: [q.w, q.x, q.y, q.z] },
               velocity: numbers(actor.getLinearVelocity()), spin: numbers(actor.getAngularVelocity()) };
    },
    drive(piece, { next }) {
      actors.get(piece).setKinematicTarget(transform(next.position, next.quat_wxyz));
    },
    step() {
      manifolds = [];
      scene.simulate(step);
      scene.fetchResults(true);
      return manifolds;
    },
  };
}

if (isRollout) await rollOut("PhysX", versionOf("physx-js-webidl"), worldOf);
else await answer("PhysX", versionOf("physx-js-webidl"), (frame, shapes, asked) => {
  const scene = sceneWith([0, 0, 0]);
  names = new Map();
  manifolds = [];
  const actors = [];
  for (const [name, pose] of Object.entries(frame.poses)) {
    const geometry = knownGeometry(name, shapes[name]);
    if (geometry === null) continue;
    const still = stands(shapes[name]);
    const at = transform(pose.position, pose.quat_wxyz);
    const actor = still ? physics.createRigidStatic(at) : physics.createRigidDynamic(at);
    const shape = physics.createShape(geometry[0], material, true, flags);
    shape.setLocalPose(transform(geometry[1], geometry[2]));
    shape.setSimulationFilterData(all);
    actor.attachShape(shape);
    names.set(shape.ptr, name);
    if (!still) {
      actor.setMass(1);
      actor.setMassSpaceInertiaTensor(new px.PxVec3(1, 1, 1));
    }
    scene.addActor(actor);
    actors.push(actor);
  }
  scene.simulate(1 / 60);
  scene.fetchResults(true);
  for (const actor of actors) actor.release();
  scene.release();
  return manifolds.filter(({ a, b }) => isAsked(asked, a, b));
});
