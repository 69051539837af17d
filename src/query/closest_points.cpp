#include "query/closest_points.h"

#include "core/pack.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S> struct Segment {
  Segment(const Vec3<S>& start, const Vec3<S>& end)
      : from(start), to(end), along(end - start), squared_length(along.squaredNorm()) {}

  /// Computed from the nearer end, so that both ends are exact and neither is preferred.
  Vec3<S> at(S parameter) const {
    if (parameter <= S(0.5)) return from + parameter * along;
    return to - (S(1) - parameter) * along;
  }

  const Vec3<S>&from, &to;
  Vec3<S> along;
  S squared_length;
};

/// Foot of the perpendicular from `point`, as a parameter of the segment's line; 0 without a line.
template <class S> S foot(const Vec3<S>& point, const Segment<S>& segment) {
  if (!(segment.squared_length > S(0))) return S(0);
  // From the nearer end, so that the rounding of a long segment is relative to the distance.
  const Vec3<S> from_start = point - segment.from, from_end = point - segment.to;
  if (from_start.squaredNorm() <= from_end.squaredNorm())
    return from_start.dot(segment.along) / segment.squared_length;
  return S(1) + from_end.dot(segment.along) / segment.squared_length;
}

template <class S> bool is_within(S parameter) { return S(0) <= parameter && parameter <= S(1); }

/// A candidate for the closest pair of points.
template <class S> struct Candidate {
  S parameter_a, parameter_b;
  S squared_distance;
  S squared_overhang;  // square metres: from the foot of the perpendicular to the segment's end
};

/// True if the point is alongside the other segment, by more than the rounding of its foot.
template <class S>
bool is_outside(const Candidate<S>& candidate, const Segment<S>& a, const Segment<S>& b) {
  constexpr S kRounding = S(8) * std::numeric_limits<S>::epsilon();
  const S squared_scale = candidate.squared_distance + a.squared_length + b.squared_length;
  return candidate.squared_overhang <= kRounding * kRounding * squared_scale;
}

template <class S>
Candidate<S> from_point_of_a(S parameter_a, const Segment<S>& a, const Segment<S>& b) {
  const Vec3<S> point = a.at(parameter_a);
  const S foot_b = foot(point, b);
  const S parameter_b = std::clamp(foot_b, S(0), S(1));
  const Vec3<S> between = b.at(parameter_b) - point;
  const S overhang = foot_b - parameter_b;
  return {parameter_a, parameter_b, between.squaredNorm(), overhang * overhang * b.squared_length};
}

template <class S>
Candidate<S> from_point_of_b(S parameter_b, const Segment<S>& a, const Segment<S>& b) {
  const Candidate<S> mirrored = from_point_of_a(parameter_b, b, a);
  return {mirrored.parameter_b, mirrored.parameter_a, mirrored.squared_distance,
          mirrored.squared_overhang};
}

/// The four ends, A's first, each with its closest point on the other segment: all at once, and
/// bitwise equal to from_point_of_a() and from_point_of_b().
template <class S>
void from_all_ends(const Segment<S>& a, const Segment<S>& b, Candidate<S>* candidates) {
  using lanes::all;
  using lanes::Pack;
  constexpr int kLanes = lanes::kWidth<S>;
  const Segment<S>* const of_end[4] = {&a, &a, &b, &b};
  const Segment<S>* const other[4] = {&b, &b, &a, &a};
  for (int first = 0; first < 4; first += kLanes) {
    const auto each = [&](const auto& value) {
      return lanes::each<S>([&](int lane) { return value(first + lane); });
    };
    const auto end = [&](int i) -> const Vec3<S>& {
      return i % 2 == 0 ? of_end[i]->from : of_end[i]->to;
    };
    const Pack<S> squared_length = each([&](int i) { return other[i]->squared_length; });
    Pack<S> along[3], from_start[3], from_end[3], point[3], from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      point[k] = each([&](int i) { return end(i)[k]; });
      from[k] = each([&](int i) { return other[i]->from[k]; });
      to[k] = each([&](int i) { return other[i]->to[k]; });
      along[k] = each([&](int i) { return other[i]->along[k]; });
      from_start[k] = point[k] - from[k];
      from_end[k] = point[k] - to[k];
    }
    const auto dot = [](const Pack<S>(&u)[3], const Pack<S>(&v)[3]) {
      return u[0] * v[0] + (u[1] * v[1] + u[2] * v[2]);
    };
    const Pack<S> zero = {};
    const Pack<S> one = all(S(1));
    const auto start_is_nearer = dot(from_start, from_start) <= dot(from_end, from_end);
    const Pack<S> from_nearer = start_is_nearer ? dot(from_start, along) / squared_length
                                                : one + dot(from_end, along) / squared_length;
    const Pack<S> foot = squared_length > zero ? from_nearer : zero;
    const Pack<S> parameter = foot < zero ? zero : (foot > one ? one : foot);
    const auto in_first_half = parameter <= all(S(0.5));
    Pack<S> between[3];
    for (int k = 0; k < 3; ++k) {
      const Pack<S> at =
          in_first_half ? from[k] + parameter * along[k] : to[k] - (one - parameter) * along[k];
      between[k] = at - point[k];
    }
    const Pack<S> squared_distance = dot(between, between);
    const Pack<S> overhang = foot - parameter;
    const Pack<S> squared_overhang = overhang * overhang * squared_length;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = first + lane;
      const S at_end = i % 2 == 0 ? S(0) : S(1);
      candidates[i] = {i < 2 ? at_end : parameter[lane], i < 2 ? parameter[lane] : at_end,
                       squared_distance[lane], squared_overhang[lane]};
    }
  }
}

