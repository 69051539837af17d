#include "snapshot/store.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "core/input_error.h"
#include "snapshot/sample_trace.h"
#include "support/temporary_folder.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const std::string kScenario = "hull/face_contact";

TEST(Store, PathsFollowTheFormat) {
  EXPECT_EQ(picture_path("snapshots", {kScenario, {}, 12}),
            "snapshots/hull/face_contact/frame_0012.png");
  EXPECT_EQ(picture_path("snapshots", {kScenario, "side", 0}),
            "snapshots/hull/face_contact/side/frame_0000.png");
  EXPECT_EQ(trace_path("snapshots", kScenario), "snapshots/hull/face_contact/trace.jsonl");
  EXPECT_EQ(frame_stem(123456), "frame_123456");
}

TEST(Store, ANameCannotLeaveItsFolder) {
  for (const char* scenario :
       {"", "hull", "/hull", "hull/", "../hull", "hull/..", "hull/a/b", "./a"}) {
    EXPECT_THROW(scenario_folder("snapshots", scenario), std::invalid_argument) << scenario;
  }
  for (const char* view : {"", ".", "..", "a/b"}) {
    EXPECT_THROW(picture_folder("snapshots", kScenario, view), std::invalid_argument) << view;
  }
}

class StoredFiles : public testing::Test {
 protected:
  void put(const std::string& file) { write_text(folder_.path() / file, "x"); }
  std::vector<std::string> relative(const std::vector<std::filesystem::path>& paths) const {
    std::vector<std::string> names;
    for (const std::filesystem::path& path : paths) {
      names.push_back(path.lexically_relative(folder_.path()).generic_string());
    }
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(StoredFiles, ObsoleteFilesAreStale) {
  put("hull/face_contact/trace.jsonl");
  put("hull/face_contact/notes.md");
  put("hull/face_contact/frame_0000.png");
  put("hull/face_contact/frame_0012.png");
  put("hull/face_contact/frame_12.png");
  put("hull/face_contact/side/frame_0000.png");
  const std::vector<int> frames{0};
  EXPECT_THAT(relative(stale_files(folder_.path(), kScenario, {}, frames)),
              ElementsAre("hull/face_contact/frame_0012.png", "hull/face_contact/frame_12.png",
                          "hull/face_contact/side/frame_0000.png"));
  const std::vector<std::string> views{"side", "top"};
  EXPECT_THAT(relative(stale_files(folder_.path(), kScenario, views, frames)),
              ElementsAre("hull/face_contact/frame_0000.png", "hull/face_contact/frame_0012.png",
                          "hull/face_contact/frame_12.png"));
  EXPECT_THAT(stale_files(folder_.path(), "hull/none", views, frames), IsEmpty());
}

TEST_F(StoredFiles, ScenariosAreListed) {
  put("hull/b/trace.jsonl");
  put("hull/a/side/frame_0000.png");
  put("mesh/a/README.md");
  put("loose.png");
  EXPECT_THAT(stored_scenarios(folder_.path()), ElementsAre("hull/a", "hull/b"));
  EXPECT_THAT(stored_scenarios(folder_.path() / "none"), IsEmpty());
}

TEST_F(StoredFiles, ATraceIsReadBack) {
  EXPECT_FALSE(read_stored_trace(folder_.path(), kScenario).has_value());
  write_text(trace_path(folder_.path(), kScenario), to_json_lines(sample_trace()));
  EXPECT_EQ(read_stored_trace(folder_.path(), kScenario), to_json_lines(sample_trace()));
}

TEST_F(StoredFiles, ANameWithoutAFolderIsWrittenWhereWeAre) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  EXPECT_NO_THROW(write_text("junit.xml", "x"));
  std::filesystem::current_path(before);
  EXPECT_EQ(read_text(folder_ / "junit.xml"), "x");
}

TEST_F(StoredFiles, WritingReplacesTheWholeFileAndLeavesNoOther) {
  const std::filesystem::path file = folder_.path() / "a" / "b" / "text";
  write_text(file, "a long first text");
  write_text(file, "short");
  EXPECT_EQ(read_text(file), "short");
  EXPECT_THAT(folder_.files(), UnorderedElementsAre("a/b/text"));
}

TEST_F(StoredFiles, AFailedWriteIsAnErrorAndLeavesNothing) {
  std::filesystem::create_directories(folder_.path() / "folder" / "inside");
  EXPECT_THROW(write_text(folder_.path() / "folder", "x"), std::filesystem::filesystem_error);
  EXPECT_THAT(folder_.files(), IsEmpty());
}

}  // namespace
}  // namespace contactscope::snapshot
