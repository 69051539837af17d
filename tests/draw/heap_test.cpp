// Pictures of many bodies: the camera, the mark that stands out, and panels that rank and count.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "draw/drawn_texts.h"
#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/pen.h"
#include "draw/scene/scene.h"
#include "draw/staging.h"
#include "draw/strip.h"

namespace contactscope::draw {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

trace::Shape box(const std::string& name, const Vec3d& half) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i)
    shape.vertices.push_back(
        half.cwiseProduct(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return shape;
}

Pose<double> at(const Vec3d& position) {
  Pose<double> pose;
  pose.position = position;
  return pose;
}

/// Crates in a square on a floor, each with one contact point; overlaps differ.
struct Heap {
  trace::Header header;
  std::vector<trace::Frame> frames{1};
  View view;

  explicit Heap(int side, double floor = 3) {
    header.scenario = "engine/run";
    header.up = "y";
    header.title =
        "{kept:point}, {overlap} deep | {kept:point}, {gap} apart | "
        "{kept:point}, no overlap | nothing touches";
    header.shapes.push_back(box("floor", {floor, 0.1, floor}));
    frames[0].poses.emplace_back("floor", at({0, -0.1, 0}));
    for (int i = 0; i < side * side; ++i) {
      const std::string name = "crate_" + std::to_string(i);
      header.shapes.push_back(box(name, {0.25, 0.25, 0.25}));
      const Vec3d place(0.7 * (i % side - 0.5 * (side - 1)), 0.25,
                        0.7 * (i / side - 0.5 * (side - 1)));
      frames[0].poses.emplace_back(name, at(place));
      touch("floor", name, place - Vec3d(0, 0.25, 0), -0.001 * ((7 * i) % (side * side) + 1));
    }
    view.focus = Focus::Shapes;
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  }

  void touch(const std::string& a, const std::string& b, const Vec3d& point, double separation) {
    trace::Pair& pair = frames[0].pairs.emplace_back();
    pair.a = a;
    pair.b = b;
    pair.kind = "hull-hull";
    pair.state = "touching";
    pair.separation = separation;
    trace::Manifold& manifold = pair.manifolds.emplace_back();
    manifold.normal = Vec3d::UnitY();
    manifold.points = {{point, separation, "id"}};
  }

  /// Moves a crate without a contact.
  void throw_off(int crate, const Vec3d& to) {
    const std::string name = "crate_" + std::to_string(crate);
    for (auto& [shape, pose] : frames[0].poses)
      if (shape == name) pose.position = to;
    std::erase_if(frames[0].pairs, [&](const trace::Pair& pair) { return pair.b == name; });
  }

  Staging staged(bool as_trace = true) const {
    const FittedFrames fitted{frames};
    return stage(header, frames, view, 1280, 720, {}, kLayers, {}, as_trace ? &fitted : nullptr);
  }
  double pixels_per_metre(bool as_trace = true) const {
    return staged(as_trace).camera.pixels_per_metre(Vec3d::Zero());
  }
};

TEST(HeapCamera, BodiesThatFlyOffDoNotShrinkTheRest) {
  Heap heap(7);
  const double before = heap.pixels_per_metre();
  EXPECT_THAT(words(illustrate(heap.staged(), heap.frames[0])),
              Not(Contains(HasSubstr("left the view"))));
  heap.throw_off(3, {40, 3, 0});
  heap.throw_off(17, {-900, 2e4, 30});
  heap.throw_off(24, {5, -1e9, 1});
  EXPECT_NEAR(heap.pixels_per_metre(), before, 0.02 * before);
  EXPECT_THAT(words(illustrate(heap.staged(), heap.frames[0])),
              Contains("3 shapes have left the view"));
}

TEST(HeapCamera, AScenarioLosesABodyOnlyIfItFliesFarOff) {
  Heap heap(7);
  const double before = heap.pixels_per_metre(false);
  heap.throw_off(3, {12, 3, 0});
  EXPECT_LT(heap.pixels_per_metre(false), 0.6 * before) << "the crate is in view";
  heap.throw_off(3, {1e4, 3, 0});
  EXPECT_NEAR(heap.pixels_per_metre(false), before, 0.05 * before);
}

TEST(HeapCamera, AWideFloorDoesNotCount) {
  const Heap small(6, 3), wide(6, 300);
  EXPECT_GT(wide.pixels_per_metre(), 0.9 * small.pixels_per_metre());
  EXPECT_LT(wide.pixels_per_metre(false), 0.1 * small.pixels_per_metre(false));
}

TEST(HeapCamera, FramesTheShapesInFocus) {
  Heap heap(7, 12);
  const auto share = [](const Staging& staging, const Vec3d& center) {
    EXPECT_TRUE(staging.camera.sees(center));
    return 0.5 * staging.camera.pixels_per_metre(center) / staging.layout.view.height;
  };
  heap.view.focus_on = {"crate_8", "floor"};
  EXPECT_GT(share(heap.staged(), heap.frames[0].poses[9].second.position), 0.2);
  heap.view.focus_on.clear();
  heap.touch("crate_30", "crate_31", heap.frames[0].poses[31].second.position, -0.2);
  heap.view.focus = Focus::Deepest;
  const Staging staging = heap.staged();
  EXPECT_EQ(staging.view.focus_on, (std::vector<std::string>{"crate_30", "crate_31"}));
  EXPECT_GT(share(staging, heap.frames[0].poses[31].second.position), 0.15);
}

TEST(HeapCamera, AStripFramesTheHeapOfItsCells) {
  Heap heap(7);
  heap.frames.push_back(heap.frames[0]);
  heap.frames[1].frame = 1;
  const auto pixels_per_metre = [&](bool as_trace) {
    const FittedFrames fitted{heap.frames};
    const Strip strip(heap.header, heap.frames, heap.frames, heap.view, 1200, 0, 2, {},
                      as_trace ? &fitted : nullptr);
    return strip.cell().camera.pixels_per_metre(Vec3d::Zero());
  };
  const double before = pixels_per_metre(true);
  heap.frames[1].poses[4].second.position = {12, 3, 0};
  std::erase_if(heap.frames[1].pairs, [](const trace::Pair& pair) { return pair.b == "crate_3"; });
  EXPECT_NEAR(pixels_per_metre(true), before, 0.02 * before);
  EXPECT_LT(pixels_per_metre(false), 0.6 * before) << "of a scenario, the crate is in view";
}

TEST(HeapFocus, TheWorstOverlapIsForTheSizeOfTheSmallerBody) {
  Heap heap(5);
  heap.header.shapes.push_back(box("pebble", {0.02, 0.02, 0.02}));
  heap.frames[0].poses.emplace_back("pebble", at({0, 0.52, 0}));
  heap.touch("crate_12", "pebble", {0, 0.5, 0}, -0.01);
  heap.view.focus = Focus::Worst;
  EXPECT_EQ(heap.staged().view.focus_on, (std::vector<std::string>{"crate_12", "pebble"}));
  heap.view.focus = Focus::Deepest;
  EXPECT_EQ(heap.staged().view.focus_on.at(0), "floor");
}

TEST(HeapMarks, OnePointStandsOutAndTheOthersHaveAnAreaByOverlap) {
  const Heap heap(6);
  const Sketch sketch = sketch_frame(heap.staged(), heap.frames[0]);
  EXPECT_EQ(sketch.arrows.size(), 1u) << "the normal of the deepest point";
  const auto ring = std::ranges::find(sketch.marks, MarkKind::WideRing, &Mark::kind);
  ASSERT_NE(ring, sketch.marks.end());
  std::map<long, float> sizes;  // by overlap, millimetres
  const trace::Point* deepest = nullptr;
  for (const trace::Pair& pair : heap.frames[0].pairs) {
    const trace::Point& point = pair.manifolds[0].points[0];
    if (deepest == nullptr || point.separation < deepest->separation) deepest = &point;
    for (const Mark& mark : sketch.marks)
      if (mark.at == point.position && mark.kind != MarkKind::WideRing)
        sizes[std::lround(-1000 * point.separation)] = mark.size;
  }
  EXPECT_EQ(ring->at, deepest->position);
  ASSERT_EQ(sizes.size(), 36u);
  EXPECT_TRUE(std::ranges::is_sorted(sizes, {}, [](const auto& size) { return size.second; }));
  EXPECT_NEAR(sizes[36] / sizes[9], 2, 1e-3) << "four times the area";
  const Heap few(5);  // 25 manifolds
  EXPECT_EQ(sketch_frame(few.staged(), few.frames[0]).arrows.size(), 25u);
}

TEST(HeapMarks, TheArrowIsAtThePointThatLintNames) {
  Heap heap(6);
  heap.view.focus = Focus::Worst;
  const trace::Pair& pair = heap.frames[0].pairs[3];
  const Vec3d point = pair.manifolds[0].points[0].position;
  heap.view.faults.push_back({"internal_edge", 1, 40, 0, {{0, pair.b, pair.a, point}}});
  const Sketch sketch = sketch_frame(heap.staged(), heap.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_EQ(sketch.arrows[0].from, point);
  // If the pair has a second point, and this one is deeper.
  heap.frames[0].pairs[3].manifolds[0].points.push_back(
      {point + Vec3d(0.1, 0, 0), -0.2, "a:v0 b:f0"});
  EXPECT_EQ(sketch_frame(heap.staged(), heap.frames[0]).arrows.at(0).from, point);
}

TEST(HeapWalls, OnlyFrontWallsAreOutlinesAndTheseAreWhole) {
  Heap heap(7);
  const double side = 2.7, thick = 0.05;
  std::map<std::string, Vec3d> outward = {
      {"east", {1, 0, 0}}, {"west", {-1, 0, 0}}, {"south", {0, 0, 1}}, {"north", {0, 0, -1}}};
  const auto add = [&](const std::string& name, const Vec3d& half, const Vec3d& middle) {
    heap.header.shapes.push_back(box(name, half));
    heap.frames[0].poses.emplace_back(name, at(middle));
  };
  for (const auto& [name, out] : outward)
    add(name, out.x() != 0 ? Vec3d(thick, 0.4, side) : Vec3d(side, 0.4, thick),
        side * out + Vec3d(0, 0.4, 0));
  add("block", {1, 0.8, 1}, {0, 1.31, 0});  // as large as a wall, but not thin
  const Staging staging = heap.staged();
  const Scene scene = scene_of(staging, heap.frames[0]);
  const Sketch sketch = sketch_frame(staging, heap.frames[0]);
  int fronts = 0;
  for (const PlacedShape& shape : scene.shapes) {
    const std::string& name = shape.traced().name;
    if (!outward.contains(name) && name != "block") continue;
    const auto own = [&](const Vec3d& p) { return std::ranges::count(shape.vertices, p) > 0; };
    const auto faces = std::ranges::count_if(
        sketch.surfaces, [&](const Surface& s) { return std::ranges::all_of(s.polygon, own); });
    const bool front = name != "block" && staging.camera.faces(side * outward[name], outward[name]);
    EXPECT_EQ(faces == 0, front) << name;
    fronts += front;
    if (!front) continue;
    std::size_t seen = 0;
    for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
      const auto in_front = [&](int f) {
        return staging.camera.faces(shape.polygon(f).front(), shape.normal(f));
      };
      const Vec3d from = shape.vertex(edge.from), to = shape.vertex(edge.to);
      const auto drawn = std::ranges::count_if(sketch.lines, [&](const Line& line) {
        return (line.from == from && line.to == to) || (line.from == to && line.to == from);
      });
      EXPECT_EQ(drawn, in_front(edge.left) || in_front(edge.right)) << name;
      seen += drawn > 0;
    }
    EXPECT_EQ(seen, 9u) << "three faces of a box are in front";
  }
  EXPECT_EQ(fronts, 2);
}

TEST(HeapLegend, NamesNoMarginThatCannotBeSeen) {
  const auto entries = [](int side) {
    Heap heap(side);
    for (trace::Shape& shape : heap.header.shapes) shape.margin = 0.04;
    std::vector<std::string> texts;
    for (const LegendEntry& entry : legend_of(heap.staged(), heap.frames[0]).listed)
      texts.push_back(entry.text);
    return texts;
  };
  EXPECT_THAT(entries(3), Contains(HasSubstr("without its margin of 40")));
  EXPECT_THAT(entries(6), Not(Contains(HasSubstr("margin"))));
  EXPECT_THAT(entries(6), Contains(HasSubstr("area = overlap")));
}

/// Texts of a panel, and what it has left out.
std::vector<std::string> panel_texts(const Heap& heap, Panel panel, double height = 600,
                                     const std::string& left_out = "") {
  Heap shown = heap;
  shown.view.panels = {panel};
  const Staging staging = shown.staged();
  Drawing drawing;
  Sheet sheet({900, 80, 332, height}, 1, drawing);
  const auto panels = make_panels(staging, shown.frames);
  EXPECT_EQ(panels.at(0).content->lay_out({shown.frames.size() - 1, {}}, sheet), left_out);
  return words(drawing);
}

TEST(HeapFacts, TitlePanelAndMarkAgree) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> separation(-0.02, 0.002);
  for (int run = 0; run < 20; ++run) {
    Heap heap(6);
    double least = 0;
    for (trace::Pair& pair : heap.frames[0].pairs) {
      pair.separation = pair.manifolds[0].points[0].separation = separation(random);
      least = std::min(least, pair.separation);
    }
    const Staging staging = heap.staged();
    const std::string depth = spell_length(-least, 0, staging.scales.length);
    EXPECT_EQ(fill_title(staging, heap.frames[0]), "36 points, " + depth + " deep");
    EXPECT_THAT(words(illustrate(staging, heap.frames[0])),
                Contains(HasSubstr("overlap " + depth + ": floor and crate")));
    const std::vector<std::string> ranked = panel_texts(heap, Panel::Worst);
    EXPECT_THAT(ranked, Contains("worst of 36 pairs in contact"));
    EXPECT_EQ(
        *std::ranges::find_if(ranked, [](const std::string& text) { return text.ends_with("mm"); }),
        depth);
  }
}

