/// Records what Bullet 3, in float or double, finds and solves, for contactscope:
///
///     contactscope::BulletRecorder recorder(world, "stack.jsonl");
///
/// after the world has its own tick callbacks; from then on each step is a frame. One source file of the program
/// defines CONTACTSCOPE_IMPLEMENTATION before this include. C++11. README.md says what is turned and why.
///
/// A frame has the poses from before the step, which are those of its contacts: Bullet detects, solves and
/// integrates, in this order, and at the end of the step the bodies have left the points behind.
///
/// MIT License, as recorder/contactscope.h, which has its text.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bullet_shapes.h"

namespace contactscope {

class BulletRecorder {
 public:
  /// Writes to `path`; `scenario` is GROUP/IDEA, where pictures go. The world must outlive the recorder, and
  /// callbacks that it gets later displace the recorder's.
  BulletRecorder(btDynamicsWorld& world, const char* path, const char* scenario = "bullet/run")
      : world_(world),
        path_(path),
        scenario_(scenario),
        before_(world.*Callbacks::before()),
        after_(world.*Callbacks::after()) {
    recorders()[&world] = this;
    world.*Callbacks::before() = &BulletRecorder::begin_step;
    world.*Callbacks::after() = &BulletRecorder::end_step;
  }
  ~BulletRecorder() {
    if (world_.*Callbacks::before() == &BulletRecorder::begin_step)
      world_.*Callbacks::before() = before_;
    if (world_.*Callbacks::after() == &BulletRecorder::end_step)
      world_.*Callbacks::after() = after_;
    recorders().erase(&world_);
    cs_stop(recorder_);
  }
  BulletRecorder(const BulletRecorder&) = delete;
  BulletRecorder& operator=(const BulletRecorder&) = delete;

  /// Before the first step that has the object; without a name it is called by the kind of its shape and a number.
  void name(const btCollisionObject* object, const std::string& name) { names_[object] = name; }

  /// What it writes with: null before the first step, and where the file cannot be made.
  cs_recorder* recorder() const { return recorder_; }

 private:
  /// The world's callbacks are protected, and its setter overwrites the user's pointer, which theirs need.
  struct Callbacks : btDynamicsWorld {
    static btInternalTickCallback btDynamicsWorld::*before() {
      return &Callbacks::m_internalPreTickCallback;
    }
    static btInternalTickCallback btDynamicsWorld::*after() {
      return &Callbacks::m_internalTickCallback;
    }
  };
  static std::map<const btDynamicsWorld*, BulletRecorder*>& recorders() {
    static std::map<const btDynamicsWorld*, BulletRecorder*> all;
    return all;
  }
  static void begin_step(btDynamicsWorld* world, btScalar step) {
    BulletRecorder* self = recorders()[world];
    if (self->before_) self->before_(world, step);  // it may move bodies: first
    self->record_bodies();
  }
  static void end_step(btDynamicsWorld* world, btScalar step) {
    BulletRecorder* self = recorders()[world];
    self->record_contacts(step);
    if (self->after_) self->after_(world, step);  // it may remove bodies: last
  }

  /// Differs where it is another body, or has another shape.
  struct Signature {
    int proxy, type, revision;
    const btCollisionShape* form;
    std::array<btScalar, 10> numbers;
    bool operator==(const Signature& other) const {
      return proxy == other.proxy && type == other.type && revision == other.revision &&
             form == other.form && numbers == other.numbers;
    }
  };
  struct Body {
    Signature signature;
    bool is_there;
    int shape;  // its compound, or its only leaf; -1: nothing of it can be told
    std::vector<bullet::Leaf> leaves;
  };
  /// Points with one normal, on one triangle: Bullet's own manifold may have several of either.
  struct Found {
    int a, b, triangle;
    bullet::Vector normal;
    std::vector<cs_point> points;
    bool is_with(const Found& other) const {
      return a == other.a && b == other.b && triangle == other.triangle && normal == other.normal;
    }
  };

  static Signature signature_of(const btCollisionObject& object) {
    const btCollisionShape* form = object.getCollisionShape();
    const btBroadphaseProxy* proxy = object.getBroadphaseHandle();
    btVector3 low, high;
    form->getAabb(btTransform::getIdentity(), low, high);
    const btVector3& scale = form->getLocalScaling();
    const int revision =
        form->isCompound() ? static_cast<const btCompoundShape*>(form)->getUpdateRevision() : 0;
    // The number of its proxy tells a body from a later one in the same memory.
    return {proxy ? proxy->getUid() : -1,
            form->getShapeType(),
            revision,
            form,
            {{low.x(), low.y(), low.z(), high.x(), high.y(), high.z(), scale.x(), scale.y(),
              scale.z(), form->getMargin()}}};
  }

  void start() {
    has_started_ = true;
    const btVector3 down = world_.getGravity();
    cs_settings settings = cs_settings();
    settings.doubles = sizeof(btScalar) == sizeof(double);
    settings.z_up = std::abs(down.z()) > std::abs(down.y());
    settings.poses_at = 1;
    char version[16];
    std::snprintf(version, sizeof version, "%d.%02d", btGetVersion() / 100, btGetVersion() % 100);
    recorder_ = cs_start(path_.c_str(), scenario_.c_str(), "Bullet", version, &settings);
    if (!recorder_) std::fprintf(stderr, "contactscope: %s cannot be written\n", path_.c_str());
    writer_.reset(new bullet::ShapeWriter(recorder_));
  }

