#include "study/soak.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "core/spell.h"

namespace contactscope {
namespace {

constexpr const char* kScalars[] = {"float", "double"};

/// An empty line for each sweep, kind and scalar, in this order.
std::vector<SoakLine> empty_lines() {
  std::map<std::string, std::int64_t> faults;
  for (std::size_t i = 1; i < kContactFaults.size(); ++i) faults[kContactFaults[i]] = 0;
  std::vector<SoakLine> lines;
  for (const LimitSweep& sweep : limit_sweeps())
    for (const PairKind& kind : sweep.kinds)
      for (const char* scalar : kScalars)
        lines.push_back({sweep.name, to_string(kind), scalar, 0, faults});
  return lines;
}

/// Index of the "float" line; "double" follows.
std::size_t line_of(const SoakCase& one) {
  std::size_t line = 0;
  for (const LimitSweep& sweep : limit_sweeps()) {
    if (&sweep == one.sweep) break;
    line += std::size(kScalars) * sweep.kinds.size();
  }
  const auto is_kind = [&](const PairKind& kind) {
    return kind.top == one.kind.top && kind.below == one.kind.below;
  };
  const auto kind = std::ranges::find_if(one.sweep->kinds, is_kind);
  return line + std::size(kScalars) * static_cast<std::size_t>(kind - one.sweep->kinds.begin());
}

/// 64 bits hashed from a number, like splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9E3779B97F4A7C15u;
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9u;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBu;
  return number ^ (number >> 31);
}

void keep_worst(SoakLine& line, double ulps, std::int64_t number) {
  const bool is_first = ulps == line.worst_ulps && number < line.worst_case;
  if (number < 0 || (ulps <= line.worst_ulps && !is_first)) return;
  line.worst_ulps = ulps;
  line.worst_case = number;
}

void count(SoakLine& line, const PairVerdict& verdict, std::int64_t number) {
  ++line.pairs;
  if (verdict.fault != ContactFault::None) {
    ++line.faults[kContactFaults[static_cast<std::size_t>(verdict.fault)]];
    return;
  }
  if (verdict.ulps == 0) {
    ++line.exact;
    return;
  }
  int exponent = 0;
  if (std::frexp(verdict.ulps, &exponent) == 0.5)
    --exponent;  // a power of two is the end of its bin
  ++line.errors[exponent];
  keep_worst(line, verdict.ulps, number);
}

void keep_first(std::vector<SoakFailure>& failures) {
  std::ranges::sort(failures, {}, [](const SoakFailure& failure) {
    return std::pair(failure.number, failure.scalar);
  });
  if (failures.size() > kSoakFailures) failures.resize(kSoakFailures);
}

/// Sums over all kinds of pairs for each sweep and scalar.
std::vector<SoakLine> by_sweep(const Soak& soak) {
  std::vector<SoakLine> sums;
  for (const SoakLine& line : soak.lines) {
    const auto is_same = [&](const SoakLine& sum) {
      return sum.sweep == line.sweep && sum.scalar == line.scalar;
    };
    const auto sum = std::ranges::find_if(sums, is_same);
    if (sum == sums.end())
      sums.push_back(line);
    else
      sum->add(line);
  }
  std::ranges::stable_sort(sums, {}, &SoakLine::scalar);
  return sums;
}

/// Bound in ulps, a power of two, on the errors of this share of the pairs without a fault.
std::string within(const SoakLine& line, double share) {
  std::int64_t all = line.exact, seen = line.exact;
  for (const auto& [exponent, count] : line.errors) all += count;
  const double wanted = share * static_cast<double>(all);
  if (static_cast<double>(seen) >= wanted) return all == 0 ? "-" : "0";
  for (const auto& [exponent, count] : line.errors) {
    seen += count;
    if (static_cast<double>(seen) >= wanted) return printed("%g", std::ldexp(1.0, exponent));
  }
  return "-";
}

}  // namespace

std::int64_t SoakLine::wrong() const {
  std::int64_t sum = 0;
  for (const auto& [fault, count] : faults) sum += fault == "drowned" ? 0 : count;
  return sum;
}

