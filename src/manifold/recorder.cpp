#include "manifold/recorder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/at.h"
#include "geometry/hull_builder.h"
#include "manifold/dispatch.h"
#include "manifold/edge_contact.h"
#include "reduce/choices.h"
#include "reduce/polygon_area.h"

namespace contactscope {
namespace {

/// Maximum number of vertex differences for the Minkowski difference: two hulls of 64 vertices,
/// which take some milliseconds.
constexpr int kMaxMinkowskiPoints = 4096;

/// A result of the pipeline, in the world, as a fact.
template <class S>
trace::Point trace_point(const ContactPoint<S>& in_world) {
  return {in_world.position.template cast<double>(), static_cast<double>(in_world.separation),
          to_string(in_world.id)};
}

/// Compares the choice with the largest area that as many points can span.
void measure(ContactPoints<double> points, const Vec3d& normal, int max_points,
             trace::Reduction& reduction) {
  const bool all_kept = reduction.kept.size() == points.size();
  const std::vector<Vec3d> all = mapped(points, &ContactPoint<double>::position);
  if (all_kept) {
    reduction.area = convex_area(all, normal);
    reduction.best_area =
        count_of(points) <= max_points ? reduction.area : best_convex_area(all, normal, max_points);
    return;
  }
  reduction.area =
      convex_area(mapped(reduction.kept, [&](int index) { return at(all, index); }), normal);
  reduction.best_area = best_convex_area(all, normal, max_points);
  const KeptIndices best =
      reduce<double>(find_reducer("optimal"), points, normal, {.max_points = max_points});
  reduction.best.assign(best.begin(), best.end());
}

}  // namespace

template <class S>
trace::Polygon Recorder<S>::polygon(const ClipPolygon<S>& in_a) const {
  return mapped(in_a, [&](const ClipVertex<S>& vertex) { return point(vertex.position); });
}

/// The edge query looks only for pairs that beat the faces, and skips whole arcs of others.
/// Pictures also need the best pair where none beats the faces, and all crossings; these are
/// queried here. Collecting both in the query would slow a recorded pair with an edge contact by
/// half.
template <class S>
void Recorder<S>::axes(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                       const SatResult<S>& axes, Preference preference) {
  if (!stages_.sat) return;
  trace::Sat& sat = pair_.sat.emplace();
  sat.chosen = to_string(axes.chosen);
  sat.preference = to_string(preference);
  const auto recorded = [&](const FaceQuery<S>& query, const Vec3<S>& normal,
                            const PlacedHull<S>& other) -> trace::FaceAxis {
    return {query.face, query.separation, direction(normal), point(other.vertices[query.support])};
  };
  if (axes.queries_run >= 1)
    sat.face_a = recorded(axes.face_a, pair.a.normals[axes.face_a.face], pair.b);
  if (axes.queries_run >= 2)
    sat.face_b = recorded(axes.face_b, -pair.b.normals[axes.face_b.face], pair.a);
  if (stages_.gauss_map) {
    for (const EdgeQuery<S>& query : all_crossings(pair, faces_a)) {
      sat.edge_pairs.push_back(
          {query.edge_a / 2, query.edge_b / 2, query.separation, direction(query.normal)});
    }
  }
  if (axes.queries_run < 3) return;
  EdgeQuery<S> query = axes.edge;
  if (query.edge_a < 0) {
    query = query_edges(pair, faces_a, -std::numeric_limits<S>::infinity(), axes.tie);
  }
  if (query.edge_a < 0) return;
  const ClosestPoints<S> closest = closest_points(pair.a, pair.b, query);
  sat.edge = trace::EdgeAxis{query.edge_a / 2,        query.edge_b / 2,    query.separation,
                             direction(query.normal), point(closest.on_a), point(closest.on_b)};
}

template <class S>
void Recorder<S>::cache(const CacheAnswer<S>& answer) {
  trace::Cache& cache = pair_.cache.emplace();
  cache.hit = answer.hit;
  cache.kind = to_string(answer.kind);
  cache.axis = to_string(answer.axis);
  if (answer.hit) cache.normal = direction(answer.normal);
  if (answer.kind == CachedKind::Features) cache.moved = answer.moved;
}

template <class S>
void Recorder<S>::clip_begins(Owner reference, const ClipFace<S>& reference_face,
                              const ClipFace<S>& incident_face) {
  if (!stages_.clip) return;
  const auto recorded_face = [&](Owner owner, const ClipFace<S>& face) -> trace::ClipFace {
    return {owner == Owner::A ? pair_.a : pair_.b, face.face, direction(face.normal),
            polygon(face.polygon)};
  };
  trace::Clip& clip = pair_.clip.emplace();
  clip.reference = recorded_face(reference, reference_face);
  clip.incident = recorded_face(other(reference), incident_face);
}

template <class S>
void Recorder<S>::clip_step(const Plane<S>& side, const ClipPolygon<S>& left) {
  if (!stages_.clip) return;
  const Plane<double> plane = to_world_.plane(side).template cast<double>();
  pair_.clip->steps.push_back({plane.normal, plane.offset, polygon(left)});
}

template <class S>
KeptIndices Recorder<S>::reduce(const ReducerInfo* reducer, ContactPoints<S> points,
                                const Vec3<S>& normal, const ReduceOptions& options) {
  if (!stages_.reduction) return contactscope::reduce(reducer, points, normal, options);
  // Two points span no area, and so few leave no choice.
  const bool measured = count_of(points) > std::min(2, options.max_points);
  const auto exact = mapped(measured ? points : ContactPoints<S>{},
                            [](const ContactPoint<S>& point) -> ContactPoint<double> {
                              return {point.position.template cast<double>(),
                                      static_cast<double>(point.separation), point.id};
                            });
  const Vec3d exact_normal = normal.template cast<double>();
  Choices choices{{exact, exact_normal}};
  ReduceOptions watched = options;
  watched.choices = &choices;
  const KeptIndices kept = contactscope::reduce(reducer, points, normal, watched);
  trace::Reduction& reduction = pair_.reduction.emplace();
  reduction.method = reducer->name;
  reduction.points = mapped(points, trace_point<S>);
  reduction.kept.assign(kept.begin(), kept.end());
  reduction.choices = std::move(choices.made);
  if (measured) measure(exact, exact_normal, options.max_points, reduction);
  reduction_decisions(reduction, exact_normal,
                      static_cast<double>(Candidates<S>{points, normal}.depth_tie(options)));
  return kept;
}

template <class S>
void Recorder<S>::gjk(const Pose<S>& frame) {
  if (!stages_.gjk || gjk_run_.steps.empty()) return;
  const auto placed = [&](const Vec3<S>& a, const Vec3<S>& b) {
    return vertex(frame.transform(a), frame.transform(b));
  };
  const GjkResult<S>& result = gjk_run_.result;
  trace::Gjk& gjk = pair_.gjk.emplace();
  gjk.status = to_string(result.status);
  gjk.iterations = result.iterations;
  gjk.distance = static_cast<double>(result.distance);
  const trace::SimplexVertex closest = placed(result.on_a, result.on_b);
  gjk.point_a = closest.a;
  gjk.point_b = closest.b;
  for (const GjkSimplex<S>& step : gjk_run_.steps)
    gjk.steps.push_back(mapped(
        step.vertices, [&](const GjkVertex<S>& corner) { return placed(corner.a, corner.b); }));
}

template <class S>
std::vector<int> Recorder<S>::query_tree(const Mesh<S>& mesh, const Aabb<S>& box) {
  trace::Tree tree = mesh.tree.recorded_query(box);
  tree.shape = pair_.b;
  std::vector<int> candidates = tree.candidates;
  if (stages_.tree) pair_.tree = std::move(tree);
  return candidates;
}

template <class S>
void Recorder<S>::penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                              const char* fallback) {
  if (!stages_.penetration) return;
  trace::Penetration& recorded = pair_.penetration.emplace();
  recorded.method = to_string(method);
  recorded.status = to_string(result.status);
  if (fallback != nullptr) recorded.fallback = fallback;
  recorded.iterations = result.iterations;
  recorded.depth = static_cast<double>(result.depth);
  recorded.normal = direction(result.normal);
  recorded.point_a = point(result.on_a);
  recorded.point_b = point(result.on_b);
  const auto placed = [&](const GjkVertex<S>& corner) { return vertex(corner.a, corner.b); };
  for (const PolytopeStep<S>& step : penetration_steps_.polytopes)
    recorded.polytopes.push_back({mapped(step.vertices, placed), step.faces, step.nearest,
                                  static_cast<double>(step.distance)});
  for (const std::array<GjkVertex<S>, 4>& portal : penetration_steps_.portals)
    recorded.portals.push_back(mapped(portal, placed));
  for (const DirectionStep<S>& step : penetration_steps_.directions)
    recorded.directions.push_back({direction(step.normal), static_cast<double>(step.separation)});
}

