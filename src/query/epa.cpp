#include "query/polytope.h"

namespace contactscope {
namespace {

template <class S> using StartPoints = std::array<DifferencePoint<S>, 4>;

template <class S> Vec3<S> start_side(const StartPoints<S>& points, int i) {
  return at(points, i).point - points[0].point;
}

/// Distance of a point from the affine span of the first `count` points.
template <class S> S out_of(const StartPoints<S>& points, int count, const Vec3<S>& point) {
  const Vec3<S> from = point - points[0].point;
  if (count == 1) return from.norm();
  const Vec3<S> along = start_side(points, 1);
  if (count == 2) return along.cross(from).norm() / along.norm();
  const Vec3<S> normal = along.cross(start_side(points, 2));
  return std::abs(normal.dot(from)) / normal.norm();
}

/// Orders the points such that each is the farthest from the span of those before it, and stops
/// when the rest is no farther than `least`. Returns the number of points that are.
template <class S> int spread(StartPoints<S>& points, int count, S least) {
  if (count > 1) {
    // The longest edge first: points on it within rounding are between its ends.
    S longest = S(-1);
    int from = 0, to = 1;
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        const S length = (at(points, j).point - at(points, i).point).squaredNorm();
        if (length > longest) longest = length, from = i, to = j;
      }
    }
    std::swap(points[0], at(points, from));
    std::swap(points[1], at(points, to));
  }
  for (int kept = 1; kept < count; ++kept) {
    const auto out = [&](const DifferencePoint<S>& point) {
      return out_of(points, kept, point.point);
    };
    DifferencePoint<S>* const rest = points.data() + kept;
    std::swap(*rest, *std::ranges::max_element(rest, points.data() + count, {}, out));
    if (!(out(*rest) > least)) return kept;
  }
  return count;
}

/// Expands GJK's last simplex, whose closest point within rounding is the origin, to a tetrahedron.
/// Flat ones are first reduced to their largest face, and so on; then support points farthest
/// outside are added. Every simplex contains the one before, and so the origin.
///
/// Source: van den Bergen, "Collision Detection in Interactive 3D Environments", 2003, section
/// 4.3.8. There a segment becomes two tetrahedra and a triangle a double pyramid. With the origin
/// on the boundary of one tetrahedron, EPA's first expansions add the other half.
template <class S>
StartSimplex<S> blow_up(const GjkSimplex<S>& simplex, BoundedDifference<S>& difference) {
  StartSimplex<S> start;
  for (const GjkVertex<S>& vertex : simplex.vertices)
    at(start.points, start.count++) = difference.point_of({vertex.index_a, vertex.index_b});
  const S least = S(2) * difference.rounding();
  start.count = spread(start.points, start.count, least);

  while (start.count < 4) {
    DifferencePoint<S> best = start.points[0];
    S farthest = least;
    // Tries a direction and its opposite for the farthest support point.
    const auto reach_out = [&](const Vec3<S>& direction) {
      for (const Vec3<S>& outward : {direction, Vec3<S>(-direction)}) {
        const DifferencePoint<S> found = difference.support(outward);
        const S out = out_of(start.points, start.count, found.point);
        if (out > farthest) farthest = out, best = found;
      }
    };
    if (start.count == 1) {
      start.outward = -difference.between_middles().normalized();
      for (int axis = 0; axis < 3; ++axis) reach_out(Vec3<S>(Vec3<S>::Unit(axis)));
    } else if (start.count == 2) {
      const Vec3<S> along = start_side(start.points, 1);
      start.outward = any_perpendicular(along);
      const Vec3<S> other = along.cross(start.outward).normalized();
      // At 60 degrees, with their opposites: any point off the segment is ahead of one of them.
      const Vec3<S> half = S(0.5) * start.outward, side = S(0.8660254037844386) * other;
      for (const Vec3<S>& direction : {start.outward, Vec3<S>(half + side), Vec3<S>(half - side)})
        reach_out(direction);
    } else {
      const Vec3<S> normal = start_side(start.points, 1).cross(start_side(start.points, 2));
      start.outward = normal / normal.norm();
      reach_out(start.outward);
    }
    if (!difference.is_finite() || !(farthest > least)) return start;
    at(start.points, start.count++) = best;
  }
  return start;
}