TEST(HeapFacts, PointsWithoutAnOverlapAreNoContradiction) {
  Heap heap(6);
  for (trace::Pair& pair : heap.frames[0].pairs) {
    pair.separation = pair.manifolds[0].points[0].separation = 0;
    pair.state = "separated";  // as some engines write
    EXPECT_EQ(state_of(pair, 0), PairState::Touching);
  }
  EXPECT_EQ(fill_title(heap.staged(), heap.frames[0]), "36 points, no overlap");
  EXPECT_THAT(panel_texts(heap, Panel::Worst), Contains("none"));
  EXPECT_THAT(panel_texts(heap, Panel::Overlaps), Contains("no point overlaps in any frame"));
  for (trace::Frame& frame : heap.frames) frame.pairs.clear();
  EXPECT_THAT(panel_texts(heap, Panel::Worst), testing::ElementsAre("no pair in contact"));
  EXPECT_TRUE(std::ranges::none_of(sketch_frame(heap.staged(), heap.frames[0]).marks,
                                   [](const Mark& m) { return m.kind == MarkKind::WideRing; }));
}

TEST(HeapPanels, WorstRanksByOverlapImpulseAndChange) {
  Heap heap(6);
  heap.frames.push_back(heap.frames[0]);
  heap.frames[1].frame = 1;
  for (trace::Pair& pair : heap.frames[1].pairs) {
    trace::Point& point = pair.manifolds[0].points[0];
    point.impulse = trace::Impulse{pair.b == "crate_11" ? 9.0 : 1.0};
    if (pair.b == "crate_20") point.separation -= 0.0155;
  }
  const ShapeMeshes meshes(heap.header.shapes);
  const auto first = [&](Rank by) {
    return ranked_pairs(heap.frames[1], by, 5, meshes, &heap.frames[0]).at(0);
  };
  EXPECT_EQ(first(Rank::Impulse).pair->b, "crate_11");
  EXPECT_EQ(first(Rank::Change).pair->b, "crate_20");
  EXPECT_NEAR(first(Rank::Change).value, 0.0155, 1e-12);
  const auto all = ranked_pairs(heap.frames[1], Rank::Overlap, 99, meshes);
  ASSERT_EQ(all.size(), 36u);
  EXPECT_TRUE(std::ranges::is_sorted(all, std::ranges::greater(), &RankedPair::value));
  const std::vector<std::string> texts = panel_texts(heap, Panel::Worst);
  EXPECT_THAT(texts, Contains("floor and crate 11"));
  EXPECT_THAT(texts, Contains("15.5 mm"));
  EXPECT_THAT(texts, Contains("9.00 N s"));
}

