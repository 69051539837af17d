#include <map>

#include "lint/tally.h"

namespace contactscope::lint {
namespace {

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
      met.report("all contacts of a mesh are on the back of its triangles",
                 "list the vertices of each triangle counter-clockwise as seen from outside; "
                 "left-handed engines and some files have them clockwise",
                 kFewest, 0.95, findings);
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
        ++met.of;
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

std::unique_ptr<Watch> watch_windings() { return std::make_unique<WindingsWatch>(); }

}  // namespace contactscope::lint
