#include "manifold/recorder.h"

#include "geometry/hull_builder.h"
#include "manifold/dispatch.h"
#include "manifold/edge_contact.h"
#include "query/tolerance.h"
#include "reduce/choices.h"

namespace contactscope {

// Margins of the pipeline's choices: the smallest change of the compared quantities that would
// change a choice. Computed from the stages' measurements, only when recording.

namespace {

/// Maximum number of points for trying all subsets to find the second best.
constexpr std::size_t kMaxPoints = 8;

/// "points 0 2 4".
std::string spell_points(const std::vector<int>& points) {
  std::string text = points.size() == 1 ? "point" : "points";
  for (const int point : points) text += " " + std::to_string(point);
  return text;
}

/// The deciding measure of a candidate at a step of a reducer: more is better. A chosen point has
/// measures against all edges; the least of them decided.
double worth(const trace::Choice& choice, int point) {
  double least = std::numeric_limits<double>::infinity();
  for (const trace::Measure& measure : choice.measures)
    if (measure.point == point) least = std::min(least, measure.value);
  if (choice.rule == "outside" || choice.rule == "distance") return -least;
  return choice.rule == "triangle" ? std::abs(least) : least;
}

/// Most vertex differences for the Minkowski difference: two hulls of 64 vertices, milliseconds.
constexpr int kMaxMinkowskiPoints = 4096;

/// A result of the pipeline, in the world, as a fact.
template <class S> trace::Point trace_point(const ContactPoint<S>& in_world) {
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

/// A later face must beat an earlier one by more than the tie.
template <class S>
void Recorder<S>::face_decision(const char* stage, const FaceSeparations<S>& all, int count,
                                int took, S tie) {
  S margin = std::numeric_limits<S>::infinity();
  int over = -1;
  for (int face = 0; face < count; ++face) {
    const S ahead = all.separation(took) - all.separation(face) + (face < took ? -tie : tie);
    if (face != took && ahead < margin) margin = ahead, over = face;
  }
  if (over < 0) return;
  decide(stage, "face " + std::to_string(took), "face " + std::to_string(over)).margin =
      static_cast<double>(margin);
}

/// As choose() in sat.cpp: faces of A unless another axis is ahead by more than the preference,
/// then those of B, then edges.
template <class S>
void Recorder<S>::axis_decisions(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                                 const FaceSeparations<S>& faces_b, const SatResult<S>& axes,
                                 const CollideOptions& options) {
  if (!stages_.decisions) return;
  face_decision("face_a", faces_a, pair.a.normals.count(), axes.face_a.face, axes.tie);
  if (axes.queries_run > 1)
    face_decision("face_b", faces_b, pair.b.normals.count(), axes.face_b.face, axes.tie);
  const S margin = static_cast<S>(options.margin);
  if (axes.status == SatStatus::Separated) {
    decide("contact", "separated", "touching").margin =
        static_cast<double>(axes.separation(axes.chosen) - margin);
    return;
  }
  decide("contact", "touching", "separated").margin =
      static_cast<double>(margin - axes.separation(axes.deepest));
  EdgeQuery<S> edge = axes.edge;
  if (edge.edge_a < 0)
    edge = query_edges(pair, faces_a, -std::numeric_limits<S>::infinity(), axes.tie);
  const S of_a = axes.face_a.separation, of_b = axes.face_b.separation;
  const S of_edge = edge.edge_a < 0
                        ? -std::numeric_limits<S>::infinity()
                        : edge.separation - edge_handicap(pair.scale, options.preference);
  const S tolerance = options.preference == Preference::Relative
                          ? preference_tolerance(axes.separation(axes.deepest), pair.min_radius)
                          : S(0);
  if (pair_.sat) pair_.sat->tolerance = static_cast<double>(tolerance);
  AxisKind over = AxisKind::FaceA;
  S ahead = S(0);
  if (axes.chosen == AxisKind::FaceA) {
    over = of_b >= of_edge ? AxisKind::FaceB : AxisKind::EdgeEdge;
    ahead = of_a + tolerance - std::max(of_b, of_edge);
  } else if (axes.chosen == AxisKind::FaceB) {
    const S before = std::max(of_b, of_edge) - tolerance - of_a;
    const S after = of_b + tolerance - of_edge;
    over = before <= after ? AxisKind::FaceA : AxisKind::EdgeEdge;
    ahead = std::min(before, after);
  } else {
    over = of_a >= of_b ? AxisKind::FaceA : AxisKind::FaceB;
    ahead = of_edge - tolerance - std::max(of_a, of_b);
  }
  if (std::isfinite(ahead))
    decide("axis", to_string(axes.chosen), to_string(over)).margin = static_cast<double>(ahead);
}

template <class S>
void Recorder<S>::reduction_decisions(const trace::Reduction& reduction, const Vec3d& normal,
                                      double depth_tie) {
  if (!stages_.decisions || reduction.points.size() == reduction.kept.size()) return;
  for (std::size_t step = 0; step < reduction.choices.size() && step < reduction.kept.size();
       ++step) {
    const trace::Choice& choice = reduction.choices[step];
    const int took = reduction.kept[step];
    int over = -1;
    double next = -std::numeric_limits<double>::infinity();
    for (const trace::Measure& measure : choice.measures) {
      const double value = worth(choice, measure.point);
      if (measure.point != took && value > next) next = value, over = measure.point;
    }
    if (over < 0) continue;
    trace::Decision& record =
        decide("point " + std::to_string(step), "point " + std::to_string(took),
               "point " + std::to_string(over));
    const bool is_area =
        choice.rule == "outside" || choice.rule == "triangle" || choice.rule == "equally_deep";
    (is_area ? record.margin_area : record.margin) = worth(choice, took) - next;
  }
  const std::string& method = reduction.method;
  const std::size_t count = reduction.points.size(), kept = reduction.kept.size();
  if (!method.starts_with("optimal") || count > kMaxPoints || kept < 3) return;
  // All other subsets of this size; except for "optimal" they need one of the deepest points.
  const auto depth = [&](int point) { return at(reduction.points, point).separation; };
  double deep = depth(0);
  for (int point = 1; point < count_of(reduction.points); ++point)
    deep = std::min(deep, depth(point));
  const auto is_deep = [&](int point) { return depth(point) <= deep + depth_tie; };
  std::vector<int> took = reduction.kept, over;
  std::ranges::sort(took);
  double next = -1;
  std::vector<bool> is_in(count, false);
  std::fill_n(is_in.begin(), kept, true);
  do {
    std::vector<int> subset;
    std::vector<Vec3d> places;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_in[i]) continue;
      subset.push_back(static_cast<int>(i));
      places.push_back(reduction.points[i].position);
    }
    if (subset == took || (method != "optimal" && std::ranges::none_of(subset, is_deep))) continue;
    const double area = convex_area(places, normal);
    if (area > next) next = area, over = subset;
  } while (std::prev_permutation(is_in.begin(), is_in.end()));
  if (over.empty()) return;
  decide("points", spell_points(took), spell_points(over)).margin_area = reduction.area - next;
}

template <class S> trace::Polygon Recorder<S>::polygon(const ClipPolygon<S>& in_a) const {
  return mapped(in_a, [&](const ClipVertex<S>& vertex) { return point(vertex.position); });
}

/// The edge query looks only for pairs that beat the faces, and skips whole arcs of others.
/// Pictures also need all crossings, and the best pair where none beats the faces. To collect both
/// in the query would slow a recorded pair with an edge contact by half.
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
  if (stages_.gauss_map)
    for (const EdgeQuery<S>& query : all_crossings(pair, faces_a))
      sat.edge_pairs.push_back(
          {query.edge_a / 2, query.edge_b / 2, query.separation, direction(query.normal)});
  if (axes.queries_run < 3) return;
  EdgeQuery<S> query = axes.edge;
  if (query.edge_a < 0)
    query = query_edges(pair, faces_a, -std::numeric_limits<S>::infinity(), axes.tie);
  if (query.edge_a < 0) return;
  const ClosestPoints<S> closest = closest_points(pair.a, pair.b, query);
  sat.edge = trace::EdgeAxis{query.edge_a / 2,        query.edge_b / 2,    query.separation,
                             direction(query.normal), point(closest.on_a), point(closest.on_b)};
}

