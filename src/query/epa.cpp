#include "query/epa.h"

#include <algorithm>
#include <utility>

#include "query/polytope.h"

namespace contactscope {
namespace {

/// Whether the origin is in a tetrahedron, or no farther out than may_overlap() allows: what a
/// simplex of an earlier pose need not hold.
template <class S>
bool holds_origin(const Polytope<S>& tetrahedron, S rounding) {
  for (int i = 0; i < 4; ++i) {
    if (tetrahedron.face(i).offset < -S(16) * rounding) return false;
  }
  return true;
}

template <class S>
void record(const Polytope<S>& polytope, int nearest, const MinkowskiDifference<S>& difference,
            PenetrationSteps<S>& steps) {
  PolytopeStep<S>& step = steps.polytopes.emplace_back();
  std::array<int, Polytope<S>::kMaxVertices> place;
  place.fill(-1);
  step.distance = difference.unit() * polytope.face(nearest).distance;
  for (int i = 0; i < polytope.face_slots(); ++i) {
    const PolytopeFace<S>& face = polytope.face(i);
    if (!face.is_alive) continue;
    if (i == nearest) step.nearest = static_cast<int>(step.faces.size());
    std::array<int, 3>& corners = step.faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int16_t vertex = face.vertices[k];
      int& told = place[static_cast<std::size_t>(vertex)];
      if (told < 0) {
        told = static_cast<int>(step.vertices.size());
        step.vertices.push_back(difference.vertex(polytope.vertex(vertex).pair));
      }
      corners[k] = told;
    }
  }
}

/// The deepest points are those of the face whose own nearest point is where the best plane is met:
/// what was the nearest face when that plane was found may have been replaced since.
template <class S>
void weigh(const Polytope<S>& polytope, BoundedDifference<S>& difference) {
  const Vec3<S> met = difference.upper() * difference.outward();
  int best = -1;
  S least = std::numeric_limits<S>::infinity();
  for (int i = 0; i < polytope.face_slots(); ++i) {
    const PolytopeFace<S>& face = polytope.face(i);
    if (!face.is_alive) continue;
    Vec3<S> nearest = Vec3<S>::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      nearest += face.weights[k] * polytope.vertex(face.vertices[k]).point;
    }
    const S off = (nearest - met).squaredNorm();
    if (off < least) least = off, best = i;
  }
  if (best < 0) return;
  const PolytopeFace<S>& face = polytope.face(best);
  WeightedPairs<S>& weights = difference.weights();
  weights.count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (face.weights[k] > S(0))
      weights.add(polytope.vertex(face.vertices[k]).pair, face.weights[k]);
  }
}

/// Where a face's normal is too uncertain for its support point to be new, its plane is turned about
/// its longest edge until no point is beyond: gift wrapping. That edge and the far point that stops
/// it make a face of the difference that is no needle.
template <class S>
void turn_about_longest_edge(const Polytope<S>& polytope, const PolytopeFace<S>& face,
                             DifferencePoint<S> beyond, S tolerance,
                             BoundedDifference<S>& difference) {
  constexpr int kTurns = 4;
  std::size_t longest = 0;
  S squared = S(0);
  for (std::size_t e = 0; e < 3; ++e) {
    const S length = (polytope.vertex(face.vertices[(e + 1) % 3]).point -
                      polytope.vertex(face.vertices[e]).point)
                         .squaredNorm();
    if (length > squared) squared = length, longest = e;
  }
  const Vec3<S> from = polytope.vertex(face.vertices[longest]).point;
  const Vec3<S> along = polytope.vertex(face.vertices[(longest + 1) % 3]).point - from;
  Vec3<S> outward = face.direction;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Vec3<S> to_point = beyond.point - from;
    const Vec3<S> cross = along.cross(to_point);
    const S length = cross.norm();
    if (!(length > S(0))) return;
    outward = cross.dot(outward) < S(0) ? Vec3<S>(-cross / length) : Vec3<S>(cross / length);
    difference.bound(outward, beyond);
    if (outward.dot(beyond.point - from) <= tolerance) return;
  }
}

/// The nearest point of GJK's last simplex, which is the origin within rounding, gives the deepest
/// points of a difference without volume.
template <class S>
PenetrationResult<S> flat_result(const GjkSimplex<S>& simplex, const StartSimplex<S>& start,
                                 BoundedDifference<S>& difference) {
  DifferencePoint<S> found;
  const Vec3<S> between = difference.difference().between_middles();
  const bool faces_away = start.outward.dot(between) > S(0);
  const Vec3<S> outward = faces_away ? Vec3<S>(-start.outward) : start.outward;
  difference.bound(outward, found);
  WeightedPairs<S>& weights = difference.weights();
  weights.count = 0;
  for (std::size_t i = 0; i < simplex.vertices.size(); ++i) {
    weights.add({simplex.vertices[i].index_a, simplex.vertices[i].index_b}, simplex.weights[i]);
  }
  return difference.result(PenetrationStatus::Flat, S(0), 0);
}

