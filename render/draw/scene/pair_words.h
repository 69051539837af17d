#pragma once

#include "draw/scene/drawing.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"
#include "trace/find.h"
#include "trace/trace.h"

/// Texts of pictures for the facts of a pair: one term per concept, used everywhere.
///
/// Counts and ranks of contacts. Titles, panels and marks take them from here, so that they cannot
/// contradict each other.
///
/// Texts and colours for pairs that answer a query instead of computing a manifold.
namespace contactscope::draw {

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

/// Corners of a box or six points of a ball, for fitting the view to it.
std::vector<Vec3d> extent_points(const trace::Volume& volume);

}  // namespace contactscope::draw
