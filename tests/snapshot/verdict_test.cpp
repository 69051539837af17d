#include "snapshot/verdict.h"

#include <gtest/gtest.h>

namespace contactscope::snapshot {
namespace {

constexpr FindingKind kKinds[] = {FindingKind::Changed,    FindingKind::New,
                                  FindingKind::Missing,    FindingKind::Orphaned,
                                  FindingKind::Unreadable, FindingKind::UnmetExpectation,
                                  FindingKind::KnownBad};

TEST(Verdict, NothingIsWrittenByDefault) {
  for (const FindingKind kind : kKinds) EXPECT_EQ(decide(kind, {}), Done::Nothing);
}

TEST(Verdict, WriteMissingWritesNothingElse) {
  const Policy policy{false, Update::Missing};
  EXPECT_EQ(decide(FindingKind::New, policy), Done::Written);
  EXPECT_EQ(decide(FindingKind::Missing, policy), Done::Written);
  for (const FindingKind kind :
       {FindingKind::Changed, FindingKind::Orphaned, FindingKind::Unreadable})
    EXPECT_EQ(decide(kind, policy), Done::Nothing);
}

TEST(Verdict, UpdateFixesEveryFile) {
  for (const Update update : {Update::Failed, Update::All}) {
    const Policy policy{false, update};
    EXPECT_EQ(decide(FindingKind::Changed, policy), Done::Updated);
    EXPECT_EQ(decide(FindingKind::Unreadable, policy), Done::Updated);
    EXPECT_EQ(decide(FindingKind::New, policy), Done::Written);
    EXPECT_EQ(decide(FindingKind::Missing, policy), Done::Written);
    EXPECT_EQ(decide(FindingKind::Orphaned, policy), Done::Removed);
  }
}

TEST(Verdict, NoUpdateFixesAnExpectationOrTakesAKnownBug) {
  const Policy policy{false, Update::All};
  EXPECT_EQ(decide(FindingKind::UnmetExpectation, policy), Done::Nothing);
  EXPECT_EQ(decide(FindingKind::KnownBad, policy), Done::Nothing);
}

TEST(Verdict, CiNeverWritesWithAnyOption) {
  for (const Update update : {Update::None, Update::Missing, Update::Failed, Update::All})
    for (const FindingKind kind : kKinds) EXPECT_EQ(decide(kind, {true, update}), Done::Nothing);
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
