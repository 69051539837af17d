#include "lint/watch.h"

namespace contactscope::lint {
namespace {

/// An upright shape has the rotation 1, 0, 0, 0. With w last it is written as 0, 0, 0, 1, a half
/// turn about z. Boxes look right then, and only other shapes reveal it.
class RotationsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const auto& [name, pose] : frames.now->poses) {
      const Solid* const solid = solids.find(name);
      if (solid == nullptr) continue;
      constexpr double kAlmost = 0.999;
      if (std::abs(pose.rotation.w()) > kAlmost) ++upright_;
      ++half_turns_.of;
      if (std::abs(pose.rotation.z()) < kAlmost) continue;
      half_turns_.wrong(frames, name, "", [] {
        return std::pair("'quat_wxyz' is 0, 0, 0, 1: half a turn about z",
                         "with w last it is no rotation, and no shape of the trace has 1, 0, 0, 0");
      });
    }
  }

  void report(std::vector<Finding>& findings) override {
    constexpr int kFewest = 2;
    if (half_turns_.count < kFewest || upright_ > 0 || 2 * half_turns_.count < half_turns_.of)
      return;
    for (const Finding& finding : findings)
      if (finding.cause == half_turns_.cause) return;
    half_turns_.report(findings, "quaternions are in the order x, y, z, w",
                       "write w first: the key is 'quat_wxyz'", kFewest, 0.5);
  }

 private:
  int upright_ = 0;
  Tally half_turns_{"quaternions_xyzw", "poses"};
};

/// A mesh with inverted triangles is hit from behind everywhere.
class WindingsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs) {
      if (pair.manifolds.empty()) continue;
      see_shape(solids, frames, pair, pair.a, pair.b, 1);
      see_shape(solids, frames, pair, pair.b, pair.a, -1);
    }
  }

  void report(std::vector<Finding>& findings) override {
    constexpr int kFewest = 5;
    for (auto& [name, met] : met_) {
      met.cause = "mesh_inside_out";
      met.report(findings, "all contacts of a mesh are on the back of its triangles",
                 "list the vertices of each triangle counter-clockwise as seen from outside; "
                 "left-handed engines and some files have them clockwise",
                 kFewest, 0.95);
    }
  }

 private:
  /// `away`: 1 if normals point away from the shape.
  void see_shape(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                 const std::string& name, const std::string& other, double away) {
    const std::optional<Placed> placed = place(solids, frames.now, name, {});
    if (!placed) return;
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) {
        const std::optional<Vec3d> outward =
            placed->solid->face_normal(placed->pose.inverse_transform(point.position));
        if (!outward) return;
        const double cosine = away * manifold.normal.dot(placed->pose.rotate(*outward));
        constexpr double kClear = 0.5;  // smaller at edges
        if (std::abs(cosine) < kClear) continue;
        Tally& met = met_[name];
        met.cases = "points", ++met.of;
        if (cosine < 0)
          met.wrong(frames, name, other, [&] {
            return std::pair(
                "normal " + spelled(manifold.normal) + ", at " + spelled(point.position),
                "the triangle there faces " + spelled(placed->pose.rotate(*outward)));
          });
      }
  }

  std::map<std::string, Tally> met_;
};

}  // namespace

std::unique_ptr<Watch> watch_rotations() { return std::make_unique<RotationsWatch>(); }

std::unique_ptr<Watch> watch_windings() { return std::make_unique<WindingsWatch>(); }

}  // namespace contactscope::lint
