// Bullet 3.24 as Debian builds it, in float.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>

#include "peers/impact_peer.h"

namespace contactscope::peers {
namespace {

enum class CastMethod { Continuous, Gjk, Subsimplex };

btTransform cast_transform(const Pose<float>& pose) {
  const Quat<float>& q = pose.rotation;
  const Vec3<float>& p = pose.position;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), btVector3(p.x(), p.y(), p.z()));
}

struct CastBody {
  CastBody(const Hull<float>& hull, const Sweep<float>& motion)
      : shape(std::make_unique<btConvexHullShape>()),
        from(cast_transform(motion.at(0))),
        to(cast_transform(motion.at(1))) {
    for (const Vec3<float>& v : hull.vertices)
      shape->addPoint(btVector3(v.x(), v.y(), v.z()), false);
    shape->recalcLocalAabb();
    shape->setMargin(0);
  }

  std::unique_ptr<btConvexHullShape> shape;
  btTransform from, to;
};

class Cast : public ImpactFinder {
 public:
  Cast(std::span<const ImpactCase> cases, CastMethod method) : method_(method) {
    for (const ImpactCase& of : cases) {
      bodies_.emplace_back(of.a, of.of_a);
      bodies_.emplace_back(of.b, of.of_b);
    }
  }

  FoundImpact find(int index) override {
    const CastBody &a = at(bodies_, 2 * index), &b = at(bodies_, 2 * index + 1);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btContinuousConvexCollision continuous(a.shape.get(), b.shape.get(), &simplex, &penetration);
    btGjkConvexCast gjk_cast(a.shape.get(), b.shape.get(), &simplex);
    btSubsimplexConvexCast subsimplex(a.shape.get(), b.shape.get(), &simplex);
    btConvexCast* cast = &continuous;
    if (method_ == CastMethod::Gjk) cast = &gjk_cast;
    if (method_ == CastMethod::Subsimplex) cast = &subsimplex;
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    const bool hit = cast->calcTimeOfImpact(a.from, a.to, b.from, b.to, result);
    return {hit, static_cast<double>(result.m_fraction)};
  }

 private:
  CastMethod method_;
  std::vector<CastBody> bodies_;
};

ImpactFinderInfo cast_info(const std::string& name, CastMethod method, bool knows_rotation) {
  return {name, knows_rotation, [method](std::span<const ImpactCase> cases) {
            return std::make_unique<Cast>(cases, method);
          }};
}

}  // namespace

std::vector<ImpactFinderInfo> bullet_impacts() {
  return {cast_info("Bullet, continuous convex", CastMethod::Continuous, true),
          cast_info("Bullet, GJK convex cast", CastMethod::Gjk, false),
          cast_info("Bullet, subsimplex convex cast", CastMethod::Subsimplex, false)};
}

}  // namespace contactscope::peers
