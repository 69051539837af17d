#include "study/soak.h"

#include <gmock/gmock.h>

#include <set>
#include <sstream>

namespace contactscope {
namespace {

constexpr std::uint64_t kSeed = 3;
constexpr std::int64_t kCases = 600;

Soak part(std::int64_t first, std::int64_t last) { return soak_pairs(kSeed, first, last); }

void expect_same(const Soak& one, const Soak& other) {
  ASSERT_EQ(one.lines.size(), other.lines.size());
  for (std::size_t i = 0; i < one.lines.size(); ++i) {
    const SoakLine &a = one.lines[i], &b = other.lines[i];
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.faults, b.faults);
    EXPECT_EQ(a.worst_ulps, b.worst_ulps);
    EXPECT_EQ(a.worst_case, b.worst_case) << a.sweep << ", " << a.pair;
    EXPECT_EQ(a.exact, b.exact);
    EXPECT_EQ(a.errors, b.errors);
  }
  ASSERT_EQ(one.failures.size(), other.failures.size());
  for (std::size_t i = 0; i < one.failures.size(); ++i)
    EXPECT_EQ(one.failures[i].number, other.failures[i].number);
}

TEST(Soak, PartsComeToTheWholeInAnyNumberAndOrder) {
  const Soak whole = part(0, kCases);
  for (const std::vector<std::int64_t>& ends :
       {std::vector<std::int64_t>{0, 300, 600}, {0, 1, 100, 101, 420, 600}}) {
    Soak sum = part(ends[ends.size() - 2], ends.back());
    for (std::size_t i = 0; i + 2 < ends.size(); ++i) add(sum, part(ends[i], ends[i + 1]));
    expect_same(sum, whole);
  }
}

TEST(Soak, EveryCaseIsCountedOnceInEachScalar) {
  const Soak soak = part(0, kCases);
  std::int64_t pairs = 0;
  for (const SoakLine& line : soak.lines) {
    pairs += line.pairs;
    std::int64_t placed = line.exact;
    for (const auto& [exponent, count] : line.errors) placed += count;
    for (const auto& [fault, count] : line.faults) placed += count;
    EXPECT_EQ(placed, line.pairs) << "each has a fault, or a place among the errors";
    if (line.errors.empty()) continue;
    const int last = line.errors.rbegin()->first;
    EXPECT_LE(line.worst_ulps, std::ldexp(1.0, last));
    EXPECT_GT(line.worst_ulps, std::ldexp(0.5, last));
  }
  EXPECT_EQ(pairs, 2 * kCases);
  EXPECT_EQ(soak.wrong(), 0);
}

TEST(Soak, ACaseIsFoundAgainByItsNumber) {
  const Soak soak = part(0, kCases);
  for (const SoakLine& line : soak.lines) {
    if (line.worst_case < 0 || line.scalar != "float") continue;
    const SoakCase one = soak_case(kSeed, line.worst_case);
    EXPECT_EQ(one.sweep->name, line.sweep);
    EXPECT_EQ(to_string(one.kind), line.pair);
    EXPECT_EQ(judge_pair<float>(one.pair).ulps, line.worst_ulps);
  }
}

// The only two wrong cases in a hundred million: the end of one capsule and a point near an end of
// the other are closest, but by so little that squared distances in float are equal to those of
// both ends. The normal must still be perpendicular to the axis.
TEST(Soak, APointNearAnEndTiltsTheNormalByRoundingOnly) {
  for (const std::int64_t number : {37'586'174, 63'044'941}) {
    const PairVerdict verdict = judge_pair<float>(soak_case(1, number).pair);
    EXPECT_EQ(verdict.fault, ContactFault::None) << number;
    EXPECT_LT(verdict.ulps, 4) << number;
  }
}

// A thousandth of `soak 100000000`.
TEST(Soak, SlowAHundredThousandCasesHaveNoWrongAnswer) {
  constexpr std::int64_t kThousandth = 100'000;
  const Soak soak = soak_pairs(1, 0, kThousandth);
  EXPECT_EQ(soak.wrong(), 0);
  EXPECT_THAT(soak.failures, testing::IsEmpty());
}

TEST(Soak, PlacesCoverTheSweeps) {
  std::map<std::string, std::set<int>> decades;
  for (std::int64_t number = 0; number < 3000; ++number) {
    const SoakCase one = soak_case(kSeed, number);
    EXPECT_GE(one.value, one.sweep->low);
    EXPECT_LE(one.value, one.sweep->high * (1 + 1e-12));
    decades[one.sweep->name].insert(static_cast<int>(std::floor(std::log10(one.value))));
  }
  for (const LimitSweep& sweep : limit_sweeps())
    EXPECT_GE(static_cast<double>(decades[sweep.name].size()),
              std::floor(std::log10(sweep.high / sweep.low)))
        << sweep.name;
}

TEST(Soak, TheFirstWrongAnswersAreKeptWhicheverPartsTheyAreIn) {
  Soak whole, late;
  for (int i = 0; i < 30; ++i) {
    whole.failures.push_back({100 + i, "tilt", "box on box", "float", "missing"});
    late.failures.push_back({i, "tilt", "box on box", "float", "missing"});
  }
  add(whole, late);
  ASSERT_EQ(whole.failures.size(), kSoakFailures);
  EXPECT_EQ(whole.failures.front().number, 0);
  EXPECT_EQ(whole.failures.back().number, static_cast<int>(kSoakFailures) - 1);
}

TEST(Soak, TheReportNamesAWrongAnswerAndItsCase) {
  Soak soak = part(0, kCases);
  std::ostringstream right, wrong;
  EXPECT_TRUE(report(soak, right));
  EXPECT_THAT(right.str(), testing::EndsWith("\n1200 pairs judged, 0 wrong\n"));
  soak.lines.front().faults["missing"] = 1;
  soak.failures.push_back({42, "tilt", "box on box", "float", "missing", 0.5, 99});
  EXPECT_FALSE(report(soak, wrong));
  EXPECT_THAT(wrong.str(), testing::EndsWith(
                               "\ncase 42: box on box in float, tilt 0.5: missing, off by 99 ulps\n"
                               "1200 pairs judged, 1 wrong\n"));
}

}  // namespace
}  // namespace contactscope
