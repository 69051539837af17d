#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "study/limits_study.h"

/// The study of the numbers' limits for as many pairs as there is time for: random places on its sweeps, in float and
/// in double, each judged by the oracle and forgotten. What is kept are whole numbers, largest values and lowest
/// numbers of cases, so that parts that were run anywhere come to the same, whatever their number and order.
namespace contactscope {

/// As files name the members of ContactFault.
inline constexpr std::array<const char*, 7> kContactFaults = {
    "none", "not_finite", "missing", "phantom", "imprecise", "drifting", "drowned"};

/// Whether the pipeline said something that its own shapes and poses do not. An overlap that drowns in rounding
/// is none.
constexpr bool is_wrong(ContactFault fault) {
  return fault != ContactFault::None && fault != ContactFault::Drowned;
}

/// What the pairs of one sweep, kind and scalar came to.
struct SoakLine {
  std::string sweep;   // "tilt"
  std::string pair;    // "capsule on box"
  std::string scalar;  // "float", "double"
  std::int64_t pairs = 0;
  std::array<std::int64_t, kContactFaults.size()> faults{};  // by ContactFault
  // Of those without a fault:
  double worst_ulps = 0;                 // largest error, in ulps of the pair's coordinates
  std::int64_t worst_case = -1;          // the first that has it; -1: all are exact
  std::int64_t exact = 0;                // without any error
  std::map<int, std::int64_t> errors{};  // by exponent e: above 2^(e-1) ulps, up to 2^e

  std::int64_t wrong() const;
};

/// A wrong answer, to be looked at again.
struct SoakFailure {
  std::int64_t number = 0;  // of the case: the same seed and number give the same pair
  std::string sweep, pair, scalar, fault;
  double value = 0;  // of what the sweep drives
  double ulps = 0;   // of its error
};

struct Soak {
  std::uint64_t seed = 1;
  std::int64_t cases = 0;  // of the whole, in all parts
  std::vector<SoakLine> lines{};
  std::vector<SoakFailure> failures{};  // the first kSoakFailures, by number and scalar

  std::int64_t wrong() const;
};
inline constexpr std::size_t kSoakFailures = 20;

/// A case: number, sweep and kind in turn, at a random place between the sweep's ends.
struct SoakCase {
  const LimitSweep* sweep = nullptr;
  PairKind kind{};
  double value = 1;
  StackedPair pair;
};
SoakCase soak_case(std::uint64_t seed, std::int64_t number);

/// Judges the cases `first` up to but not including `last` of `cases`. `step` is told how many are done, now and then, and
/// may throw to stop.
Soak soak_pairs(std::uint64_t seed, std::int64_t cases, std::int64_t first, std::int64_t last,
                const std::function<void(std::int64_t done)>& step);

/// Adds what another part of the same whole came to.
void add(Soak& whole, const Soak& part);

}  // namespace contactscope