/// A panel lists five pairs by each rank if it has room, or fewer, and says how many it lacks.
TEST(HeapPanels, EachRankingHasFiveRowsOrAsManyAsFit) {
  Heap heap(6);
  heap.frames.push_back(heap.frames[0]);
  heap.frames[1].frame = 1;
  double number = 0;
  for (trace::Pair& pair : heap.frames[1].pairs) {
    pair.manifolds[0].points[0].impulse = trace::Impulse{++number};
    pair.manifolds[0].points[0].separation -= 1e-4 * number;
  }
  const auto rows = [](const std::vector<std::string>& texts) {
    std::map<std::string, int> counts;
    std::string title;
    for (const std::string& text : texts) {
      if (text.starts_with("by ")) counts[title = text.substr(0, text.find(' ', 3))] = 0;
      if (text.starts_with("floor and")) ++counts[title];
    }
    return counts;
  };
  using Counts = std::map<std::string, int>;
  EXPECT_EQ(rows(panel_texts(heap, Panel::Worst)),
            (Counts{{"by overlap", 5}, {"by impulse", 5}, {"by change", 5}}));
  EXPECT_EQ(rows(panel_texts(heap, Panel::Worst, 365)), rows(panel_texts(heap, Panel::Worst)));
  const auto fewer = rows(panel_texts(heap, Panel::Worst, 280));
  EXPECT_EQ(fewer.at("by overlap"), 5);
  EXPECT_GE(fewer.at("by impulse"), fewer.at("by change"));
  EXPECT_GE(fewer.at("by change"), 1);
  const auto one = panel_texts(heap, Panel::Worst, 205, "1 ranking");
  EXPECT_EQ(rows(one), (Counts{{"by overlap", 5}, {"by impulse", 1}}));
  EXPECT_THAT(one, Contains("and 1 more ranking"));
  EXPECT_LT(rows(panel_texts(heap, Panel::Worst, 140, "2 rankings")).at("by overlap"), 5)
      << "the note is within the panel too";
  heap.frames.erase(heap.frames.begin());
  for (trace::Pair& pair : heap.frames[0].pairs) pair.manifolds[0].points[0].impulse.reset();
  EXPECT_EQ(rows(panel_texts(heap, Panel::Worst, 160)), (Counts{{"by overlap", 5}}));
}

