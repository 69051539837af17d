#include <gmock/gmock.h>

#include <functional>

#include "snapshot/compared_sentences.h"
#include "snapshot/sample_trace.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// The findings about the pair, without their place.
std::vector<std::string> compare(const trace::Trace& expected, const trace::Trace& actual) {
  const std::string place = "hull/face_contact frame 12, crate-floor: ";
  std::vector<std::string> sentences = compare_traces(expected, actual);
  for (std::string& sentence : sentences) {
    EXPECT_TRUE(sentence.starts_with(place)) << sentence;
    sentence.erase(0, place.size());
  }
  return sentences;
}

std::vector<std::string> after(const std::function<void(trace::Pair&)>& change) {
  trace::Trace actual = sample_trace();
  change(sample_pair(actual));
  return compare(sample_trace(), actual);
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

TEST(CompareStages, ClipPolygonsNameTheVertexThatMovedMost) {
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
              ElementsAre("gjk step 0: vertex 0 moved 500 mm along x"));
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
              ElementsAre("cache: hit -> miss"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.cache->moved = 0.0225; }),
              ElementsAre("cache: moved 0.013 -> 0.022"));
  EXPECT_THAT(after([](trace::Pair& pair) { *pair.cache->normal *= -1; }),
              ElementsAre("cache: normal flipped"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.cache.reset(); }), ElementsAre("cache gone"));
}

TEST(CompareStages, EdgePairsBelongTogetherByTheirEdges) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.sat->edge_pairs[0].a = 4;
                pair.sat->edge_pairs[1].separation = -0.5;
              }),
              ElementsAre("sat edge pair 2-9 gone", "sat edge pair 4-9 added",
                          "sat edge pair 3-9: separation -0.25 -> -0.50"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.sat->edge_pairs[1].normal *= -1; }),
              ElementsAre("sat edge pair 3-9: normal flipped"));
  EXPECT_THAT(
      after([](trace::Pair& pair) { std::swap(pair.sat->edge_pairs[0], pair.sat->edge_pairs[1]); }),
      ElementsAre("sat edge pairs in another order"));
}

TEST(CompareStages, Impulses) {
  EXPECT_THAT(after([](trace::Pair& pair) { pair.manifolds[0].points[1].impulse->normal = 0.75; }),
              ElementsAre("point 1 impulse 0.50 -> 0.75"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.manifolds[0].points[1].impulse->friction.z() = 0.5;
                pair.manifolds[0].points[1].impulse->warm_start = 0;
              }),
              ElementsAre("point 1 friction impulse (0.125, 0, 0) -> (0.125, 0, 0.5), warm start "
                          "0.25 -> 0.00"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.manifolds[0].points[2].impulse.reset(); }),
              ElementsAre("point 2 impulse gone"));
  // The largest allowed rounding: 16 units in the last place of the largest.
  EXPECT_THAT(after([](trace::Pair& pair) { pair.manifolds[0].points[1].impulse->normal += 9e-7; }),
              IsEmpty());
  EXPECT_THAT(after([](trace::Pair& pair) { pair.manifolds[0].points[1].impulse->normal += 1e-6; }),
              SizeIs(1));
}

TEST(CompareStages, RelativeVelocities) {
  const auto moved = [](double by) {
    return after([by](trace::Pair& pair) {
      pair.manifolds[0].points[1].relative_velocity->after.y() += by;
    });
  };
  EXPECT_THAT(moved(-0.25), ElementsAre("point 1 relative velocity after the step (0.5, 0, 0) -> "
                                        "(0.5, -0.25, 0)"));
  EXPECT_THAT(moved(1e-6), IsEmpty()) << "a millionth of the fastest is rounding";
  EXPECT_THAT(
      after([](trace::Pair& pair) { pair.manifolds[0].points[2].relative_velocity.reset(); }),
      ElementsAre("point 2 relative velocity gone"));
}

TEST(CompareStages, Penetration) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.penetration->status = "out of faces";
                pair.penetration->fallback = "sat";
                pair.penetration->depth = 0.0075;
              }),
              ElementsAre("penetration: status converged -> out of faces, fallback (none) -> sat, "
                          "depth 0.0050 -> 0.0075"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.penetration->method = "mpr"; }),
              ElementsAre("penetration: method epa -> mpr"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.penetration->point_a.y() += 0.5; }),
              ElementsAre("penetration: point on a moved 500 mm along y"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.penetration->polytopes[0].nearest = 0;
                pair.penetration->polytopes[0].faces[1] = {2, 1, 0};
                pair.penetration->polytopes[0].vertices[2].b.z() += 0.25;
              }),
              ElementsAre("polytope 0: vertex 5 moved 250 mm along z, face 1 (0 2 1) -> (2 1 0), "
                          "nearest face 1 -> 0"));
  EXPECT_THAT(
      after([](trace::Pair& pair) {
        pair.penetration->polytopes.clear();
        pair.penetration->portals[0][0].a.x() += 1;
        pair.penetration->directions[0].separation = 0.25;
      }),
      ElementsAre("penetration: number of polytopes 1 -> 0", "portal 0: vertex 0 moved 1 m along x",
                  "direction 0: separation 0.50 -> 0.25"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.penetration.reset(); }),
              ElementsAre("penetration gone"));
}

