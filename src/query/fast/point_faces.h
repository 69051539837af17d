#pragma once

#include "geometry/lanes.h"
#include "query/fast/lane_search.h"
#include "query/hull_feature.h"

namespace contactscope {

/// The largest of `count` values; `count` is a multiple of the lane width.
template <class S> inline S largest_in_lanes(const S* values, int count) {
  lanes::Pack<S> best = lanes::all(-std::numeric_limits<S>::infinity());
  for (int i = 0; i < count; i += lanes::kWidth<S>)
    best = lanes::larger(lanes::load(values + i), best);
  return lanes::largest<S>(best)[0];
}

/// Calls visit(first + i) for each set bit i with first + i < count, in order.
template <class Visit>
inline void for_each_bit(std::uint32_t bits, int first, int count, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) {
    const int i = first + std::countr_zero(bits);
    if (i < count) visit(i);
  }
}

/// Calls visit(i) for each of `count` values that is not less than `least`, in order. Values must
/// be padded to the lane width; the padding is ignored.
template <class S, class Visit>
inline void for_each_not_below(const S* values, int count, S least, const Visit& visit) {
  constexpr int kLanes = lanes::kWidth<S>;
  const lanes::Pack<S> bound = lanes::all(least);
  for (int i = 0; i < count; i += kLanes) {
    const std::uint32_t below = lanes::bits<S>(lanes::load(values + i) < bound);
    for_each_bit(~below & ((1U << kLanes) - 1), i, count, visit);
  }
}

/// Calls visit(i) for each of `count` values that has all of `bits`, in order. Values must be
/// padded to the lane width; the padding is ignored.
template <class Visit>
inline void for_each_with_bits(const int* values, int count, int bits, const Visit& visit) {
  using Ints = lanes::Flags<float>;
  const Ints wanted = {bits, bits, bits, bits};
  for (int i = 0; i < count; i += 4) {
    Ints four;
    std::memcpy(&four, values + i, sizeof four);
    for_each_bit(lanes::bits<float>((four & wanted) == wanted), i, count, visit);
  }
}

/// Whether two face normals are so nearly parallel that a tie hardly affects the normal.
template <class S> bool face_the_same_direction(const Hull<S>& hull, int one, int other, S sine) {
  const Vec3<S>&n = at(hull.planes, one).normal, &m = at(hull.planes, other).normal;
  return n.dot(m) > S(0) && n.cross(m).squaredNorm() <= sine * sine;
}

/// Signed distances of a point from all face planes of a hull, hull's frame, metres (Gregorius
/// 2015, "Sphere vs Hull: Deep Penetration").
template <class S> class PointFaces {
 public:
  PointFaces(const Hull<S>& hull, const Vec3<S>& point)
      : hull_(hull), point_(point), distances_(padded(hull.face_count())) {
    using lanes::load;
    using lanes::Pack;
    const VectorLanes<S> normals(hull.lanes.normals.data(), hull.face_count());
    const S* const offsets = hull.lanes.offsets.data();
    const Pack<S> x = lanes::all(point.x()), y = lanes::all(point.y()), z = lanes::all(point.z());
    Pack<S> largest = lanes::all(-std::numeric_limits<S>::infinity());
    for (int f = 0; f < normals.padded_count(); f += lanes::kWidth<S>) {
      const Pack<S> distance =
          ((load(normals.x() + f) * x + load(normals.y() + f) * y) + load(normals.z() + f) * z) -
          load(offsets + f);
      lanes::store<S>(distance, distances_.data() + f);
      largest = lanes::larger(distance, largest);  // padding planes are behind every point
    }
    largest_ = lanes::largest<S>(largest)[0];
  }

  S operator[](int face) const { return distances_[face]; }
  /// Largest distance. Negative: the point is inside, at this depth.
  S largest() const { return largest_; }

  /// The first face whose distance is within `tie` (metres, >= 0) of the largest; among several,
  /// the first that the point projects into.
  int nearest(S tie) const {
    const int count = hull_.face_count();
    const lanes::Pack<S> least = lanes::all(largest_ - tie);
    const auto is_near = [&](const lanes::Pack<S>& distance) { return ~(distance < least); };
    const Hits near = hits(distances_.data(), padded(count), is_near);
    if (near.is_single || near.first < 0) return std::max(near.first, 0);
    int below = -1;
    for_each_not_below(distances_.data(), count, largest_ - tie, [&](int face) {
      if (below < 0 && projects_into(hull_, face, point_, tie)) below = face;
    });
    return below < 0 ? near.first : below;
  }

  /// True if a face within `tie` of the largest deviates from `face` by more than `sine`: rounding
  /// then chooses the nearest face, and the choice affects the normal.
  bool is_tied(int face, S tie, S sine) const {
    for (int other = 0; other < hull_.face_count(); ++other) {
      if (other == face || distances_[other] < largest_ - tie) continue;
      if (!face_the_same_direction(hull_, face, other, sine)) return true;
    }
    return false;
  }

 private:
  const Hull<S>& hull_;
  Vec3<S> point_;
  S largest_;
  Scratch<S, 128> distances_;
};

}  // namespace contactscope