TEST(HeapFocus, BodiesInFocusAreNamed) {
  Heap heap(6);
  heap.view.focus_on = {"crate_3", "crate_9", "crate_20"};
  std::map<std::string, Vec3d> places;
  for (const Label& label : sketch_frame(heap.staged(), heap.frames[0]).labels)
    places[label.text] = label.at;
  for (const int crate : {3, 9, 20}) {
    const std::string name = "crate " + std::to_string(crate);
    ASSERT_TRUE(places.contains(name)) << name;
    const Vec3d middle = heap.frames[0].poses[std::size_t(crate) + 1].second.position;
    EXPECT_LT((places[name] - middle).norm(), 1e-9);
  }
  EXPECT_FALSE(places.contains("crate 4"));
}

/// Without the roles a normal that points from B to A looks right.
TEST(HeapFocus, BodiesOfThePairInFocusHaveTheirRolesAndOnlyItsRowIsMarked) {
  Heap heap(6);
  heap.touch("crate_9", "crate_3", {0, 0.5, 0}, -0.001);
  heap.view.focus_on = {"crate_3", "crate_9"};
  std::vector<std::string> texts;
  for (const Label& label : sketch_frame(heap.staged(), heap.frames[0]).labels)
    texts.push_back(label.text);
  EXPECT_THAT(texts, testing::IsSupersetOf({"A: crate 9", "B: crate 3"}));
  const auto bold = [](const Heap& of) {
    Heap shown = of;
    shown.view.panels = {Panel::Worst};
    const Staging staging = shown.staged();
    Drawing drawing;
    Sheet sheet({900, 80, 332, 600}, 1, drawing);
    make_panels(staging, shown.frames).at(0).content->lay_out({0, {}}, sheet);
    std::vector<std::string> found;
    for (const Primitive& one : drawing.primitives)
      if (const auto* text = std::get_if<Text>(&one); text && text->weight == Weight::Bold)
        found.push_back(text->text);
    return found;
  };
  EXPECT_THAT(bold(heap), testing::Each(Not(HasSubstr(" and ")))) << "not among the first five";
  for (trace::Pair& pair : heap.frames[0].pairs)
    if (pair.a == "crate_9") pair.manifolds[0].points[0].separation = -0.05;
  EXPECT_THAT(bold(heap), Contains("crate 9 and crate 3"));
  heap.view.focus_on.clear();
  EXPECT_THAT(bold(heap), Contains("1")) << "the picture has the numbers";
}

