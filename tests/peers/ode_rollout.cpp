// ODE 0.16 steps a scene with dWorldQuickStep and its world's default settings.
#include <ode/ode.h>

#include <cmath>
#include <deque>

#include "peers/ode_geometry.h"
#include "peers/rollout.h"

namespace contactscope::peers {
namespace {

constexpr int kMaxPointsOfPair = 64;  // per pair of geoms
constexpr double kSlowBounce = 0.01;  // m/s: no bounce below this speed

Vec3d vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

class OdeWorld : public RolloutWorld {
 public:
  OdeWorld(const std::vector<Piece>& pieces, const Vec3d& gravity) : pieces_(pieces) {
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    dSpaceSetCleanup(space_, 0);  // each geom belongs to its OdeGeometry
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
    for (int i = 0; i < count_of(pieces); ++i) add(at(pieces, i), i);
  }
  ~OdeWorld() override {
    dJointGroupDestroy(contacts_);
    geometries_.clear();
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  BodyMotion motion(int piece) override {
    const dBodyID body = at(bodies_, piece);
    const dReal* const q = dBodyGetQuaternion(body);
    return {{Quatd(q[0], q[1], q[2], q[3]), vector_of(dBodyGetPosition(body))},
            vector_of(dBodyGetLinearVel(body)),
            vector_of(dBodyGetAngularVel(body))};
  }

  void drive(int piece, const BodyMotion& motion) override {
    const dBodyID body = at(bodies_, piece);
    if (body == nullptr) return at(geometries_, piece)->place(motion.pose);  // a plane
    place(body, motion);
  }

  std::vector<Touch> step(double seconds) override {
    dSpaceCollide(space_, this, [](void* self, dGeomID one, dGeomID other) {
      static_cast<OdeWorld*>(self)->collide(one, other);
    });
    dWorldQuickStep(world_, seconds);
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      // The first force acts on the first body, or on the only one.
      const bool has_a = at(bodies_, touches_[i].a) != nullptr;
      const bool has_b = at(bodies_, touches_[i].b) != nullptr;
      const dJointFeedback& record = feedbacks_[i];
      const Vec3d force =
          has_b ? vector_of(has_a ? record.f2 : record.f1) : Vec3d(-vector_of(record.f1));
      const Vec3d on_b = seconds * force;
      const Vec3d& normal = touches_[i].point.normal;
      const double along = on_b.dot(normal);
      touches_[i].impulse = trace::Impulse{along, on_b - along * normal};
    }
    dJointGroupEmpty(contacts_);
    feedbacks_.clear();
    return std::exchange(touches_, {});
  }

  int iterations() const override { return dWorldGetQuickStepNumIterations(world_); }

 private:
  void add(const Piece& piece, int index) {
    geometries_.push_back(std::make_unique<OdeGeometry>(piece.shape, meshes_));
    const dGeomID geom = geometries_.back()->id();
    dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(index)));
    dSpaceAdd(space_, geom);
    bodies_.push_back(nullptr);
    if (dGeomGetClass(geom) == dPlaneClass || (!piece.is_dynamic && !piece.is_scripted))
      return geometries_.back()->place(piece.start.pose);
    const dBodyID body = bodies_.back() = dBodyCreate(world_);
    dGeomSetBody(geom, body);
    const Pose<double>& frame = geometries_.back()->frame();
    if (!frame.position.isZero(0))
      dGeomSetOffsetPosition(geom, frame.position.x(), frame.position.y(), frame.position.z());
    if (piece.is_dynamic) {
      dMass mass;
      dMassSetParameters(&mass, piece.mass, 0, 0, 0, piece.moments.x(), piece.moments.y(),
                         piece.moments.z(), 0, 0, 0);
      dBodySetMass(body, &mass);
    } else {
      dBodySetKinematic(body);
    }
    place(body, piece.start);
  }

  static void place(dBodyID body, const BodyMotion& motion) {
    const Quatd& q = motion.pose.rotation;
    const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
    const Vec3d &p = motion.pose.position, &v = motion.velocity, &w = motion.angular_velocity;
    dBodySetPosition(body, p.x(), p.y(), p.z());
    dBodySetQuaternion(body, turned);
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
    dBodySetAngularVel(body, w.x(), w.y(), w.z());
  }

  static int piece_of(dGeomID geom) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom)));
  }

  void collide(dGeomID one, dGeomID other) {
    const Piece &a = at(pieces_, piece_of(one)), &b = at(pieces_, piece_of(other));
    if (!a.is_dynamic && !b.is_dynamic) return;
    std::array<dContactGeom, kMaxPointsOfPair> found;
    const int count = dCollide(one, other, kMaxPointsOfPair, found.data(), sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.geom = at(found, i);
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = std::sqrt(a.friction * b.friction);
      const double bounce = std::max(a.restitution, b.restitution);
      if (bounce > 0) {
        contact.surface.mode |= dContactBounce;
        contact.surface.bounce = bounce;
        contact.surface.bounce_vel = kSlowBounce;
      }
      const int first = piece_of(contact.geom.g1), second = piece_of(contact.geom.g2);
      const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
      dJointAttach(joint, at(bodies_, first), at(bodies_, second));
      dJointSetFeedback(joint, &feedbacks_.emplace_back());
      // ODE's normal points into the first body.
      touches_.push_back(
          {first,
           second,
           {vector_of(contact.geom.pos), -contact.geom.depth, -vector_of(contact.geom.normal)}});
    }
  }

  OdeLibrary library_;
  std::vector<Piece> pieces_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  OdeMeshes meshes_;
  std::vector<std::unique_ptr<OdeGeometry>> geometries_;
  std::vector<dBodyID> bodies_;  // one per piece; null if static
  std::vector<Touch> touches_;
  std::deque<dJointFeedback> feedbacks_;  // one per touch; their addresses must not change
};

}  // namespace

RolloutEngine ode_rollout() {
  return {"ODE", dODE_VERSION, Vec3d::UnitZ(),
          [](const std::vector<Piece>& pieces, const Vec3d& g, double) {
            for (const Piece& mesh : pieces)
              for (const Piece& hull : pieces)
                if (std::holds_alternative<std::shared_ptr<const Mesh<double>>>(mesh.shape) &&
                    std::holds_alternative<Hull<double>>(hull.shape))
                  throw NotStepped("ODE has nothing for a hull on a mesh: '" + hull.name +
                                   "' and '" + mesh.name + "'");
            return std::make_unique<OdeWorld>(pieces, g);
          }};
}

}  // namespace contactscope::peers