template <class S>
bool refers_to(const GjkSimplex<S>& simplex, const MinkowskiDifference<S>& difference) {
  if (simplex.vertices.empty()) return false;
  return std::all_of(simplex.vertices.begin(), simplex.vertices.end(),
                     [&](const GjkVertex<S>& vertex) { return difference.has(vertex); });
}

template <class S>
PenetrationResult<S> expand(const StartSimplex<S>& start, const PenetrationOptions<S>& options,
                            BoundedDifference<S>& difference, PenetrationSteps<S>* steps) {
  const S tolerance = tolerance_in_units(options, difference.difference());
  const int allowed = allowed_iterations(options, kMaxEpaIterations);
  Polytope<S> polytope(start, difference.rounding());
  PenetrationStatus status = PenetrationStatus::OutOfIterations;
  int iteration = 0;
  while (iteration < allowed) {
    const int nearest = polytope.nearest_open();
    if (nearest < 0 || difference.upper() - polytope.face(nearest).distance <= tolerance) {
      const bool is_certain = difference.upper() - polytope.distance() <= tolerance;
      status = is_certain ? PenetrationStatus::Converged : PenetrationStatus::Stalled;
      break;
    }
    ++iteration;
    const PolytopeFace<S> face = polytope.face(nearest);
    if (steps != nullptr) record(polytope, nearest, difference.difference(), *steps);

    DifferencePoint<S> support;
    difference.bound(face.direction, support);
    if (!difference.is_finite() || difference.is_separated()) break;
    const S beyond = face.direction.dot(support.point) - face.distance;
    if (beyond <= tolerance) {
      polytope.close(nearest);
    } else if (polytope.has_vertex(support.pair) || !polytope.expand(nearest, support)) {
      turn_about_longest_edge(polytope, face, support, tolerance, difference);
      polytope.close(nearest);
    }
  }
  if (difference.is_separated()) status = PenetrationStatus::Separated;
  weigh(polytope, difference);
  return difference.result(status, polytope.distance(), iteration);
}

}  // namespace

/// Van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", GDC
/// 2001, and his book of 2003, section 4.3.8.
///
/// We deviate in four things. The end: both bounds of the depth are kept, the nearest face from
/// below and the best support plane from above, and the result is the best support plane of all
/// steps, which parts the shapes whatever rounding has done to the polytope. The distance of a face
/// is that of the triangle (see Polytope::measure). The horizon is a flood fill with an explicit
/// list and is checked to be one simple loop before anything is changed. A face that rounding does
/// not let us expand is closed, after turning its plane about its longest edge, and the next
/// nearest goes on: so each step adds a vertex or closes a face, and the method ends.
///
/// Steps: 1. GJK's last simplex, blown up to a tetrahedron (blow_up.h); 2. the open face nearest to
/// the origin; 3. it is no nearer than the best plane less the tolerance: the end; 4. the support
/// point along its normal, whose plane bounds the depth; 5. not beyond the face: the face is part of
/// the surface, close it; 6. else replace all faces that the point sees, and go on at 2.
template <class S>
PenetrationResult<S> epa(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                         PenetrationSteps<S>* steps) {
  BoundedDifference<S> difference(a, b, b_in_a);
  if (!difference.is_finite()) return {};
  if (overlap != nullptr && refers_to(*overlap, difference.difference())) {
    const StartSimplex<S> start = blow_up(*overlap, difference);
    if (!difference.is_finite()) return {};
    if (start.count == 4 &&
        holds_origin(Polytope<S>(start, difference.rounding()), difference.rounding())) {
      return expand(start, options, difference, steps);
    }
  }
  const GjkResult<S> query = gjk(a, b, b_in_a);
  if (!query.on_a.allFinite() || !query.on_b.allFinite()) return {};
  PenetrationResult<S> apart;
  apart.status = PenetrationStatus::Separated;
  apart.normal = query.normal;
  apart.on_a = query.on_a;
  apart.on_b = query.on_b;
  if (!may_overlap(query, a, b, b_in_a)) return apart;
  const StartSimplex<S> start = blow_up(query.simplex, difference);
  if (!difference.is_finite()) return {};
  if (start.count < 4) {
    const bool is_apart = query.status == GjkStatus::Separated;
    return is_apart ? apart : flat_result(query.simplex, start, difference);
  }
  return expand(start, options, difference, steps);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                             \
  template PenetrationResult<S> epa(const SupportSet<S>&, const SupportSet<S>&, const Pose<S>&, \
                                    const PenetrationOptions<S>&, const GjkSimplex<S>*,         \
                                    PenetrationSteps<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