  void record_bodies() {
    if (!has_started_) start();
    if (!recorder_) return;
    find_bodies();
    cs_begin_frame(recorder_, time_);
    const btContactSolverInfo& solver = world_.getSolverInfo();
    cs_solver(recorder_, solver.m_numIterations, 1,
              (solver.m_solverMode & SOLVER_USE_WARMSTARTING) != 0);
    for (const auto& entry : bodies_) {
      if (entry.second.shape < 0) continue;
      const btTransform& pose = entry.first->getWorldTransform();
      const bullet::Vector place = bullet::vector_of(pose.getOrigin());
      cs_pose(recorder_, entry.second.shape, place.data(), bullet::quaternion_of(pose).data());
      const btRigidBody* body = btRigidBody::upcast(entry.first);
      if (!body || body->isStaticOrKinematicObject() || !(body->getInvMass() > 0)) continue;
      cs_body(recorder_, entry.second.shape, 1 / double(body->getInvMass()), place.data(),
              bullet::vector_of(body->getLinearVelocity()).data(),
              bullet::vector_of(body->getAngularVelocity()).data());
    }
  }

  void find_bodies() {
    for (auto& entry : bodies_) entry.second.is_there = false;
    const btCollisionObjectArray& objects = world_.getCollisionObjectArray();
    for (int i = 0; i < objects.size(); ++i) {
      const Signature signature = signature_of(*objects[i]);
      const auto known = bodies_.find(objects[i]);
      if (known != bodies_.end() && known->second.signature == signature) {
        known->second.is_there = true;
        continue;
      }
      const auto name = names_.find(objects[i]);
      Body body = {signature, true, -1, {}};
      body.leaves = writer_->write(objects[i]->getCollisionShape(),
                                   name == names_.end() ? "" : name->second, body.shape);
      bodies_[objects[i]] = body;
    }
    for (auto entry = bodies_.begin(); entry != bodies_.end();)
      entry = entry->second.is_there ? std::next(entry) : bodies_.erase(entry);
  }

  static bool is_moved_by_solver(const btCollisionObject* object) {
    return !object->isStaticOrKinematicObject() && object->isActive();
  }

  void record_contacts(btScalar step) {
    time_ += double(step);
    if (!recorder_) return;
    btDispatcher* dispatcher = world_.getDispatcher();
    for (int i = 0; i < dispatcher->getNumManifolds(); ++i)
      record_manifold(*dispatcher->getManifoldByIndexInternal(i));
    cs_end_frame(recorder_);
  }

  void record_manifold(const btPersistentManifold& manifold) {
    const btCollisionObject *a = manifold.getBody0(), *b = manifold.getBody1();
    const auto body_a = bodies_.find(a), body_b = bodies_.find(b);
    if (body_a == bodies_.end() || body_b == bodies_.end()) return;
    const bool is_sensor = !a->hasContactResponse() || !b->hasContactResponse();
    // Points of a pair that sleeps keep the impulses of its last step.
    const bool is_solved = !is_sensor && (is_moved_by_solver(a) || is_moved_by_solver(b));
    std::vector<Found> groups;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& found = manifold.getContactPoint(i);
      const Where at_a =
          where(body_a->second, *a, found.m_partId0, found.m_index0, found.getPositionWorldOnA());
      const Where at_b =
          where(body_b->second, *b, found.m_partId1, found.m_index1, found.getPositionWorldOnB());
      if (at_a.shape < 0 || at_b.shape < 0) continue;
      cs_point point = point_of(found);
      point.has_impulse = is_solved;
      point.idle = is_sensor || (is_solved && point.separation > 0 && point.impulse == 0);
      // Bullet's normal points from b to a.
      const Found one = {at_a.shape,
                         at_b.shape,
                         at_a.triangle >= 0 ? at_a.triangle : at_b.triangle,
                         bullet::vector_of(-found.m_normalWorldOnB),
                         {point}};
      std::size_t group = 0;
      while (group < groups.size() && !groups[group].is_with(one)) ++group;
      if (group == groups.size())
        groups.push_back(one);
      else
        groups[group].points.push_back(point);
    }
    for (const Found& group : groups)
      cs_manifold(recorder_, group.a, group.b, group.normal.data(), group.triangle,
                  group.points.data(), int(group.points.size()));
  }

  struct Where {
    int shape, triangle;
  };
  static Where where(const Body& body, const btCollisionObject& object, int part, int index,
                     const btVector3& point) {
    const btTransform& pose = object.getWorldTransform();
    const bullet::Leaf* leaf = bullet::leaf_at(body.leaves, pose, part, index, point);
    if (!leaf) return {-1, -1};
    return {leaf->shape, bullet::triangle_at(*leaf, pose, part, index, point)};
  }

  /// Its impulses act on a; ours on b.
  static cs_point point_of(const btManifoldPoint& found) {
    const btVector3 friction = -(found.m_appliedImpulseLateral1 * found.m_lateralFrictionDir1 +
                                 found.m_appliedImpulseLateral2 * found.m_lateralFrictionDir2);
    cs_point point = cs_point();
    for (int k = 0; k < 3; ++k) {
      point.on_a[k] = double(found.getPositionWorldOnA()[k]);
      point.on_b[k] = double(found.getPositionWorldOnB()[k]);
      point.position[k] = (point.on_a[k] + point.on_b[k]) / 2;
      point.friction[k] = double(friction[k]);
    }
    point.has_sides = 1;
    point.separation = double(found.getDistance());
    point.impulse = double(found.m_appliedImpulse);
    return point;
  }

  btDynamicsWorld& world_;
  std::string path_, scenario_;
  btInternalTickCallback before_, after_;
  cs_recorder* recorder_ = nullptr;
  std::unique_ptr<bullet::ShapeWriter> writer_;
  bool has_started_ = false;
  double time_ = 0;
  std::map<const btCollisionObject*, std::string> names_;
  std::map<const btCollisionObject*, Body> bodies_;
};

}  // namespace contactscope
