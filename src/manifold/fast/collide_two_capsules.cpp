#include "manifold/fast/fast_pairs.h"

#include "manifold/round_contact.h"
#include "query/fast/packed_vectors.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

using namespace boxes;

/// A capsule's axis between its ends, in A's frame.
template <class S> struct Axis {
  Three<S> ends[2];
  Three<S> along = ends[1] - ends[0];
};

/// Products of the axes and of the offset between their first ends, square metres.
template <class S> struct Products {
  [[gnu::always_inline]] Products(const Axis<S>& a, const Axis<S>& b) {
    const Three<S> offset = a.ends[0] - b.ends[0];
    const Three<S> a_offset = a.along * offset, b_offset = b.along * offset;
    squares =
        Coordinates<S>(a.along * a.along, b.along * b.along, a.along * b.along, offset * offset)
            .sums();
    projections = Coordinates<S>(a_offset, b_offset, a_offset, b_offset).sums();
  }

  Three<S> squares;      // a a, b b, a b, offset offset
  Three<S> projections;  // a offset, b offset
};

/// The nearest ends of two axes, or the nearest end of one and the other axis.
struct Nearest {
  enum Kind { TwoEnds, EndAndAxis, Uncertain } kind = Uncertain;
  int which = 0;               // the corner or the side, see nearest()
  bool beyond_middle = false;  // the foot is in the second half of the axis
};

/// The squared distance of the points at s of A and t of B is convex; the products give its slopes.
///
///     t = 1  c2--s3--c3      Two ends: a corner is the minimum if both slopes lead upwards from
///            s0      s1      it into the square. An end and its foot on the other axis: a side has
///     t = 0  c0--s2--c1      the minimum between its corners, and the other slope leads upwards
///         s = 0      s = 1   from there. Otherwise the minimum is inside.
///
/// closest_of_segments() takes the least of measured distances. It certainly finds the same minimum
/// if the slopes exceed rounding and no corner is within rounding of the foot.
template <class S> [[gnu::always_inline]] inline Nearest nearest(const Products<S>& products) {
  constexpr S kUnsure = S(2048) * std::numeric_limits<S>::epsilon();
  const Three<S>& squares = products.squares;
  const Three<S> aa = spread<0>(squares), bb = spread<1>(squares), ab = spread<2>(squares);
  const Three<S> a_offset = spread<0>(products.projections),
                 b_offset = spread<1>(products.projections);
  const Three<S> unsure = kUnsure * (aa + bb + spread<3>(squares));
  constexpr Three<S> kS = {0, 1, 0, 1}, kT = {0, 0, 1, 1};
  constexpr Three<S> kInS = S(1) - S(2) * kS, kInT = S(1) - S(2) * kT;
  const Three<S> inwards_s = (a_offset * kInS - aa * kS) - ab * (kT * kInS);
  const Three<S> inwards_t = (bb * -kT - b_offset * kInT) - ab * (kS * kInT);
  const std::uint32_t corners = lane_bits<S>(lanes::smaller(inwards_s, inwards_t) > unsure);
  if (corners != 0) return {Nearest::TwoEnds, std::countr_zero(corners), false};

  // s = 0, s = 1, t = 0, t = 1.
  const Three<S> lengths = __builtin_shufflevector(squares, squares, 1, 1, 0, 0);
  const Three<S> projections = __builtin_shufflevector(b_offset, -a_offset, 0, 0, 4, 4);
  const Three<S> foot = (projections + ab * kS) / lengths;
  const Three<S> to_end = lanes::smaller(foot, S(1) - foot);
  const Three<S> begins = __builtin_shufflevector(a_offset, -b_offset, 0, 0, 4, 4);
  const Three<S> far = __builtin_shufflevector(squares, squares, 0, 0, 1, 1);
  const Three<S> inwards = ((begins + far * kS) - foot * ab) * kInS;
  // At this distance from the foot, squared distances exceed the foot's by more than rounding.
  const auto is_between = to_end * absolute<S>(to_end) * lengths > unsure * S(1.0 / 16);
  const std::uint32_t sides = lane_bits<S>((inwards > unsure) & is_between);
  if (sides == 0) return {};
  // Near the middle it is uncertain from which end closest_of_segments() measures the foot.
  const Three<S> from_middle = (foot - S(0.5)) * lengths;
  const std::uint32_t unclear = lane_bits<S>(absolute<S>(from_middle) <= unsure);
  if ((sides & unclear) != 0) return {};
  return {Nearest::EndAndAxis, std::countr_zero(sides), (sides & lane_bits<S>(foot > S(0.5))) != 0};
}

/// The point of an axis nearest to `point`, measured from the axis's nearer end, as in
/// from_all_ends() and Segment::at() of closest_points.cpp.
template <class S>
[[gnu::always_inline]] inline Three<S> foot_on(const Axis<S>& axis, const Three<S>& point,
                                               S squared_length, bool beyond_middle) {
  const Three<S> end = axis.ends[beyond_middle ? 1 : 0];
  const Three<S> along = (point - end) * axis.along;
  const S offset = (along[0] + (along[1] + along[2])) / squared_length;
  // From the second end: the parameter 1 + offset is rounded before it is subtracted from 1.
  return end + (beyond_middle ? -(S(1) - (S(1) + offset)) : offset) * axis.along;
}

/// Indices: the first end of an axis, the second, the axis.
constexpr int kOnAxis = 2;
constexpr std::array<std::array<FeatureRef, 3>, 2> kFeatures = {
    {{vertex_ref(Owner::A, 0), vertex_ref(Owner::A, 1), edge_ref(Owner::A, 0)},
     {vertex_ref(Owner::B, 0), vertex_ref(Owner::B, 1), edge_ref(Owner::B, 0)}}};