std::int64_t Soak::wrong() const {
  std::int64_t sum = 0;
  for (const SoakLine& line : lines) sum += line.wrong();
  return sum;
}

SoakCase soak_case(std::uint64_t seed, std::int64_t number) {
  const auto sweeps = static_cast<std::int64_t>(limit_sweeps().size());
  SoakCase one;
  one.sweep = &limit_sweeps()[static_cast<std::size_t>(number % sweeps)];
  const auto kinds = static_cast<std::int64_t>(one.sweep->kinds.size());
  one.kind = one.sweep->kinds[static_cast<std::size_t>(number / sweeps % kinds)];
  const std::uint64_t bits = scrambled(seed ^ scrambled(static_cast<std::uint64_t>(number)));
  const double share = std::ldexp(static_cast<double>(bits >> 11), -53);
  one.value = one.sweep->low * std::pow(one.sweep->high / one.sweep->low, share);
  // Even and odd cases differ, so they are numbered within a sweep and kind.
  const auto index = static_cast<int>(number / (sweeps * kinds));
  one.pair = limit_case(*one.sweep, one.value, one.kind, index, seed);
  return one;
}

Soak soak_pairs(std::uint64_t seed, std::int64_t first, std::int64_t last) {
  Soak soak{empty_lines()};
  for (std::int64_t number = first; number < last; ++number) {
    const SoakCase one = soak_case(seed, number);
    const PairVerdict verdicts[] = {judge_pair<float>(one.pair), judge_pair<double>(one.pair)};
    const std::size_t line = line_of(one);
    for (std::size_t scalar = 0; scalar < std::size(kScalars); ++scalar) {
      const PairVerdict& verdict = verdicts[scalar];
      count(soak.lines[line + scalar], verdict, number);
      if (!is_wrong(verdict.fault) || soak.failures.size() >= kSoakFailures) continue;
      soak.failures.push_back({number, one.sweep->name, to_string(one.kind), kScalars[scalar],
                               kContactFaults[static_cast<std::size_t>(verdict.fault)], one.value,
                               verdict.ulps});
    }
  }
  keep_first(soak.failures);
  return soak;
}

void SoakLine::add(const SoakLine& more) {
  pairs += more.pairs;
  exact += more.exact;
  for (const auto& [fault, count] : more.faults) faults[fault] += count;
  for (const auto& [exponent, number] : more.errors) errors[exponent] += number;
  keep_worst(*this, more.worst_ulps, more.worst_case);
}

void add(Soak& whole, const Soak& part) {
  for (std::size_t i = 0; i < whole.lines.size() && i < part.lines.size(); ++i)
    whole.lines[i].add(part.lines[i]);
  whole.failures.insert(whole.failures.end(), part.failures.begin(), part.failures.end());
  keep_first(whole.failures);
}

bool report(const Soak& soak, std::ostream& out) {
  const auto row = [&](const std::string& sweep, const std::vector<std::string>& cells) {
    out << std::left << std::setw(10) << sweep << std::right;
    for (const std::string& cell : cells) out << std::setw(13) << cell;
    out << '\n';
  };
  row("sweep", {"scalar", "pairs", "wrong", "drowned", "half within", "99.9% within",
                "worst (ulps)", "worst case"});
  std::int64_t pairs = 0;
  for (const SoakLine& line : by_sweep(soak)) {
    pairs += line.pairs;
    row(line.sweep,
        {line.scalar, std::to_string(line.pairs), std::to_string(line.wrong()),
         std::to_string(line.faults.at("drowned")), within(line, 0.5), within(line, 0.999),
         printed("%.3g", line.worst_ulps), std::to_string(line.worst_case)});
  }
  for (const SoakFailure& failure : soak.failures)
    out << "case " << failure.number << ": " << failure.pair << " in " << failure.scalar << ", "
        << failure.sweep << " " << printed("%.3g", failure.value) << ": " << failure.fault
        << ", off by " << printed("%.3g", failure.ulps) << " ulps\n";
  out << pairs << " pairs judged, " << soak.wrong() << " wrong\n";
  return soak.wrong() == 0;
}

}  // namespace contactscope