/// As `--pair crate_14,floor` trims it: seen from so near that the middle of the floor is behind.
TEST(HeapFocus, APairHasItsWholeNames) {
  Heap heap(6, 12);
  trace::Frame& frame = heap.frames[0];
  std::erase_if(frame.pairs, [](const trace::Pair& pair) { return pair.b != "crate_0"; });
  std::erase_if(frame.poses, [](const trace::Placement& one) {
    return one.first != "crate_0" && one.first != "floor";
  });
  const Vec3d crate = frame.poses[1].second.position;
  heap.view.target = crate;
  heap.view.eye = crate + Vec3d(-1.1, 0.9, -1.2);
  EXPECT_FALSE(heap.staged().camera.project({2, -0.1, 2}) &&
               heap.staged().camera.project({-12, 0, -12}));
  EXPECT_THAT(words(illustrate(heap.staged(), frame)),
              testing::IsSupersetOf({"A: floor", "B: crate 0"}));
}

TEST(HeapPanels, LintListsThePairsOfTheFrameAndTheViewMarksThem) {
  Heap heap(6);
  EXPECT_THAT(panel_texts(heap, Panel::Lint), testing::ElementsAre("lint: nothing is wrong"));
  heap.view.ignores_faults = true;
  EXPECT_THAT(panel_texts(heap, Panel::Lint), testing::ElementsAre("lint: nothing else is wrong"));
  heap.throw_off(9, {0.4, 0.9, 0.1});
  heap.throw_off(24, {5, -1e9, 1});  // not in view
  const auto on_floor = [](int frame, int crate) {
    return Fault::Place{frame, "floor", "crate_" + std::to_string(crate)};
  };
  heap.view.faults = {
      {"pairs_flicker", 3, 40, 0, {{0, "crate_3", "crate_9"}, {0, "crate_3", "crate_9"}}},
      {"points_twice", 9, 0, 0, {on_floor(0, 1), on_floor(0, 2), on_floor(0, 4), on_floor(0, 5)}},
      {"normals_jump", 1, 36, 7, {on_floor(7, 2)}},
      {"poses_jump", 1, 0, 0, {{0, "crate_24", ""}}}};
  EXPECT_THAT(panel_texts(heap, Panel::Lint),
              testing::ElementsAre("lint: 4 findings", "3 of 40", "pairs flicker",
                                   "!1  crate 3 and crate 9", "9 times", "points twice",
                                   "!2  floor and crate 1", "!3  floor and crate 2",
                                   "!4  floor and crate 4", "and 1 more pair", "1 of 36, frame 7",
                                   "normals jump", "1 time", "poses jump", "!5  crate 24"));
  const Sketch sketch = sketch_frame(heap.staged(), heap.frames[0]);
  std::map<std::string, Vec3d> marked;
  for (const Label& label : sketch.labels)
    if (label.text.starts_with("!")) marked.emplace(label.text, label.at);
  ASSERT_EQ(marked.size(), 4u);
  // Without a contact it is at one of the two crates, which are equal.
  const bool is_at_crate = std::ranges::any_of(heap.frames[0].poses, [&](const auto& pose) {
    return (pose.first == "crate_3" || pose.first == "crate_9") &&
           (marked["!1"] - pose.second.position).norm() < 1e-9;
  });
  EXPECT_TRUE(is_at_crate);
  for (const trace::Pair& pair : heap.frames[0].pairs)
    if (pair.b == "crate_2") {
      EXPECT_EQ(marked["!3"], pair.manifolds[0].points[0].position);
    }
}

