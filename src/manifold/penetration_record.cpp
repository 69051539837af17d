#include "manifold/penetration_record.h"

#include <utility>

#include "geometry/hull_builder.h"

namespace contactscope {
namespace {

/// From A's frame to the world, exactly to double, in the order of the record.
template <class S>
class RecordFrame {
 public:
  RecordFrame(const ToWorld<S>& to_world, bool mirrored)
      : to_world_(to_world), mirrored_(mirrored) {}

  Vec3d normal(const Vec3<S>& in_a) const {
    const Vec3d direction = to_world_.direction(in_a).template cast<double>();
    return mirrored_ ? Vec3d(-direction) : direction;
  }
  trace::SimplexVertex vertex(const Vec3<S>& a, const Vec3<S>& b) const {
    const Vec3d on_a = to_world_.point(a).template cast<double>();
    const Vec3d on_b = to_world_.point(b).template cast<double>();
    return mirrored_ ? trace::SimplexVertex{on_b, on_a} : trace::SimplexVertex{on_a, on_b};
  }
  bool mirrored() const { return mirrored_; }

 private:
  const ToWorld<S>& to_world_;
  bool mirrored_;
};

template <class S>
trace::Polytope polytope_record(const RecordFrame<S>& frame, const PolytopeStep<S>& step) {
  trace::Polytope polytope;
  for (const GjkVertex<S>& vertex : step.vertices) {
    polytope.vertices.push_back(frame.vertex(vertex.a, vertex.b));
  }
  polytope.faces = step.faces;
  // Mirrored at the origin, what was counter-clockwise is clockwise.
  if (frame.mirrored()) {
    for (std::array<int, 3>& face : polytope.faces) std::swap(face[1], face[2]);
  }
  polytope.nearest = step.nearest;
  polytope.distance = static_cast<double>(step.distance);
  return polytope;
}

}  // namespace

template <class S>
trace::Penetration penetration_record(const ToWorld<S>& to_world, bool mirrored,
                                      PenetrationMethod method, const PenetrationResult<S>& result,
                                      const PenetrationSteps<S>& steps) {
  const RecordFrame<S> frame(to_world, mirrored);
  trace::Penetration told;
  told.method = to_string(method);
  told.status = to_string(result.status);
  told.iterations = result.iterations;
  told.depth = static_cast<double>(result.depth);
  told.normal = frame.normal(result.normal);
  const trace::SimplexVertex deepest = frame.vertex(result.on_a, result.on_b);
  told.point_a = deepest.a;
  told.point_b = deepest.b;
  for (const PolytopeStep<S>& step : steps.polytopes) {
    told.polytopes.push_back(polytope_record(frame, step));
  }
  for (const std::array<GjkVertex<S>, 4>& portal : steps.portals) {
    trace::Simplex& simplex = told.portals.emplace_back();
    for (const GjkVertex<S>& vertex : portal) simplex.push_back(frame.vertex(vertex.a, vertex.b));
  }
  for (const DirectionStep<S>& step : steps.directions) {
    told.directions.push_back({frame.normal(step.normal), static_cast<double>(step.separation)});
  }
  return told;
}

template <class S>
std::optional<trace::Minkowski> minkowski_record(const ToWorld<S>& to_world, bool mirrored,
                                                 const Hull<S>& a, const Hull<S>& b,
                                                 const Pose<S>& b_in_a) {
  if (a.vertex_count() > kMaxMinkowskiPoints / b.vertex_count()) return std::nullopt;
  const RecordFrame<S> frame(to_world, mirrored);
  std::vector<Vec3d> differences;
  for (const Vec3<S>& vertex_b : b.vertices) {
    const Vec3<S> placed = b_in_a.transform(vertex_b);
    for (const Vec3<S>& vertex_a : a.vertices) {
      differences.push_back(frame.normal(Vec3<S>(placed - vertex_a)));
    }
  }
  try {
    HullOptions options;
    options.weld_duplicates = true;
    const Hull<double> hull = build_hull(differences, options);
    trace::Minkowski told;
    told.vertices = hull.vertices;
    for (int face = 0; face < hull.face_count(); ++face) {
      told.faces.push_back(face_vertices(hull, face));
    }
    return told;
  } catch (const HullError&) {
    return std::nullopt;  // the picture goes without it
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                          \
  template trace::Penetration penetration_record(const ToWorld<S>&, bool, PenetrationMethod, \
                                                 const PenetrationResult<S>&,                \
                                                 const PenetrationSteps<S>&);                \
  template std::optional<trace::Minkowski> minkowski_record(                                 \
      const ToWorld<S>&, bool, const Hull<S>&, const Hull<S>&, const Pose<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