template <class S>
void Recorder<S>::field_search(FieldSearch method, const Pose<double>& field_in_a) {
  trace::FieldProbes& recorded = pair_.field_probes.emplace();
  recorded.method = to_string(method);
  for (const trace::FieldProbe& probe : probes_)
    recorded.probes.push_back(
        {point(field_in_a.transform(probe.position).template cast<S>()), probe.separation});
  probes_.clear();
}

/// The Minkowski difference B - A in the world's axes: the hull of the differences of all vertices.
/// None if there are more than kMaxMinkowskiPoints or the builder fails: then the picture omits it.
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
    const Hull<double> hull = build_hull(differences, {.weld_duplicates = true});
    trace::Minkowski& recorded = pair_.minkowski.emplace();
    recorded.vertices = hull.vertices;
    for (int face = 0; face < hull.face_count(); ++face)
      recorded.faces.push_back(face_vertices(hull, face));
  } catch (const ShapeError&) {
    return;
  }
}

template <class S>
void record_manifolds(std::span<const Manifold<S>> manifolds, trace::Pair& record) {
  record.state = manifolds.empty() ? "separated" : "touching";
  if (!manifolds.empty()) record.separation = std::numeric_limits<double>::infinity();
  for (const Manifold<S>& manifold : manifolds) {
    trace::Manifold& recorded = record.manifolds.emplace_back();
    recorded.normal = manifold.normal.template cast<double>();
    recorded.axis = to_string(manifold.axis);
    recorded.type = to_string(manifold.type);
    if (manifold.triangle >= 0) recorded.triangle = manifold.triangle;
    recorded.points = mapped(manifold.points, trace_point<S>);
    // For several manifolds (a mesh's) the deepest point gives the pair's separation.
    for (const trace::Point& point : recorded.points)
      record.separation = std::min(record.separation, point.separation);
  }
}

template class Recorder<float>;
template class Recorder<double>;
template decltype(record_manifolds<float>) record_manifolds<float>;
template decltype(record_manifolds<double>) record_manifolds<double>;

}  // namespace contactscope
