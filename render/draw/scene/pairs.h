#pragma once

#include "draw/scene/scene.h"
#include "trace/trace.h"

/// Look-ups in the pairs of a trace: points, the surfaces at a point, and one pair through the
/// frames of a sequence. A pair is identified by its bodies and its label.
namespace contactscope::draw {

/// A contact point and its manifold; both belong to the pair.
struct PairPoint {
  const trace::Manifold* manifold;
  const trace::Point* point;
};

std::vector<PairPoint> all_points(const trace::Pair& pair);

std::vector<Vec3d> positions_of(const trace::Pair& pair);

/// The kept points, as the reducer saw them if that is recorded. With several manifolds each was
/// reduced separately, and the record contains only one of them, so all points are returned.
std::vector<PairPoint> kept_points(const trace::Pair& pair);

/// Convex border of the points that a reducer kept. Fewer than three points if they have no area.
std::vector<Vec3d> kept_polygon(const trace::Reduction& reduction, const Vec3d& normal);

/// Whether a corner was kept although the side planes cut it away, because nothing else was left.
/// Its contact point is above it on the reference face.
bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped);

/// Whether the point is in the manifold only because of its margin, and the shapes do not touch
/// there.
inline bool stands_off(const trace::Point& point, const SequenceScales& scales) {
  return point.separation > scales.touching;
}

/// A point on the surface of A and one on the surface of B, world.
struct OnBoth {
  Vec3d on_a, on_b;
};

/// The two surfaces along the normal at a contact point. An overlap extends from the surface of A
/// to the surface of B, which is behind it.
OnBoth surfaces_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// The same with the scene's exaggeration: the overlap is longer by its factor. It is fixed at the
/// contact point, on one surface or midway between both.
OnBoth whisker_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// Whether the point has a visible whisker: contacts are shown, no age is marked at the point, and
/// the whisker is longer than its dot is wide and not under the impulse arrow.
bool has_whisker(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// With more manifolds, as on a mesh, marks common to all of them are drawn smaller.
inline constexpr std::size_t kFewManifolds = 2;

/// Whether two unit vectors are within 30 degrees of each other.
inline bool is_like(const Vec3d& normal, const Vec3d& other) { return normal.dot(other) > 0.866; }

/// The most common normal, over pairs with many manifolds. Pictures highlight the manifolds that
/// differ from it. Nothing if all agree, or if no normal is shared by more than half of them.
std::optional<Vec3d> usual_normal(const trace::Frame& frame);

struct PairEdge {
  bool of_a = false;
  int index = 0;

  bool operator==(const PairEdge&) const = default;
};

/// The edges in an id such as "a:e3 b:e7".
std::vector<PairEdge> edges_in(std::string_view id);

/// The first pair of a frame that satisfies a predicate; nullptr if there is none.
const trace::Pair* first_pair(const trace::Frame& frame, bool (*holds)(const trace::Pair&));

/// Pairs that satisfy a predicate in some frame. Each points to its first such frame.
std::vector<const trace::Pair*> distinct_pairs(const std::vector<trace::Frame>& frames,
                                               bool (*holds)(const trace::Pair&));

/// The pair in every frame; null where it is missing. Other engines may leave out distant pairs.
std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted);

/// The pair's label, or the names of both bodies.
std::string pair_name(const trace::Pair& pair);

/// Axis of the contact, or of the separation, of a pair in one frame. Empty if it is not recorded.
std::string axis_of(const trace::Pair& pair);

struct AxisMoment {
  const trace::Pair* pair = nullptr;  // nullptr if no axis is known
  std::string axis;
  bool switched = false;  // to another axis, or to another face or edge pair on the same one
};

/// `pairs`: the pair in each frame, nullptr where it is missing. A cache hit counts as the last
/// test's features as long as the axis is the same.
std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs);

}  // namespace contactscope::draw
