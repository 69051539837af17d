#pragma once

#include "query/gjk.h"

namespace contactscope {

/// Largest power of two up to `value`, a finite normal number > 0. Fast: clears only the mantissa.
template <class S> S power_of_two_up_to(S value) {
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits kMantissa = (Bits(1) << (std::numeric_limits<S>::digits - 1)) - 1;
  return std::bit_cast<S>(std::bit_cast<Bits>(value) & ~kMantissa);
}

/// A point of the Minkowski difference, as indices of the points that it is the difference of.
struct IndexPair {
  int a, b;
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
};

/// The Minkowski difference B - A, in A's frame, scaled by a power of two to order 1, so that no
/// power of a length leaves the range of S. It contains the origin in overlap. Refers to both sets.
template <class S> class MinkowskiDifference {
 public:
  MinkowskiDifference(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a)
      : a_(a), b_(b), rotation_(b_in_a.rotation.toRotationMatrix()), position_(b_in_a.position) {
    const S length = reach_of(a) + reach_of(b) + position_.norm();
    if (length >= std::numeric_limits<S>::min()) {
      unit_ = power_of_two_up_to(length);
      per_unit_ = S(1) / unit_;
      scale_ = length * per_unit_;
    }
  }

  /// Length scale, from 1 to 2, in units.
  S scale() const { return scale_; }
  /// Length of a unit in metres.
  S unit() const { return unit_; }

  GjkVertex<S> vertex(const IndexPair& pair) const {
    return {pair.a, pair.b, a_.points[pair.a], b_in_frame_of_a(pair)};
  }
  /// In units.
  Vec3<S> point(const IndexPair& pair) const {
    return per_unit_ * (b_in_frame_of_a(pair) - a_.points[pair.a]);
  }
  /// The vertex of the difference farthest against `direction`.
  IndexPair support_against(const Vec3<S>& direction) const {
    const Vec3<S> in_b = -(rotation_.transpose() * direction);
    return {support_index(a_, direction), support_index(b_, in_b)};
  }

  /// From the centre of A to that of B, any length > 0.
  Vec3<S> between_middles() const {
    const Vec3<S> between = rotation_ * middle_of(b_) + position_ - middle_of(a_);
    return between.squaredNorm() > S(0) ? between : Vec3<S>(Vec3<S>::UnitX());
  }
  /// True if `simplex`, from an earlier call, fits these sets; false for null.
  bool has(const GjkSimplex<S>* simplex) const {
    return simplex != nullptr && !simplex->vertices.empty() &&
           std::ranges::all_of(simplex->vertices, [this](const GjkVertex<S>& vertex) {
             return vertex.index_a >= 0 && vertex.index_a < a_.count && vertex.index_b >= 0 &&
                    vertex.index_b < b_.count;
           });
  }
  /// Simplex of the first `count` pairs, with their weights.
  GjkSimplex<S> simplex(const std::array<IndexPair, 4>& pairs, const std::array<S, 4>& weights,
                        int count) const {
    GjkSimplex<S> result;
    result.weights = {};
    for (int i = 0; i < count; ++i) {
      result.vertices.push_back(vertex(at(pairs, i)));
      at(result.weights, i) = at(weights, i);
    }
    return result;
  }

 private:
  Vec3<S> b_in_frame_of_a(const IndexPair& pair) const {
    return rotation_ * b_.points[pair.b] + position_;
  }

  const SupportSet<S>& a_;
  const SupportSet<S>& b_;
  Mat3<S> rotation_;
  Vec3<S> position_;
  S scale_ = 1, unit_ = 1, per_unit_ = 1;
};

/// Weighted mean of a simplex's points on one shape, relative to the heaviest vertex: rounding of
/// the weights multiplies differences of vertices, not their distance from the origin.
template <class S> Vec3<S> weighted(const GjkSimplex<S>& simplex, Vec3<S> GjkVertex<S>::*point) {
  std::size_t heaviest = 0;
  for (std::size_t i = 1; i < simplex.vertices.size(); ++i)
    if (simplex.weights[i] > simplex.weights[heaviest]) heaviest = i;
  const Vec3<S>& base = simplex.vertices[heaviest].*point;
  Vec3<S> aside = Vec3<S>::Zero();
  for (std::size_t i = 0; i < simplex.vertices.size(); ++i)
    if (i != heaviest) aside += simplex.weights[i] * (simplex.vertices[i].*point - base);
  return base + aside;
}

}  // namespace contactscope
