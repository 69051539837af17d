#pragma once

#include <string>
#include <string_view>

#include "draw/scene/quantity.h"
#include "trace/trace.h"

/// What pictures call what a trace tells of a pair: one word for a thing, wherever it is said.
namespace contactscope::draw {

/// How two shapes stand to each other. A trace's `state` says whether there are contact points;
/// this tells the cases apart in which that and the geometry differ.
enum class PairState {
  Apart,         // a gap, and no points
  WithinMargin,  // points, and a gap: a margin made them
  Touching,      // points, and an overlap or none
  Skipped,  // an overlap, and no points: geometry had no normal, and the pair was to be skipped
};

/// `touching`: metres; a gap up to that counts as none, as SequenceScales has it.
PairState state_of(const trace::Pair& pair, double touching);
/// "touching", "within the margin", "apart", "overlap, contact skipped".
std::string spell_state(PairState state);

/// "gap" or "overlap", of a separation with its sign.
const char* gap_or_overlap(double separation);
/// "gap 3.00 mm", "overlap 450 mm": never a sign. `noise` as in spell_length().
std::string spell_separation(double separation, double noise, const LengthUnit& unit = {});

/// "face of A", "edges of A and B", "closest points", of an axis as traces name it.
std::string spell_axis(const std::string& axis);
/// "edge on face", of features as traces name them: "edge-face"; of others as it stands.
std::string spell_features(const std::string& type);

/// "time of impact" of "time_of_impact", "GJK" of "gjk": what a trace calls a method, for people.
std::string in_words(std::string_view code);

/// Whether a body can rest on a manifold. A margin of less than 5 % of the support is marginal: the
/// next push may turn the body.
enum class Balance { Stable, Marginal, Unstable, NoContact };
Balance balance_of(const trace::Stability& stability);
/// "stable", "marginal", "unstable", "no contact".
std::string spell_balance(Balance balance);

}  // namespace contactscope::draw
