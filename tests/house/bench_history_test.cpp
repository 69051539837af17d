#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace contactscope::house {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kJump = 0.15;

/// Errors in a history of ratios: lines that cannot be read, and benchmarks whose last ratio
/// differs by more than 15 % from the previous one without a note that gives the reason.
std::vector<std::string> faults_of(const std::string& history) {
  struct Last {
    double ratio = 0;
    std::string fault{};
  };
  std::vector<std::string> faults;
  std::map<std::string, Last> benchmarks;
  std::istringstream in(history);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> columns(1);
    for (const char c : line) {
      if (c == '\t') {
        columns.emplace_back();
      } else {
        columns.back() += c;
      }
    }
    const std::string place = "line " + std::to_string(number) + ": ";
    if (columns.size() != 4) {
      faults.push_back(place + "benchmark, commit, ratio and note stand between three tabs");
      continue;
    }
    const double ratio = std::strtod(columns[2].c_str(), nullptr);
    if (!(ratio > 0) || !std::isfinite(ratio)) {
      faults.push_back(place + "'" + columns[2] + "' is no ratio");
      continue;
    }
    Last& last = benchmarks[columns[0]];
    const double change = last.ratio > 0 ? ratio / last.ratio - 1 : 0;
    last = {ratio};
    // The file's digits leave an uncertainty of a thousandth.
    if ((change > kJump + 1e-3 || change < 1 / (1 + kJump) - 1 - 1e-3) && columns[3].empty())
      last.fault = place + columns[0] + " is " + columns[2] + " at " + columns[1] + ", " +
                   std::to_string(std::lround(100 * change)) +
                   " % off the row before; mend it, or say in the last column why that is right";
  }
  for (const auto& [name, last] : benchmarks)
    if (!last.fault.empty()) faults.push_back(last.fault);
  return faults;
}

TEST(BenchHistory, RatiosDoNotJumpWithoutAReason) {
  std::ifstream file(std::string(CONTACTSCOPE_SOURCE_DIR) + "/tests/bench/history.tsv");
  const std::string history(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(history, HasSubstr("\nreduction by optimal over area, 32 points\t"))
      << "written by the target bench_history";
  EXPECT_THAT(faults_of(history), IsEmpty());
}

TEST(BenchHistory, JumpsAreSeenUpAndDown) {
  EXPECT_THAT(faults_of("a\t1\t2.0\t\na\t2\t2.29\t\nb\t1\t1\t\nb\t2\t0.88\t\n"), IsEmpty());
  EXPECT_THAT(faults_of("# why\n\na\t1\t2.0\t\na\t2\t2.4\t\nb\t2\t1\t\n"),
              ElementsAre(HasSubstr("line 4: a is 2.4 at 2, 20 % off the row before")));
  EXPECT_THAT(faults_of("a\t1\t2\t\na\t2\t1\t\n"), ElementsAre(HasSubstr("-50 % off")));
  EXPECT_THAT(faults_of("a\t1\t2\t\na\t2\t1\tby a new kernel\n"), IsEmpty());
  // Only the last two rows of each are compared: earlier ones have passed.
  EXPECT_THAT(faults_of("a\t1\t2\t\na\t2\t9\t\na\t3\t9\t\n"), IsEmpty());
  EXPECT_THAT(faults_of("a\t1\t2\t\nb\t2\t9\t\na\t3\t9\t\n"),
              ElementsAre(HasSubstr("line 3: a is 9 at 3")));
}

TEST(BenchHistory, UnreadableLinesAreReported) {
  EXPECT_THAT(faults_of("a\t1\n"), ElementsAre(HasSubstr("line 1: benchmark, commit")));
  EXPECT_THAT(faults_of("a\t1\tfast\t\na\t1\t0\t\na\t1\tinf\t\n"),
              ElementsAre(HasSubstr("'fast' is no ratio"), HasSubstr("'0' is no ratio"),
                          HasSubstr("'inf' is no ratio")));
}

}  // namespace
}  // namespace contactscope::house
