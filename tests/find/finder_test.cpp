#include "find/finder.h"

#include <gmock/gmock.h>

#include <sstream>

#include "trace/json.h"

namespace contactscope::find {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct At {
  int frame;
  const char* pair;
  bool operator==(const At& other) const {
    return frame == other.frame && std::string(pair) == other.pair;
  }
  friend void PrintTo(const At& at, std::ostream* out) { *out << at.frame << " " << at.pair; }
};

trace::Pair pair_of(const char* b, const Vec3d& normal, std::vector<double> separations,
                    double impulse = 0) {
  trace::Pair pair;
  pair.a = "floor";
  pair.b = b;
  pair.state = separations.empty() ? "separated" : "touching";
  if (separations.empty()) return pair;
  trace::Manifold& manifold = pair.manifolds.emplace_back();
  manifold.normal = normal;
  manifold.axis = "face_a";
  for (const double separation : separations) {
    trace::Point& point = manifold.points.emplace_back();
    point.separation = separation;
    point.id = "a:f0 b:v" + std::to_string(manifold.points.size());
    if (impulse != 0) point.impulse = trace::Impulse{impulse};
    pair.separation = std::min(pair.separation, separation);
  }
  return pair;
}

/// A crate that slides, a ball that bounces, and a rod whose normal turns.
std::vector<trace::Frame> sample() {
  const Vec3d up(0, 1, 0), leaning(std::sin(0.5), std::cos(0.5), 0);
  std::vector<trace::Frame> frames(6);
  for (int f = 0; f < 6; ++f) {
    trace::Frame& frame = frames[static_cast<std::size_t>(f)];
    frame.frame = f;
    frame.time = 0.1 * f;
    Pose<double> crate;
    crate.position.x() = 0.01 * f * f;  // 1, 3, 5, 7, 9 cm a frame
    if (f == 4) crate.rotation = Quatd(Eigen::AngleAxisd(0.2, Vec3d::UnitY()));
    frame.poses = {{"floor", {}}, {"crate", crate}};
    frame.pairs.push_back(pair_of("crate", up, {-0.001 * f, -0.002}, 1.0 + f));
    if (f == 2) frame.pairs.back().manifolds[0].points.pop_back();
    if (f == 0 || f == 1 || f == 4) frame.pairs.push_back(pair_of("ball", up, {-0.003}));
    if (f == 5) frame.pairs.push_back(pair_of("ball", up, {}));
    if (f > 0) frame.pairs.push_back(pair_of("rod", f == 3 ? leaning : up, {-0.006}));
  }
  return frames;
}

std::vector<At> find(const std::string& text, const std::vector<lint::Finding>& findings = {}) {
  static const std::vector<std::string> kNames = {"crate", "ball", "rod"};
  Finder finder{Expression(text, vocabulary())};
  finder.take(findings);
  std::vector<At> found;
  for (const trace::Frame& frame : sample())
    for (const Hit& hit : finder.next(frame))
      found.push_back(
          {hit.frame, std::ranges::find(kNames, hit.a == "floor" ? hit.b : hit.a)->c_str()});
  return found;
}

/// The ball has no record in frame 3, and the crate is named alone.
TEST(Finder, FindingsOfLintAreTriedInTheirFrames) {
  std::vector<lint::Finding> findings(3);
  findings[0].cause = "pairs_flicker";
  findings[0].marks = {{3, 5, "ball", "floor"}, {4, 6, "floor", "ball"}};
  findings[1].cause = "poses_jump";
  findings[1].marks = {{4, 6, "crate", ""}};
  findings[2].cause = "side";
  findings[2].marks = {{0, 2, "floor", "crate"}};
  findings[2].below = "2 %";  // not reported
  EXPECT_THAT(find("lint", findings), ElementsAre(At{3, "ball"}, At{4, "crate"}, At{4, "ball"}));
  EXPECT_THAT(find("lint.pairs_flicker and points == 0", findings), ElementsAre(At{3, "ball"}));
  EXPECT_THAT(find("lint.poses_jump == 1", findings), ElementsAre(At{4, "crate"}));
  EXPECT_THAT(find("lint.side", findings), IsEmpty());
  EXPECT_THAT(find("lint"), IsEmpty());
}

TEST(Finder, QuantitiesOfAFrame) {
  EXPECT_THAT(find("overlap > 4.5 mm and b == 'crate'"), ElementsAre(At{5, "crate"}));
  EXPECT_THAT(find("overlap == .006 and frame < 3"), ElementsAre(At{1, "rod"}, At{2, "rod"}));
  EXPECT_THAT(find("time > 250ms and impulse >= 9 N s"),
              ElementsAre(At{4, "crate"}, At{5, "crate"}));  // two points, 1 + f each
  EXPECT_THAT(find("not touching"), ElementsAre(At{2, "ball"}, At{5, "ball"}));
}

TEST(Finder, ChangesFromTheFrameBefore) {
  EXPECT_THAT(find("normal_turn > 20 deg"), ElementsAre(At{3, "rod"}, At{4, "rod"}));
  EXPECT_THAT(find("normal_turn > 0.51 rad"), IsEmpty());
  EXPECT_THAT(find("points_lost > 0"), ElementsAre(At{2, "crate"}, At{2, "ball"}, At{5, "ball"}));
  EXPECT_THAT(find("ids_gained == 1 and points_gained == 1"),
              ElementsAre(At{1, "rod"}, At{3, "crate"}, At{4, "ball"}));
  EXPECT_THAT(find("points != previous.points and b == 'crate'"),
              ElementsAre(At{2, "crate"}, At{3, "crate"}));
  EXPECT_THAT(find("abs(overlap_change) > 5.5 mm"), ElementsAre(At{1, "rod"}));
  EXPECT_THAT(find("impulse_change >= 5 Ns"), ElementsAre(At{3, "crate"}));  // 3 to 2 * 4
  EXPECT_THAT(find("motion > 6 cm"), ElementsAre(At{4, "crate"}, At{5, "crate"}));
  EXPECT_THAT(find("turn > 11 deg and turn < 12 deg"), ElementsAre(At{4, "crate"}, At{5, "crate"}));
}

/// As on a mesh, where each triangle has a manifold.
TEST(Finder, OfSeveralManifoldsOneFits) {
  std::vector<trace::Frame> frames(2);
  for (trace::Frame& frame : frames) {
    frame.pairs = {pair_of("crate", {0, 1, 0}, {-0.001})};
    trace::Manifold second = frame.pairs[0].manifolds[0];
    second.normal = {0.6, 0.8, 0};
    second.axis = "edge_edge";
    frame.pairs[0].manifolds.push_back(second);
  }
  frames[1].frame = 1;
  frames[1].pairs[0].manifolds[1].normal = {0.8, 0.6, 0};
  const auto found = [&](const char* text) {
    Finder finder{Expression(text, vocabulary())};
    std::vector<std::pair<int, std::vector<Value>>> hits;
    for (const trace::Frame& frame : frames)
      for (const Hit& hit : finder.next(frame)) hits.emplace_back(hit.frame, hit.values);
    return hits;
  };
  using Values = std::vector<Value>;
  EXPECT_THAT(found("normal_y < .9"),
              ElementsAre(std::pair(0, Values{0.8}), std::pair(1, Values{0.6})));
  EXPECT_THAT(found("normal_y > .9 and normal_x > .5"), IsEmpty());  // of one and the same
  EXPECT_THAT(found("axis == 'edge_edge' and frame == 0"),
              ElementsAre(std::pair(0, Values{std::string("edge_edge"), 0.0})));
  EXPECT_THAT(found("normal_x - previous.normal_x > .1"),
              ElementsAre(std::pair(1, Values{0.8, 0.6})));
}

TEST(Finder, AgeAndAbsenceOfAContact) {
  EXPECT_THAT(find("age == 0"),
              ElementsAre(At{0, "crate"}, At{0, "ball"}, At{1, "rod"}, At{4, "ball"}));
  EXPECT_THAT(find("age == 4"), ElementsAre(At{4, "crate"}, At{5, "rod"}));
  EXPECT_THAT(find("age == 0 and away <= 2"), ElementsAre(At{4, "ball"}));  // it came back
  EXPECT_THAT(find("away == 1 and not touching"), ElementsAre(At{2, "ball"}, At{5, "ball"}));
}

TEST(Finder, ListsTheValuesOfTheExpression) {
  Finder finder{Expression("overlap > 1 mm and points != previous.points", vocabulary())};
  std::vector<Hit> hits;
  for (const trace::Frame& frame : sample())
    for (Hit& hit : finder.next(frame)) hits.push_back(std::move(hit));
  ASSERT_FALSE(hits.empty());
  EXPECT_EQ(hits[0].frame, 1);
  EXPECT_THAT(hits[0].values, ElementsAre(Value(0.006), Value(1.0), Value(0.0)));
  EXPECT_EQ(finder.expression().facts()[2].name(), "previous.points");
}

TEST(Finder, ReadsTheSameFromTextOnSeveralThreadsWithoutTheOtherParts) {
  std::ostringstream text;
  trace::Header header;
  header.scenario = "mine/sample";
  header.scalar = "double";
  header.up = "y";
  text << trace::to_json_line(header) << "\n\n";
  for (trace::Frame& frame : sample()) {
    for (trace::Pair& pair : frame.pairs) {
      pair.sat.emplace();
      pair.cache.emplace();
    }
    text << trace::to_json_line(frame) << '\n';
  }
  text << R"({"frame":6,"ti)";  // torn
  Workers workers(3);
  for (const char* condition : {"points_lost > 0 or motion > 6 cm", "age == 0"}) {
    std::istringstream in(text.str());
    trace::TraceReader reader(in, "run.jsonl");
    Finder finder{Expression(condition, vocabulary())};
    std::vector<trace::FrameText> lines;
    for (trace::FrameText line; reader.take(line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 7u);
    std::vector<At> found;
    static const std::vector<std::string> kNames = {"crate", "ball", "rod"};
    for (trace::Frame& frame : reader.read(lines, finder.parts(), workers)) {
      EXPECT_EQ(frame.line, frame.frame + 3);
      EXPECT_FALSE(frame.pairs.front().sat || frame.pairs.front().cache);
      EXPECT_EQ(frame.poses.empty(), std::string(condition) == "age == 0");
      for (const Hit& hit : finder.next(std::move(frame)))
        found.push_back(
            {hit.frame, std::ranges::find(kNames, hit.a == "floor" ? hit.b : hit.a)->c_str()});
    }
    EXPECT_THAT(found, testing::ElementsAreArray(find(condition)));
    ASSERT_TRUE(reader.torn());
    EXPECT_EQ(reader.torn()->line, 9);
    lines.clear();
    EXPECT_THAT(reader.read(lines, finder.parts(), workers), testing::IsEmpty());
  }
}

TEST(Finder, RefusesWhatItCannotKnow) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      Expression(text, vocabulary());
    } catch (const ExpressionError& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_THAT(complaint("points > 1 and overlp > 1 mm"), HasSubstr("did you mean 'overlap'?"));
  EXPECT_THAT(complaint("points > 1 and overlp > 1 mm"),
              HasSubstr("\n  points > 1 and overlp > 1 mm\n                 ^"));
  EXPECT_THAT(complaint("overlap > 1 mn"),
              HasSubstr("column 13 of 'overlap > 1 mn': 'mn' is not a unit; "));
  EXPECT_THAT(complaint("overlap > 1mmm"), HasSubstr("did you mean 'mm'?"));
  EXPECT_THAT(
      complaint("overlap > 20 deg"),
      HasSubstr("column 9 of 'overlap > 20 deg': left of '>' is a length, right of it an angle"));
  EXPECT_THAT(complaint("overlap + age > 1"), HasSubstr("a count"));
  EXPECT_THAT(complaint("bullet.points > 1"), HasSubstr("before a dot there may be 'previous'"));
  EXPECT_THAT(complaint("previous.ids_lost > 1"), HasSubstr("leave out 'previous.'"));
  EXPECT_THAT(complaint("motion / time > 1 mm / 1 s"), testing::StrEq("no complaint"));
}

}  // namespace
}  // namespace contactscope::find
