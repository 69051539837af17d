#include "manifold/collide_pairs.h"
#include "manifold/create_contact.h"
#include "query/fast/face_bounds.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Index of the farthest vertex, or most parallel normal, along a direction.
template <class S> int farthest(const VectorLanes<S>& vectors, const Vec3<S>& direction) {
  int best = 0;
  S most = -std::numeric_limits<S>::infinity();
  for (int i = 0; i < vectors.count(); ++i) {
    const S along = direction.dot(vectors[i]);
    if (along > most) most = along, best = i;
  }
  return best;
}

template <class S> S measured_separation(const HullPair<S>& pair, const Vec3<S>& normal) {
  const Vec3<S> on_a = pair.a.vertices[farthest(pair.a.vertices, normal)];
  const Vec3<S> on_b = pair.b.vertices[farthest(pair.b.vertices, Vec3<S>(-normal))];
  return normal.dot(Vec3<S>(on_b - on_a));
}

/// The pair of edges at the two support vertices whose cross product is nearest to the normal.
template <class S> EdgeQuery<S> nearest_edge_pair(const HullPair<S>& pair, const Vec3<S>& normal) {
  const int vertex_a = farthest(pair.a.vertices, normal);
  const int vertex_b = farthest(pair.b.vertices, Vec3<S>(-normal));
  EdgeQuery<S> best;
  S most = S(0);
  for (const int edge_a : pair.a.hull.around_vertex(vertex_a)) {
    const Vec3<S> along_a = pair.a.direction(edge_a);
    for (const int edge_b : pair.b.hull.around_vertex(vertex_b)) {
      const Vec3<S> cross = along_a.cross(pair.b.direction(edge_b));
      const S sine = cross.norm();
      if (sine < kParallelSine<S>) continue;
      const S along = normal.dot(cross) / sine;
      if (!(std::abs(along) > most)) continue;
      most = std::abs(along);
      best.edge_a = edge_a & ~1;
      best.edge_b = edge_b & ~1;
      best.normal = along < S(0) ? Vec3<S>(-cross / sine) : Vec3<S>(cross / sine);
    }
  }
  if (best.edge_a >= 0) best.separation = measured_separation(pair, best.normal);
  return best;
}

/// The touching features of two hulls that overlap along a known normal, for methods that give only
/// a normal: the other half of the separating axis test's result.
///
/// Three candidates: the face of A most parallel to the normal; the face of B most anti-parallel;
/// the pair of edges at the two support vertices whose cross product is nearest to the normal. Each
/// is measured as in the queries of sat(), by support vertices of the whole other hull. Then
/// sat()'s preference chooses among them, so that the same code makes the contact without more
/// flicker: a face as long as it is nearly as deep as the best candidate.
///
/// So the contact's normal is its features' normal, not `normal`: which corrects a method that
/// stopped short. If all three are deeper than `depth` by more than the preference allows, they do
/// not explain that normal, and the result's status is Separated; otherwise Touching.
/// Preference::None allows a ten-thousandth of the smaller radius: sampling's error.
///
/// `queries_run` is 3; the edge query has no pair if all edges are nearly parallel.
template <class S>
SatResult<S> axes_of_normal(const HullPair<S>& pair, const Vec3<S>& normal, S depth,
                            Preference preference) {
  SatResult<S> axes;
  axes.queries_run = 3;
  axes.face_a = measure_face(pair.a, farthest(pair.a.normals, normal), pair.b);
  axes.face_b = measure_face(pair.b, farthest(pair.b.normals, Vec3<S>(-normal)), pair.a);
  axes.edge = nearest_edge_pair(pair, normal);

  axes.deepest = AxisKind::FaceA;
  if (axes.face_b.separation > axes.face_a.separation) axes.deepest = AxisKind::FaceB;
  if (axes.edge.edge_a >= 0 && axes.edge.separation > axes.separation(axes.deepest) +
                                                          edge_handicap(pair.scale, preference)) {
    axes.deepest = AxisKind::EdgeEdge;
  }
  const S best = axes.separation(axes.deepest);
  const bool is_relative = preference == Preference::Relative;
  const S slack = is_relative ? preference_tolerance(depth, pair.min_radius)
                              : std::max(S(1e-4) * pair.min_radius, depth_rounding(pair.scale));
  axes.status = best < -depth - slack ? SatStatus::Separated : SatStatus::Touching;

  const S least = best - (is_relative ? preference_tolerance(best, pair.min_radius) : S(0));
  axes.chosen = AxisKind::EdgeEdge;
  if (axes.face_b.separation >= least) axes.chosen = AxisKind::FaceB;
  if (axes.face_a.separation >= least) axes.chosen = AxisKind::FaceA;
  return axes;
}

}  // namespace

template <class S>
std::optional<S> collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                        const CollideOptions& options, Contact<S>& contact,
                                        Recorder<S>* recorder) {
  const SupportSet<S> set_a = support_set(a), set_b = support_set(b);
  const GjkResult<S> query = gjk<S>(set_a, set_b, b_in_a, nullptr, gjk_run(recorder));
  if (recorder) recorder->gjk(Pose<S>());
  const bool overlap = may_overlap(query, set_a, set_b, b_in_a);
  if (!overlap && query.distance > options.margin) return query.distance;
  if (!overlap) return std::nullopt;

  const PenetrationResult<S> found = penetration<S>(options.penetration, set_a, set_b, b_in_a, {},
                                                    &query.simplex, penetration_steps(recorder));
  if (has_depth(found.status)) {
    const HullPair<S> pair(a, b, b_in_a);
    const SatResult<S> axes = axes_of_normal(pair, found.normal, found.depth, options.preference);
    if (axes.status == SatStatus::Touching) {
      if (recorder) recorder->penetration(options.penetration, found, nullptr);
      create_contact(pair, axes, options, contact, recorder);
      return axes.separation(axes.chosen);
    }
  }
  if (recorder) recorder->penetration(options.penetration, found, "sat");
  return std::nullopt;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_by_penetration);

}  // namespace contactscope
