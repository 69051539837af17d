// FCL 0.7 as Debian builds it, in double, with libccd as default solver. It has no memory.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <array>
#include <exception>
#include <limits>
#include <unordered_map>

#include "peers/peer.h"

namespace contactscope::peers {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;
using Model = fcl::BVHModel<fcl::OBBRSSd>;
using Meshes = std::unordered_map<const Mesh<double>*, Geometry>;

/// Enough for a box on a box, and for every triangle under a small shape.
constexpr std::size_t kMaxPoints = 64;

/// A geometry and its frame relative to the shape's.
struct MadeGeometry {
  Geometry geometry;
  Pose<double> frame;
};

MadeGeometry make(const Sphere<double>& sphere, Meshes&) {
  return {std::make_shared<fcl::Sphered>(sphere.radius), {}};
}

MadeGeometry make(const Capsule<double>& capsule, Meshes&) {
  // FCL's capsule axis is z.
  return {std::make_shared<fcl::Capsuled>(capsule.radius, capsule_length(capsule)),
          capsule_frame(capsule, Vec3d::UnitZ())};
}

MadeGeometry make(const Box& box, Meshes&) {
  return {std::make_shared<fcl::Boxd>(fcl::Vector3d(2 * box.half_extents)), {}};
}

MadeGeometry make(const Hull<double>& hull, Meshes&) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(hull.vertices);
  auto faces = std::make_shared<std::vector<int>>();
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> loop = face_vertices(hull, face);
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  return {std::make_shared<fcl::Convexd>(vertices, hull.face_count(), faces), {}};
}

MadeGeometry make(const std::shared_ptr<const Mesh<double>>& mesh, Meshes& meshes) {
  Geometry& built = meshes[mesh.get()];
  if (!built) {
    std::vector<fcl::Triangle> corners;
    for (const std::array<int, 3>& index : mesh->triangles) {
      corners.emplace_back(index[0], index[1], index[2]);
    }
    auto model = std::make_shared<Model>();
    model->beginModel();
    model->addSubModel(mesh->vertices, corners);
    model->endModel();
    built = model;
  }
  return {built, {}};
}

MadeGeometry make(const HalfSpace<double>& half_space, Meshes&) {
  return {std::make_shared<fcl::Halfspaced>(half_space.plane.normal, half_space.plane.offset), {}};
}

MadeGeometry made(const PeerShape& shape, Meshes& meshes) {
  return std::visit([&](const auto& value) { return make(value, meshes); }, shape);
}

fcl::Transform3d transform_of(const Pose<double>& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.rotation.toRotationMatrix();
  result.translation() = pose.position;
  return result;
}

class FclPair : public PeerPair {
 public:
  FclPair(MadeGeometry a, MadeGeometry b) : a_(std::move(a)), b_(std::move(b)) {}

  void place(const Pose<double>& pose_a, const Pose<double>& pose_b) override {
    placed_a_ = transform_of(compose(pose_a, a_.frame));
    placed_b_ = transform_of(compose(pose_b, b_.frame));
  }

  void forget() override {}

  double run() override {
    fcl::CollisionResultd result;
    process(result);
    double sum = 0;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      sum += result.getContact(i).penetration_depth;
    }
    return sum;
  }

  PeerContact collide() override {
    fcl::CollisionResultd result;
    PeerContact contact;
    contact.failed = !process(result);
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const fcl::Contactd& found = result.getContact(i);
      // FCL may have swapped the shapes.
      const double sign = found.o1 == a_.geometry.get() ? 1 : -1;
      contact.points.push_back(
          {Vec3d(found.pos), -found.penetration_depth, Vec3d(sign * found.normal)});
    }
    return contact;
  }

 private:
  bool process(fcl::CollisionResultd& result) {
    try {
      fcl::collide(a_.geometry.get(), placed_a_, b_.geometry.get(), placed_b_, request_, result);
      return true;
    } catch (const std::exception&) {
      return false;  // "FCL failed at this configuration"
    }
  }

  MadeGeometry a_;
  MadeGeometry b_;
  fcl::Transform3d placed_a_;
  fcl::Transform3d placed_b_;
  fcl::CollisionRequestd request_{kMaxPoints, true};
};

class Fcl : public Peer {
 public:
  const char* name() const override { return "FCL"; }
  std::string version() const override { return FCL_VERSION; }
  double epsilon() const override { return std::numeric_limits<double>::epsilon(); }
  std::unique_ptr<PeerPair> pair(const PeerShape& a, const PeerShape& b) override {
    return std::make_unique<FclPair>(made(a, meshes_), made(b, meshes_));
  }

 private:
  Meshes meshes_;
};

}  // namespace

std::unique_ptr<Peer> make_fcl() { return std::make_unique<Fcl>(); }

}  // namespace contactscope::peers