TEST(CompareStages, Minkowski) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.minkowski->vertices[3].x() += 0.5;
                pair.minkowski->faces.pop_back();
              }),
              ElementsAre("minkowski: vertex 3 moved 500 mm along x, 2 -> 1 faces"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.minkowski.reset(); }),
              ElementsAre("minkowski gone"));
}

TEST(CompareStages, PersistentPoints) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.incremental->query = "epa";
                pair.incremental->points[1].state = "broken";
                pair.incremental->points[1].reason = "slid";
                pair.incremental->points[3].point.on_b->y() -= 0.5;
              }),
              ElementsAre("incremental: query gjk -> epa",
                          "persistent point 1 state persisted -> broken, reason (none) -> slid",
                          "persistent point 3 place on b moved 500 mm along -y"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.incremental->points.erase(pair.incremental->points.begin());
                pair.incremental->points[0].age = 8;
              }),
              ElementsAre("persistent point 0 (a:e0 a:e4) gone", "persistent point 1 age 7 -> 8"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.incremental.reset(); }),
              ElementsAre("incremental gone"));
}

TEST(CompareStages, Stability) {
  EXPECT_THAT(
      after([](trace::Pair& pair) {
        pair.stability->verdict = "stable";
        pair.stability->margin = -0.25;
        pair.stability->support.pop_back();
        pair.stability->axis.reset();
      }),
      ElementsAre("stability: verdict turns about a line -> stable, support 4 -> 3 vertices, "
                  "margin 0.25 -> -0.25, axis gone"));
  EXPECT_THAT(after([](trace::Pair& pair) { (*pair.stability->axis)[1].x() += 0.5; }),
              ElementsAre("stability: second point of the axis moved 500 mm along x"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.stability.reset(); }),
              ElementsAre("stability gone"));
}

TEST(CompareStages, AReducersChoicesAndItsBestPolygon) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.reduction->best = {0, 2};
              }),
              ElementsAre("reduction: best 0 1 2 3 -> 0 2"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.reduction->choices[1].rule = "distance";
                pair.reduction->choices[1].measures[0].edge = {1, 2};
                pair.reduction->choices[1].measures[0].value = 0.5;
              }),
              ElementsAre("choice 1: rule outside -> distance",
                          "choice 1: measure 0: edge 0 1 -> 1 2, value 0.25 -> 0.50"));
  EXPECT_THAT(after([](trace::Pair& pair) { pair.reduction->choices.pop_back(); }),
              ElementsAre("reduction: number of choices 2 -> 1"));
}

TEST(CompareStages, StepsAndVisitsAreCountedAndHeldAgainstEachOther) {
  EXPECT_THAT(after([](trace::Pair& pair) { pair.gjk->steps.emplace_back(); }),
              ElementsAre("gjk: number of steps 1 -> 2"));
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.tree->visits[0].box.upper.x() += 1;
                pair.tree->visits[0].leaf = false;
              }),
              ElementsAre("tree box 0: upper corner of the box moved 1 m along x, leaf yes -> no"));
}

TEST(CompareStages, ACacheLosesItsNormal) {
  EXPECT_THAT(after([](trace::Pair& pair) {
                pair.cache->normal.reset();
                pair.cache->moved.reset();
              }),
              ElementsAre("cache: normal gone, moved gone"));
}

TEST(CompareStages, MeshManifoldsBelongTogetherByTriangle) {
  trace::Trace expected = sample_trace();
  trace::Pair& pair = sample_pair(expected);
  pair.manifolds[0].triangle = 4;
  pair.manifolds.push_back(pair.manifolds[0]);
  pair.manifolds[1].triangle = 9;
  trace::Trace actual = expected;
  EXPECT_THAT(compare(expected, actual), IsEmpty());
  std::vector<trace::Manifold>& manifolds = sample_pair(actual).manifolds;
  manifolds.erase(manifolds.begin());
  manifolds[0].normal *= -1;
  EXPECT_THAT(compare(expected, actual),
              ElementsAre("manifold of triangle 4 gone", "manifold of triangle 9: normal flipped"));
}

TEST(CompareStages, AStageThatWasNotRecordedBeforeIsSeen) {
  trace::Trace without = sample_trace();
  sample_pair(without).clip.reset();
  sample_pair(without).stability.reset();
  EXPECT_THAT(compare(without, sample_trace()), ElementsAre("clip added", "stability added"));
}

}  // namespace
}  // namespace contactscope::snapshot
