#include "trace/pair.h"

#include <gmock/gmock.h>

#include "trace/sample_trace.h"

namespace contactscope::trace {
namespace {

/// The sample's first pair as JSON, after `change`.
template <class Change> std::string line_after(Change&& change) {
  Frame frame = sample_frame();
  change(frame.pairs[0]);
  return to_json_line(frame);
}

TEST(Mirror, TwiceIsTheIdentity) {
  EXPECT_NE(line_after([](Pair& pair) { mirror(pair); }), line_after([](Pair&) {}));
  EXPECT_EQ(line_after([](Pair& pair) {
              mirror(pair);
              mirror(pair);
            }),
            line_after([](Pair&) {}));
}

TEST(Mirror, SwapsWhatBelongsToEachShape) {
  const Pair pair = sample_frame().pairs[0];
  Pair mirrored = pair;
  mirrored.kind = "hull-mesh";
  mirror(mirrored);
  EXPECT_EQ(mirrored.a, pair.b);
  EXPECT_EQ(mirrored.b, pair.a);
  EXPECT_EQ(mirrored.kind, "mesh-hull");
  EXPECT_EQ(mirrored.separation, pair.separation);
  EXPECT_EQ(mirrored.sat->face_a->face, pair.sat->face_b->face);
  EXPECT_EQ(mirrored.sat->face_a->support, pair.sat->face_b->support);
  EXPECT_EQ(mirrored.sat->face_b->separation, pair.sat->face_a->separation);
  EXPECT_EQ(mirrored.sat->edge->a, pair.sat->edge->b);
  EXPECT_EQ(mirrored.sat->edge->point_a, pair.sat->edge->point_b);
  EXPECT_EQ(mirrored.sat->chosen, "face_a");
  EXPECT_EQ(mirrored.gjk->point_b, pair.gjk->point_a);
  EXPECT_EQ(mirrored.gjk->steps[1][1].a, pair.gjk->steps[1][1].b);
  EXPECT_EQ(mirrored.incremental->margin_a, pair.incremental->margin_b);
  EXPECT_EQ(mirrored.incremental->points[0].on_b(), pair.incremental->points[0].on_a());
  EXPECT_EQ(mirrored.clip->reference.shape, pair.clip->reference.shape);
  EXPECT_EQ(mirrored.stability->margin, pair.stability->margin);
}

TEST(Mirror, ReversesVectorsFromAToB) {
  const Pair pair = sample_frame().pairs[0];
  Pair mirrored = pair;
  mirror(mirrored);
  EXPECT_EQ(mirrored.manifolds[0].normal, -pair.manifolds[0].normal);
  EXPECT_EQ(mirrored.sat->face_a->normal, -pair.sat->face_b->normal);
  EXPECT_EQ(mirrored.sat->edge_pairs[1].normal, -pair.sat->edge_pairs[1].normal);
  EXPECT_EQ(*mirrored.cache->normal, -*pair.cache->normal);
  EXPECT_EQ(mirrored.manifolds[0].points[1].impulse->friction,
            -pair.manifolds[0].points[1].impulse->friction);
  EXPECT_EQ(mirrored.clip->reference.normal, pair.clip->reference.normal);
  // Mirroring at the origin turns counter-clockwise into clockwise.
  EXPECT_EQ(mirrored.minkowski->vertices[1], -pair.minkowski->vertices[1]);
  EXPECT_THAT(mirrored.minkowski->faces[0], testing::ElementsAre(0, 2, 1));
  EXPECT_THAT(mirrored.penetration->polytopes[0].faces[0], testing::ElementsAre(0, 1, 2));
}

TEST(Mirror, IdsStaySorted) {
  const auto flipped = [](const std::string& id) {
    Pair pair;
    pair.manifolds.emplace_back().points.emplace_back().id = id;
    mirror(pair);
    return pair.manifolds[0].points[0].id;
  };
  EXPECT_EQ(flipped("a:e3 b:e7"), "a:e7 b:e3");
  EXPECT_EQ(flipped("a:e1 a:e12"), "b:e1 b:e12");
  EXPECT_EQ(flipped("a:v1 b:f2"), "a:f2 b:v1");
  EXPECT_EQ(flipped("17"), "17") << "another engine's";
}

}  // namespace
}  // namespace contactscope::trace
