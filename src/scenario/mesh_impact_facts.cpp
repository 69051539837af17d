#include "continuous/impact_with_mesh.h"
#include "scenario/between_frames.h"

namespace contactscope {
namespace {

/// The corners of a mesh and their end positions in the step, world.
struct ScriptedMesh {
  Mesh<double> start;
  std::vector<Vec3d> end;

  ScriptedMesh(const ScenarioShape& shape, double from, double to)
      : start(build_mesh_with_flat_triangles(placed(shape, from), original(shape).triangles)),
        end(placed(shape, to)) {}

  static const Mesh<double>& original(const ScenarioShape& shape) {
    return std::get<Mesh<double>>(*shape.geometry);
  }
  static std::vector<Vec3d> placed(const ScenarioShape& shape, double time) {
    std::vector<Vec3d> corners = original(shape).vertices;
    if (shape.deforms()) corners = deformed_vertices(*shape.motion.deformation, corners, time);
    const Pose<double> pose = pose_at(shape, time);
    for (Vec3d& corner : corners) corner = pose.transform(corner);
    return corners;
  }

  std::vector<Vec3d> corners(int triangle, double time) const {
    std::vector<Vec3d> places;
    for (const int vertex : at(start.triangles, triangle)) {
      const Vec3d& from = at(start.vertices, vertex);
      places.emplace_back(from + time * (at(end, vertex) - from));
    }
    return places;
  }
};

/// `u` and `v` are the weights of a face's corners 1 and 2, or `u` is the fraction along an edge.
Vec3d point_of(const std::vector<Vec3d>& corners, int feature, bool is_edges, double u, double v) {
  if (is_edges) {
    const auto from = static_cast<std::size_t>(feature);
    return corners[from] + u * (corners[(from + 1) % 3] - corners[from]);
  }
  if (feature >= 0) return corners[static_cast<std::size_t>(feature)];
  return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

}  // namespace

trace::Impact mesh_impact_facts(const ScenarioShape& a, const ScenarioShape& b, double from,
                                double to) {
  const ScriptedMesh mesh_a(a, from, to), mesh_b(b, from, to);
  const MeshImpact found =
      impact_of_meshes<double>({mesh_a.start, mesh_a.end}, {mesh_b.start, mesh_b.end});
  const FeatureImpact& impact = found.impact;
  trace::Impact facts;
  facts.method = to_string(ImpactMethod::TimeOfImpact);
  // Distances below rounding count as a hit, as they do in the solver.
  facts.status = impact.status == FeatureStatus::Near ? "hit" : to_string(impact.status);
  facts.time = impact.begin;
  if (impact.status == FeatureStatus::Separated) return facts;
  facts.distance = impact.distance;
  facts.triangle_a = found.triangle_a;
  facts.triangle_b = found.triangle_b;
  facts.corners_a = mesh_a.corners(found.triangle_a, impact.begin);
  facts.corners_b = mesh_b.corners(found.triangle_b, impact.begin);
  if (impact.status == FeatureStatus::Overlapping) return facts;
  facts.normal = impact.normal;
  facts.point_a = point_of(facts.corners_a, found.feature_a, found.is_edges, impact.u, impact.v);
  facts.point_b = point_of(facts.corners_b, found.feature_b, found.is_edges,
                           found.is_edges ? impact.v : impact.u, impact.v);
  return facts;
}

}  // namespace contactscope
