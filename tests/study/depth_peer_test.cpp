#include "study/peers.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using testing::ElementsAre;

class DepthPeers : public testing::Test {
 protected:
  std::vector<DepthPeer> query_pair(const std::string& script) {
    const std::string file =
        folder_.write("contactscope-depth-peers", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    std::mt19937_64 engine(3);
    pair_ = overlapping_hulls(engine, 8);
    return run_depth_peers({folder_.path().string()}, {pair_}, 2);
  }

  TemporaryFolder folder_;
  OverlappingHulls pair_;
};

TEST_F(DepthPeers, GetPairsOfOneMetreAndReportDepthsOfTheirSize) {
  const std::string seen = folder_ / "seen";
  const auto peers = query_pair("cat >'" + seen +
                                "'\necho name One, EPA\necho nanoseconds 2\necho 40 41\n"
                                "echo 0.5 0 0 1\n"
                                "echo name Other\necho nanoseconds 2\necho 7 6\necho -1 0 0 0");
  ASSERT_EQ(peers.size(), 2u);
  EXPECT_EQ(peers[0].name, "One, EPA");
  EXPECT_THAT(peers[0].nanoseconds, ElementsAre(40, 41));
  EXPECT_EQ(peers[0].found[0].depth, 0.5 * pair_.size);
  EXPECT_EQ(peers[0].found[0].normal, Vec3d::UnitZ());
  EXPECT_LT(peers[1].found[0].depth, 0);
  std::istringstream request(read_text(seen));
  std::string word;
  int repetitions = 0, pairs = 0, vertices = 0;
  request >> word >> repetitions >> word >> pairs >> vertices;
  EXPECT_EQ(repetitions, 2);
  EXPECT_EQ(pairs, 1);
  EXPECT_EQ(vertices, 8);
  Vec3d first;
  request >> first.x() >> first.y() >> first.z();
  EXPECT_TRUE((first * pair_.size).isApprox(pair_.a.vertices[0], 1e-14));
}

TEST_F(DepthPeers, ThatFailOrEndEarlyAreAnError) {
  EXPECT_THROW(query_pair("exit 3"), std::runtime_error);
  EXPECT_THROW(query_pair("echo name One; echo nanoseconds 2; echo 3"), std::runtime_error);
}

TEST_F(DepthPeers, ThatAreMissingAreNotRun) {
  EXPECT_TRUE(run_depth_peers({folder_.path().string()}, {}, 2).empty());
}

}  // namespace
}  // namespace contactscope
