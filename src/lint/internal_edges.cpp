#include "lint/watch.h"
#include "query/closest_points.h"

namespace contactscope::lint {
namespace {

/// A normal may lean from the faces around its point by this much, radians: engines approximate.
constexpr double kLeaning = 15 * std::numbers::pi / 180, kFlat = 0.02;

double angle_between(const Vec3d& one, const Vec3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

/// The surface of a mesh around a point, in the mesh's frame.
struct SurfaceAround {
  std::vector<Vec3d> faces;  // unit normals, to the side of the other shape
  bool ends = false;         // it has a boundary there
  bool is_convex = false;    // an edge or a corner sticks out
};

double distance_to_edge(const Mesh<double>& mesh, int triangle, int k, const Vec3d& point) {
  return (closest_on_segment(point, mesh.corner(triangle, k), mesh.corner(triangle, (k + 1) % 3))
              .point -
          point)
      .norm();
}

/// Whether the point is over the triangle, seen along its normal.
bool is_over(const Mesh<double>& mesh, int triangle, const Vec3d& point) {
  for (int k = 0; k < 3; ++k) {
    const Vec3d along = mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k);
    if (along.cross(point - mesh.corner(triangle, k)).dot(mesh.normal(triangle)) < 0) return false;
  }
  return true;
}

SurfaceAround surface_around(const Mesh<double>& mesh, const Vec3d& point, double reach,
                             const Vec3d& outward) {
  SurfaceAround around;
  const Vec3d by = Vec3d::Constant(reach);
  mesh.tree.query({point - by, point + by}, [&](int triangle) {
    const Vec3d& normal = mesh.normal(triangle);
    const double height = std::abs(normal.dot(point - mesh.corner(triangle, 0)));
    bool is_near = height <= reach && is_over(mesh, triangle, point);
    for (int k = 0; k < 3; ++k) {
      if (!(distance_to_edge(mesh, triangle, k, point) <= reach)) continue;
      is_near = true;
      around.ends |= mesh.edge_class(triangle, k) == EdgeClass::Boundary;
      around.is_convex |= mesh.edge_class(triangle, k) == EdgeClass::Convex;
    }
    if (is_near) around.faces.push_back(normal.dot(outward) < 0 ? Vec3d(-normal) : normal);
  });
  return around;
}

/// The direction nearest to a normal that the surface allows: the normals of its faces, and where
/// an edge or a corner sticks out those between them.
Vec3d allowed_normal(const SurfaceAround& around, const Vec3d& outward) {
  if (around.faces.empty() || around.ends) return outward;
  const auto by_angle = [&](const Vec3d& face) { return angle_between(face, outward); };
  const Vec3d nearest = std::ranges::min(around.faces, {}, by_angle);
  if (!around.is_convex) return nearest;
  Vec3d middle = Vec3d::Zero();
  double spread = 0;
  for (const Vec3d& face : around.faces) middle += face;
  for (const Vec3d& face : around.faces) spread = std::max(spread, angle_between(face, middle));
  const double lean = angle_between(middle, outward);
  if (lean - spread >= by_angle(nearest)) return nearest;
  if (lean <= spread) return outward;
  return Eigen::AngleAxisd(spread, middle.cross(outward).normalized()) * middle.normalized();
}

/// Contacts with an edge between triangles although the surface continues there: the "ghost
/// collisions" at which bodies trip. Terdiman, "Contact generation for meshes".
class InternalEdgesWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs) {
      if (pair.kind.find("sdf") != std::string::npos) continue;  // a field rounds its surface
      see_mesh(solids, frames, pair, pair.a, pair.b, 1);
      see_mesh(solids, frames, pair, pair.b, pair.a, -1);
    }
  }

  void report(std::vector<Finding>& findings) override {
    tally_.report(
        findings, "contacts push against edges within the surface of a mesh",
        "no shape can be touched there in that direction, because the surface continues: "
        "turn on the engine's handling of internal edges (active edges, welding), or give "
        "the contact the normal of its face");
  }

 private:
  /// `away`: 1 if normals point away from the mesh.
  void see_mesh(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                const std::string& name, const std::string& other, double away) {
    const std::optional<Placed> placed = place(solids, frames.now, name, {});
    const std::optional<Placed> on_top = place(solids, frames.now, other, {});
    const auto* mesh = placed ? std::get_if<Mesh<double>>(&placed->solid->shape()) : nullptr;
    if (mesh == nullptr || !on_top || placed->scale != 1) return;
    const double tolerance = solids.tolerance_of(*placed, *on_top);
    for (const trace::Manifold& manifold : pair.manifolds) {
      const Vec3d outward = placed->pose.inverse_rotate(away * manifold.normal);
      for (const trace::Point& point : manifold.points) {
        const double impulse = point.impulse ? point.impulse->normal : 0;
        if (point.separation > tolerance && !(impulse > 0)) continue;
        ++tally_.of;
        const double reach = 2 * std::max(tolerance, std::abs(point.separation));
        const Vec3d local = placed->pose.inverse_transform(point.position);
        const Vec3d allowed = allowed_normal(surface_around(*mesh, local, reach, outward), outward);
        const double lean = angle_between(allowed, outward);
        // Before it touches, a surface that is curved below the shape may have another direction.
        const bool may_differ =
            point.separation > tolerance &&
            std::ranges::any_of(
                surface_around(*mesh, local, on_top->size(), outward).faces,
                [&](const Vec3d& face) { return angle_between(face, allowed) > kFlat; });
        if (!(lean > (may_differ ? 3 * kLeaning : kLeaning))) continue;
        frames.explained->try_emplace(&pair, Explained::ButForSigns);
        // By the impulse along the surface; where none is known, by the lean.
        const double worst = impulse > 0 ? 1 + std::sin(lean) * impulse : lean / 2;
        tally_.wrong_at({frames.now->frame, frames.now->line, name, other, point.position,
                         away * placed->pose.rotate(allowed)},
                        frames, worst, [&] {
                          return std::pair("normal " + spelled(manifold.normal) + ", at " +
                                               spelled(point.position),
                                           "it leans by " + shown(lean * 180 / std::numbers::pi) +
                                               " degrees from the surface, which continues there");
                        });
      }
    }
  }

  Tally tally_{"internal_edge", "points", true};
};

}  // namespace

std::unique_ptr<Watch> watch_internal_edges() { return std::make_unique<InternalEdgesWatch>(); }

}  // namespace contactscope::lint