TEST(HeapPanels, TheCameraLooksAcrossTwoNormalsAndSeesAllSteps) {
  Heap heap(6);
  trace::Pair& pair = heap.frames[0].pairs[0];
  const Vec3d reported = pair.manifolds[0].normal;
  for (const Vec3d& turned : {Vec3d(1, 0, 0), Vec3d(0, 0, 1), Vec3d(0.6, 0, 0.8)}) {
    heap.view.focus = Focus::Worst;
    heap.view.faults = {{"internal_edge", 1, 40, 0, {{0, pair.a, pair.b}}}};
    heap.view.faults[0].places[0].normal = turned;
    const Camera& camera = heap.staged().camera;
    const Vec3d to_eye = camera.to_eye(pair.manifolds[0].points[0].position);
    for (const Vec3d& normal : {reported, turned}) EXPECT_LT(std::abs(to_eye.dot(normal)), 0.5);
  }
  heap.view.faults = {{"bodies_fly_off", 2, 40, 0, {{0, "crate_3", ""}, {0, "crate_9", ""}}}};
  const std::array<Vec3d, 2> first = {Vec3d(0, 0.1, 0), Vec3d(4, 6, 1)},
                             second = {Vec3d(1, 0.1, 0), Vec3d(-3, 5, -2)};
  heap.view.faults[0].places[0].path = first, heap.view.faults[0].places[1].path = second;
  for (const std::array<Vec3d, 2>& path : {first, second})
    for (const Vec3d& end : path) EXPECT_TRUE(heap.staged().camera.sees(end));
}

/// A finding has a line of time with a tick for each frame, and words about its first place.
TEST(HeapPanels, LintShowsWhenEachFindingOccurs) {
  Heap heap(6);
  heap.frames.resize(40, heap.frames[0]);
  for (int f = 0; f < 40; ++f) {
    heap.frames[static_cast<std::size_t>(f)].frame = f;
    heap.frames[static_cast<std::size_t>(f)].time = f / 10.0;
  }
  heap.view.panels = {Panel::Lint};
  heap.view.faults = {{"pairs_flicker", 3, 40, 30, {{30, "crate_3", "crate_9"}}}};
  heap.view.faults[0].frames = {10, 20, 30};
  heap.view.faults[0].detail = "0 points; the separation there is 0";
  const Staging staging = heap.staged();
  const auto panels = make_panels(staging, heap.frames);
  for (const std::size_t frame : {30, 5}) {
    Drawing drawing;
    Sheet sheet({900, 80, 332, 600}, 1, drawing);
    panels.at(0).content->lay_out({frame, {}}, sheet);
    const std::vector<std::string> texts = words(drawing);
    EXPECT_THAT(texts, ::testing::IsSupersetOf({"0", "time", "3.90 s"}));
    const std::string detail = "!1: 0 points; the separation there is 0";
    EXPECT_EQ(std::ranges::count(texts, detail), frame == 30 ? 1 : 0);
    std::vector<double> ticks;
    for (const Primitive& primitive : drawing.primitives)
      if (const auto* const fill = std::get_if<Fill>(&primitive); fill && fill->color == kText)
        ticks.push_back(std::ranges::min_element(fill->polygon, {}, &Point2::x)->x);
    const double column = 332 / 40.0;
    EXPECT_THAT(ticks,
                ::testing::Pointwise(::testing::DoubleNear(1),
                                     {900 + 10 * column, 900 + 20 * column, 900 + 30 * column}));
  }
}

