// FCL 0.7 as Debian builds it, in double, with its default solver (libccd).
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "peers/impact_peer.h"

namespace contactscope::peers {
namespace {

fcl::Transform3d moved_to(const Pose<double>& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.rotation.normalized().toRotationMatrix();
  result.translation() = pose.position;
  return result;
}

struct AdvancedBody {
  AdvancedBody(const Hull<float>& hull, const Sweep<float>& motion)
      : from(moved_to(motion.cast<double>().at(0))), to(moved_to(motion.cast<double>().at(1))) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3<float>& v : hull.vertices) vertices->push_back(v.cast<double>());
    auto faces = std::make_shared<std::vector<int>>();
    for (int face = 0; face < hull.face_count(); ++face) {
      const std::vector<int> loop = face_vertices(hull, face);
      faces->push_back(static_cast<int>(loop.size()));
      faces->insert(faces->end(), loop.begin(), loop.end());
    }
    shape = std::make_shared<fcl::Convexd>(vertices, hull.face_count(), faces);
    shape->computeLocalAABB();
  }

  std::shared_ptr<fcl::Convexd> shape;
  fcl::Transform3d from, to;
};

class Advancement : public ImpactFinder {
 public:
  explicit Advancement(std::span<const ImpactCase> cases) {
    for (const ImpactCase& of : cases) {
      bodies_.emplace_back(of.a, of.of_a);
      bodies_.emplace_back(of.b, of.of_b);
    }
  }

  FoundImpact find(int index) override {
    const AdvancedBody &a = at(bodies_, 2 * index), &b = at(bodies_, 2 * index + 1);
    fcl::ContinuousCollisionRequestd request;
    request.ccd_motion_type = fcl::CCDM_LINEAR;
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(a.shape.get(), a.from, a.to, b.shape.get(), b.from, b.to, request,
                           result);
    return {result.is_collide, result.time_of_contact};
  }

 private:
  std::vector<AdvancedBody> bodies_;
};

}  // namespace

std::vector<ImpactFinderInfo> fcl_impacts() {
  return {{"FCL, conservative advancement", true,
           [](std::span<const ImpactCase> cases) { return std::make_unique<Advancement>(cases); }}};
}

}  // namespace contactscope::peers
