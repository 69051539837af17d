#include "manifold/trace_recorder.h"

#include <algorithm>
#include <limits>

#include "manifold/edge_contact.h"
#include "manifold/penetration_record.h"
#include "query/edge_pairs.h"
#include "query/tolerance.h"
#include "reduce/choices.h"
#include "reduce/polygon_area.h"

namespace contactscope {
namespace {

/// The pipeline leaves out edge pairs that cannot beat the faces. A picture of the test shows the
/// best of each query, so for the record the query runs again without that floor.
template <class S>
EdgeQuery<S> best_edges(const HullPair<S>& pair, const SatResult<S>& axes, Preference preference) {
  if (axes.edge.edge_a >= 0) return axes.edge;
  const S tie = preference == Preference::Relative ? tie_tolerance(pair.scale) : S(0);
  FaceSeparations<S> faces_a(pair.a);
  query_faces(pair.a, pair.b, tie, faces_a);
  return query_edges(pair, faces_a, -std::numeric_limits<S>::infinity(), tie);
}

/// The best that as many points can span, and how the method came to its choice.
void measure(std::span<const ContactPoint<double>> points, const Vec3d& normal, int max_points,
             trace::Reduction& reduction) {
  std::vector<Vec3d> all;
  std::vector<Vec3d> chosen;
  for (const ContactPoint<double>& point : points) all.push_back(point.position);
  for (const int index : reduction.kept) chosen.push_back(all[static_cast<std::size_t>(index)]);
  reduction.area = convex_area(chosen, normal);
  reduction.best_area = best_convex_area(all, normal, max_points);
  if (reduction.kept.size() == points.size()) return;  // nothing was chosen

  ReduceOptions options;
  options.max_points = max_points;
  const Reduction best = reduce<double>(find_reducer<double>("optimal"), points, normal, options);
  reduction.best.assign(best.kept.begin(), best.kept.end());
  reduction.choices = choices_made(reduction.method, points, normal, reduction.kept);
}

}  // namespace

template <class S>
TraceRecorder<S>::TraceRecorder(const ToWorld<S>& to_world, const char* reducer_name,
                                const trace::Stages& stages, bool mirrored, trace::Pair& pair)
    : to_world_(to_world),
      reducer_name_(reducer_name),
      stages_(stages),
      mirrored_(mirrored),
      pair_(pair) {
  pair_.state = "separated";
  pair_.manifolds.clear();
  pair_.degenerate.reset();
  pair_.tree.reset();
  pair_.gjk.reset();
  pair_.cache.reset();
  pair_.sat.reset();
  pair_.clip.reset();
  pair_.reduction.reset();
  pair_.penetration.reset();
  pair_.minkowski.reset();
}

template <class S>
Vec3d TraceRecorder<S>::point(const Vec3<S>& in_a) const {
  return to_world_.point(in_a).template cast<double>();
}

template <class S>
Vec3d TraceRecorder<S>::direction(const Vec3<S>& in_a) const {
  return to_world_.direction(in_a).template cast<double>();
}

template <class S>
Vec3d TraceRecorder<S>::normal(const Vec3<S>& in_a) const {
  return mirrored_ ? Vec3d(-direction(in_a)) : direction(in_a);
}

template <class S>
const std::string& TraceRecorder<S>::name(Owner owner) const {
  return (owner == Owner::A) != mirrored_ ? pair_.a : pair_.b;
}

template <class S>
trace::Point TraceRecorder<S>::trace_point(const ContactPoint<S>& in_world) const {
  return {in_world.position.template cast<double>(), static_cast<double>(in_world.separation),
          to_string(mirrored_ ? in_world.id.flipped() : in_world.id)};
}

template <class S>
std::vector<trace::Point> TraceRecorder<S>::trace_points(
    std::span<const ContactPoint<S>> in_world) const {
  std::vector<trace::Point> result;
  result.reserve(in_world.size());
  for (const ContactPoint<S>& point : in_world) result.push_back(trace_point(point));
  return result;
}

template <class S>
trace::Polygon TraceRecorder<S>::polygon(const ClipPolygon<S>& in_a) const {
  trace::Polygon result;
  result.reserve(in_a.size());
  for (const ClipVertex<S>& vertex : in_a) result.push_back(point(vertex.position));
  return result;
}

template <class S>
void TraceRecorder<S>::axes(const HullPair<S>& pair, const SatResult<S>& axes,
                            Preference preference) {
  if (!stages_.sat) return;
  trace::Sat& sat = pair_.sat.emplace();
  sat.chosen = to_string(told(axes.chosen));
  sat.preference = to_string(preference);
  if (axes.queries_run >= 1) {
    const FaceQuery<S>& query = axes.face_a;
    (mirrored_ ? sat.face_b : sat.face_a) =
        trace::FaceAxis{query.face, query.separation, normal(pair.a.normals[query.face]),
                        point(pair.b.vertices[query.support])};
  }
  if (axes.queries_run >= 2) {
    const FaceQuery<S>& query = axes.face_b;
    (mirrored_ ? sat.face_a : sat.face_b) =
        trace::FaceAxis{query.face, query.separation, normal(Vec3<S>(-pair.b.normals[query.face])),
                        point(pair.a.vertices[query.support])};
  }
  if (stages_.gauss_map) edge_pairs(pair, sat);
  if (axes.queries_run >= 3) {
    const EdgeQuery<S> query = best_edges(pair, axes, preference);
    if (query.edge_a < 0) return;
    const ClosestPoints<S> closest = closest_points(pair, query);
    trace::EdgeAxis& edge = sat.edge.emplace();
    edge = {query.edge_a / 2,     query.edge_b / 2,    query.separation,
            normal(query.normal), point(closest.on_a), point(closest.on_b)};
    if (mirrored_) {
      std::swap(edge.a, edge.b);
      std::swap(edge.point_a, edge.point_b);
    }
  }
}

template <class S>
void TraceRecorder<S>::edge_pairs(const HullPair<S>& pair, trace::Sat& sat) const {
  FaceSeparations<S> faces_a(pair.a);
  query_faces(pair.a, pair.b, tie_tolerance(pair.scale), faces_a);
  for (const EdgeQuery<S>& query : crossing_edge_pairs(pair, faces_a)) {
    trace::EdgePair& told = sat.edge_pairs.emplace_back();
    told = {query.edge_a / 2, query.edge_b / 2, query.separation, normal(query.normal)};
    if (mirrored_) std::swap(told.a, told.b);
  }
}

template <class S>
void TraceRecorder<S>::cache(const CacheAnswer<S>& answer) {
  trace::Cache& cache = pair_.cache.emplace();
  cache.hit = answer.hit;
  cache.kind = to_string(answer.kind);
  cache.axis = to_string(told(answer.axis));
  if (answer.hit) cache.normal = normal(answer.normal);
  if (answer.kind == CachedKind::Features) cache.moved = answer.moved;
}

template <class S>
void TraceRecorder<S>::clip_begins(Owner reference, const ClipFace<S>& reference_face,
                                   const ClipFace<S>& incident_face) {
  if (!stages_.clip) return;
  const auto told_face = [&](Owner owner, const ClipFace<S>& face) -> trace::ClipFace {
    return {name(owner), face.face, direction(face.normal), polygon(face.polygon)};
  };
  trace::Clip& clip = pair_.clip.emplace();
  clip.reference = told_face(reference, reference_face);
  clip.incident = told_face(other(reference), incident_face);
}

template <class S>
void TraceRecorder<S>::clip_step(const Plane<S>& side, const ClipPolygon<S>& left) {
  if (!stages_.clip) return;
  const Plane<double> plane = to_world_.plane(side).template cast<double>();
  pair_.clip->steps.push_back({plane.normal, plane.offset, polygon(left)});
}

template <class S>
void TraceRecorder<S>::dropped(const Vec3<S>& position, const char* reason) {
  if (stages_.clip) pair_.clip->dropped.push_back({point(position), reason});
}

template <class S>
void TraceRecorder<S>::clip_abandoned() {
  pair_.clip.reset();
}

template <class S>
void TraceRecorder<S>::contact_axis(AxisKind kind) {
  if (stages_.sat) pair_.sat->chosen = to_string(told(kind));
}

template <class S>
void TraceRecorder<S>::reduction(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                                 int max_points, const KeptIndices& kept) {
  if (!stages_.reduction) return;
  trace::Reduction& reduction = pair_.reduction.emplace();
  reduction.method = reducer_name_;
  reduction.points = trace_points(points);
  reduction.kept.assign(kept.begin(), kept.end());
  std::vector<ContactPoint<double>> exact;
  for (const ContactPoint<S>& point : points) {
    exact.push_back(
        {point.position.template cast<double>(), static_cast<double>(point.separation), point.id});
  }
  measure(exact, normal.template cast<double>(), max_points, reduction);
}

template <class S>
void TraceRecorder<S>::gjk(const Pose<S>& frame) {
  if (!stages_.gjk || gjk_run_.steps.empty()) return;
  const auto placed = [&](const Vec3<S>& local) { return point(frame.transform(local)); };
  const GjkResult<S>& result = gjk_run_.result;
  trace::Gjk& gjk = pair_.gjk.emplace();
  gjk.status = to_string(result.status);
  gjk.iterations = result.iterations;
  gjk.distance = static_cast<double>(result.distance);
  gjk.point_a = placed(result.on_a);
  gjk.point_b = placed(result.on_b);
  if (mirrored_) std::swap(gjk.point_a, gjk.point_b);
  for (const GjkSimplex<S>& step : gjk_run_.steps) {
    trace::Simplex& simplex = gjk.steps.emplace_back();
    for (const GjkVertex<S>& vertex : step.vertices) {
      simplex.push_back({placed(vertex.a), placed(vertex.b)});
      if (mirrored_) std::swap(simplex.back().a, simplex.back().b);
    }
  }
}

template <class S>
void TraceRecorder<S>::penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                                   const char* fallback) {
  if (!stages_.penetration) return;
  pair_.penetration = penetration_record(to_world_, mirrored_, method, result, penetration_steps_);
  if (fallback != nullptr) pair_.penetration->fallback = fallback;
}