/// Whether the origin is in a tetrahedron up to may_overlap(): a simplex may be of an earlier pose.
template <class S> bool holds_origin(const Polytope<S>& tetrahedron, S rounding) {
  return std::ranges::none_of(tetrahedron.faces, [&](const PolytopeFace<S>& face) {
    return face.offset < -S(16) * rounding;
  });
}

template <class S>
void record(const Polytope<S>& polytope, int nearest, const MinkowskiDifference<S>& difference,
            PenetrationSteps<S>& steps) {
  PolytopeStep<S>& step = steps.polytopes.emplace_back();
  std::array<int, Polytope<S>::kMaxVertices> place;
  place.fill(-1);
  step.distance = difference.unit() * at(polytope.faces, nearest).distance;
  for (const PolytopeFace<S>& face : polytope.faces) {
    if (!face.is_alive) continue;
    if (&face == &at(polytope.faces, nearest)) step.nearest = count_of(step.faces);
    std::array<int, 3>& corners = step.faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      int& recorded = at(place, face.vertices[k]);
      if (recorded < 0) {
        recorded = count_of(step.vertices);
        step.vertices.push_back(difference.vertex(at(polytope.vertices, face.vertices[k]).pair));
      }
      corners[k] = recorded;
    }
  }
}

/// The deepest points come from the face whose closest point is where the best plane touches. The
/// face that was closest when that plane was found may have been replaced since.
template <class S> void weigh(const Polytope<S>& polytope, BoundedDifference<S>& difference) {
  const Vec3<S> met = difference.upper() * difference.outward();
  const PolytopeFace<S>* best = nullptr;
  S least = std::numeric_limits<S>::infinity();
  for (const PolytopeFace<S>& face : polytope.faces) {
    if (!face.is_alive) continue;
    Vec3<S> nearest = Vec3<S>::Zero();
    for (int k = 0; k < 3; ++k) nearest += at(face.weights, k) * polytope.corner(face, k).point;
    const S off = (nearest - met).squaredNorm();
    if (off < least) least = off, best = &face;
  }
  if (best == nullptr) return;
  WeightedPairs<S>& weights = difference.weights();
  weights.count = 0;
  for (int k = 0; k < 3; ++k) {
    const S weight = at(best->weights, k);
    if (weight > S(0)) weights.add(polytope.corner(*best, k).pair, weight);
  }
}

