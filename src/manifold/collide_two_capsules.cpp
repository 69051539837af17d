#include "manifold/collide_two_capsules.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "manifold/contact.h"
#include "manifold/round_order.h"
#include "query/packed_vectors.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

using boxes::absolute;
using boxes::Coordinates;
using boxes::four_of;
using boxes::lane_bits;
using boxes::largest_of;
using boxes::spread;
using boxes::sum_of;
using boxes::Three;
using boxes::Turn;
using boxes::TurnMatrix;

/// A capsule's axis between its ends, in A's frame.
template <class S>
struct Axis {
  /// As Segment::at() of closest_points.cpp has it.
  [[gnu::always_inline]] Three<S> at(S parameter) const {
    if (parameter <= S(0.5)) return ends[0] + parameter * along;
    return ends[1] - (S(1) - parameter) * along;
  }

  Three<S> ends[2];
  Three<S> along = ends[1] - ends[0];
};

/// The products of the axes and of the way between their beginnings, square metres.
template <class S>
struct Products {
  [[gnu::always_inline]] Products(const Axis<S>& a, const Axis<S>& b) {
    const Three<S> way = a.ends[0] - b.ends[0];
    const Three<S> a_way = a.along * way, b_way = b.along * way;
    squares =
        Coordinates<S>(a.along * a.along, b.along * b.along, a.along * b.along, way * way).sums();
    ways = Coordinates<S>(a_way, b_way, a_way, b_way).sums();
  }

  Three<S> squares;  // a a, b b, a b, way way
  Three<S> ways;     // a way, b way
};

/// Which ends of two axes, or which end of one and the other axis, are nearest.
struct Nearest {
  enum Kind { TwoEnds, EndAndAxis, Uncertain } kind = Uncertain;
  int which = 0;  // the corner or the side, see nearest()
};

/// The squared distance between the points at s of A and t of B is a convex function over a square, and its
/// slopes along s and t follow from the products.
///
///     t = 1  c2--s3--c3      Where both slopes lead upwards into the square from a corner, the corner is the
///            s0      s1      minimum: two ends. Where the minimum of a side is between its corners, and the
///     t = 0  c0--s2--c1      other slope leads upwards from there: an end and its foot on the other axis.
///         s = 0      s = 1   Else the minimum is inside.
///
/// closest_of_segments() measures distances and takes the least. It is certain to find the same where the
/// slopes are more than rounding, and a foot is farther from the corners than what rounding hides.
template <class S>
[[gnu::always_inline]] inline Nearest nearest(const Products<S>& products) {
  constexpr S kUnsure = S(4096) * std::numeric_limits<S>::epsilon();
  const Three<S> aa = spread<0>(products.squares), bb = spread<1>(products.squares);
  const Three<S> ab = spread<2>(products.squares);
  const Three<S> a_way = spread<0>(products.ways), b_way = spread<1>(products.ways);
  const Three<S> unsure = kUnsure * (aa + bb + spread<3>(products.squares));
  constexpr Three<S> kS = {0, 1, 0, 1}, kT = {0, 0, 1, 1};
  const Three<S> along_s = (a_way + aa * kS) - ab * kT, along_t = (bb * kT - b_way) - ab * kS;
  const Three<S> inwards_s = along_s * (S(1) - S(2) * kS);
  const Three<S> inwards_t = along_t * (S(1) - S(2) * kT);
  const std::uint32_t corners = lane_bits<S>(lanes::smaller(inwards_s, inwards_t) > unsure);
  if (corners != 0) return {Nearest::TwoEnds, std::countr_zero(corners)};

  // s = 0, s = 1, t = 0, t = 1.
  const Three<S> lengths = __builtin_shufflevector(products.squares, products.squares, 1, 1, 0, 0);
  const Three<S> ways = __builtin_shufflevector(b_way, -a_way, 0, 0, 4, 4);
  const Three<S> foot = (ways + ab * kS) / lengths;
  const Three<S> to_end = lanes::smaller(foot, S(1) - foot);
  const Three<S> begins = __builtin_shufflevector(a_way, -b_way, 0, 0, 4, 4);
  const Three<S> far = __builtin_shufflevector(products.squares, products.squares, 0, 0, 1, 1);
  const Three<S> inwards = ((begins + far * kS) - foot * ab) * (S(1) - S(2) * kS);
  // So far from the foot squared distances are more than rounding larger.
  const auto is_between = to_end * absolute<S>(to_end) * lengths > unsure * S(1.0 / 16);
  const std::uint32_t sides = lane_bits<S>((inwards > unsure) & is_between);
  if (sides != 0) return {Nearest::EndAndAxis, std::countr_zero(sides)};
  return {};
}

/// The parameter of the point of `axis` that is nearest to `point`: as from_all_ends() of
/// closest_points.cpp finds it. `squared_length` is the axis'.
template <class S>
[[gnu::always_inline]] inline S foot_on(const Axis<S>& axis, const Three<S>& point,
                                        S squared_length) {
  const Three<S> from_start = point - axis.ends[0], from_end = point - axis.ends[1];
  const Coordinates<S> products(from_start * from_start, from_end * from_end,
                                from_start * axis.along, from_end * axis.along);
  const Three<S> dots = products.x + (products.y + products.z);
  return dots[0] <= dots[1] ? dots[2] / squared_length : S(1) + dots[3] / squared_length;
}

/// By number: the first end of an axis, the second, the axis.
constexpr std::array<std::array<FeatureRef, 3>, 2> kFeatures = {
    {{vertex_ref(Owner::A, 0), vertex_ref(Owner::A, 1), edge_ref(Owner::A, 0)},
     {vertex_ref(Owner::B, 0), vertex_ref(Owner::B, 1), edge_ref(Owner::B, 0)}}};

