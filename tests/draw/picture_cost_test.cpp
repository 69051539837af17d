// Cost of a picture, measured as calls that draw layers, not in seconds.

#include <gtest/gtest.h>

#include "draw/crate_on_slab.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

int drawings = 0;
int explanations = 0;

const LayerDrawing kCounting{
    .search = [](const Scene&, const trace::Pair&, Sketch&) { ++drawings; },
    .explain = [](const Scene&, Legend&) { ++explanations; },
};

LayerTable counting_table() {
  LayerTable table;
  table.fill(&kCounting);
  return table;
}

/// A sequence in which the crate slides, with the given numbers of frames and pairs.
CrateOnSlab sliding(int frames, std::size_t pairs) {
  CrateOnSlab scene;
  const trace::Frame first = scene.frames.front();
  scene.frames.clear();
  for (int f = 0; f < frames; ++f) {
    trace::Frame& frame = scene.frames.emplace_back(first);
    frame.frame = f;
    frame.poses[1].second.position.x() += 0.001 * f;
    frame.pairs.assign(pairs, first.pairs.front());
  }
  scene.view.layers = {Layer::Tree};
  return scene;
}

struct Counts {
  int drawn = 0, explained = 0;
};

template <class Work> Counts counted(const Work& work) {
  drawings = explanations = 0;
  work();
  return {drawings, explanations};
}

TEST(PictureCost, StagingDrawsNothingAndExplainsEachFrameOnce) {
  const LayerTable table = counting_table();
  for (const int frames : {1, 10, 300}) {
    const CrateOnSlab scene = sliding(frames, 3);
    const Counts counts =
        counted([&] { stage(scene.header, scene.frames, scene.view, 1280, 720, {}, table); });
    EXPECT_EQ(counts.drawn, 0) << frames;
    EXPECT_EQ(counts.explained, frames);
  }
}

TEST(PictureCost, APictureCostsWhatItsOwnFrameDoes) {
  const LayerTable table = counting_table();
  for (const int frames : {1, 10, 300}) {
    const CrateOnSlab scene = sliding(frames, 3);
    const Staging staging = stage(scene.header, scene.frames, scene.view, 1280, 720, {}, table);
    const Counts counts = counted([&] { illustrate(staging, scene.frames.back()); });
    EXPECT_EQ(counts.drawn, 3) << frames;
    EXPECT_EQ(counts.explained, 1) << frames;
  }
}

TEST(PictureCost, LayersThatAViewOmitsAreNotCalled) {
  const LayerTable table = counting_table();
  CrateOnSlab scene = sliding(10, 3);
  scene.view.layers = {};
  const Counts counts = counted([&] {
    const Staging staging = stage(scene.header, scene.frames, scene.view, 1280, 720, {}, table);
    illustrate(staging, scene.frames.back());
  });
  EXPECT_EQ(counts.drawn, 0);
  EXPECT_EQ(counts.explained, 0);
}

// Some legends are made separately from the drawing: neither may contain more than the other.
TEST(PictureCost, EmptyLayersHaveNoLegend) {
  CrateOnSlab scene;
  for (std::size_t i = 0; i < kLayerNames.size(); ++i) {
    scene.view.layers = {static_cast<Layer>(i)};
    const Sketch sketch = scene.sketch();
    const bool empty = sketch.surfaces.empty() && sketch.curves.empty() && sketch.lines.empty() &&
                       sketch.arrows.empty() && sketch.marks.empty();
    if (empty) {
      EXPECT_TRUE(sketch.legend.sorted().empty()) << kLayerNames[i];
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
