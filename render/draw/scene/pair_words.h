#pragma once

#include <string>
#include <string_view>

#include "draw/scene/quantity.h"
#include "trace/trace.h"

/// Texts of pictures for the facts of a pair: one term per concept, used everywhere.
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

}  // namespace contactscope::draw
