#include "lint/faults.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "lint/worlds.h"
#include "support/temporary_folder.h"
#include "trace/read_trace.h"

/// Faults of engines in traces of Bullet, ODE and MuJoCo, recorded by their adapters: the linter
/// names each, and finds nothing in the traces as they are.
namespace contactscope::lint {
namespace {

using test::World;
using Record = void (*)(const test::Recording&);

Trace recorded_by(Record record, World world, int in_heap = 12) {
  const TemporaryFolder folder;
  test::Recording recording{.world = world, .path = folder / "run.jsonl"};
  if (world == World::Heap) recording.bodies = in_heap, recording.unrecorded = 200;
  record(recording);
  std::ifstream in(recording.path);
  return trace::read_trace(in, recording.path);
}

std::string named_in(const std::vector<Finding>& findings) {
  std::string names;
  for (const Finding& finding : findings) names += finding.cause + " ";
  return names;
}

struct Source {
  const char* name;
  Trace trace;
  std::vector<std::string> known{};  // what is wrong in it, at most
  bool touches = false;              // bodies at rest do not overlap: rounding decides
};
const std::vector<Source>& stacks() {
  static const std::vector<Source> all = {
      {"Bullet, stack", recorded_by(&test::record_in_bullet, World::Stack)},
      {"ODE, stack", recorded_by(&test::record_in_ode, World::Stack)},
#ifdef CONTACTSCOPE_HAS_MUJOCO
      {"MuJoCo, stack", recorded_by(&test::record_in_mujoco, World::Stack)},
#endif
  };
  return all;
}

/// In a heap, Bullet keeps points while boxes slide, and rounds their edges against hulls.
const std::vector<Source>& heaps() {
  static const std::vector<Source> all = {
      {"Bullet, heap",
       recorded_by(&test::record_in_bullet, World::Heap),
       {"surface", "separation"}},
      {"ODE, heap", recorded_by(&test::record_in_ode, World::Heap), {}, true},
#ifdef CONTACTSCOPE_HAS_MUJOCO
      {"MuJoCo, heap", recorded_by(&test::record_in_mujoco, World::Heap)},
#endif
  };
  return all;
}

TEST(LintFaults, TracesOfEnginesAsTheyAreHaveNoFindings) {
  for (const std::vector<Source>* sources : {&stacks(), &heaps()})
    for (const Source& source : *sources) {
      ASSERT_EQ(source.trace.frames.size(), 60u);
      for (const Finding& finding : lint(source.trace))
        EXPECT_THAT(source.known, testing::Contains(finding.cause))
            << source.name << ", " << finding.count << " of " << finding.of << ", frame "
            << finding.frame << ", " << finding.a << "-" << finding.b << ": " << finding.said
            << "; " << finding.is;
    }
}

/// Each fault in every frame (every second one if it is a change), in one frame of 30, and once.
void expect_named_first(const Source& source) {
  constexpr const char* kOften[] = {"always", "rarely", "once"};
  int named = 0, all = 0;
  std::ostringstream misses;
  const std::vector<Target> chosen = targets(source.trace, 1);
  ASSERT_FALSE(chosen.empty()) << source.name;
  const Target& target = chosen.front();
  for (const Fault& fault : faults())
    for (const Often often : {Often::Always, Often::Rarely, Often::Once}) {
      Trace trace = source.trace;
      seed(trace, fault, target, often);
      const std::vector<Finding> findings = lint(trace);
      const std::vector<std::string>& expected =
          often == Often::Always && !fault.always.empty() ? fault.always : fault.causes;
      ++all;
      if (!findings.empty() &&
          std::ranges::find(expected, findings.front().cause) != expected.end()) {
        ++named;
        continue;
      }
      misses << target.a << "-" << target.b << ", " << fault.name << ", "
             << kOften[static_cast<int>(often)] << ": " << named_in(findings) << "\n";
    }
  EXPECT_GE(named, 0.95 * all) << source.name << ": " << named << " of " << all << "\n"
                               << misses.str();
}

TEST(LintFaults, SlowEachIsNamedFirstAlwaysRarelyAndOnce) {
  EXPECT_GE(faults().size(), 20u);
  for (const Source& source : stacks()) expect_named_first(source);
}

TEST(LintFaults, SlowEachIsNamedFirstInHeaps) {
  for (const Source& source : heaps())
    if (!source.touches) expect_named_first(source);
}

TEST(LintFaults, ABodyThatFliesOffIsNamedWithItsFrame) {
  Trace trace = stacks()[0].trace;
  const std::string body = targets(trace, 1).front().body;
  for (std::size_t f = 31; f < 60; ++f) {
    std::erase_if(trace.frames[f].pairs,
                  [&](const trace::Pair& pair) { return pair.a == body || pair.b == body; });
    for (trace::Placement& one : trace.frames[f].poses)
      if (one.first == body) one.second.position.x() += static_cast<double>(f - 30);
  }
  const std::vector<Finding> findings = lint(trace);
  const auto flight = std::ranges::find(findings, "bodies_fly_off", &Finding::cause);
  ASSERT_NE(flight, findings.end()) << named_in(findings);
  // No earlier contact is the cause, so it is the frame in which the body is elsewhere.
  EXPECT_EQ(flight->frame, trace.frames[31].frame);
  EXPECT_THAT(flight->said, testing::HasSubstr("m since the frame before"));
  EXPECT_EQ(flight->a, body);
}

/// Each shape of the heaps that moves, scaled in the trace alone.
TEST(LintFaults, SlowAShapeOfAnotherSizeThanInTheEngineIsNamed) {
  int named = 0, all = 0;
  std::ostringstream misses;
  for (const Source& source : heaps())
    for (std::size_t i = 0; i < source.trace.header.shapes.size(); ++i)
      for (const double factor : {0.8, 1.2}) {
        Trace trace = source.trace;
        trace::Shape& shape = trace.header.shapes[i];
        const auto touches = [&](const trace::Pair& pair) {
          return !pair.manifolds.empty() && (pair.a == shape.name || pair.b == shape.name);
        };
        // One contact has any margin as its cause.
        if (shape.half_space || std::ranges::count_if(trace.frames[0].pairs, touches) < 2) continue;
        const bool is_static =
            trace.frames[0].poses[i].second.position == trace.frames[59].poses[i].second.position;
        if (is_static) continue;
        for (Vec3d& vertex : shape.vertices) vertex *= factor;
        shape.radius *= factor, shape.margin *= factor;
        const std::vector<Finding> findings = lint(trace);
        const char* const cause = factor > 1 ? "shape_too_large" : "shape_too_small";
        const std::string what =
            "'" + shape.name + "' is " + (factor > 1 ? "1.2" : "0.8") + " times";
        ++all;
        if (!findings.empty() && findings[0].cause == cause && findings[0].what.starts_with(what))
          ++named;
        else
          misses << source.name << ", " << what << ": " << named_in(findings)
                 << (findings.empty() ? "" : findings[0].what) << "\n";
      }
  EXPECT_GT(all, 20);
  EXPECT_GE(named, 0.8 * all) << named << " of " << all << "\n" << misses.str();
}

/// A shape that is too large seems to overlap where the engine reports nothing. Other pairs are judged.
TEST(LintFaults, LostContactsOfAShapeThatIsTooLargeAreItsEffect) {
  Trace trace = heaps()[0].trace;
  const std::vector<Target> all = targets(trace, 30);
  const Target own = all.front();
  const auto is_of_own = [&](const std::string& a, const std::string& b) {
    return a == own.body || b == own.body;
  };
  const auto other =
      std::ranges::find_if(all, [&](const Target& one) { return !is_of_own(one.a, one.b); });
  ASSERT_NE(other, all.end());
  for (trace::Shape& shape : trace.header.shapes)
    if (shape.name == own.body) {
      for (Vec3d& vertex : shape.vertices) vertex *= 1.2;
      shape.radius *= 1.2, shape.margin *= 1.2;
    }
  for (const Target& lost : {own, *other})
    for (const std::size_t frame : {20u, 30u, 40u})
      std::erase_if(trace.frames[frame].pairs,
                    [&](const trace::Pair& pair) { return pair.a == lost.a && pair.b == lost.b; });
  const std::vector<Finding> findings = lint(trace);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].cause, "shape_too_large") << named_in(findings);
  const auto flicker = std::ranges::find(findings, "pairs_flicker", &Finding::cause);
  ASSERT_NE(flicker, findings.end()) << named_in(findings);
  EXPECT_EQ(flicker->a + " " + flicker->b, other->a + " " + other->b);
  EXPECT_EQ(flicker->count, 3);
}

