#include "query/sat.h"
#include "query/support_set.h"

namespace contactscope {
namespace {

/// A unit direction from A to B, and B's deepest vertex along it.
template <class S> struct Sample {
  Vec3<S> direction;
  int support;
};

/// Common data of the searches along A's arcs.
template <class S> struct Search {
  const HullPair<S>& pair;
  Mat3<S> a_to_b;
  Vec3<S> normal;
  S cosine;
  S bound;  // largest so far

  Sample<S> sample(const Vec3<S>& direction) const {
    const Vec3<S> against = -(a_to_b * direction);
    return {direction, support_index(support_set(pair.b.hull), against)};
  }
};

/// Upper bound of the separation along all directions of an arc between two normals of A, with `e`,
/// a vertex of A, as support point. Stops early if the bound cannot exceed `search.bound`.
///
/// For x on the chord between the ends, the separation is min x . (b - e) / |x| over B's vertices
/// b. Without the division each vertex gives a line, and the support vertex has the lowest one.
/// With it each gives a piece of a sine, which is convex where it is negative, as |x| <= 1: nothing
/// is above the ends and the crossing of their lines (Kelley 1960, the cutting-plane method).
///
///       -.      .-     Steps: if the crossing is too high, find the support vertex there. Its line
///         `-. .-       bounds the side on which it falls, which is then done; continue with the
///            X         other side.
///
/// If a value is not negative, neither is the result.
template <class S>
S largest_between(const Search<S>& search, const Vec3<S>& e, Sample<S> left, Sample<S> right) {
  constexpr int kRounds = 8;
  S done = -std::numeric_limits<S>::infinity();  // bound of the parts outside left and right
  S bound = std::numeric_limits<S>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const Vec3<S> left_line = search.pair.b.vertices[left.support] - e;
    const Vec3<S> right_line = search.pair.b.vertices[right.support] - e;
    const S left_value = left.direction.dot(left_line);
    const S left_at_right = right.direction.dot(left_line);
    const S right_value = right.direction.dot(right_line);
    const S right_at_left = left.direction.dot(right_line);
    if (left_at_right <= left_value) return std::min(bound, std::max(done, left_value));
    if (right_at_left <= right_value) return std::min(bound, std::max(done, right_value));
    // Zero if a line goes through both ends; otherwise positive, up to rounding.
    const S above_left = std::max(right_at_left - left_value, S(0));
    const S above_right = std::max(left_at_right - right_value, S(0));
    const S above = above_left + above_right;
    const S t = above > S(0) ? above_left / above : S(0);
    const Vec3<S> offset = right.direction - left.direction;
    const Vec3<S> crossing = left.direction + t * offset;
    const S length = crossing.norm();
    const S at_crossing = (left_value + t * (left_at_right - left_value)) / length;
    const S ends = std::max(left_value, right_value);
    bound = std::min(bound, std::max(std::max(done, at_crossing), ends));
    if (bound <= search.bound) return bound;
    const Sample<S> middle = search.sample(Vec3<S>(crossing / length));
    if (middle.support == left.support || middle.support == right.support) return bound;
    const Vec3<S> middle_line = search.pair.b.vertices[middle.support] - e;
    if (offset.dot(middle_line) > S(0)) {
      done = std::max(done, left.direction.dot(middle_line));
      left = middle;
    } else {
      done = std::max(done, right.direction.dot(middle_line));
      right = middle;
    }
  }
  return bound;
}

/// Bound for the part of an arc from a far direction towards a near one that is still far.
template <class S>
S largest_far_part(const Search<S>& search, const Vec3<S>& e, const Sample<S>& far,
                   const Vec3<S>& near) {
  // Solves x . normal = cosine |x|, squared, for x = far + t (near - far). The cosine is raised by
  // more than rounding, so that no far direction is left out.
  const S cosine = search.cosine + S(32) * std::numeric_limits<S>::epsilon();
  const S at_far = far.direction.dot(search.normal);
  const S rise = near.dot(search.normal) - at_far;
  const S sag = cosine * cosine * (S(1) - near.dot(far.direction));
  const S square = rise * rise - S(2) * sag;
  const S half_linear = at_far * rise + sag;
  const S constant = at_far * at_far - cosine * cosine;
  const S root = std::sqrt(std::max(half_linear * half_linear - square * constant, S(0)));
  // The root where x . normal is rising, in the form without cancellation.
  const S t = half_linear > S(0) ? -constant / (half_linear + root) : (root - half_linear) / square;
  const Vec3<S> border = far.direction + std::clamp(t, S(0), S(1)) * (near - far.direction);
  return largest_between(search, e, far, search.sample(Vec3<S>(border / border.norm())));
}

/// Bound for an arc between two face normals, each with B's support vertex.
template <class S>
S largest_on_arc(const Search<S>& search, const Vec3<S>& e, const Sample<S>& first,
                 const Sample<S>& second) {
  const S first_cosine = first.direction.dot(search.normal);
  const S second_cosine = second.direction.dot(search.normal);
  if (first_cosine >= search.cosine) return largest_far_part(search, e, second, first.direction);
  if (second_cosine >= search.cosine) return largest_far_part(search, e, first, second.direction);
  // Both ends are far. In between, the normal's projection on the arc's plane is closest, if there.
  const S between = first.direction.dot(second.direction);
  const S along_first = first_cosine - between * second_cosine;
  const S along_second = second_cosine - between * first_cosine;
  if (along_first > S(0) && along_second > S(0)) {
    const Vec3<S> nearest = along_first * first.direction + along_second * second.direction;
    const Vec3<S> unit = nearest / nearest.norm();
    if (unit.dot(search.normal) > search.cosine)
      return std::max(largest_far_part(search, e, first, unit),
                      largest_far_part(search, e, second, unit));
  }
  return largest_between(search, e, first, second);
}

/// Bound for the faces of one hull; `sign` is -1 for B, whose normals point from B to A.
template <class S>
S largest_of_faces(const PlacedHull<S>& hull, const FaceSeparations<S>& faces,
                   const Search<S>& search, S sign) {
  S bound = search.bound;
  for (int face = 0; face < hull.normals.count(); ++face) {
    const bool near = sign * hull.normals[face].dot(search.normal) >= search.cosine;
    if (!near) bound = std::max(bound, faces.separation(face));
  }
  return bound;
}

}  // namespace