/// Midpoint of the smallest and largest parameters of candidates in any order; symmetric in both.
template <class S> struct Middle {
  bool empty() const { return low_a > high_a; }
  S a() const { return S(0.5) * (low_a + high_a); }
  S b() const { return S(0.5) * (low_b + high_b); }

  S low_a = S(2), high_a = S(-1);
  S low_b = S(2), high_b = S(-1);
};

template <class S, class Counts>
Middle<S> middle_where(std::span<const Candidate<S>> candidates, const Counts& counts) {
  Middle<S> middle;
  for (const Candidate<S>& candidate : candidates) {
    if (!counts(candidate)) continue;
    middle.low_a = std::min(middle.low_a, candidate.parameter_a);
    middle.high_a = std::max(middle.high_a, candidate.parameter_a);
    middle.low_b = std::min(middle.low_b, candidate.parameter_b);
    middle.high_b = std::max(middle.high_b, candidate.parameter_b);
  }
  return middle;
}

template <class S>
ClosestOfSegments<S> at_parameters(S parameter_a, S parameter_b, const Segment<S>& a,
                                   const Segment<S>& b) {
  const Vec3<S> on_a = a.at(parameter_a), on_b = b.at(parameter_b);
  return {on_a, on_b, parameter_a, parameter_b, Vec3<S>(on_b - on_a).norm()};
}

}  // namespace

template <class S>
ClosestOnSegment<S> closest_on_segment(const Vec3<S>& point, const Vec3<S>& from,
                                       const Vec3<S>& to) {
  const Segment<S> segment(from, to);
  const S parameter = std::clamp(foot(point, segment), S(0), S(1));
  return {segment.at(parameter), parameter};
}

/// Follows Ericson, "Real-Time Collision Detection" 2005, section 5.1.9, in trying the closest
/// points of the lines first. We use cross products instead of a determinant of dot products, where
/// cancellation acts on the square of the angle. If the points are not on the segments, we take the
/// nearest of four candidates (each end and its closest point on the other segment) instead of
/// clamping one parameter after the other. This treats A and B alike.
///
/// Steps: 1. take the lines' closest points, if well defined and on the segments; 2. for parallel
/// segments: take the middle of the stretch bounded by all ends that have a foot on the other
/// segment; 3. take the nearest of the four ends' candidates. If the lines are nearly parallel,
/// also try each line's closest point with its own foot on the other: both parameters are then
/// uncertain along the segments, but a foot is not.
template <class S>
ClosestOfSegments<S> closest_of_segments(const Vec3<S>& from_a, const Vec3<S>& to_a,
                                         const Vec3<S>& from_b, const Vec3<S>& to_b) {
  const Segment<S> a(from_a, to_a), b(from_b, to_b);
  const Vec3<S> normal = a.along.cross(b.along);
  const S squared_sine = normal.squaredNorm();  // times both squared lengths
  const S squared_lengths = a.squared_length * b.squared_length;
  const bool is_parallel = squared_sine <= kParallelSine<S> * kParallelSine<S> * squared_lengths;

  Candidate<S> candidates[6];
  int count = 0;
  if (!is_parallel) {
    const Vec3<S> offset = from_b - from_a;
    const S line_a = offset.cross(b.along).dot(normal) / squared_sine;
    const S line_b = offset.cross(a.along).dot(normal) / squared_sine;
    if (is_within(line_a) && is_within(line_b)) {
      if (squared_sine > kNoisySine<S> * kNoisySine<S> * squared_lengths)
        return at_parameters(line_a, line_b, a, b);
      candidates[count++] = from_point_of_a(line_a, a, b);
      candidates[count++] = from_point_of_b(line_b, a, b);
    }
  }
  from_all_ends(a, b, candidates + count);
  const std::span<const Candidate<S>> all(candidates, static_cast<std::size_t>(count + 4));

  if (is_parallel && squared_lengths > S(0)) {
    const Middle<S> outside = middle_where(
        all, [&](const Candidate<S>& candidate) { return is_outside(candidate, a, b); });
    if (!outside.empty()) return at_parameters(outside.a(), outside.b(), a, b);
  }
  // Candidates at the same distance meet in the middle.
  S least = std::numeric_limits<S>::infinity();
  for (const Candidate<S>& candidate : all) least = std::min(least, candidate.squared_distance);
  const Middle<S> nearest = middle_where(
      all, [&](const Candidate<S>& candidate) { return candidate.squared_distance == least; });
  return at_parameters(nearest.a(), nearest.b(), a, b);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(closest_on_segment, closest_of_segments);

}  // namespace contactscope
