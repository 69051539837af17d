#include "study/peers.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using testing::ElementsAre;

class FieldPeer : public testing::Test {
 protected:
  std::optional<PeerField> query_pair(const std::string& script) {
    const std::string file =
        folder_.write("contactscope-field-fake", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    const Mesh<double> triangle = build_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    return run_field_peer({folder_.path().string()}, "fake", triangle, 64, 3, 2,
                          {{0.25, 0.25, 0.5}, {0, 0, -1}});
  }

  TemporaryFolder folder_;
};

TEST_F(FieldPeer, ReportsWhatItBuiltAndFound) {
  const std::string seen = folder_ / "seen";
  const auto field = query_pair("cat >'" + seen +
                                "'\necho name Fake 1.0\necho build 12.5 bytes 3000 nanoseconds 2\n"
                                "echo 40 41\necho 0.5 0 0 1\necho -1 0 0 -1");
  ASSERT_TRUE(field);
  EXPECT_EQ(field->name, "Fake 1.0");
  EXPECT_EQ(field->build, 12.5);
  EXPECT_EQ(field->bytes, 3000);
  EXPECT_THAT(field->nanoseconds, ElementsAre(40, 41));
  EXPECT_THAT(field->distances, ElementsAre(0.5, -1));
  EXPECT_EQ(field->gradients[1], Vec3d(0, 0, -1));
  EXPECT_EQ(read_text(seen),
            "cells 64 band 3 repetitions 2\nvertices 3\n0 0 0\n1 0 0\n0 1 0\n"
            "triangles 1\n0 1 2\npoints 2\n0.25 0.25 0.5\n0 0 -1\n");
}

TEST_F(FieldPeer, OneThatFailsOrEndsEarlyIsAnError) {
  EXPECT_THROW(query_pair("exit 3"), std::runtime_error);
  EXPECT_THROW(query_pair("echo name Fake; echo build 1 bytes 2 nanoseconds 2; echo 3"),
               std::runtime_error);
}

TEST_F(FieldPeer, AMissingOneIsNotRun) {
  const Mesh<double> triangle = build_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_FALSE(run_field_peer({folder_.path().string()}, "none", triangle, 64, 3, 2, {}));
}

}  // namespace
}  // namespace contactscope
