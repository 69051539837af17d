#include "geometry/hull_builder.h"
#include "manifold/recorder.h"

namespace contactscope {

template <class S>
trace::Polytope Recorder<S>::polytope(const PolytopeStep<S>& step) const {
  trace::Polytope polytope;
  for (const GjkVertex<S>& corner : step.vertices)
    polytope.vertices.push_back(vertex(corner.a, corner.b));
  polytope.faces = step.faces;
  polytope.nearest = step.nearest;
  polytope.distance = static_cast<double>(step.distance);
  return polytope;
}

template <class S>
void Recorder<S>::penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                              const char* fallback) {
  if (!stages_.penetration) return;
  trace::Penetration& told = pair_.penetration.emplace();
  told.method = to_string(method);
  told.status = to_string(result.status);
  if (fallback != nullptr) told.fallback = fallback;
  told.iterations = result.iterations;
  told.depth = static_cast<double>(result.depth);
  told.normal = direction(result.normal);
  told.point_a = point(result.on_a);
  told.point_b = point(result.on_b);
  for (const PolytopeStep<S>& step : penetration_steps_.polytopes)
    told.polytopes.push_back(polytope(step));
  for (const std::array<GjkVertex<S>, 4>& portal : penetration_steps_.portals) {
    trace::Simplex& simplex = told.portals.emplace_back();
    for (const GjkVertex<S>& corner : portal) simplex.push_back(vertex(corner.a, corner.b));
  }
  for (const DirectionStep<S>& step : penetration_steps_.directions)
    told.directions.push_back({direction(step.normal), static_cast<double>(step.separation)});
}

/// The Minkowski difference B - A in the world's axes: the hull of the differences of all vertices.
/// None where these are more than kMaxMinkowskiPoints, and where the builder gives no hull of them:
/// the picture goes without it.
template <class S>
void Recorder<S>::minkowski(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a) {
  if (!stages_.minkowski || a.vertex_count() > kMaxMinkowskiPoints / b.vertex_count()) return;
  std::vector<Vec3d> differences;
  for (const Vec3<S>& vertex_b : b.vertices) {
    const Vec3<S> placed = b_in_a.transform(vertex_b);
    for (const Vec3<S>& vertex_a : a.vertices)
      differences.push_back(direction(Vec3<S>(placed - vertex_a)));
  }
  try {
    HullOptions options;
    options.weld_duplicates = true;
    const Hull<double> hull = build_hull(differences, options);
    trace::Minkowski& told = pair_.minkowski.emplace();
    told.vertices = hull.vertices;
    for (int face = 0; face < hull.face_count(); ++face)
      told.faces.push_back(face_vertices(hull, face));
  } catch (const HullError&) {
    return;
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                      \
  template void Recorder<S>::penetration(PenetrationMethod, const PenetrationResult<S>&, \
                                         const char*);                                   \
  template void Recorder<S>::minkowski(const Hull<S>&, const Hull<S>&, const Pose<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
