#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "lint/recorded.h"

/// Typical mistakes of trace writers, each inserted into correct traces: the linter names it.
namespace contactscope::lint {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using trace::Trace;

Mistaken separations_times(double factor) {
  return [=](Trace& trace) {
    each_point(trace, [&](auto&, auto&, trace::Point& point) { point.separation *= factor; });
  };
}

void flip_normals(Trace& trace) {
  each_manifold(trace, [](auto&, auto&, trace::Manifold& m) { m.normal = -m.normal; });
}

Mistaken points_in_frame_of(std::string trace::Pair::*shape) {
  return [=](Trace& trace) {
    each_point(trace, [&](trace::Frame& frame, trace::Pair& pair, trace::Point& point) {
      point.position = pose_of(frame, pair.*shape).inverse_transform(point.position);
    });
  };
}

Mistaken normals_in_frame_of(std::string trace::Pair::*shape) {
  return [=](Trace& trace) {
    each_manifold(trace, [&](trace::Frame& frame, trace::Pair& pair, trace::Manifold& manifold) {
      manifold.normal = pose_of(frame, pair.*shape).inverse_rotate(manifold.normal);
    });
  };
}

Mistaken rotations_by(const std::function<Quat<double>(const Quat<double>&)>& change) {
  return [=](Trace& trace) {
    for (trace::Frame& frame : trace.frames)
      for (auto& [name, pose] : frame.poses) pose.rotation = change(pose.rotation);
  };
}

Quat<double> written_xyzw(const Quat<double>& q) { return {q.x(), q.y(), q.z(), q.w()}; }

Mistaken shapes_times(double factor) {
  return [=](Trace& trace) {
    for (trace::Shape& shape : trace.header.shapes) {
      for (Vec3d& vertex : shape.vertices) vertex *= factor;
      shape.radius *= factor;
    }
  };
}

void poses_after_the_step(Trace& trace) {
  for (std::size_t f = 0; f + 1 < trace.frames.size(); ++f)
    trace.frames[f].poses = trace.frames[f + 1].poses;
  trace.frames.pop_back();
}

void poses_of_the_step_before(Trace& trace) {
  for (std::size_t f = trace.frames.size() - 1; f > 0; --f)
    trace.frames[f].poses = trace.frames[f - 1].poses;
  trace.frames.erase(trace.frames.begin());
}

/// Shapes whose origin is not their centre of mass, with poses of the centre of mass.
void poses_of_the_center_of_mass(Trace& trace) {
  const Vec3d offset(0.3, 0.1, -0.2);
  for (trace::Shape& shape : trace.header.shapes) {
    if (shape.half_space) continue;  // it has no centre
    for (Vec3d& vertex : shape.vertices) vertex += offset;
    shape.center_of_mass += offset;
  }
}

/// Scales everything that has a length, as if the world had other units.
Mistaken world_times(double factor) {
  return [=](Trace& trace) {
    shapes_times(factor)(trace);
    for (trace::Shape& shape : trace.header.shapes) shape.center_of_mass *= factor;
    for (trace::Frame& frame : trace.frames) {
      for (auto& [name, pose] : frame.poses) pose.position *= factor;
      frame.solver.reset();
    }
    each_point(trace, [&](auto&, auto&, trace::Point& point) {
      point.position *= factor;
      point.separation *= factor;
    });
  };
}

Mistaken impulses_times(double factor) {
  return [=](Trace& trace) {
    each_point(trace, [&](auto&, auto&, trace::Point& point) {
      if (!point.impulse) return;
      point.impulse->normal *= factor;
      point.impulse->friction *= factor;
    });
  };
}

void ids_by_chance(Trace& trace) {
  int next = 0;
  each_point(trace, [&](auto&, auto&, trace::Point& point) {
    point.id = "a:v" + std::to_string(next++) + " b:f0";
  });
}

void no_contacts_in_half_of_the_frames(Trace& trace) {
  for (std::size_t f = 0; f < trace.frames.size(); f += 2) trace.frames[f].pairs.clear();
}

void with_noise(Trace& trace) {
  each_pair(trace, [](trace::Frame& frame, trace::Pair& pair) {
    if (frame.line % 2 == 0) return;
    pair.manifolds.clear();
    pair.state = "separated";
  });
}

void sides_swapped(Trace& trace) {
  each_manifold(trace, [](auto&, auto&, trace::Manifold& manifold) {
    for (trace::Point& point : manifold.points) {
      // Each is far enough from the other that it cannot be on both surfaces.
      point.on_a = point.position + 0.5 * point.separation * manifold.normal;
      point.on_b = point.position - 0.5 * point.separation * manifold.normal;
    }
  });
}

void deepest_is_dropped(Trace& trace) {
  each_manifold(trace, [](auto&, auto&, trace::Manifold& manifold) {
    if (manifold.points.size() < 2) return;
    manifold.points.erase(std::ranges::min_element(manifold.points, {}, &trace::Point::separation));
  });
}

std::vector<Seed> seeds() {
  using trace::Pair;
  return {
      {"flipped normals", heap, flip_normals, "flipped_normals"},
      {"flipped normals on a mesh", terrain, flip_normals, "flipped_normals"},
      {"depths", heap, separations_times(-1), "positive_depths"},
      {"depths on a mesh", terrain, separations_times(-1), "positive_depths"},
      {"half", heap, separations_times(0.5), "half_depths"},
      {"half of overlaps below any tolerance", stack, separations_times(0.5), "half_depths"},
      {"twice", heap, separations_times(2), "double_depths"},
      {"depths in centimetres", heap, separations_times(100), "depths_in_centimetres"},
      {"depths in millimetres", heap, separations_times(1000), "depths_in_millimetres"},
      {"points of a", heap, points_in_frame_of(&Pair::a), "points_in_frame_of_a"},
      {"points of b", heap, points_in_frame_of(&Pair::b), "points_in_frame_of_b"},
      {"points of b on a mesh", terrain, points_in_frame_of(&Pair::b), "points_in_frame_of_b"},
      {"points in millimetres", heap,
       [](Trace& trace) {
         each_point(trace, [](auto&, auto&, trace::Point& point) { point.position *= 1000; });
       },
       "points_in_millimetres"},
      {"normals of b", heap, normals_in_frame_of(&Pair::b), "normals_in_frame_of_b"},
      {"w last", heap, rotations_by(written_xyzw), "quaternions_xyzw"},
      {"w last of boxes that stand upright", stack, rotations_by(written_xyzw), "quaternions_xyzw"},
      {"inverted rotations", heap, rotations_by([](const auto& q) { return q.conjugate(); }),
       "inverse_rotations"},
      {"whole extents as half ones", heap, shapes_times(2), "shapes_twice_as_large"},
      {"half extents as whole ones", heap, shapes_times(0.5), "shapes_half_as_large"},
      {"shapes in centimetres", heap, shapes_times(100), "shapes_in_centimetres"},
      {"poses after the step", heap, poses_after_the_step, "poses_of_frame_before"},
      {"poses a step late", heap, poses_of_the_step_before, "poses_of_frame_after"},
      {"poses of the centre of mass", heap, poses_of_the_center_of_mass, "poses_of_center_of_mass"},
      {"a margin", heap,
       [](Trace& trace) {
         each_point(trace, [](auto&, auto&, trace::Point& point) { point.separation -= 0.04; });
       },
       "margin_added"},
      // In another unit these separations would fit as well, being small.
      {"a margin taken off", heap,
       [](Trace& trace) {
         each_point(trace, [](auto&, auto&, trace::Point& point) { point.separation += 0.02; });
       },
       "margin_taken_off"},
      {"contacts left out", heap, no_contacts_in_half_of_the_frames, "pairs_flicker"},
      {"told apart", heap, with_noise, "overlap_told_apart"},
      {"ids by chance", stack, ids_by_chance, "ids_change"},
      {"another axis up", heap, [](Trace& trace) { trace.header.up = "z"; }, "up_axis"},
      {"centimetres", heap, world_times(100), "world_in_centimetres"},
      {"millimetres", heap, world_times(1000), "world_in_millimetres"},
      {"forces", stack, impulses_times(60), "impulses_are_forces"},
      {"impulses on a", stack, impulses_times(-1), "impulses_on_a"},
      {"half of the impulses", stack, impulses_times(0.5), "impulses_halved"},
      {"sides swapped", heap, sides_swapped, "sides_swapped"},
      {"deepest dropped", heap, deepest_is_dropped, "deepest"},
  };
}

TEST(Lint, CorrectTracesHaveNoFindings) {
  for (const Trace* trace : {&heap(), &stack(), &terrain()})
    EXPECT_THAT(causes_of(lint(*trace)), IsEmpty()) << trace->header.scenario;
}

TEST(Lint, SlowEachMistakeIsNamed) {
  for (const Seed& seed : seeds()) expect_named(seed);
}

/// In one frame, one crate of the stack hangs in the air above its recorded contact points.
TEST(Lint, ABoxThatFloatsAboveItsPointsIsNamedWithItsFrame) {
  Trace trace = stack();
  trace::Frame& frame = trace.frames[20];
  const std::string top = frame.pairs.back().b;
  pose_of(frame, top).position.y() += 0.04;
  const std::vector<Finding> findings = lint(trace);
  ASSERT_EQ(findings.size(), 1u) << testing::PrintToString(causes_of(findings));
  EXPECT_EQ(findings[0].cause, "poses_jump");
  EXPECT_EQ(findings[0].line, 22);
  EXPECT_EQ(findings[0].frame, frame.frame);
  EXPECT_EQ(findings[0].count, 1);
  EXPECT_EQ(findings[0].a, top);
  EXPECT_THAT(findings[0].said, HasSubstr("0.04"));
}

/// In a single frame, in which nothing falls, masses reveal the unit.
TEST(Lint, AWorldInMillimetresIsKnownByItsMasses) {
  Trace trace = stack();
  const std::optional<trace::Solver> solver = trace.frames[3].solver;
  world_times(1000)(trace);
  trace.frames = {trace.frames[3]};
  trace.frames[0].solver = solver;
  each_point(trace, [](auto&, auto&, trace::Point& point) { point.impulse.reset(); });
  EXPECT_THAT(causes_of(lint(trace)), testing::ElementsAre("world_in_millimetres"));
}

TEST(Lint, OneFlippedNormalAmongManyIsNamed) {
  Trace trace = heap();
  trace::Pair& pair = trace.frames[30].pairs[3];
  ASSERT_FALSE(pair.manifolds.empty());
  pair.manifolds[0].normal = -pair.manifolds[0].normal;
  const std::vector<Finding> findings = lint(trace);
  ASSERT_EQ(findings.size(), 1u) << testing::PrintToString(causes_of(findings));
  EXPECT_EQ(findings[0].cause, "flipped_normals");
  EXPECT_EQ(findings[0].line, 32);
  EXPECT_EQ(findings[0].a + findings[0].b, pair.a + pair.b);
}

/// Some are half as deep by chance; a convention of the recorder would halve nearly all of a pair.
TEST(Lint, AFewSeparationsOfEachPairThatAreHalfAreNoConvention) {
  Trace trace = heap();
  const Trace whole = trace;
  separations_times(0.5)(trace);
  for (std::size_t f = 5; f < trace.frames.size(); ++f) trace.frames[f] = whole.frames[f];
  EXPECT_THAT(causes_of(lint(trace)), testing::Not(Contains("half_depths")));
}

/// The last line of a truncated trace has one neighbouring frame fewer; around a frame that is
/// missing in the middle, there is none to compare with.
TEST(Lint, FramesThatAreMissingAreNoFault) {
  Trace trace = heap();
  trace.frames.erase(trace.frames.begin() + 5, trace.frames.begin() + 9);
  EXPECT_THAT(causes_of(lint(trace)), IsEmpty());
}

/// As MuJoCo halves the depths of two boxes: that is no reason to overlook a ball.
TEST(Lint, AnErrorOfAnotherKindOfPairsIsNamedToo) {
  Trace trace = heap();
  const auto type_of = [&](const std::string& name) {
    return std::ranges::find(trace.header.shapes, name, &trace::Shape::name)->type;
  };
  each_point(trace, [&](auto&, const trace::Pair& pair, trace::Point& point) {
    if (type_of(pair.a) == "box" && type_of(pair.b) == "box") point.separation *= 0.5;
  });
  const auto has_ball = [&](const trace::Pair& pair) {
    return !pair.manifolds.empty() && type_of(pair.b) == "sphere";
  };
  std::vector<trace::Pair>& pairs = trace.frames[40].pairs;
  const auto changed = std::ranges::find_if(pairs, has_ball);
  ASSERT_NE(changed, pairs.end());
  for (trace::Point& point : changed->manifolds[0].points) point.separation -= 0.1;
  const std::vector<Finding> findings = lint(trace);
  EXPECT_THAT(causes_of(findings), testing::UnorderedElementsAre("half_depths", "separation"));
  const auto separation = std::ranges::find(findings, "separation", &Finding::cause);
  ASSERT_NE(separation, findings.end());
  EXPECT_EQ(separation->line, 42);
  EXPECT_EQ(separation->a + separation->b, changed->a + changed->b);
  EXPECT_THAT(separation->what, testing::EndsWith(": all are 0.1 m too deep"));
}

/// The effects of a cause that is ignored are no findings of their own.
TEST(Lint, IgnoringACauseAddsNoFinding) {
  for (const double factor : {0.5, 0.0}) {
    Trace trace = heap();
    separations_times(factor)(trace);
    std::vector<std::string> rest = causes_of(lint(trace));
    LintOptions options;
    options.ignored.push_back({rest.at(0), ""});
    rest.erase(rest.begin());
    EXPECT_EQ(causes_of(lint(trace, options)), rest) << factor;
  }
}

TEST(Lint, TwoMistakesAtOnceAreBothNamed) {
  Trace trace = heap();
  flip_normals(trace);
  separations_times(-1)(trace);
  EXPECT_THAT(causes_of(lint(trace)), Contains("flipped_normals"));
  EXPECT_THAT(causes_of(lint(trace)), Contains("positive_depths"));
}

}  // namespace
}  // namespace contactscope::lint
