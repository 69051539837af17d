#include "app/cli/catalogue.h"

#include <gmock/gmock.h>

#include <set>

namespace contactscope::app {
namespace {

using testing::ElementsAre;

std::vector<Costed> ten() {
  std::vector<Costed> all;
  for (int i = 0; i < 10; ++i) all.push_back({"group/" + std::to_string(i), 1.0 + i % 4});
  return all;
}

TEST(Shard, EachScenarioIsInOnePart) {
  for (int of : {1, 2, 3, 7, 20}) {
    std::multiset<std::string> seen;
    for (int part = 1; part <= of; ++part)
      for (const std::string& name : names_in_shard(ten(), {part, of})) seen.insert(name);
    EXPECT_EQ(seen.size(), 10u) << of;
    EXPECT_EQ(std::set<std::string>(seen.begin(), seen.end()).size(), 10u) << of;
  }
}

TEST(Shard, PartsAreBalancedByCost) {
  const std::vector<Costed> all = {{"a/long", 10}, {"b/b", 4}, {"c/c", 3}, {"d/d", 3}};
  EXPECT_THAT(names_in_shard(all, {1, 2}), ElementsAre("a/long"));
  EXPECT_THAT(names_in_shard(all, {2, 2}), ElementsAre("b/b", "c/c", "d/d"));
}

}  // namespace
}  // namespace contactscope::app
