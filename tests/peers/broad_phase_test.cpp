// Other libraries' broad phases find all of our pairs, and more because of their margins.

#include "peers/broad_phase_peer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "broadphase/broad_phase.h"
#include "broadphase/random_boxes.h"

namespace contactscope::peers {
namespace {

TEST(BroadPhasePeers, FindTheSamePairsWhileBoxesMove) {
  using testing::RandomBoxes;
  using testing::Spread;
  constexpr float kMargins = 0.2f;  // metres, the largest of these libraries' own
  for (const PairFinderInfo& info : broad_phase_peers()) {
    const std::unique_ptr<PairFinder> peer = info.make();
    RandomBoxes random(Spread::Uniform, 10, 2);
    std::vector<Aabb<float>> boxes;
    std::vector<int> every_box;
    for (int i = 0; i < 600; ++i) {
      boxes.push_back(random.box());
      every_box.push_back(i);
    }
    const auto ours = make_broad_phase("columns");
    for (const Aabb<float>& box : boxes) ours->add(box);
    for (int step = 0; step < 5; ++step) {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Vec3<float> by = random.vector(-0.05f, 0.05f);
        boxes[i] = {boxes[i].lower + by, boxes[i].upper + by};
        ours->move(static_cast<int>(i), boxes[i]);
      }
      peer->place(boxes, every_box);
      std::vector<BoxPair> theirs;
      peer->find(theirs);
      for (BoxPair& pair : theirs) pair = {std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
      std::ranges::sort(theirs);
      EXPECT_EQ(std::ranges::adjacent_find(theirs), theirs.end()) << info.name << ": twice";
      for (const BoxPair& pair : ours->pairs())
        EXPECT_TRUE(std::ranges::binary_search(theirs, pair)) << info.name;
      for (const BoxPair& pair : theirs) {
        const Aabb<float>&a = ours->box(pair.a), &b = ours->box(pair.b);
        const Vec3<float> gap = (a.lower - b.upper).cwiseMax(b.lower - a.upper);
        EXPECT_LE(gap.maxCoeff(), kMargins) << info.name;
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::peers
