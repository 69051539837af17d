#pragma once

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

/// Types of the shapes of a pair, in order: an engine has a function for each two.
using Types = std::pair<std::string, std::string>;
inline Types types_of(const Solids& solids, const std::string& a, const std::string& b) {
  const auto [first, second] = std::minmax(solids.type_of(a), solids.type_of(b));
  return {first, second};
}
/// "box-sphere", as the kind of a pair.
inline std::string in_words(const Types& types) { return types.first + "-" + types.second; }

/// Overlaps of a millimetre are within the tolerance whatever is reported. But if all are reported
/// as half, that is a mistake, of all pairs or of those of two types.
class SmallDepths {
 public:
  void add(const Types& types, const trace::Pair& pair, const Verdict& verdict) {
    for (std::size_t i = 0; i < verdict.separations.size(); ++i) {
      const double is = verdict.separations[i], said = is - verdict.deeper[i];
      constexpr double kSmallest = 0.05;  // relative to the tolerance; smaller ones are noise
      if (!(is < -kSmallest * verdict.tolerance)) continue;
      for (Counts* const counts : {&all_, &of_[types]}) {
        ++counts->count;
        if (counts->pairs.size() < kPairs) counts->pairs.emplace(pair.a, pair.b);
        for (std::size_t f = 0; f < std::size(kFactors); ++f)
          counts->by[f] += std::abs(said - kFactors[f] * is) <= 0.03 * std::abs(is);
      }
    }
  }

  void report(std::vector<Finding>& findings) const {
    if (report(all_, "", findings)) return;
    for (const auto& [types, counts] : of_)
      // A pair at rest repeats what may be chance.
      if (counts.pairs.size() >= kPairs)
        report(counts, ", in pairs of kind " + in_words(types), findings);
  }

  /// Whether most small overlaps of pairs of these types do not have the sign or factor of a reading.
  template <class AllTypes> bool refute(const Reading& reading, const AllTypes& types) const {
    const double factor = (reading.separations_negated ? -1 : 1) / reading.separation_scale;
    const auto* const known = std::ranges::find(kFactors, factor);
    if (known == std::end(kFactors)) return false;
    int count = 0, by = 0;
    for (const Types& one : types)
      if (const auto found = of_.find(one); found != of_.end())
        count += found->second.count, by += found->second.by[known - std::begin(kFactors)];
    return count >= kEnough && 2 * by < count;
  }

 private:
  static constexpr double kFactors[] = {-1, 0.5, 2};
  static constexpr int kEnough = 8;
  static constexpr std::size_t kPairs = 3;

  struct Counts {
    int count = 0;
    int by[std::size(kFactors)] = {};
    std::set<std::pair<std::string, std::string>> pairs{};  // some of them
  };

  static bool report(const Counts& counts, const std::string& where,
                     std::vector<Finding>& findings) {
    constexpr const char* kNames[] = {"positive_depths", "half_depths", "double_depths"};
    bool any = false;
    for (std::size_t f = 0; f < std::size(kFactors) && counts.count >= kEnough; ++f) {
      if (counts.by[f] < 0.9 * counts.count) continue;
      const auto mistake = std::ranges::find(mistakes(), std::string(kNames[f]), &Mistake::name);
      findings.push_back(
          {mistake->name, mistake->what + where, mistake->remedy, counts.by[f], counts.count});
      any = true;
    }
    return any;
  }

  Counts all_;
  std::map<Types, Counts> of_;
};

}  // namespace contactscope::lint
