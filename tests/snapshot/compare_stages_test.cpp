#include <gmock/gmock.h>

#include <functional>

#include "snapshot/compare_pair.h"
#include "snapshot/sample_trace.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Tolerance kTolerance{1e-6, 1e-6, 1e-6};

std::vector<std::string> after(const std::function<void(trace::Pair&)>& change) {
  trace::Trace expected = sample_trace();
  trace::Trace actual = sample_trace();
  change(sample_pair(actual));
  return compare_pair(sample_pair(expected), sample_pair(actual), kTolerance);
}

TEST(CompareStages, SatAxes) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.sat->face_a->face = 5;
                pair.sat->face_a->separation = -0.25;
              }),
              ElementsAre("sat face_a: face 3 -> 5, separation -0.005 -> -0.250"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.sat->edge->b = 10;
                pair.sat->edge->point_b.x() += 0.5;
              }),
              ElementsAre("sat edge: edge of b 9 -> 10, point on b moved 500 mm along x"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.sat->chosen = "face_a"; }),
              ElementsAre("sat: chosen face_b -> face_a"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.sat->preference = "none"; }),
              ElementsAre("sat: preference relative -> none"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.sat->edge.reset(); }),
              ElementsAre("sat edge gone"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.sat.reset(); }), ElementsAre("sat gone"));
}

TEST(CompareStages, ClipFaces) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.clip->reference.shape = "crate";
                pair.clip->reference.face = 0;
              }),
              ElementsAre("reference face: shape floor -> crate, face 2 -> 0"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.clip->incident.normal *= -1; }),
              ElementsAre("incident face: normal flipped"));
}

TEST(CompareStages, ClipPolygonsTellTheVertexThatMovedMost) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.clip->steps[1].polygon[0].z() += 0.001;
                pair.clip->steps[1].polygon[2].z() += 0.003;
              }),
              ElementsAre("clip step 1: vertex 2 moved 3 mm along z, 1 more moved"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.clip->steps[0].polygon.pop_back(); }),
              ElementsAre("clip step 0: 4 -> 3 vertices"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.clip->steps[0].offset = 0.75; }),
              ElementsAre("clip step 0: offset 0.50 -> 0.75"));
}

TEST(CompareStages, ClipStepsAndDroppedPointsAreCounted) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.clip->steps.pop_back();
                pair.clip->dropped.clear();
              }),
              ElementsAre("clip: number of side planes 2 -> 1, number of dropped points 1 -> 0"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.clip->dropped[0].reason = "reduced away"; }),
              ElementsAre("dropped point 0 reason above the reference face -> reduced away"));
}

TEST(CompareStages, Reduction) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.reduction->kept = {0, 2, 3};
                pair.reduction->area = 0.18;
              }),
              ElementsAre("reduction: kept 0 2 1 3 -> 0 2 3, area 0.36 -> 0.18"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.reduction->method = "none"; }),
              ElementsAre("reduction: method area -> none"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.reduction->points[1].separation = 0.045; }),
              ElementsAre("reduction point 1 separation -0.005 -> 0.045"));
}

TEST(CompareStages, Gjk) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.gjk->status = "touching";
                pair.gjk->iterations = 5;
              }),
              ElementsAre("gjk: status separated -> touching, iterations 3 -> 5"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.gjk->point_b.x() += 0.5; }),
              ElementsAre("gjk: point on b moved 500 mm along x"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.gjk->steps[0][0].a.x() += 0.5; }),
              ElementsAre("gjk: vertex 0 moved 500 mm along x"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.gjk.reset(); }), ElementsAre("gjk gone"));
}

TEST(CompareStages, Tree) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.tree->candidates = {4};
                pair.tree->visits.clear();
              }),
              ElementsAre("tree: number of boxes 1 -> 0, candidates 4 17 -> 4"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.tree->box.upper.y() += 0.5; }),
              ElementsAre("tree: upper corner of the box moved 500 mm along y"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.tree.reset(); }), ElementsAre("tree gone"));
}

TEST(CompareStages, ContactTypeAndDegenerateAnswer) {
  EXPECT_THAT(after([](trace::Pair& pair) { pair.manifolds[0].type = "edge-face"; }),
              ElementsAre("type face-face -> edge-face"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.degenerate->answer = "skip"; }),
              ElementsAre("degenerate: answer fallback -> skip"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.degenerate.reset(); }),
              ElementsAre("degenerate gone"));
}

TEST(CompareStages, Cache) {
  EXPECT_THAT(after([](trace::Pair& pair) { pair.cache->hit = false; }),
              ElementsAre("cache: hit of features, face_a -> miss of features, face_a"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.cache->moved = 0.0225; }),
              ElementsAre("cache: moved 0.013 -> 0.022"));
  EXPECT_THAT(after([](trace::Pair& pair) { *pair.cache->normal *= -1; }),
              ElementsAre("cache: normal flipped"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.cache.reset(); }), ElementsAre("cache gone"));
}

TEST(CompareStages, MeshManifoldsBelongTogetherByTriangle) {
  trace::Trace trace = sample_trace();
  trace::Pair& expected = sample_pair(trace);
  expected.manifolds[0].triangle = 4;
  expected.manifolds.push_back(expected.manifolds[0]);
  expected.manifolds[1].triangle = 9;
  trace::Pair actual = expected;
  EXPECT_THAT(compare_pair(expected, actual, kTolerance), IsEmpty());
  actual.manifolds.erase(actual.manifolds.begin());
  actual.manifolds[0].normal *= -1;
  EXPECT_THAT(compare_pair(expected, actual, kTolerance),
              ElementsAre("manifold of triangle 4 gone", "manifold of triangle 9: normal flipped"));
}

TEST(CompareStages, AStageThatWasNotRecordedBeforeIsSeen) {
  trace::Trace with = sample_trace(), without = sample_trace();
  sample_pair(without).clip.reset();
  EXPECT_THAT(compare_pair(sample_pair(without), sample_pair(with), kTolerance),
              ElementsAre("clip added"));
}

}  // namespace
}  // namespace contactscope::snapshot
