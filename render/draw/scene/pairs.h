#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/scene/scene.h"
#include "trace/trace.h"

/// What drawings look up in the pairs of a trace: their points, where the surfaces are there, and one
/// pair through the frames of a sequence, which is the same bodies under the same label.
namespace contactscope::draw {

/// A point with the manifold that it is of, both of the pair.
struct PairPoint {
  const trace::Manifold* manifold;
  const trace::Point* point;
};

/// The points of all manifolds.
std::vector<PairPoint> all_points(const trace::Pair& pair);

std::vector<Vec3d> positions_of(const trace::Pair& pair);

/// Those of them that were kept, as the reducer saw them where it is recorded: of several manifolds
/// each was reduced by itself, and the record holds one of these.
std::vector<PairPoint> kept_points(const trace::Pair& pair);

/// A corner that the side planes cut away and that was kept all the same, because nothing else was
/// left: the contact point is above it on the reference face.
bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped);

/// The point is in the manifold although the shapes do not touch there, because they are within its
/// margin.
inline bool stands_off(const trace::Point& point, const SequenceScales& scales) {
  return point.separation > scales.touching;
}

/// A place on the surface of A and one on that of B, world.
struct OnBoth {
  Vec3d on_a, on_b;
};

/// Where along the normal the two surfaces are at a contact point: an overlap from the surface of A
/// to that of B, which is behind it.
OnBoth surfaces_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// The same with the scene's scale: the overlap is so many times as long, and begins at the surface on
/// which the point lies, or in the middle of both.
OnBoth whisker_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// Whether a whisker is seen of the point: where contacts are shown, of a point that has no age beside it, longer than its
/// dot is wide, and not under the arrow of its impulse.
bool has_whisker(const Scene& scene, const trace::Pair& pair, const PairPoint& at);

/// Manifolds of a pair. With more, as on a mesh, what they have in common is drawn smaller.
inline constexpr std::size_t kFewManifolds = 2;

/// Within 30 degrees of each other; both unit.
inline bool is_like(const Vec3d& normal, const Vec3d& other) {
  return normal.dot(other) > 0.866;
}

/// The normal that most manifolds of pairs with many have, where some of them have another: these are
/// what a picture is to show. Nothing where all agree, or no half of them does.
std::optional<Vec3d> usual_normal(const trace::Frame& frame);

/// An edge of A or of B.
struct PairEdge {
  bool of_a = false;
  int index = 0;

  bool operator==(const PairEdge&) const = default;
};

/// Those that an id such as "a:e3 b:e7" names.
std::vector<PairEdge> edges_in(std::string_view id);

/// The first of a frame's pairs for which that holds; nullptr where there is none.
const trace::Pair* first_pair(const trace::Frame& frame, bool (*holds)(const trace::Pair&));

/// The pairs for which that holds in some frame, at the first one of each.
std::vector<const trace::Pair*> distinct_pairs(const std::vector<trace::Frame>& frames,
                                               bool (*holds)(const trace::Pair&));

/// The pair in every frame; null where a frame has none. Traces of other engines may leave out
/// pairs that are far apart.
std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted);

/// What a picture calls the pair: its label, or the names of both.
std::string pair_name(const trace::Pair& pair);

/// The axis that made the contact of a pair in one frame, or kept it apart. Empty where nothing
/// says.
std::string axis_of(const trace::Pair& pair);

struct AxisMoment {
  const trace::Pair* pair = nullptr;  // nullptr where no axis is known
  std::string axis;
  bool switched = false;  // to another axis, or to another face or pair of edges on the same one
};

/// `pairs`: the pair in each frame, nullptr where a frame has none. What a cache answers with is what
/// the last test chose, as long as it is on the same axis.
std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs);

}  // namespace contactscope::draw
