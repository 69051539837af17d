// Jolt Physics: each frame its bodies are placed, and the contacts that a step of it begins with are taken
// from the listener. The normal points from body 1 to body 2; a manifold has points on both surfaces.

import initJolt from "jolt-physics/wasm-compat";
import { isRollout, refuse, rollOut } from "./rollout.mjs";
import { answer, dot, halfExtents, isAsked, isCentered, leftOut, segmentOf, stands, sub, triangles, turnBetween,
         versionOf } from "./trace.mjs";

const Jolt = await initJolt();
const kMoving = 1, kStanding = 0;  // layers

const settings = new Jolt.JoltSettings();
const layers = new Jolt.ObjectLayerPairFilterTable(2);
layers.EnableCollision(kStanding, kMoving);
layers.EnableCollision(kMoving, kMoving);
const broadPhase = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
broadPhase.MapObjectToBroadPhaseLayer(kStanding, new Jolt.BroadPhaseLayer(0));
broadPhase.MapObjectToBroadPhaseLayer(kMoving, new Jolt.BroadPhaseLayer(1));
settings.mObjectLayerPairFilter = layers;
settings.mBroadPhaseLayerInterface = broadPhase;
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
  broadPhase, 2, layers, 2);
const jolt = new Jolt.JoltInterface(settings);
const system = jolt.GetPhysicsSystem();
system.SetGravity(new Jolt.Vec3(0, 0, 0));
const bodies = system.GetBodyInterface();

const vec = ([x, y, z]) => new Jolt.Vec3(x, y, z);
const numbers = (v) => [v.GetX(), v.GetY(), v.GetZ()];

// The engine's own radius of rounded corners, where a shape is large enough for it.
const convexRadius = (half) => Math.min(0.05, 0.25 * Math.min(...half));

function shapeSettings(shape) {
  const { half } = halfExtents(shape.vertices.length > 0 ? shape : { vertices: [[0, 0, 0]] });
  switch (shape.type) {
    case "sphere":
      return new Jolt.SphereShapeSettings(shape.radius);
    case "capsule": {
      const { middle: center, length, direction } = segmentOf(shape);
      const [w, x, y, z] = turnBetween([0, 1, 0], direction);
      return new Jolt.RotatedTranslatedShapeSettings(
        vec(center), new Jolt.Quat(x, y, z, w), new Jolt.CapsuleShapeSettings(length / 2, shape.radius));
    }
    case "plane": {
      const { normal, offset } = shape.half_space;
      return new Jolt.PlaneShapeSettings(new Jolt.Plane(vec(normal), -offset), null, 1000);
    }
    case "mesh": {
      const list = new Jolt.TriangleList();
      const corners = triangles(shape);
      list.resize(corners.length);
      corners.forEach((corner, i) => {
        const triangle = list.at(i);
        corner.forEach((index, k) => {
          const v = triangle.get_mV(k), [x, y, z] = shape.vertices[index];
          v.x = x; v.y = y; v.z = z;
        });
      });
      return new Jolt.MeshShapeSettings(list);
    }
    case "box":
      if (isCentered(shape)) return new Jolt.BoxShapeSettings(vec(half), convexRadius(half));
  }
  if (shape.type === "sdf" || (shape.radius ?? 0) > 0) return null;
  const hull = new Jolt.ConvexHullShapeSettings();
  for (const vertex of shape.vertices) hull.mPoints.push_back(vec(vertex));
  hull.mMaxConvexRadius = convexRadius(half.map((h) => h || 0.04));
  return hull;
}

const made = new Map();   // bodies by name
const names = new Map();  // by number of the body
function bodyOf(name, shape, pose) {
  if (made.has(name)) return made.get(name);
  const wanted = shapeSettings(shape);
  const result = wanted === null ? null : wanted.Create();
  let body = null;
  if (result === null || result.HasError()) {
    leftOut(name, result === null ? `Jolt has no ${shape.type}` : result.GetError().c_str());
  } else {
    const creation = new Jolt.BodyCreationSettings(
      result.Get(), new Jolt.RVec3(...pose.position), new Jolt.Quat(0, 0, 0, 1),
      stands(shape) ? Jolt.EMotionType_Static : Jolt.EMotionType_Dynamic,
      stands(shape) ? kStanding : kMoving);
    creation.mAllowSleeping = false;
    body = bodies.CreateBody(creation);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    names.set(body.GetID().GetIndexAndSequenceNumber(), name);
  }
  made.set(name, body);
  return body;
}

