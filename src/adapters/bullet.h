/// Records the contacts and impulses of Bullet 3 (float or double) for contactscope:
///
///     contactscope::BulletRecorder recorder(world, "stack.jsonl");
///
/// Create it after the world has its own tick callbacks; each later step becomes a frame. C++11.
/// Define CONTACTSCOPE_IMPLEMENTATION before this include in one source file. README.md explains
/// the conversions. Poses are from before the step, as contacts are: Bullet detects, solves and
/// integrates in this order, so after the step the bodies have moved on.
///
/// MIT License; the text is in recorder/contactscope.h.
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
  /// `scenario` is GROUP/IDEA, the folder of the pictures. The world must outlive the recorder.
  /// Tick callbacks that are set later replace the recorder's.
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
  BulletRecorder(btDynamicsWorld* world, const char* path, const char* scenario = "bullet/run")
      : BulletRecorder(*world, path, scenario) {}
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

  /// Call it before the first step with the object. The default is the shape's kind and a number.
  void name(const btCollisionObject* object, const std::string& name) { names_[object] = name; }

  /// Null before the first step and if the file cannot be created.
  cs_recorder* recorder() const { return recorder_; }

 private:
  /// The callbacks are protected, and their setter would overwrite the user pointer of the program.
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
    if (self->before_) self->before_(world, step);  // first: it may move bodies
    self->record_bodies();
  }
  static void end_step(btDynamicsWorld* world, btScalar step) {
    BulletRecorder* self = recorders()[world];
    self->record_contacts(step);
    if (self->after_) self->after_(world, step);  // last: it may remove bodies
  }

  /// Changes if the memory holds another body, or if the body has another shape.
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
    int shape;  // its compound, or its only leaf; -1: nothing of it is recorded
    std::vector<bullet::Leaf> leaves;
  };
  /// Points with the same normal and triangle. One Bullet manifold may have several of both.
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
    // The proxy's unique id distinguishes a body from a later one in the same memory.
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
    // Points of a sleeping pair keep the impulses of their last step.
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

  /// Bullet's impulses act on a, recorded ones on b.
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
