#pragma once

#include "draw/scene/scene.h"
#include "trace/find.h"

/// Look-ups in the pairs of a trace: points, the surfaces at a point, and one pair through the
/// frames of a sequence. A pair is identified by its bodies and its label.
namespace contactscope::draw {

/// A contact point and its manifold; both belong to the pair.
struct PairPoint {
  const trace::Manifold* manifold;
  const trace::Point* point;
};

std::vector<PairPoint> all_points(const trace::Pair& pair);
/// The clipping that made the pair's only manifold. Null for a manifold of several triangles, since
/// a record has the clipping of one.
const trace::Clip* own_clip(const trace::Pair& pair);

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

struct PairFeature {
  bool of_a = false;
  int index = 0;
  char kind = 'e';  // or 'v', 'f'

  bool operator==(const PairFeature&) const = default;
};

/// The features in an id such as "a:v0 b:e7".
std::vector<PairFeature> features_in(std::string_view id);

/// The edges among them.
std::vector<PairFeature> edges_in(std::string_view id);

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

// pair_words.cpp: texts for the facts of a pair, one term per concept. Titles, panels and marks take
// counts and ranks from here as well, so that they cannot contradict each other.

/// Contact state of a pair. A trace's `state` records whether there are contact points. This enum
/// adds the cases in which points and geometry disagree.
enum class PairState {
  Separation,    // a gap, no points
  WithinMargin,  // points and a gap, because of a margin
  Touching,      // points, and an overlap or no gap
  Skipped,       // an overlap, no points: the geometry had no normal, and such pairs are skipped
};

/// `touching`: metres; a smaller gap counts as none, as in SequenceScales.
PairState state_of(const trace::Pair& pair, double touching);
/// "touching", "within the margin", "apart", "overlap, contact skipped".
std::string spell_state(PairState state);

/// "gap" or "overlap", by the sign of a separation.
const char* gap_or_overlap(double separation);
/// "gap 3.00 mm", "overlap 450 mm": without a sign. `noise` as in spell_length().
std::string spell_separation(double separation, double noise, const LengthUnit& unit = {});

/// "face of A", "edges of A and B", "closest points", for an axis as named in traces.
std::string spell_axis(const std::string& axis);
/// "edge on face" for "edge-face", a feature type of traces; other types are not changed.
std::string spell_features(const std::string& type);

/// "time of impact" for "time_of_impact", "GJK" for "gjk": readable name of a method in traces.
std::string in_words(std::string_view code);

/// Whether a body can rest on a manifold. A margin of less than 5 % of the support's size is
/// marginal: the next push may tip the body.
enum class Balance { Stable, Marginal, Unstable, NoContact };
Balance balance_of(const trace::Stability& stability);
/// "stable", "marginal", "unstable", "no contact".
std::string spell_balance(Balance balance);

/// Separation of a pair, metres, negative for an overlap; nothing if it is unknown.
std::optional<double> separation_of(const trace::Pair& pair);

/// The deepest point of a pair, with its manifold; nothing without points.
std::optional<PairPoint> deepest_contact(const trace::Pair& pair);

/// Radius of the smaller body, metres; infinite if both are unknown.
double smaller_radius(const trace::Pair& pair, const ShapeMeshes& meshes);

/// Totals of a frame.
struct ContactCounts {
  std::size_t pairs = 0, manifolds = 0, points = 0;  // those with contact points
};
ContactCounts count_contacts(const trace::Frame& frame);

/// Whether a frame has so many contacts that marks at each would hide the bodies.
bool is_heap(const trace::Frame& frame);

/// Quantities by which pairs are ranked.
enum class Rank {
  Overlap,  // metres
  Worst,    // overlap as a share of the smaller body's radius
  Impulse,  // newton seconds
  Change,   // metres between the overlaps of this frame and the previous one
};

struct RankedPair {
  const trace::Pair* pair = nullptr;
  double value = 0;  // > 0
};

/// The first `most` pairs by a quantity, largest first. `before`: the previous frame, for Change.
std::vector<RankedPair> ranked_pairs(const trace::Frame& frame, Rank by, std::size_t most,
                                     const ShapeMeshes& meshes,
                                     const trace::Frame* before = nullptr);

enum class AnswerKind {
  No,
  Yes,
  FalsePositive,  // bounds overlap, shapes do not
  Missed,         // shapes overlap, bounds do not
};

constexpr bool is_wrong(AnswerKind kind) {
  return kind == AnswerKind::FalsePositive || kind == AnswerKind::Missed;
}

/// Answer of a pair with a query: do the shapes, or their bounds, overlap or touch?
AnswerKind answer_kind(const trace::Pair& pair);

/// One colour for each answer, used in all drawings.
Color answer_color(AnswerKind kind);

/// "do the oriented boxes overlap, touching included?"
std::string spell_question(const trace::Query& query);

/// "yes, though the shapes are 12.0 cm apart: a false positive"
std::string spell_answer(const trace::Pair& pair, const LengthUnit& unit = {});

/// "yes", "no, falsely".
std::string spell_answer_kind(AnswerKind kind);

/// Label of a pair with a query of bounds, followed by the answer: "spheres: yes, falsely".
std::string label_with_answer(const trace::Pair& pair);

/// "A's y", "A's x × B's z", "middle to middle". For axis-aligned boxes "x", an axis of the world.
std::string spell_axis(const trace::Query& query, const trace::TestedAxis& axis);

/// Adds a frame to the history of two shapes.
void add_frame(const trace::Frame& frame, const std::string& a, const std::string& b,
               PairHistory& history);

/// Corners of a box or six points of a ball, for fitting the view to it.
std::vector<Vec3d> extent_points(const trace::Volume& volume);

}  // namespace contactscope::draw
