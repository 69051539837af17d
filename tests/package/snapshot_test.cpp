#include <contactscope/collide.h>
#include <contactscope/gtest.h>

#include <cstdlib>
#include <optional>

#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Sets an environment variable for the duration of a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    if (value != nullptr)
      setenv(name, value, 1);
    else
      unsetenv(name);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

Manifold patch_moved_by(double shift) {
  Manifold manifold{{0, 1, 0}};
  for (const Vec3& corner : {Vec3{1, 0, 1}, Vec3{1, 0, -1}, Vec3{-1, 0, -1}, Vec3{-1, 0, 1}})
    manifold.points.push_back({corner, -0.01, "corner " + std::to_string(manifold.points.size())});
  manifold.points[2].position.x += shift;
  return manifold;
}

class PackageSnapshot : public testing::Test {
 protected:
  SnapshotOptions options(std::optional<bool> update = false) const {
    SnapshotOptions all;
    all.folder = folder_.path().string();
    all.out = folder_ / "out";
    all.update = update;
    all.pictures = false;
    return all;
  }
  Comparison compare(const auto& value, std::optional<bool> update = false) const {
    return compare_with_snapshot(value, "stack/frame_12", options(update));
  }

  TemporaryFolder folder_;
  Variable ci_{"CI", nullptr};
  Variable update_{"CONTACTSCOPE_UPDATE", nullptr};
};

TEST_F(PackageSnapshot, MissingOneIsAFailureWithTheRemedy) {
  const Comparison missing = compare(patch_moved_by(0));
  EXPECT_FALSE(missing.ok);
  EXPECT_THAT(missing.message, HasSubstr(folder_ / "stack/frame_12/trace.jsonl"));
  EXPECT_THAT(missing.message, HasSubstr("CONTACTSCOPE_UPDATE=1"));
  EXPECT_THAT(folder_.files(), IsEmpty());
}

TEST_F(PackageSnapshot, IsWrittenOnRequestAndThenTheSame) {
  EXPECT_TRUE(compare(patch_moved_by(0), true).ok);
  EXPECT_THAT(folder_.files(), ElementsAre("stack/frame_12/trace.jsonl"));
  const Comparison same = compare(patch_moved_by(0));
  EXPECT_TRUE(same.ok) << same.message;
  EXPECT_THAT(same.message, IsEmpty());
  EXPECT_TRUE(compare(patch_moved_by(1e-9)).ok) << "less than a rounding of float";
}

TEST_F(PackageSnapshot, EnvironmentRequestsItToo) {
  const Variable update("CONTACTSCOPE_UPDATE", "1");
  EXPECT_TRUE(compare(patch_moved_by(0), std::nullopt).ok);
  EXPECT_TRUE(compare(patch_moved_by(0.5), std::nullopt).ok);
  EXPECT_TRUE(compare(patch_moved_by(0.5)).ok);
}

TEST_F(PackageSnapshot, NothingIsWrittenInCI) {
  const Variable ci("CI", "true");
  const Comparison refused = compare(patch_moved_by(0), true);
  EXPECT_FALSE(refused.ok);
  EXPECT_THAT(refused.message, HasSubstr("CI is set"));
  EXPECT_THAT(folder_.files(), IsEmpty());
}

TEST_F(PackageSnapshot, MovedPointIsReported) {
  compare(patch_moved_by(0), true);
  const Comparison moved = compare(patch_moved_by(0.0013));
  EXPECT_FALSE(moved.ok);
  EXPECT_THAT(moved.message,
              HasSubstr("stack/frame_12 frame 0, a-b: point 2 moved 1.3 mm along x"));
  EXPECT_THAT(moved.message, Not(HasSubstr("vertex"))) << "stand-ins are no facts";
  EXPECT_THAT(files_below(folder_ / "out"), IsEmpty());
}

TEST_F(PackageSnapshot, ManifoldsOfAnySizeAreStored) {
  for (std::size_t size : {0u, 1u, 2u, 3u}) {
    Manifold manifold = patch_moved_by(0);
    manifold.points.resize(size);
    const std::string name = "points/" + std::to_string(size);
    EXPECT_TRUE(compare_with_snapshot(manifold, name, options(true)).ok);
    EXPECT_TRUE(compare_with_snapshot(manifold, name, options()).ok);
    EXPECT_FALSE(compare_with_snapshot(patch_moved_by(0), name, options()).ok);
    EXPECT_EQ(read_trace(folder_ / (name + "/trace.jsonl")).frame_count(), 1);
  }
}

TEST_F(PackageSnapshot, RecordedContactsAreComparedWithTheirStages) {
  CollideOptions recorded;
  recorded.record = true;
  const auto contacts = [&](double height) {
    return collide(Box{{1, 1, 1}}, {}, Box{{0.5, 0.5, 0.5}}, {{0, height, 0}, {}}, recorded);
  };
  EXPECT_THAT(contacts(1.49), MatchesSnapshot("box/box", options(true)));
  EXPECT_THAT(contacts(1.49), MatchesSnapshot("box/box", options()));
  testing::StringMatchResultListener listener;
  const testing::Matcher<Contacts> matcher = MatchesSnapshot("box/box", options());
  EXPECT_FALSE(matcher.MatchAndExplain(contacts(1.48), &listener));
  EXPECT_THAT(listener.str(), HasSubstr("sat"));
}

TEST_F(PackageSnapshot, NameThatLeavesItsFolderIsRefused) {
  for (const char* name : {"frame_12", "../frame_12", "stack/..", "a/b/c"})
    EXPECT_THROW(compare_with_snapshot(patch_moved_by(0), name, options(true)),
                 std::invalid_argument)
        << name;
}

TEST_F(PackageSnapshot, StoredFileThatIsNoTraceIsAnInputError) {
  folder_.write("stack/frame_12/trace.jsonl", "{\"schema\":\n");
  EXPECT_THROW(compare(patch_moved_by(0)), InputError);
  EXPECT_TRUE(compare(patch_moved_by(0), true).ok) << "asked for, it is written anew";
}

}  // namespace
}  // namespace contactscope