/// With a condition only the points of its pairs are drawn.
TEST(HeapPanels, APictureOfAConditionHasThePointsOfItsPairsAlone) {
  Heap heap(6);
  const auto points = [&] {
    std::set<std::string> pairs;
    const Drawing drawing = illustrate(heap.staged(), heap.frames[0]);
    for (const Part& part : drawing.parts)
      if (part.layer == "contacts") pairs.insert(part.pair);
    return pairs;
  };
  EXPECT_EQ(points().size(), 36u);
  heap.view.faults = {
      {"overlap > 5 mm", 2, 0, 0, {{0, "floor", "crate_1"}, {0, "floor", "crate_5"}}}};
  heap.view.faults[0].is_condition = true;
  EXPECT_THAT(points(),
              ::testing::IsSubsetOf({"floor crate_1", "floor crate_5", "floor crate_31"}));
  EXPECT_THAT(points(), ::testing::IsSupersetOf({"floor crate_1", "floor crate_5"}));
}

TEST(HeapPanels, LintCountsTheFindingsForWhichThereIsNoRoom) {
  Heap heap(6);
  heap.view.faults.assign(99, {"normals_jump", 1, 36, 7, {}});
  const std::vector<std::string> texts = panel_texts(heap, Panel::Lint);
  const auto listed = std::ranges::count(texts, "normals jump");
  EXPECT_GT(listed, 10);
  EXPECT_EQ(texts.back(), "and " + std::to_string(99 - listed) + " more findings");
}

/// A ring is at the point of its finding, not at the deepest one of the pair, and has a row.
TEST(HeapPanels, RingsOfLintAreAtTheirPointsAndInThePanel) {
  Heap heap(6);
  const Vec3d point(0.3, 0.1, 0.2);
  for (int fault = 0; fault < 8; ++fault) {
    heap.view.faults.push_back({"points_flicker", 9, 40, 0, {}});
    for (int i = 0; i < 4; ++i)
      heap.view.faults.back().places.push_back({0, "floor",
                                                "crate_" + std::to_string(4 * fault + i),
                                                point + Vec3d(0, 0, 0.01 * fault)});
  }
  std::set<std::string> rings, rows;
  for (const Label& label : sketch_frame(heap.staged(), heap.frames[0]).labels)
    if (label.text.starts_with("!")) {
      rings.insert(label.text);
      const int fault = (std::stoi(label.text.substr(1)) - 1) / 3;
      EXPECT_LT((label.at - point - Vec3d(0, 0, 0.01 * fault)).norm(), 1e-12) << label.text;
    }
  for (const std::string& text : panel_texts(heap, Panel::Lint))
    if (text.starts_with("!")) rows.insert(text.substr(0, text.find(' ')));
  EXPECT_EQ(rings, rows);
  EXPECT_GE(rings.size(), 6u);
  EXPECT_LT(rings.size(), 24u);
}

/// Both normals where a finding knows the shapes' one, and the step of a body that jumps.
TEST(HeapPanels, AFindingShowsTheRightNormalOrTheStepOfItsBody) {
  Heap heap(6);
  heap.view.focus = Focus::Worst;
  const trace::Pair& pair = heap.frames[0].pairs[3];
  const Vec3d point = pair.manifolds[0].points[0].position, up = pair.manifolds[0].normal;
  const Vec3d right = Eigen::AngleAxisd(0.4, Vec3d::UnitX()) * up;
  heap.view.faults = {{"internal_edge", 1, 40, 0, {{0, pair.a, pair.b, point, right}}}};
  const Sketch sketch = sketch_frame(heap.staged(), heap.frames[0]);
  std::vector<Vec3d> directions;
  for (const Arrow& arrow : sketch.arrows)
    if (arrow.from == point) directions.push_back(arrow.direction);
  EXPECT_THAT(directions, testing::UnorderedElementsAre(up, right));
  EXPECT_THAT(sketch.labels, Contains(testing::Field(&Label::text, "23°")));

  heap.view.faults = {{"bodies_fly_off", 1, 0, 0, {{0, "crate_3", ""}}}};
  const std::array path{Vec3d(-3, 1, 0), Vec3d(0, 1, 4)};
  heap.view.faults[0].places[0].path = path;
  const Sketch flight = sketch_frame(heap.staged(), heap.frames[0]);
  const auto step = std::ranges::find(flight.arrows, path[0], &Arrow::from);
  ASSERT_NE(step, flight.arrows.end());
  EXPECT_EQ(step->to, path[1]);
  EXPECT_THAT(flight.labels, Contains(testing::Field(&Label::text, "5.00 m in a step")));
}

