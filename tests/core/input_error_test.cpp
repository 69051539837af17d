#include "core/input_error.h"

#include <gtest/gtest.h>

namespace contactscope {
namespace {

TEST(InputError, BeginsWithFileLineAndColumn) {
  EXPECT_STREQ(InputError("a.toml", 3, 14, "no").what(), "a.toml:3:14: no");
}

TEST(InputError, LeavesOutALineThatIsNotKnown) {
  EXPECT_STREQ(InputError("a.toml", 0, 0, "no such file").what(), "a.toml: no such file");
}

}  // namespace
}  // namespace contactscope