template <class S>
void TraceRecorder<S>::minkowski(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a) {
  if (stages_.minkowski) pair_.minkowski = minkowski_record(to_world_, mirrored_, a, b, b_in_a);
}

template <class S>
void TraceRecorder<S>::tree(const Mesh<S>& mesh, const Aabb<S>& box) {
  if (!stages_.tree) return;
  const auto box_of = [](const Aabb<S>& of) {
    return trace::Box{of.lower.template cast<double>(), of.upper.template cast<double>()};
  };
  trace::Tree& tree = pair_.tree.emplace();
  tree.shape = name(Owner::B);
  tree.box = box_of(box);
  const AabbTreeRecord<S> found = mesh.tree.recorded_query(box);
  for (const auto& visit : found.visits)
    tree.visits.push_back({box_of(visit.box), visit.depth, visit.leaf, visit.overlaps});
  tree.candidates = found.candidates;
}

template <class S>
void TraceRecorder<S>::degenerate(const char* geometry, Degenerate answer) {
  pair_.degenerate = trace::Degenerate{geometry, to_string(answer)};
}

template <class S>
void TraceRecorder<S>::separation(S separation) {
  pair_.separation = separation;
}

template <class S>
void TraceRecorder<S>::manifold(const Manifold<S>& result) {
  // Of several manifolds, a mesh's, the deepest point stands for the pair.
  if (pair_.manifolds.empty()) pair_.separation = std::numeric_limits<double>::infinity();
  pair_.state = "touching";
  trace::Manifold& manifold = pair_.manifolds.emplace_back();
  manifold.normal = result.normal.template cast<double>();
  if (mirrored_) manifold.normal = -manifold.normal;
  manifold.axis = to_string(told(result.axis));
  manifold.type = to_string(result.type);
  if (result.triangle >= 0) manifold.triangle = result.triangle;
  manifold.points = trace_points(std::span<const ContactPoint<S>>(result.points));
  for (const trace::Point& kept : manifold.points) {
    pair_.separation = std::min(pair_.separation, kept.separation);
  }
}

template class TraceRecorder<float>;
template class TraceRecorder<double>;

}  // namespace contactscope
