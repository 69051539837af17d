#include "snapshot/verdict.h"

#include <gtest/gtest.h>

#include <ostream>

namespace contactscope::snapshot {

std::ostream& operator<<(std::ostream& out, Verdict verdict) {
  return out << to_string(verdict);
}

namespace {

void expect(Finding finding, Policy policy, Verdict verdict, Action action, bool fails) {
  const Decision decision = decide(finding, policy);
  EXPECT_EQ(decision.verdict, verdict);
  EXPECT_EQ(decision.action, action) << decision.verdict;
  EXPECT_EQ(decision.fails, fails) << decision.verdict;
}

TEST(Verdict, WithoutUpdateOnlyWhatIsMissingIsWrittenAndStillFails) {
  const Policy local{false, Update::None};
  expect(Finding::Same, local, Verdict::Same, Action::Keep, false);
  expect(Finding::Different, local, Verdict::Different, Action::Keep, true);
  expect(Finding::Missing, local, Verdict::Written, Action::Write, true);
  expect(Finding::Stale, local, Verdict::Stale, Action::Keep, true);
}

TEST(Verdict, UpdateRewritesOnlyWhatFailed) {
  const Policy update{false, Update::Failed};
  expect(Finding::Same, update, Verdict::Same, Action::Keep, false);
  expect(Finding::Different, update, Verdict::Updated, Action::Write, false);
  expect(Finding::Missing, update, Verdict::Written, Action::Write, false);
  expect(Finding::Stale, update, Verdict::Removed, Action::Remove, false);
}

TEST(Verdict, UpdateAllRewritesEverything) {
  const Policy all{false, Update::All};
  expect(Finding::Same, all, Verdict::Updated, Action::Write, false);
  expect(Finding::Different, all, Verdict::Updated, Action::Write, false);
  expect(Finding::Missing, all, Verdict::Written, Action::Write, false);
  expect(Finding::Stale, all, Verdict::Removed, Action::Remove, false);
}

TEST(Verdict, CiNeverWritesWhateverIsAsked) {
  for (const Update update : {Update::None, Update::Failed, Update::All}) {
    const Policy ci{true, update};
    expect(Finding::Same, ci, Verdict::Same, Action::Keep, false);
    expect(Finding::Different, ci, Verdict::Different, Action::Keep, true);
    expect(Finding::Missing, ci, Verdict::Missing, Action::Keep, true);
    expect(Finding::Stale, ci, Verdict::Stale, Action::Keep, true);
  }
}

TEST(Verdict, CiIsReadFromItsVariable) {
  EXPECT_TRUE(is_ci("true"));
  EXPECT_TRUE(is_ci("1"));
  EXPECT_FALSE(is_ci("false"));
  EXPECT_FALSE(is_ci("0"));
  EXPECT_FALSE(is_ci(""));
  EXPECT_FALSE(is_ci(nullptr));
}

}  // namespace
}  // namespace contactscope::snapshot
