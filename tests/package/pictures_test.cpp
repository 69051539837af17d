#include <contactscope/collide.h>
#include <contactscope/render.h>
#include <contactscope/snapshot.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Contacts crate_at(double height) {
  CollideOptions options;
  options.record = true;
  return collide(Plane{}, {}, Box{{0.5, 0.5, 0.5}}, {{0, height, 0}, {}}, options);
}

RenderOptions small() {
  RenderOptions options;
  options.width = 320;
  options.height = 200;
  return options;
}

TEST(PackagePictures, FrameIsDrawnToMemory) {
  const Contacts contacts = crate_at(0.48);
  const Picture picture = render(contacts.trace, 0, small());
  ASSERT_EQ(picture.rgba.size(), 4u * 320 * 200);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    ASSERT_EQ(picture.rgba[i + 3], 255);
    drawn += picture.rgba[i] != 255 || picture.rgba[i + 1] != 255 || picture.rgba[i + 2] != 255;
  }
  EXPECT_GT(drawn, 320u * 200 / 50);
  int frames = 0;
  render_all(contacts.trace, small(), [&](int index, const Picture& same) {
    EXPECT_EQ(index, frames++);
    EXPECT_TRUE(std::ranges::equal(same.rgba, picture.rgba));
  });
  EXPECT_EQ(frames, 1);
  const TemporaryFolder folder;
  write_png(folder / "crate.png", picture);
  EXPECT_THAT(read_text(folder / "crate.png"), testing::StartsWith("\x89PNG"));
}

TEST(PackagePictures, UnknownFramesAndLayersAreRefused) {
  const Contacts contacts = crate_at(0.48);
  RenderOptions layer = small(), tiny = small();
  layer.layers = {"shape"};
  tiny.width = 8;
  EXPECT_THROW(render(contacts.trace, 1, small()), std::invalid_argument);
  EXPECT_THROW(render(contacts.trace, 0, tiny), std::invalid_argument);
  try {
    render(contacts.trace, 0, layer);
    FAIL() << "it was drawn";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'shapes'?"));
  }
}

TEST(PackagePictures, FailedSnapshotLeavesThreePictures) {
  const TemporaryFolder folder;
  SnapshotOptions options;
  options.folder = folder / "snapshots";
  options.out = folder / "out";
  Manifold manifold{{0, 1, 0}};
  manifold.points = {{{1, 0, 1}, -0.01}, {{1, 0, -1}, -0.01}, {{-1, 0, 0}, -0.01}};
  options.update = true;
  unsetenv("CI");  // CI forbids it; each test is a process, except under the sanitizers
  ASSERT_TRUE(compare_with_snapshot(manifold, "stack/frame_12", options).ok);
  options.update = false;
  ASSERT_TRUE(compare_with_snapshot(manifold, "stack/frame_12", options).ok);
  manifold.points[2].position.x = -0.9;
  const Comparison moved = compare_with_snapshot(manifold, "stack/frame_12", options);
  EXPECT_FALSE(moved.ok);
  EXPECT_THAT(moved.message, HasSubstr("point 2 moved 100 mm along x"));
  EXPECT_THAT(moved.message,
              HasSubstr(folder / "out/check/stack/frame_12/frame_0000.difference.png"));
  EXPECT_THAT(files_below(folder / "out"),
              ElementsAre("check/stack/frame_12/frame_0000.actual.png",
                          "check/stack/frame_12/frame_0000.difference.png",
                          "check/stack/frame_12/frame_0000.expected.png"));
  EXPECT_NE(read_text(folder / "out/check/stack/frame_12/frame_0000.actual.png"),
            read_text(folder / "out/check/stack/frame_12/frame_0000.expected.png"));
}

}  // namespace
}  // namespace contactscope