/// If a face's normal is too uncertain to give a new support point, turn its plane about its
/// longest edge until no point is beyond it: gift wrapping. That makes a face that is no needle.
template <class S>
void turn_about_longest_edge(const Polytope<S>& polytope, const PolytopeFace<S>& face,
                             DifferencePoint<S> beyond, S tolerance,
                             BoundedDifference<S>& difference) {
  constexpr int kTurns = 4;
  Vec3<S> from = polytope.corner(face, 0).point;
  Vec3<S> along = Vec3<S>::Zero();
  for (int e = 0; e < 3; ++e) {
    const Vec3<S>& corner = polytope.corner(face, e).point;
    const Vec3<S> side = polytope.corner(face, e + 1).point - corner;
    if (side.squaredNorm() > along.squaredNorm()) from = corner, along = side;
  }
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

/// Without volume, the closest point of GJK's last simplex, the origin, gives the deepest points.
template <class S>
PenetrationResult<S> flat_result(const GjkSimplex<S>& simplex, const StartSimplex<S>& start,
                                 BoundedDifference<S>& difference) {
  DifferencePoint<S> found;
  const bool faces_away = start.outward.dot(difference.between_middles()) > S(0);
  difference.bound(faces_away ? Vec3<S>(-start.outward) : start.outward, found);
  WeightedPairs<S>& weights = difference.weights();
  weights.count = 0;
  for (std::size_t i = 0; i < simplex.vertices.size(); ++i)
    weights.add({simplex.vertices[i].index_a, simplex.vertices[i].index_b}, simplex.weights[i]);
  return difference.result(PenetrationStatus::Flat, S(0), 0);
}

template <class S>
PenetrationResult<S> expand(const StartSimplex<S>& start, const PenetrationOptions<S>& options,
                            BoundedDifference<S>& difference, PenetrationSteps<S>* steps) {
  const S tolerance = difference.tolerance(options);
  const int allowed = allowed_iterations(options, kMaxEpaIterations);
  Polytope<S> polytope(start, difference.rounding());
  PenetrationStatus status = PenetrationStatus::OutOfIterations;
  int iteration = 0;
  while (iteration < allowed) {
    const int nearest = polytope.nearest_open();
    if (nearest < 0 || difference.upper() - at(polytope.faces, nearest).distance <= tolerance) {
      const bool is_certain = difference.upper() - polytope.distance() <= tolerance;
      status = is_certain ? PenetrationStatus::Converged : PenetrationStatus::Stalled;
      break;
    }
    ++iteration;
    const PolytopeFace<S> face = at(polytope.faces, nearest);
    if (steps != nullptr) record(polytope, nearest, difference, *steps);

    DifferencePoint<S> support;
    difference.bound(face.direction, support);
    if (!difference.is_finite() || difference.is_separated()) break;
    const S beyond = face.direction.dot(support.point) - face.distance;
    if (beyond <= tolerance) {
      at(polytope.faces, nearest).is_closed = true;
    } else if (polytope.has_vertex(support.pair) || !polytope.expand(nearest, support)) {
      turn_about_longest_edge(polytope, face, support, tolerance, difference);
      at(polytope.faces, nearest).is_closed = true;
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
/// Deviations. Termination: we keep both bounds of the depth, the closest face from below and the
/// best support plane from above. The result is the best support plane of all steps, which
/// separates the shapes whatever rounding has done to the polytope. Distance: that of the triangle
/// (see Polytope::measure). Horizon: a flood fill with an explicit list, checked to be one simple
/// loop before any change. A face that rounding keeps from expanding is closed after turning its
/// plane about its longest edge. So each step adds a vertex or closes a face, and the method ends.
///
/// Steps: 1. expand GJK's last simplex to a tetrahedron (blow_up()); 2. take the open face closest
/// to the origin; 3. stop if it is no closer than the best plane minus the tolerance; 4. find the
/// support point along its normal, whose plane bounds the depth; 5. if it is not beyond the face,
/// close the face, which is part of the surface; 6. otherwise replace all visible faces; go to 2.
template <class S>
PenetrationResult<S> epa(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                         PenetrationSteps<S>* steps) {
  BoundedDifference<S> difference(a, b, b_in_a);
  if (!difference.is_finite()) return {};
  if (difference.has(overlap)) {
    const StartSimplex<S> start = blow_up(*overlap, difference);
    if (!difference.is_finite()) return {};
    if (start.count == 4 &&
        holds_origin(Polytope<S>(start, difference.rounding()), difference.rounding())) {
      return expand(start, options, difference, steps);
    }
  }
  const GjkResult<S> query = gjk(a, b, b_in_a);
  if (!query.on_a.allFinite() || !query.on_b.allFinite()) return {};
  const PenetrationResult<S> separated{.status = PenetrationStatus::Separated,
                                       .normal = query.normal,
                                       .on_a = query.on_a,
                                       .on_b = query.on_b};
  if (!may_overlap(query, a, b, b_in_a)) return separated;
  const StartSimplex<S> start = blow_up(query.simplex, difference);
  if (!difference.is_finite()) return {};
  if (start.count < 4) {
    const bool is_separated = query.status == GjkStatus::Separated;
    return is_separated ? separated : flat_result(query.simplex, start, difference);
  }
  return expand(start, options, difference, steps);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(epa);

}  // namespace contactscope