/// Each hull of larger heaps with another margin in the trace than in the engine.
TEST(LintFaults, SlowAMarginOfOneHullIsNamedWithItsDifference) {
  int named = 0, all = 0;
  std::ostringstream misses;
  for (const Record record : {&test::record_in_bullet, &test::record_in_ode}) {
    const Trace heap = recorded_by(record, World::Heap, 30);
    for (std::size_t i = 0; i < heap.header.shapes.size(); ++i)
      for (const double off : {-1.0, 0.02, 0.04}) {
        Trace trace = heap;
        trace::Shape& shape = trace.header.shapes[i];
        const auto touches = [&](const trace::Pair& pair) {
          return !pair.manifolds.empty() && (pair.a == shape.name || pair.b == shape.name);
        };
        if (shape.type != "hull" || std::ranges::count_if(trace.frames[0].pairs, touches) < 2)
          continue;
        const double by = std::max(off, -shape.margin);
        if (by == 0) continue;
        shape.margin += by;
        const std::vector<Finding> findings = lint(trace);
        const std::string what = findings.empty() ? "" : findings[0].what;
        const std::string margin = "the margin of '" + shape.name + "' is off by ";
        const std::size_t place = what.find(margin);
        ++all;
        if (place != std::string::npos && std::abs(std::stod(what.substr(place + margin.size())) -
                                                   std::abs(by)) < 0.1 * std::abs(by))
          ++named;
        else
          misses << shape.name << ", " << by << ": " << named_in(findings) << what << "\n";
      }
  }
  EXPECT_GT(all, 10);
  EXPECT_GE(named, 0.8 * all) << named << " of " << all << "\n" << misses.str();
}