/// In processing order.
template <class S>
[[gnu::always_inline]] inline bool collide_in_order(const Capsule<S>& a, const Pose<S>& pose_a,
                                                    const Capsule<S>& b, const Pose<S>& pose_b,
                                                    bool swapped, const CollideOptions& options,
                                                    Manifolds<S>& manifolds) {
  // Pose of B in A, as in relative_pose().
  const Turn<S> to_a{four_of<S, 0>(pose_a.rotation) * Three<S>{-1, -1, -1, 1}};
  const Quat<S> turn = pose_a.rotation.conjugate() * pose_b.rotation;
  const Turn<S> b_to_a{four_of<S, 0>(turn)};
  const auto position = [](const Pose<S>& pose) __attribute__((always_inline)) {
    const Three<S> last = four_of<S, 3>(pose);
    return __builtin_shufflevector(last, last, 1, 2, 3, 0);
  };
  const Three<S> position_a = position(pose_a);
  const Three<S> offset = to_a.of(position(pose_b) - position_a);
  const Three<S> own_ends_b[2] = {four_of<S, 0>(b), four_of<S, 3>(b)};
  const Axis<S> axes[2] = {
      {{four_of<S, 0>(a), four_of<S, 3>(a)}},
      {{b_to_a.of(own_ends_b[0]) + offset, b_to_a.of(own_ends_b[1]) + offset}}};

  // Upper bound of the coordinates, in either frame.
  const S scale = largest_of<S>(lanes::larger(
      lanes::larger(lanes::larger(absolute<S>(axes[0].ends[0]), absolute<S>(axes[0].ends[1])),
                    lanes::larger(absolute<S>(axes[1].ends[0]), absolute<S>(axes[1].ends[1]))),
      lanes::larger(absolute<S>(own_ends_b[0]), absolute<S>(own_ends_b[1]))));
  const Products<S> products(axes[0], axes[1]);
  // Nearly parallel axes make two points: those with a squared sine below 0.01. The rest of 0.011
  // allows for the axis of B being turned by the rounding of its placed ends.
  const S rounding = S(8192) * std::numeric_limits<S>::epsilon() * scale;
  const S aa = products.squares[0], bb = products.squares[1], ab = products.squares[2];
  if (!(ab * ab < S(0.989) * (aa * bb) && bb > rounding * rounding)) return false;
  const Nearest found = nearest(products);
  if (found.kind == Nearest::Uncertain) return false;

  // For A and B: the closest points and their features.
  const int end = found.which & 1, owner = found.which >> 1;
  Three<S> on[2] = {axes[0].ends[end], axes[1].ends[owner]};
  int feature[2] = {end, owner};
  if (found.kind == Nearest::EndAndAxis) {
    on[owner] = axes[owner].ends[end];
    on[1 - owner] =
        foot_on<S>(axes[1 - owner], on[owner], owner == 0 ? bb : aa, found.beyond_middle);
    feature[owner] = end;
    feature[1 - owner] = kOnAxis;
  }
  const Three<S> between = on[1] - on[0];
  const S distance = std::sqrt(sum_of<S>(between * between));
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return true;
  if (!(distance > clip_thickness(scale))) return false;
  if constexpr (std::is_same_v<S, float>) {
    // As in belongs_in_double().
    if (!(tie_tolerance(scale + std::max(a.radius, b.radius)) <=
          preference_tolerance(S(0), std::min(a.radius, b.radius))))
      return false;
  }

  // As normal_between() in collide_capsule_capsule.cpp.
  Three<S> normal = between / distance;
  if (found.kind == Nearest::EndAndAxis) {
    const Three<S> own_along_b = own_ends_b[1] - own_ends_b[0];
    const Three<S> alongs[2] = {axes[0].along, b_to_a.of(own_along_b)};
    const S squared_lengths[2] = {aa, sum_of<S>(own_along_b * own_along_b)};
    const Three<S> unit = alongs[1 - owner] / std::sqrt(squared_lengths[1 - owner]);
    const Three<S> across = between - sum_of<S>(between * unit) * unit;
    normal = across / std::sqrt(sum_of<S>(across * across));
  }
  const Three<S> middle = S(0.5) * ((on[0] + a.radius * normal) + (on[1] - b.radius * normal));
  // As in ToWorld.
  const TurnMatrix<S> to_world(pose_a.rotation);
  const Three<S> direction = to_world.of(normal), point = to_world.of(middle) + position_a;
  // Zero times a finite number is zero; times any other it is NaN.
  if (!all<S>(S(0) * direction + S(0) * point == S(0))) return false;

  Manifold<S>& manifold = manifolds.emplace_back();
  manifold.normal = vector<S>(direction * (swapped ? S(-1) : S(1)));
  manifold.axis = AxisKind::ClosestPoints;
  manifold.type = found.kind == Nearest::TwoEnds ? ContactType::PointPoint : ContactType::PointEdge;
  manifold.points.push_back({vector<S>(point), separation, {}});
  manifold.points[0].id.first = at(kFeatures[0], feature[swapped ? 1 : 0]);
  manifold.points[0].id.second = at(kFeatures[1], feature[swapped ? 0 : 1]);
  return true;
}

}  // namespace

template <class S>
bool collide_two_capsules(const Capsule<S>& a, const Pose<S>& pose_a, const Capsule<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          Manifolds<S>& manifolds) {
  manifolds.clear();
  const bool swapped = against_order(a, pose_a, b, pose_b, options.b_first);
  return collide_in_order(swapped ? b : a, swapped ? pose_b : pose_a, swapped ? a : b,
                          swapped ? pose_a : pose_b, swapped, options, manifolds);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_two_capsules);

}  // namespace contactscope