/// In the order in which the pair is worked on.
template <class S>
[[gnu::always_inline]] inline bool collide_in_order(const Capsule<S>& a, const Pose<S>& pose_a,
                                                    const Capsule<S>& b, const Pose<S>& pose_b,
                                                    bool traded, const CollideOptions& options,
                                                    Manifolds<S>& manifolds) {
  // Where B is, seen from A: as relative_pose().
  const Turn<S> to_a{four_of<S, 0>(pose_a.rotation) * Three<S>{-1, -1, -1, 1}};
  const Quat<S> turn = pose_a.rotation.conjugate() * pose_b.rotation;
  const Turn<S> b_to_a{four_of<S, 0>(turn)};
  const auto position = [](const Pose<S>& pose) __attribute__((always_inline)) {
    const Three<S> last = four_of<S, 3>(pose);
    return __builtin_shufflevector(last, last, 1, 2, 3, 0);
  };
  const Three<S> position_a = position(pose_a);
  const Three<S> way = to_a.of(position(pose_b) - position_a);
  const Three<S> own_ends_b[2] = {four_of<S, 0>(b), four_of<S, 3>(b)};
  const Axis<S> axis_a{{four_of<S, 0>(a), four_of<S, 3>(a)}};
  const Axis<S> axis_b{{b_to_a.of(own_ends_b[0]) + way, b_to_a.of(own_ends_b[1]) + way}};

  // No coordinate is larger, in either frame.
  const S scale = largest_of<S>(lanes::larger(
      lanes::larger(lanes::larger(absolute<S>(axis_a.ends[0]), absolute<S>(axis_a.ends[1])),
                    lanes::larger(absolute<S>(axis_b.ends[0]), absolute<S>(axis_b.ends[1]))),
      lanes::larger(absolute<S>(own_ends_b[0]), absolute<S>(own_ends_b[1]))));
  const Products<S> products(axis_a, axis_b);
  const S aa = products.squares[0], bb = products.squares[1], ab = products.squares[2];
  // Nearly parallel axes make two points. The squared sine would have to be less than 0.01; what the
  // placed ends of B may be off by turns its axis by less than the rest.
  const S rounding = S(8192) * std::numeric_limits<S>::epsilon() * scale;
  if (!(ab * ab < S(0.98) * (aa * bb) && bb > rounding * rounding)) return false;
  const Nearest found = nearest(products);
  if (found.kind == Nearest::Uncertain) return false;

  constexpr int kOnAxis = 2;
  const bool two_ends = found.kind == Nearest::TwoEnds;
  int feature_a = found.which & 1, feature_b = two_ends ? found.which >> 1 : found.which & 1;
  Three<S> on_a = axis_a.ends[feature_a], on_b = axis_b.ends[feature_b];
  if (!two_ends) {
    if (found.which < 2) {
      on_b = axis_b.at(foot_on(axis_b, on_a, bb));
      feature_b = kOnAxis;
    } else {
      on_a = axis_a.at(foot_on(axis_a, on_b, aa));
      feature_a = kOnAxis;
    }
  }
  const Three<S> between = on_b - on_a;
  const S distance = std::sqrt(sum_of<S>(between * between));
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return true;
  if (!(distance > clip_thickness(scale))) return false;
  if constexpr (std::is_same_v<S, float>) {
    // As belongs_in_double().
    if (!(tie_tolerance(scale + std::max(a.radius, b.radius)) <=
          preference_tolerance(S(0), std::min(a.radius, b.radius))))
      return false;
  }

  // normal_between() of collide_capsule_capsule.cpp.
  Three<S> normal = between / distance;
  if (!two_ends) {
    const Three<S> own_along_b = own_ends_b[1] - own_ends_b[0];
    const Three<S> unit =
        feature_a == kOnAxis
            ? axis_a.along / std::sqrt(aa)
            : b_to_a.of(own_along_b) / std::sqrt(sum_of<S>(own_along_b * own_along_b));
    const Three<S> across = between - sum_of<S>(between * unit) * unit;
    normal = across / std::sqrt(sum_of<S>(across * across));
  }
  const Three<S> middle = S(0.5) * ((on_a + a.radius * normal) + (on_b - b.radius * normal));
  // As ToWorld.
  const TurnMatrix<S> to_world(pose_a.rotation);
  const Three<S> direction = to_world.of(normal), point = to_world.of(middle) + position_a;
  // Zero times anything finite is zero.
  if (!boxes::all<S>(S(0) * direction + S(0) * point == S(0))) return false;

  Manifold<S>& manifold = manifolds.emplace_back();
  manifold.normal = boxes::vector<S>(traded ? -direction : direction);
  manifold.axis = AxisKind::ClosestPoints;
  manifold.type = two_ends ? ContactType::PointPoint : ContactType::PointEdge;
  if (traded) std::swap(feature_a, feature_b);
  manifold.points.push_back({boxes::vector<S>(point), separation, {}});
  manifold.points[0].id.first = at(kFeatures[0], feature_a);
  manifold.points[0].id.second = at(kFeatures[1], feature_b);
  return true;
}

}  // namespace

template <class S>
bool collide_two_capsules(const Capsule<S>& a, const Pose<S>& pose_a, const Capsule<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          Manifolds<S>& manifolds) {
  manifolds.clear();
  const bool traded = against_order(a, pose_a, b, pose_b, options.b_first);
  return collide_in_order(traded ? b : a, traded ? pose_b : pose_a, traded ? a : b,
                          traded ? pose_a : pose_b, traded, options, manifolds);
}

template decltype(collide_two_capsules<float>) collide_two_capsules<float>;
template decltype(collide_two_capsules<double>) collide_two_capsules<double>;

}  // namespace contactscope