/// No convention of the recorder makes one pair wrong, and all others of its bodies right.
TEST(LintFaults, DepthsOfOnePairThatAreAlwaysWrongAreNoConvention) {
  for (const Source& source : stacks())
    for (const Target& target : targets(source.trace, 10)) {
      SCOPED_TRACE(source.name + (" " + target.a) + "-" + target.b);
      Trace trace = source.trace;
      int count = 0;
      for (trace::Frame& frame : trace.frames)
        for (trace::Pair& pair : frame.pairs)
          if (pair.a == target.a && pair.b == target.b && ++count > 0)
            for (trace::Manifold& manifold : pair.manifolds)
              for (trace::Point& point : manifold.points) point.separation = -0.1;
      const std::vector<Finding> findings = lint(trace);
      ASSERT_EQ(named_in(findings), "separation ");
      EXPECT_EQ(findings[0].count, count);
      EXPECT_EQ(findings[0].a, target.a);
      EXPECT_EQ(findings[0].b, target.b);
    }
}

TEST(LintFaults, ManyBodiesThatFlyOffAreNamedWithTheOverlapBefore) {
  Trace trace = recorded_by(&test::record_in_bullet, World::Heap);
  std::vector<std::string> bodies;
  for (const trace::Body& body : trace.frames[0].solver->bodies)
    if (bodies.size() < 7) bodies.push_back(body.name);
  std::ranges::sort(bodies);
  for (std::size_t f = 31; f < 60; ++f)
    for (trace::Placement& one : trace.frames[f].poses)
      if (std::ranges::find(bodies, one.first) != bodies.end())
        one.second.position.y() += 3 * static_cast<double>(f - 30);
  for (trace::Pair& pair : trace.frames[30].pairs)
    if (std::ranges::find(bodies, pair.a) != bodies.end() ||
        std::ranges::find(bodies, pair.b) != bodies.end())
      for (trace::Manifold& manifold : pair.manifolds) manifold.points[0].separation = -0.3;
  const std::vector<Finding> findings = lint(trace);
  const auto flight = std::ranges::find(findings, "bodies_fly_off", &Finding::cause);
  ASSERT_NE(flight, findings.end()) << named_in(findings);
  EXPECT_EQ(flight->count, 7);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    EXPECT_EQ(flight->what.find("'" + bodies[i] + "'") != std::string::npos, i < 5) << flight->what;
  EXPECT_THAT(flight->what, testing::EndsWith(" and 2 others"));
  EXPECT_THAT(flight->said, testing::HasSubstr("after an overlap of 0.3 m with '"));
  EXPECT_THAT(flight->said, testing::HasSubstr("in frame " + std::to_string(flight->frame)));
}