/// Steps: use the measured faces; then search each arc of A that is not entirely near. An arc is
/// near if its ends are, because the near directions are a cap smaller than a hemisphere.
template <class S>
S far_separation(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                 const FaceSeparations<S>& faces_b, const Vec3<S>& normal, S cosine, S floor,
                 S ceiling) {
  const PlacedHull<S>& a = pair.a;
  Search<S> search{pair, pair.b.rotation.transpose(), normal, cosine, floor};
  search.bound = largest_of_faces(a, faces_a, search, S(1));
  search.bound = largest_of_faces(pair.b, faces_b, search, S(-1));
  if (search.bound > ceiling) return std::numeric_limits<S>::infinity();

  for (int edge = 0; edge < 2 * a.hull.edge_count(); edge += 2) {
    const int first = a.half_edge(edge).face;
    const int second = a.half_edge(edge + 1).face;
    const Sample<S> at_first{a.normals[first], faces_a.support(first)};
    const Sample<S> at_second{a.normals[second], faces_a.support(second)};
    const bool near =
        at_first.direction.dot(normal) >= cosine && at_second.direction.dot(normal) >= cosine;
    if (near) continue;
    const S largest = largest_on_arc(search, a.origin(edge), at_first, at_second);
    if (!(largest <= std::min(ceiling, S(0)))) return std::numeric_limits<S>::infinity();
    search.bound = std::max(search.bound, largest);
  }
  return search.bound;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(far_separation);

}  // namespace contactscope
