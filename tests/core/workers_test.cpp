#include "core/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace contactscope {
namespace {

TEST(Workers, DoEachPieceOnce) {
  for (const int count : {1, 2, 3, 8}) {
    Workers workers(count);
    EXPECT_EQ(workers.count(), count);
    for (const int pieces : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(pieces));
      std::vector<std::atomic<int>> by(static_cast<std::size_t>(count));
      workers.for_each(pieces, [&](int i, int worker) {
        ++at(done, i);
        ++at(by, worker);
      });
      int all = 0;
      for (const auto& own : by) all += own;
      EXPECT_EQ(all, pieces);
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Workers, WorkSideBySide) {
  // Each piece waits for the other one: a single thread would wait forever.
  Workers workers(2);
  std::atomic<int> here = 0;
  workers.for_each(2, [&](int, int) {
    ++here;
    while (here < 2) std::this_thread::yield();
  });
  EXPECT_EQ(here, 2);
}

TEST(Workers, ThrowWhatTheFirstPieceThrew) {
  for (const int count : {1, 2, 5}) {
    Workers workers(count);
    for (int round = 0; round < 50; ++round) {
      std::atomic<int> begun = 0;
      try {
        workers.for_each(1000, [&](int i, int) {
          ++begun;
          if (i >= 10) throw std::runtime_error(std::to_string(i));
        });
        FAIL();
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "10");
      }
      EXPECT_LE(begun, 10 + count);
      // And continue with the next list.
      std::atomic<int> done = 0;
      workers.for_each(20, [&](int, int) { ++done; });
      EXPECT_EQ(done, 20);
    }
  }
}

}  // namespace
}  // namespace contactscope