/// A stack at rest for an hour: one of its pairs in one frame is less than 0.01 %.
Trace long_stack(int times = 60) {
  Trace trace = stacks()[0].trace;
  const std::vector<trace::Frame> frames = trace.frames;
  const double step = frames[1].time - frames[0].time;
  for (int n = 1; n < times; ++n)
    for (const trace::Frame& frame : frames) trace.frames.push_back(frame);
  for (int f = 0; f < count_of(trace.frames); ++f)
    at(trace.frames, f).frame = f, at(trace.frames, f).time = f * step;
  return trace;
}

/// Small ones may be rounding, and stay below the threshold.
TEST(LintFaults, AGrossOneIsReportedHoweverRareItIs) {
  const Trace clean = long_stack();
  EXPECT_EQ(named_in(lint(clean)), "");
  const Target target = targets(clean, 1).front();
  const std::vector<std::pair<std::string, bool>> expected = {{"separations are 100 mm less", true},
                                                              {"separations are 1 mm less", false},
                                                              {"normals turn by 30 degrees", true},
                                                              {"normals turn by 8 degrees", false}};
  for (const auto& [name, is_gross] : expected) {
    const auto fault = std::ranges::find(faults(), name, &Fault::name);
    ASSERT_NE(fault, faults().end());
    Trace trace = clean;
    seed(trace, *fault, target, Often::Once);
    const std::vector<Finding> findings = lint(trace);
    EXPECT_EQ(!findings.empty() && findings[0].cause == fault->causes[0], is_gross)
        << name << ": " << named_in(findings);
    if (is_gross && !findings.empty()) {
      EXPECT_EQ(findings[0].frame, count_of(trace.frames) / 2) << name;
    }
    const std::vector<Finding> all = lint(trace, {.strict = true});
    EXPECT_NE(std::ranges::find(all, fault->causes[0], &Finding::cause), all.end()) << name;
  }
}

/// As rare ones of the same cause that are nearly as large show, the engine does this now and then.
TEST(LintFaults, ARareOneLikeOthersOfTheTraceStaysBelowTheThreshold) {
  Trace trace = long_stack(80);
  const Target target = targets(trace, 1).front();
  for (const auto& [frame, metres] : {std::pair(1000, 0.0015), {2000, 0.008}})
    for (trace::Pair& pair : at(trace.frames, frame).pairs)
      if (pair.a == target.a && pair.b == target.b)
        for (trace::Manifold& manifold : pair.manifolds)
          for (trace::Point& point : manifold.points) point.separation -= metres;
  const std::vector<Finding> findings = lint(trace);
  EXPECT_EQ(named_in(findings), "");
}

/// A mistake in some pairs does not hide what happens in others.
TEST(LintFaults, AFaultInAPairIsNamedNextToAMistakeInOthers) {
  const Trace clean = long_stack(4);
  const std::vector<Target> both = targets(clean, 2);
  ASSERT_EQ(both.size(), 2u);
  const auto each_point = [](Trace& trace, const Target& target, const auto& change) {
    for (trace::Frame& frame : trace.frames)
      for (trace::Pair& pair : frame.pairs)
        if (std::minmax(pair.a, pair.b) == std::minmax(target.a, target.b))
          for (trace::Manifold& manifold : pair.manifolds) change(frame, manifold);
  };
  for (const bool same : {false, true}) {
    Trace trace = clean;
    each_point(trace, both[0], [](auto&, auto& manifold) { manifold.normal = -manifold.normal; });
    each_point(trace, both[same ? 0 : 1], [](auto& frame, auto& manifold) {
      for (trace::Point& point : manifold.points) point.separation -= 0.02 * (frame.frame % 2);
    });
    const std::vector<Finding> findings = lint(trace);
    const auto jump = std::ranges::find(findings, "depths_jump", &Finding::cause);
    EXPECT_NE(std::ranges::find(findings, "flipped_normals", &Finding::cause), findings.end());
    ASSERT_EQ(jump == findings.end(), same) << named_in(findings);
    if (same) continue;
    EXPECT_EQ(std::set({jump->a, jump->b}), std::set({both[1].a, both[1].b}));
  }
}