template <class S> void Recorder<S>::cache(const CacheAnswer<S>& answer) {
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

template <class S> void Recorder<S>::clip_step(const Plane<S>& side, const ClipPolygon<S>& left) {
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

template <class S> void Recorder<S>::merged(std::vector<int> triangles, int points) {
  if (!stages_.reduction) return;
  if (!pair_.merge) pair_.merge.emplace();
  std::ranges::sort(triangles);
  pair_.merge->manifolds.push_back({std::move(triangles), points});
}

template <class S>
void Recorder<S>::reduced_outline_of(ContactPoints<S> all, const std::vector<int>& indices) {
  if (!pair_.reduction) return;
  trace::Reduction& reduction = *pair_.reduction;
  const auto map = [&](int& index) {
    if (index >= 0) index = at(indices, index);
  };
  for (int& index : reduction.kept) map(index);
  for (int& index : reduction.best) map(index);
  for (trace::Choice& choice : reduction.choices) {
    for (trace::Measure& measure : choice.measures) {
      map(measure.point);
      for (int& index : measure.edge) map(index);
    }
  }
  reduction.points = mapped(all, [&](const ContactPoint<S>& in_a) {
    return trace_point<S>({to_world_.point(in_a.position), in_a.separation, in_a.id});
  });
}

template <class S> void Recorder<S>::gjk(const Pose<S>& frame) {
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
void Recorder<S>::walk(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                       const std::vector<ComparedFeatures>& pairs) {
  for (const auto& [of_a, of_b] : pairs) {
    const std::vector<Vec3<S>> points_a = corners_of(a, of_a), points_b = corners_of(b, of_b);
    const SupportSet<S> set_a{points_a.data(), count_of(points_a), nullptr};
    const SupportSet<S> set_b{points_b.data(), count_of(points_b), nullptr};
    pair_.query->walk.push_back(
        {to_string(FeatureId::of(of_a.ref(Owner::A), of_b.ref(Owner::B))),
         static_cast<double>(contactscope::gjk(set_a, set_b, b_in_a).distance)});
  }
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
    const Hull<double> hull =
        build_hull(differences, {.weld_duplicates = true, .allow_flat = true});
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

template <class S>
void Recorder<S>::voided(Owner owner, const char* reason, const Contact<S>& contact) {
  pair_.voided = trace::Voided{
      owner == Owner::A ? pair_.a : pair_.b, reason, direction(contact.normal),
      mapped(contact.points, [&](const ContactPoint<S>& one) -> trace::Point {
        return {point(one.position), static_cast<double>(one.separation), to_string(one.id)};
      })};
}

template class Recorder<float>;
template class Recorder<double>;
CONTACTSCOPE_FLOAT_AND_DOUBLE(record_manifolds);

}  // namespace contactscope
