#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "study/limits_study.h"

/// The study of numerical limits for as many pairs as time allows: random positions on its sweeps,
/// in float and double, each tested by the oracle and not stored. Results are integers, maxima and
/// smallest case numbers, so that any split into parts adds up to the same result.
namespace contactscope {

/// Names of ContactFault.
inline constexpr std::array<const char*, 7> kContactFaults = {
    "none", "not_finite", "missing", "phantom", "imprecise", "drifting", "drowned"};

/// Whether the pipeline's result contradicts its own shapes and poses. An overlap within rounding
/// does not count.
constexpr bool is_wrong(ContactFault fault) {
  return fault != ContactFault::None && fault != ContactFault::Drowned;
}

/// Results for the pairs of one sweep, kind and scalar.
struct SoakLine {
  std::string sweep;   // "tilt"
  std::string pair;    // "capsule on box"
  std::string scalar;  // "float", "double"
  std::int64_t pairs = 0;
  std::map<std::string, std::int64_t> faults{};  // by name
  // Without faults:
  double worst_ulps = 0;                 // largest error, in ulps of the pair's coordinates
  std::int64_t worst_case = -1;          // the first with that error; -1: all are exact
  std::int64_t exact = 0;                // without any error
  std::map<int, std::int64_t> errors{};  // by exponent e: above 2^(e-1) ulps, up to 2^e

  std::int64_t wrong() const;
  void add(const SoakLine& more);
};

/// A wrong result, to be examined later.
struct SoakFailure {
  std::int64_t number = 0;  // case number: the same seed and number give the same pair
  std::string sweep, pair, scalar, fault;
  double value = 0;  // of the sweep's parameter
  double ulps = 0;   // its error
};

struct Soak {
  std::vector<SoakLine> lines{};
  std::vector<SoakFailure> failures{};  // the first kSoakFailures, by number and scalar

  std::int64_t wrong() const;
};
inline constexpr std::size_t kSoakFailures = 20;

/// A case: its number selects sweep and kind in turn, at a random position of the sweep.
struct SoakCase {
  const LimitSweep* sweep = nullptr;
  PairKind kind{};
  double value = 1;
  StackedPair pair;
};
SoakCase soak_case(std::uint64_t seed, std::int64_t number);

/// Tests the cases from `first` up to but excluding `last`.
Soak soak_pairs(std::uint64_t seed, std::int64_t first, std::int64_t last);

/// Adds the results of another part.
void add(Soak& whole, const Soak& part);

/// Prints a table of the sweeps, each wrong result, and the sum. Returns whether none is wrong.
bool report(const Soak& soak, std::ostream& out);

}  // namespace contactscope