/// Engines approximate now and then, and never by the same amount for long.
TEST(LintFaults, APairThatIsOffByTheSameAmountForLongIsNamedHoweverRareItIs) {
  const Trace clean = long_stack(80);
  const Target target = targets(clean, 1).front();
  for (const double varied : {0.0, 0.4}) {
    Trace trace = clean;
    for (int f = 1000; f < 1030; ++f)
      for (trace::Pair& pair : at(trace.frames, f).pairs)
        if (pair.a == target.a && pair.b == target.b)
          for (trace::Manifold& manifold : pair.manifolds)
            for (trace::Point& point : manifold.points)
              point.separation -= 0.01 * (1 + varied * (f % 2));
    const std::vector<Finding> findings = lint(trace);
    const auto found = std::ranges::find(findings, "separation", &Finding::cause);
    ASSERT_EQ(found == findings.end(), varied > 0) << named_in(findings);
    if (varied > 0) continue;
    EXPECT_EQ(found, findings.begin()) << named_in(findings);
    EXPECT_EQ(found->frame, 1000);
    EXPECT_GE(found->count, 29);  // the first one is a jump too
    EXPECT_EQ(std::set({found->a, found->b}), std::set({target.a, target.b}));
  }
}

TEST(LintFaults, EveryOccurrenceInTheRequestedFramesIsMarked) {
  // So many that a sample would leave out most of them.
  Trace trace = long_stack();
  for (trace::Frame& frame : trace.frames)
    for (trace::Pair& pair : frame.pairs)
      for (trace::Manifold& manifold : pair.manifolds) manifold.normal = -manifold.normal;
  const int last = trace.frames.back().frame;
  for (const Finding& finding :
       lint(trace, {.is_marked = [&](int frame) { return frame == 7 || frame == last - 1; }})) {
    if (finding.cause != "flipped_normals") continue;
    std::set<std::pair<int, std::string>> marked, expected;
    for (const Mark& mark : finding.marks) marked.emplace(mark.frame, mark.a + "-" + mark.b);
    for (const int frame : {7, last - 1})
      for (const trace::Pair& pair : at(trace.frames, frame).pairs)
        expected.emplace(frame, pair.a + "-" + pair.b);
    EXPECT_EQ(marked, expected);
    return;
  }
  ADD_FAILURE() << "the flipped normals are not named";
}

TEST(LintFaults, AFindingHasAMarkForEachFrameAndCanBeIgnored) {
  Trace trace = stacks()[0].trace;
  const Target target = targets(trace, 1).front();
  seed(trace, faults().front(), target, Often::Rarely);
  const auto found = [&](const LintOptions& options) { return lint(trace, options); };
  const std::vector<Finding> findings = found({});
  ASSERT_FALSE(findings.empty());
  ASSERT_EQ(findings[0].marks.size(), 2u);
  EXPECT_EQ(findings[0].marks[0].frame, trace.frames[20].frame);
  EXPECT_EQ(findings[0].marks[1].frame, trace.frames[50].frame);
  EXPECT_EQ(findings[0].marks[1].b, target.b);
  const std::string cause = findings[0].cause;
  const auto is_named = [&](const std::vector<Finding>& all) {
    return std::ranges::find(all, cause, &Finding::cause) != all.end();
  };
  EXPECT_FALSE(is_named(found({.ignored = {{cause}}})));
  EXPECT_FALSE(is_named(found({.ignored = {{cause, target.b}}})));
  EXPECT_TRUE(is_named(found({.ignored = {{cause, "another"}}})));
}

TEST(LintFaults, WhatIsBelowAThresholdIsCountedAndStrictReportsIt) {
  Trace trace = stacks()[0].trace;
  trace::Point& point = trace.frames[30].pairs[0].manifolds[0].points[0];
  point.position.y() += 0.004;
  Linter linter(trace.header);
  for (const trace::Frame& frame : trace.frames) linter.look_at(frame);
  const std::vector<Finding> all = linter.findings();
  const auto below = std::ranges::find(all, "surface", &Finding::cause);
  ASSERT_NE(below, all.end()) << named_in(all);
  EXPECT_EQ(below->count, 1);
  EXPECT_FALSE(below->below.empty());
  EXPECT_EQ(named_in(lint(trace)), "");
  EXPECT_EQ(named_in(lint(trace, {.strict = true})), "surface ");
  EXPECT_EQ(named_in(lint(trace, {.strict = true, .tolerance = 0.01})), "");
}