let found = [];
const listener = new Jolt.ContactListenerJS();
const seen = (pointer1, pointer2, pointer) => {
  const body1 = Jolt.wrapPointer(pointer1, Jolt.Body), body2 = Jolt.wrapPointer(pointer2, Jolt.Body);
  const manifold = Jolt.wrapPointer(pointer, Jolt.ContactManifold);
  const normal = numbers(manifold.mWorldSpaceNormal);
  const points = [];
  for (let i = 0; i < manifold.mRelativeContactPointsOn1.size(); ++i) {
    const on_a = numbers(manifold.GetWorldSpaceContactPointOn1(i));
    const on_b = numbers(manifold.GetWorldSpaceContactPointOn2(i));
    points.push({ position: on_b, separation: dot(sub(on_b, on_a), normal), on_a, on_b });
  }
  const name = (body) => names.get(body.GetID().GetIndexAndSequenceNumber());
  found.push({ a: name(body1), b: name(body2), normal, points });
};
listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
listener.OnContactAdded = seen;
listener.OnContactPersisted = seen;
listener.OnContactRemoved = () => {};
system.SetContactListener(listener);

/** Steps the pieces. Jolt works out the inertia of a mass that fills its shape evenly, about the centre that it has. */
function worldOf(pieces, gravity, step) {
  system.SetGravity(vec(gravity));
  const ids = new Map();
  const quat = ([w, x, y, z]) => new Jolt.Quat(x, y, z, w);
  for (const piece of pieces) {
    const wanted = shapeSettings(piece.shape), result = wanted === null ? null : wanted.Create();
    if (result === null || result.HasError())
      refuse(`Jolt has no ${piece.shape.type} like '${piece.name}'` + (result === null ? "" : `: ${result.GetError().c_str()}`));
    const moves = piece.isDynamic || piece.isScripted;
    const creation = new Jolt.BodyCreationSettings(
      result.Get(), new Jolt.RVec3(...piece.pose.position), quat(piece.pose.quat_wxyz),
      piece.isDynamic ? Jolt.EMotionType_Dynamic : piece.isScripted ? Jolt.EMotionType_Kinematic : Jolt.EMotionType_Static,
      moves ? kMoving : kStanding);
    creation.mAllowSleeping = false;
    creation.mLinearDamping = creation.mAngularDamping = 0;
    creation.mMaxLinearVelocity = 1e4;
    creation.mApplyGyroscopicForce = true;
    creation.mFriction = piece.friction;
    creation.mRestitution = piece.restitution;
    if (piece.isDynamic) {
      creation.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
      creation.mMassPropertiesOverride.mMass = piece.mass;
    }
    const id = bodies.CreateBody(creation).GetID();
    bodies.AddBody(id, Jolt.EActivation_Activate);
    names.set(id.GetIndexAndSequenceNumber(), piece.name);
    ids.set(piece, id);
    if (!piece.isDynamic) continue;
    bodies.SetLinearVelocity(id, vec(piece.velocity));
    bodies.SetAngularVelocity(id, vec(piece.spin));
  }
  return {
    motion(piece) {
      const id = ids.get(piece), q = bodies.GetRotation(id);
      return { pose: { position: numbers(bodies.GetPosition(id)), quat_wxyz: [q.GetW(), q.GetX(), q.GetY(), q.GetZ()] },
               velocity: numbers(bodies.GetLinearVelocity(id)), spin: numbers(bodies.GetAngularVelocity(id)) };
    },
    drive(piece, { next }) {
      bodies.MoveKinematic(ids.get(piece), new Jolt.RVec3(...next.position), quat(next.quat_wxyz), step);
    },
    step() {
      found = [];
      jolt.Step(step, 1);
      return found;
    },
  };
}

if (isRollout) await rollOut("Jolt", versionOf("jolt-physics"), worldOf);
else await answer("Jolt", versionOf("jolt-physics"), (frame, shapes, asked) => {
  for (const [name, pose] of Object.entries(frame.poses)) {
    const body = bodyOf(name, shapes[name], pose);
    if (body === null) continue;
    const [w, x, y, z] = pose.quat_wxyz;
    bodies.SetPositionAndRotation(body.GetID(), new Jolt.RVec3(...pose.position),
                                  new Jolt.Quat(x, y, z, w), Jolt.EActivation_Activate);
    if (body.IsStatic()) continue;
    bodies.SetLinearVelocity(body.GetID(), new Jolt.Vec3(0, 0, 0));
    bodies.SetAngularVelocity(body.GetID(), new Jolt.Vec3(0, 0, 0));
  }
  found = [];
  jolt.Step(1 / 60, 1);
  return found.filter(({ a, b }) => isAsked(asked, a, b));
});
