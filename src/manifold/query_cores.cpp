#include "geometry/triangle_hull.h"
#include "manifold/queried_pair.h"
#include "query/tolerance.h"
#include "query/winding.h"

namespace contactscope {
namespace {

/// Rounding of results in double: GJK and the separating axis test differ by up to 36 epsilon.
double rounding_of_double(double lengths) { return depth_rounding(2 * lengths); }

double rounding_along(const Vec3d& normal, const PlacedCore& core, const Vec3d& in_set,
                      Epsilon epsilon) {
  return rounding_along(normal, core.given, core.origin + in_set, epsilon) + epsilon * core.radius;
}

/// From the world's origin.
double reach_of(const PlacedCore& core) {
  return reach_of(core.set) + core.radius + core.origin.norm() + core.given.position.norm();
}

/// Whether the depth matters for cores that may overlap, also if it may be only rounding.
bool needs_depth(const Question& question, double radii, double rounding) {
  if (question.kind == QueryKind::Penetration) return true;
  const bool compares = question.kind == QueryKind::Touching || !question.inclusive();
  return compares && radii <= question.tolerance + rounding;
}

bool has_features(const PlacedCore& core) { return core.has_volume() && !core.set.hull->flat(); }

constexpr QueryMethod query_method(PenetrationMethod method) {
  return static_cast<QueryMethod>(static_cast<int>(QueryMethod::Sat) + static_cast<int>(method));
}
static_assert(query_method(PenetrationMethod::Sampling) == QueryMethod::Sampling);

const char* to_word(TriangleOverlapKind kind) {
  constexpr const char* kWords[] = {"none", "touching", "proper", "coplanar"};
  return kWords[static_cast<int>(kind)];
}

/// Touching triangles share no interior point. Guigue and Devillers 2003 call an overlap proper if it
/// is not within one plane.
bool counts(TriangleOverlapKind kind, QueryComparison comparison) {
  return kind == TriangleOverlapKind::Proper ||
         (kind == TriangleOverlapKind::Coplanar && comparison != QueryComparison::Proper) ||
         (kind == TriangleOverlapKind::Touching && comparison == QueryComparison::Inclusive);
}

template <class S>
void record_intersections(const MeshOverlap<S>& found, const Pose<S>& pose_a, trace::Pair& record) {
  const ToWorld<S> to_world(pose_a);
  for (const MeshIntersection<S>& crossing : found.intersections) {
    trace::Intersection& recorded = record.intersections.emplace_back();
    const TriangleOverlap<S>& overlap = crossing.overlap;
    recorded.a = crossing.a;
    recorded.b = crossing.b;
    recorded.kind = to_word(overlap.kind);
    recorded.a_degenerate = overlap.a_degenerate;
    recorded.b_degenerate = overlap.b_degenerate;
    if (overlap.kind == TriangleOverlapKind::Coplanar) continue;
    const auto placed = [&](const Vec3<S>& point) -> Vec3d {
      return to_world.point(point).template cast<double>();
    };
    recorded.segment = {placed(overlap.segment[0]), placed(overlap.segment[1])};
  }
  record.query->trees = trace::TreeCounts{static_cast<int>(found.counts.node_pairs),
                                          static_cast<int>(found.counts.leaf_pairs),
                                          static_cast<int>(found.counts.triangle_pairs)};
}

/// For each node, the range of triangles below it, in the order of the tree.
template <class S> std::vector<std::pair<int, int>> triangles_below(const AabbTree<S>& tree) {
  std::vector<std::pair<int, int>> ranges(tree.nodes.size());  // first and count
  // Backwards, because a node's children come after it.
  for (int i = count_of(tree.nodes) - 1; i >= 0; --i) {
    const auto& node = at(tree.nodes, i);
    at(ranges, i) = node.leaf()
                        ? std::pair(node.next, node.count)
                        : std::pair(at(ranges, i + 1).first,
                                    at(ranges, i + 1).second + at(ranges, tree.right_of(i)).second);
  }
  return ranges;
}

template <class S>
std::vector<trace::NodePair> recorded_node_pairs(const AabbTree<S>& a, const AabbTree<S>& b,
                                                 const std::vector<NodePairVisit>& visits) {
  const auto below_a = triangles_below(a), below_b = triangles_below(b);
  return mapped(visits, [&](const NodePairVisit& visit) -> trace::NodePair {
    const auto [before_a, count_a] = at(below_a, visit.a);
    const auto [before_b, count_b] = at(below_b, visit.b);
    return {before_a, count_a,        before_b,
            count_b,  visit.overlaps, at(a.nodes, visit.a).leaf() && at(b.nodes, visit.b).leaf()};
  });
}

template <class S>
trace::Containment recorded_containment(Containment containment, const Mesh<S>& b) {
  using enum Containment;
  if (containment == AInB) return {"inside", "outside"};
  if (containment == BInA) return {"outside", "inside"};
  if (containment == AHasHoles) return {"open", open_edges(b).empty() ? "unknown" : "open"};
  if (containment == BHasHoles) return {"unknown", "open"};
  return {"outside", "outside"};
}

}  // namespace

double rounding_along(const Vec3d& normal, const Pose<double>& pose, const Vec3d& in_frame,
                      Epsilon epsilon) {
  const Vec3d local = pose.inverse_rotate(normal);
  // Half the derivatives of normal . (q x q*) / |q|^2 by the four numbers of q; x is the point.
  const double w = pose.rotation.w();
  const Vec3d v = pose.rotation.vec(), &x = in_frame;
  const double along = local.dot(x);
  const double by_w = w * (normal.dot(x) - along) + normal.dot(v.cross(x));
  const Vec3d by_v =
      v.dot(x) * normal + v.dot(normal) * x + w * x.cross(normal) - (normal.dot(x) + along) * v;
  const double turned = 2 * (std::abs(w * by_w) + v.cwiseAbs().dot(by_v.cwiseAbs()));
  const double moved = normal.cwiseAbs().dot(pose.position.cwiseAbs());
  return epsilon * (moved + turned + local.cwiseAbs().dot(x.cwiseAbs()));
}

double bound_of_rounding(double lengths, Epsilon epsilon) {
  return 4 * epsilon * lengths + rounding_of_double(lengths);
}

Gap gap_of_cores(const PlacedCore& a, const PlacedCore& b, const Question& question,
                 Epsilon epsilon, Recorder<double>* recorder, QueryMemory* memory) {
  const Pose<double> pose_a = a.pose(), b_in_a = relative_pose(pose_a, b.pose());
  const double radii = a.radius + b.radius;
  const double computed =
      rounding_of_double(reach_of(a.set) + reach_of(b.set) + b_in_a.position.norm() + radii);
  Gap found;
  const auto from_cores = [&](double distance, const Vec3d& normal, const Vec3d& on_a,
                              const Vec3d& on_b) {
    const Vec3d axis = pose_a.rotate(normal);
    found.gap = distance - radii;
    found.rounding = computed + rounding_along(axis, a, on_a, epsilon) +
                     rounding_along(axis, b, b_in_a.inverse_transform(on_b), epsilon);
    found.normal = normal;
    found.on_a = on_a + a.radius * normal;
    found.on_b = on_b - b.radius * normal;
  };
  if (question.distance == DistanceMethod::VClip && has_features(a) && has_features(b)) {
    const ComparedFeatures* const start = memory && memory->features ? &*memory->features : nullptr;
    std::vector<ComparedFeatures> walk;
    const VClipResult<double> walked =
        v_clip(*a.set.hull, *b.set.hull, b_in_a, start, recorder ? &walk : nullptr);
    if (memory) memory->features = walked.features;
    if (recorder) recorder->walk(*a.set.hull, *b.set.hull, b_in_a, walk);
    if (walked.status == VClipStatus::Separated && walked.distance > computed) {
      from_cores(walked.distance, (walked.on_b - walked.on_a).normalized(), walked.on_a,
                 walked.on_b);
      found.method = QueryMethod::VClip;
      return found;
    }
  }
  GjkSimplex<double>* const simplex = memory ? &memory->simplex : nullptr;
  const GjkResult<double> cores = gjk<double>(a.set, b.set, b_in_a, simplex, gjk_run(recorder));
  if (simplex) *simplex = cores.simplex;
  if (recorder) recorder->gjk(Pose<double>());
  const bool any_volume = a.has_volume() || b.has_volume();
  const double bound = bound_of_rounding(reach_of(a) + reach_of(b), epsilon);
  if (any_volume && may_overlap(cores, a.set, b.set, b_in_a) &&
      needs_depth(question, radii, bound)) {
    const auto by = [&](PenetrationMethod method, PenetrationSteps<double>* steps) {
      return penetration<double>(method, a.set, b.set, b_in_a, {}, &cores.simplex, steps);
    };
    PenetrationMethod method =
        question.kind == QueryKind::Penetration ? question.penetration : PenetrationMethod::Sat;
    PenetrationResult<double> deep = by(method, penetration_steps(recorder));
    if (recorder) recorder->penetration(method, deep, nullptr);
    // The other methods give more than the least depth, which may be only rounding.
    if (method != PenetrationMethod::Sat && !question.inclusive() && radii <= bound) {
      const PenetrationResult<double> least = by(PenetrationMethod::Sat, nullptr);
      if (!has_depth(least.status) || least.depth <= bound) {
        method = PenetrationMethod::Sat;
        deep = least;
      }
    }
    if (has_depth(deep.status)) {
      found.method = query_method(method);
      from_cores(-deep.depth, deep.normal, deep.on_a, deep.on_b);
      return found;
    }
    // Touching for GJK, just separated for the other method: the two agree within rounding.
    from_cores(cores.distance, deep.normal, cores.on_a, cores.on_b);
  }
  if (cores.status == GjkStatus::Separated) {
    from_cores(cores.distance, cores.normal, cores.on_a, cores.on_b);
  } else if (!any_volume) {
    found.gap = -radii;
    found.rounding = computed + epsilon * radii;
  }
  return found;
}

Gap gap_to_plane(const PlacedCore& a, const HalfSpace<double>& b, const Pose<double>& pose_b,
                 Epsilon epsilon) {
  const Pose<double> b_in_a = relative_pose(a.pose(), pose_b);
  const Vec3d outward = b_in_a.rotate(b.plane.normal);
  const Vec3d& lowest = at(a.set.points, support_index<double>(a.set, -outward));
  Gap found;
  found.method = QueryMethod::Support;
  found.normal = -outward;
  found.on_a = lowest - a.radius * outward;
  const double gap = outward.dot(found.on_a - b_in_a.position) - b.plane.offset;
  found.gap = gap;
  found.on_b = found.on_a - gap * outward;
  const Vec3d axis = pose_b.rotate(b.plane.normal);
  found.rounding = rounding_of_double(reach_of(a.set) + b_in_a.position.norm() +
                                      std::abs(b.plane.offset) + a.radius) +
                   rounding_along(axis, a, lowest, epsilon) +
                   rounding_along(axis, pose_b, b_in_a.inverse_transform(found.on_b), epsilon);
  return found;
}

template <class S>
std::optional<Gap> gap_to_mesh(const PlacedCore& a, const Mesh<S>& b, const Pose<double>& pose_b,
                               const Question& question) {
  const Pose<double> a_in_b = relative_pose(pose_b, a.pose());
  Aabb<double> box;
  for (int i = 0; i < a.set.count; ++i) box.include(a_in_b.transform(a.set.points[i]));
  const double lengths = reach_of(a) + a.radius + a_in_b.position.norm() + pose_b.position.norm();
  const Vec3d grown =
      Vec3d::Constant(a.radius + question.tolerance + 2 * bound_of_rounding(lengths, kEpsilon<S>));
  box = {box.lower - grown, box.upper + grown};
  TriangleHull<double> triangle;
  std::optional<Gap> least;
  b.tree.query(box.template cast<S>(), [&](int index) {
    const auto corner = [&](int k) -> Vec3d { return b.corner(index, k).template cast<double>(); };
    const Vec3d v0 = corner(0), v1 = corner(1), v2 = corner(2);
    Vec3d normal = triangle_normal(v0, v1, v2);
    if (normal.isZero(0)) normal = b.normal(index).template cast<double>();
    triangle.set(v0, v1, v2, normal);
    const PlacedCore flat{support_set(triangle.hull), 0, pose_b, triangle.origin};
    const Gap gap = gap_of_cores(a, flat, {.kind = QueryKind::Penetration}, kEpsilon<S>, nullptr);
    if (!least || *gap.gap < *least->gap) least = gap;
  });
  if (least && *least->gap > question.tolerance + least->rounding) return std::nullopt;
  return least;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(gap_to_mesh);

template <class S>
Answer<S> query_meshes(const Mesh<S>& a, const Pose<S>& pose_a, const Mesh<S>& b,
                       const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                       const trace::Stages& stages, MeshFront* front) {
  const Pose<S> b_in_a = relative_pose(pose_a, pose_b);
  const bool watched = record != nullptr && stages.node_pairs;
  std::vector<NodePairVisit> visits;
  const MeshOverlap<S> found = mesh_overlap(a, b, b_in_a, watched ? &visits : nullptr, front);
  Answer<S> answer;
  answer.method = QueryMethod::Triangles;
  answer.trees = found.counts;
  answer.overlap = std::ranges::any_of(found.intersections, [&](const MeshIntersection<S>& one) {
    return counts(one.overlap.kind, question.comparison);
  });
  if (record) record_intersections(found, pose_a, *record);
  if (watched) record->query->node_pairs = recorded_node_pairs(a.tree, b.tree, visits);
  if (found.overlapping()) return answer;
  const Containment containment = mesh_containment(a, b, b_in_a);
  answer.overlap = containment == Containment::AInB || containment == Containment::BInA;
  if (record) record->query->containment = recorded_containment(containment, b);
  return answer;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(query_meshes);

}  // namespace contactscope
