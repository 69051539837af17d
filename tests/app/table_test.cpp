#include "app/table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace contactscope::app {
namespace {

TEST(Table, ColumnsAreAsWideAsATerminalShowsThem) {
  EXPECT_EQ(columns_of("crate"), 5u);
  EXPECT_EQ(columns_of("ящик"), 4u);
  EXPECT_EQ(columns_of("箱"), 2u);
  EXPECT_EQ(columns_of("📦"), 2u);
  EXPECT_EQ(columns_of("e\u0301tage"), 5u);
  std::ostringstream out;
  print({{"shape", "mass"}, {"ящик", "1"}, {"箱", "20"}}, out);
  EXPECT_EQ(out.str(), "shape  mass\nящик      1\n箱       20\n");
}

}  // namespace
}  // namespace contactscope::app
