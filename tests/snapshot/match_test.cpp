#include <gmock/gmock.h>

#include "snapshot/compare_facts.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(Match, EqualKeysBelongTogetherWhereverTheyStand) {
  const Match match = match_keys({"a", "b", "c"}, {"b", "c", "d"});
  EXPECT_THAT(match.both, ElementsAre(Pair(1, 0), Pair(2, 1)));
  EXPECT_THAT(match.gone, ElementsAre(0));
  EXPECT_THAT(match.added, ElementsAre(2));
  EXPECT_FALSE(match.reordered());
}

TEST(Match, AnotherOrderIsSeen) { EXPECT_TRUE(match_keys({"a", "b"}, {"b", "a"}).reordered()); }

TEST(Match, RepeatedKeysGoInOrder) {
  const Match match = match_keys({"a", "a", "a"}, {"a", "b", "a"});
  EXPECT_THAT(match.both, ElementsAre(Pair(0, 0), Pair(1, 2)));
  EXPECT_THAT(match.gone, ElementsAre(2));
  EXPECT_THAT(match.added, ElementsAre(1));
}

TEST(Match, TheRestGoesByIndex) {
  Match match = match_keys({"a", "b", "c", "d"}, {"a", "x", "c"});
  match_rest_by_index(match);
  EXPECT_THAT(match.both, ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2)));
  EXPECT_THAT(match.gone, ElementsAre(3));
  EXPECT_THAT(match.added, IsEmpty());
}

}  // namespace
}  // namespace contactscope::snapshot
