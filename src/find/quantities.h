#pragma once

#include <array>
#include <vector>

#include "find/expression.h"
#include "trace/trace.h"

namespace contactscope::find {

/// A pair in a frame, and in the frame before. A pair that is not there has no contacts.
struct PairMoment {
  const trace::Pair* now = nullptr;     // never null
  const trace::Pair* before = nullptr;  // null: there is no frame before
  const trace::Frame* frame = nullptr;
  double age = kUnknown;   // frames of contact without a break; 0 in the first
  double away = kUnknown;  // frames without contact before that, or up to now
  std::array<const Pose<double>*, 2> poses{}, poses_before{};  // of a and b; null: unknown
};

struct PairQuantity : Quantity {
  Value (*of)(const PairMoment& moment) = nullptr;
};

/// All that an expression about a pair in a frame may name. The first ones follow from the pair alone.
const std::vector<PairQuantity>& pair_quantities();
inline constexpr std::size_t kOfPairAlone = 12;
Value value_of(const PairMoment& moment, const std::string& quantity);

}  // namespace contactscope::find