/// The charts of a pair in focus are its own: none where it has no contact.
TEST(HeapPanels, ChartsOfAPairInFocusAreItsOwn) {
  Heap heap(6);
  heap.frames.resize(3, heap.frames[0]);
  for (int f = 0; f < 3; ++f) heap.frames[std::size_t(f)].frame = f;
  std::erase_if(heap.frames[2].pairs, [](const trace::Pair& of) { return of.b == "crate_3"; });
  EXPECT_THAT(panel_texts(heap, Panel::Plots), Contains("35"));
  heap.view.focus_on = {"crate_3", "floor"};
  const std::vector<std::string> texts = panel_texts(heap, Panel::Plots);
  EXPECT_THAT(texts, Contains("crate 3 and floor over time"));
  EXPECT_THAT(texts, Contains("none"));
  EXPECT_THAT(texts, Not(Contains("35")));
}

/// The panel of a heap of few contacts, with the arrows' lengths.
TEST(HeapPictures, NormalsAreNotLongerThanTheBodies) {
  const auto longest = [](double floor) {
    Heap heap(5, floor);  // 25 contacts
    double most = 0;
    const Staging staging = heap.staged();
    for (const Arrow& arrow : sketch_frame(staging, heap.frames[0]).arrows) {
      const double pixels = staging.camera.pixels_per_metre(arrow.from);
      most = std::max(most, arrow.pixels / pixels);
    }
    return most;
  };
  // A crate of 0.5 m is 0.87 m from corner to corner.
  EXPECT_GT(longest(3), 0.2);
  EXPECT_LT(longest(3), 0.88);
  EXPECT_LT(longest(12), 0.88);
}

/// The label of the worst pair is above all bodies that it would cover.
TEST(HeapPictures, TheLabelOfTheWorstPairCoversNoBody) {
  Heap heap(6);
  const Staging staging = heap.staged();
  for (const Label& label : sketch_frame(staging, heap.frames[0]).labels) {
    if (label.text.find("crate") == std::string::npos) continue;
    const auto from = staging.camera.project(label.at);
    ASSERT_TRUE(from.has_value());
    const double bottom = from->y - label.clearance;
    for (const auto& [name, pose] : heap.frames[0].poses) {
      const auto middle = staging.camera.project(pose.position);
      if (name == "floor" || !middle || std::abs(middle->x - from->x) > 60) continue;
      EXPECT_LT(bottom, middle->y) << name;
    }
    return;
  }
  ADD_FAILURE() << "no pair is named";
}

/// The picture's text itself, also where an edge of the floor is above the bodies.
TEST(HeapPictures, TheTextOfTheWorstPairIsOverNoBody) {
  int found = 0;
  for (const double floor : {3.0, 3.5, 4.0, 5.0}) {
    for (const int side : {6, 7, 8}) {
      const Heap heap(side, floor);
      const Staging staging = heap.staged();
      for (const Primitive& primitive : illustrate(staging, heap.frames[0]).primitives) {
        const Text* text = std::get_if<Text>(&primitive);
        if (text == nullptr || text->text.find(": floor and crate") == std::string::npos) continue;
        ++found;
        const float width = text_width(text->text, text->size, text->weight);
        for (const auto& [name, pose] : heap.frames[0].poses) {
          if (name == "floor") continue;
          for (const std::vector<int>& face : heap.header.shapes[1].faces) {
            std::vector<Point2> corners;
            for (const int corner : face)
              corners.push_back(*staging.camera.project(
                  pose.transform(contactscope::at(heap.header.shapes[1].vertices, corner))));
            for (int i = 0; i <= 60; ++i) {
              const Point2 letter{text->at.x + width * static_cast<float>(i) / 60,
                                  text->at.y - 0.35f * text->size};
              int left = 0;
              for (std::size_t k = 0; k < 4; ++k) {
                const Point2 along = corners[(k + 1) % 4] - corners[k], to = letter - corners[k];
                left += along.x * to.y - along.y * to.x > 0;
              }
              EXPECT_TRUE(left % 4 != 0)
                  << text->text << " over " << name << ", floor of " << floor << " m, " << side;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(found, 12);
}

TEST(HeapPanels, OverlapsCountEachPointOnce) {
  Heap heap(8);
  heap.touch("crate_1", "crate_2", Vec3d::Zero(), 0.01);
  const std::vector<std::string> texts = panel_texts(heap, Panel::Overlaps);
  EXPECT_EQ(texts.at(0), "overlaps of 64 of 65 points");
  // Overlaps of 1 to 64 mm: 1, 1, 3, 5, 10, 30 and 14 of them end at 1, 2, 5, 10, 20, 50, 100 mm.
  std::vector<std::string> bars;
  for (const std::string& text : texts)
    if (text.find_first_not_of("0123456789") == std::string::npos) bars.push_back(text);
  EXPECT_EQ(bars, (std::vector<std::string>{"1", "1", "3", "5", "10", "30", "14"}));
}

}  // namespace
}  // namespace contactscope::draw
