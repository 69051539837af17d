#include "snapshot/verdict.h"

#include <gtest/gtest.h>

namespace contactscope::snapshot {
namespace {

void expect(Finding finding, Policy policy, Verdict verdict, bool fails) {
  const Decision decision = decide(finding, policy);
  EXPECT_EQ(decision.verdict, verdict);
  EXPECT_EQ(decision.fails, fails) << static_cast<int>(decision.verdict);
}

TEST(Verdict, WithoutUpdateOnlyWhatIsMissingIsWrittenAndStillFails) {
  const Policy local{false, Update::None};
  expect(Finding::Same, local, Verdict::Same, false);
  expect(Finding::Different, local, Verdict::Different, true);
  expect(Finding::Missing, local, Verdict::Written, true);
  expect(Finding::Stale, local, Verdict::Stale, true);
}

TEST(Verdict, UpdateRewritesOnlyWhatFailed) {
  const Policy update{false, Update::Failed};
  expect(Finding::Same, update, Verdict::Same, false);
  expect(Finding::Different, update, Verdict::Updated, false);
  expect(Finding::Missing, update, Verdict::Written, false);
  expect(Finding::Stale, update, Verdict::Removed, false);
}

TEST(Verdict, UpdateAllRewritesEverything) {
  const Policy all{false, Update::All};
  expect(Finding::Same, all, Verdict::Updated, false);
  expect(Finding::Different, all, Verdict::Updated, false);
  expect(Finding::Missing, all, Verdict::Written, false);
  expect(Finding::Stale, all, Verdict::Removed, false);
}

TEST(Verdict, CiNeverWritesWhateverIsAsked) {
  for (const Update update : {Update::None, Update::Failed, Update::All}) {
    const Policy ci{true, update};
    expect(Finding::Same, ci, Verdict::Same, false);
    expect(Finding::Different, ci, Verdict::Different, true);
    expect(Finding::Missing, ci, Verdict::Missing, true);
    expect(Finding::Stale, ci, Verdict::Stale, true);
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
