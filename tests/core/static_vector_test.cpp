#include "core/static_vector.h"

#include <numeric>

#include <gtest/gtest.h>

namespace contactscope {
namespace {

TEST(StaticVector, GrowsToItsCapacity) {
  StaticVector<int, 4> items;
  EXPECT_TRUE(items.empty());
  for (int i = 0; i < 4; ++i) items.push_back(i * i);
  EXPECT_EQ(items.size(), items.capacity());
  EXPECT_EQ(items[2], 4);
  EXPECT_EQ(items.back(), 9);
  EXPECT_EQ(std::accumulate(items.begin(), items.end(), 0), 14);
}

TEST(StaticVector, TruncateKeepsTheFirst) {
  StaticVector<int, 8> items;
  for (int i = 0; i < 6; ++i) items.push_back(i);
  items.truncate(2);
  EXPECT_EQ(items.size(), 2u);
  EXPECT_EQ(items.back(), 1);
  items.clear();
  EXPECT_TRUE(items.empty());
  EXPECT_EQ(items.begin(), items.end());
}

TEST(StaticVector, CopiesAreIndependent) {
  StaticVector<double, 3> one;
  one.push_back(1.5);
  StaticVector<double, 3> two = one;
  two.push_back(2.5);
  two[0] = 7;
  EXPECT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0], 1.5);
  one = two;
  EXPECT_EQ(one.size(), 2u);
  EXPECT_EQ(one[1], 2.5);
}

TEST(StaticVector, RangeForSeesOnlyWhatWasPushed) {
  StaticVector<int, 16> items;
  items.push_back(3);
  items.push_back(4);
  int count = 0;
  for (const int item : items) {
    EXPECT_EQ(item, 3 + count);
    ++count;
  }
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace contactscope