/// A coarser tolerance only hides: no cause is added, and none is counted more often.
TEST(LintFaults, SlowFindingsBecomeFewerAsTheToleranceGrows) {
  for (const std::vector<Source>* sources : {&stacks(), &heaps()})
    for (const Source& source : *sources) {
      const std::vector<Target> chosen = targets(source.trace, 1);
      if (chosen.empty()) continue;
      for (std::size_t f = 0; f <= faults().size(); f += 2) {
        Trace trace = source.trace;
        if (f < faults().size()) seed(trace, faults()[f], chosen.front(), Often::Rarely);
        std::map<std::string, int> last;
        for (const double tolerance : {0.0, 0.003, 0.006, 0.02, 0.5}) {
          std::map<std::string, int> counts;
          for (const Finding& one : lint(trace, {.tolerance = tolerance}))
            counts[one.cause] += one.count;
          for (const auto& [cause, count] : counts)
            EXPECT_TRUE(tolerance == 0 || (last.contains(cause) && count <= last[cause]))
                << source.name << ", " << (f < faults().size() ? faults()[f].name : "as it is")
                << ", " << tolerance << ": " << count << " " << cause;
          last = std::move(counts);
        }
      }
    }
}

/// A normal that is grossly wrong in all frames is named before an impulse that is missing once.
TEST(LintFaults, ANormalThatIsAlwaysWrongIsNamedBeforeAnImpulseThatFlickers) {
  Trace trace = stacks()[1].trace;
  const Target target = targets(trace, 1).at(0);
  for (trace::Frame& frame : trace.frames)
    for (trace::Pair& pair : frame.pairs) {
      if (pair.a != target.a || pair.b != target.b) continue;
      for (trace::Manifold& manifold : pair.manifolds) {
        manifold.normal = (manifold.normal + 0.35 * Vec3d::UnitX()).normalized();
        for (trace::Point& point : manifold.points)
          if (frame.frame == trace.frames[30].frame) point.impulse = trace::Impulse{};
      }
    }
  const std::string named = named_in(lint(trace));
  EXPECT_TRUE(named.starts_with("normal ")) << named;
  EXPECT_THAT(named, testing::HasSubstr("impulses_flicker"));
}

/// Bullet keeps a point of each body, and reports the middle. Here a crate of 1 m has slid, so that
/// the point halfway is next to the crate.
TEST(LintFaults, APointThatIsKeptIsBetweenThePointsOfItsBodies) {
  const auto named = [](double slid, double on_b_at, double separation) {
    Trace trace;
    trace.header.up = "y";
    for (const auto& [name, half] :
         {std::pair("floor", Vec3d(3, 0.5, 3)), {"crate", {0.5, 0.5, 0.5}}}) {
      trace::Shape& box = trace.header.shapes.emplace_back();
      box.name = name, box.type = "box";
      for (int i = 0; i < 8; ++i)
        box.vertices.push_back(
            half.cwiseProduct(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
      box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                   {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    }
    for (int f = 0; f < 10; ++f) {
      trace::Frame& frame = trace.frames.emplace_back();
      frame.frame = f, frame.time = f / 60.0, frame.line = f + 2;
      for (const auto& [name, y] : {std::pair("floor", 0.0), {"crate", 1.0}}) {
        Pose<double> pose;
        pose.position.y() = y;
        frame.poses.emplace_back(name, pose);
      }
      trace::Pair& pair = frame.pairs.emplace_back();
      pair.a = "floor", pair.b = "crate", pair.state = "touching";
      trace::Manifold& manifold = pair.manifolds.emplace_back();
      manifold.normal = Vec3d::UnitY();
      for (const double z : {-0.5, 0.5})
        for (const double side : {-1.0, 1.0}) {
          trace::Point& point = manifold.points.emplace_back();
          point.on_b = Vec3d(side * on_b_at, 0.5, z);
          point.on_a = Vec3d(side * (0.5 + slid), 0.5, z);
          point.position = (*point.on_a + *point.on_b) / 2;
          point.separation = separation;
        }
    }
    return named_in(lint(trace));
  };
  EXPECT_EQ(named(0, 0.5, 0), "");
  EXPECT_EQ(named(0.01, 0.5, 0), "") << "halfway it is 5 mm beside the crate";
  EXPECT_NE(named(0.01, 0.51, 0), "") << "none is on the crate";
  EXPECT_NE(named(0.2, 0.5, 0), "") << "too far to be one contact";
  EXPECT_NE(named(0.01, 0.5, 0.01), "") << "another separation than that of the two points";
}

}  // namespace
}  // namespace contactscope::lint
