// The panel `code` from random records: its numbers are those of the record.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "crate_on_slab.h"
#include "draw/panels/panel.h"
#include "inside.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using crate_sample::same;
using crate_sample::texts;
using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;

constexpr Rect kSheet{900, 80, 332, 500};

Drawing code_of(CrateOnSlab& scene) {
  scene.view.panels = {Panel::Code};
  const Staging staging = scene.staged();
  const std::vector<FilledPanel> panels = make_panels(staging, scene.frames);
  Drawing drawing;
  Sheet sheet(kSheet, staging.layout.scale, drawing);
  EXPECT_EQ(panels.at(0).content->lay_out({}, sheet), "");
  return drawing;
}

/// The value to the right of a line of code; "no such line" without it.
std::string value_of(const Drawing& drawing, const std::string& code) {
  const std::vector<std::string> all = texts(drawing);
  const auto found = std::ranges::find(all, code);
  return found == all.end() || found + 1 == all.end() ? "no such line" : *(found + 1);
}

/// Metres of "−10.4 mm".
double metres(std::string text) {
  double sign = 1;
  if (text.starts_with("−")) sign = -1, text = text.substr(std::string("−").size());
  std::size_t end = 0;
  const double value = std::stod(text, &end);
  const std::string unit = text.substr(end + (end < text.size()));
  return sign * value * (unit.starts_with("mm") ? 1e-3 : unit.starts_with("µm") ? 1e-6 : 1);
}

/// The lines on a band of colour, bold.
std::vector<std::string> decided(const Drawing& drawing, const Color& color) {
  std::vector<std::string> found;
  for (const Primitive& band : drawing.primitives) {
    const Fill* const fill = std::get_if<Fill>(&band);
    if (fill == nullptr || !same(fill->color, color)) continue;
    const auto [top, bottom] = std::ranges::minmax(fill->polygon, {}, &Point2::y);
    for (const Primitive& primitive : drawing.primitives)
      if (const Text* text = std::get_if<Text>(&primitive))
        if (text->at.y > top.y && text->at.y < bottom.y && text->align == Align::Left)
          found.push_back(text->text);
  }
  return found;
}

struct RandomRecord : CrateOnSlab {
  explicit RandomRecord(unsigned seed) : random(seed) {
    sat.face_a = trace::FaceAxis{.face = count(0, 5), .separation = -length()};
    sat.face_b = trace::FaceAxis{.face = count(0, 5), .separation = -length()};
    best = std::max(sat.face_a->separation, sat.face_b->separation);
    if (count(0, 1) == 1) {
      sat.edge = trace::EdgeAxis{.a = count(0, 11), .b = count(0, 11), .separation = 0.7 * best};
      best = sat.edge->separation;
    }
    sat.tolerance = 0.4 * length();
    sat.chosen = best - sat.face_a->separation <= *sat.tolerance   ? "face_a"
                 : best - sat.face_b->separation <= *sat.tolerance ? "face_b"
                                                                   : "edge_edge";
    pair().sat = sat;
  }

  int count(int least, int most) { return std::uniform_int_distribution(least, most)(random); }
  double length() { return std::uniform_real_distribution(0.002, 0.08)(random); }

  std::mt19937 random;
  trace::Sat sat;
  double best = 0;
};

TEST(CodePanel, ShowsTheNumbersOfRandomRecordsAndMarksWhatDecided) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    RandomRecord scene(seed);
    const Drawing drawing = code_of(scene);
    const auto expect_length = [&](const std::string& code, double expected) {
      EXPECT_NEAR(metres(value_of(drawing, code)), expected, 0.006 * std::abs(expected) + 1e-9)
          << seed << ": " << code;
    };
    expect_length("faceA = QueryFaceDirections(A, B)", scene.sat.face_a->separation);
    expect_length("faceB = QueryFaceDirections(B, A)", scene.sat.face_b->separation);
    if (scene.sat.edge)
      expect_length("edges = QueryEdgeDirections(A, B)", scene.sat.edge->separation);
    else
      EXPECT_EQ(value_of(drawing, "edges = QueryEdgeDirections(A, B)"), "none is better");
    expect_length("best = max(faceA, faceB, edges)", scene.best);
    // The loss by taking A's faces, and the tolerance for it.
    const bool of_a = scene.sat.chosen == "face_a", of_b = scene.sat.chosen == "face_b";
    const std::string compared = value_of(drawing, "if (best − faceA ≤ tolerance)");
    const std::size_t limit = compared.find(" ≤ ");
    ASSERT_NE(limit, std::string::npos) << compared;
    const double loss = scene.best - scene.sat.face_a->separation;
    EXPECT_NEAR(metres(compared.substr(0, limit)), loss, 0.006 * loss);
    EXPECT_NEAR(metres(compared.substr(limit + std::string(" ≤ ").size())), *scene.sat.tolerance,
                0.006 * *scene.sat.tolerance);
    EXPECT_TRUE(compared.ends_with(of_a ? ": yes" : ": no")) << compared;

    const std::vector<std::string> faces = decided(drawing, kReferenceFace);
    const std::vector<std::string> edges = decided(drawing, kAxis);
    if (of_a || of_b) {
      const std::string name = of_a ? "A" : "B";
      const int face = (of_a ? scene.sat.face_a : scene.sat.face_b)->face;
      const std::string branch = of_a ? "if" : "else if";
      EXPECT_THAT(faces, testing::ElementsAre(branch + " (best − face" + name + " ≤ tolerance)",
                                              "    CreateFaceContact(" + name + ")"));
      EXPECT_TRUE(edges.empty());
      EXPECT_EQ(value_of(drawing, "    CreateFaceContact(" + name + ")"),
                "face " + std::to_string(face));
      EXPECT_EQ(value_of(drawing, "else CreateEdgeContact()"), "");
    } else {
      EXPECT_TRUE(faces.empty());
      EXPECT_THAT(edges, testing::ElementsAre("else CreateEdgeContact()"));
      EXPECT_EQ(
          value_of(drawing, "else CreateEdgeContact()"),
          "edges " + std::to_string(scene.sat.edge->a) + ", " + std::to_string(scene.sat.edge->b));
    }
    expect_inside(drawing, kSheet.grown(6));  // bands are wider than the text
  }
}

TEST(CodePanel, PutsBsFacesFirstWhereTheyWerePreferred) {
  RandomRecord scene(1);
  scene.sat.face_a->separation = scene.sat.face_b->separation = -0.01;
  scene.sat.edge.reset();
  scene.sat.chosen = "face_b";
  scene.pair().sat = scene.sat;
  const std::vector<std::string> all = texts(code_of(scene));
  EXPECT_LT(std::ranges::find(all, "    CreateFaceContact(B)"),
            std::ranges::find(all, "    CreateFaceContact(A)"));
}

TEST(CodePanel, EndsWithTheQueryThatSeparates) {
  CrateOnSlab scene;
  scene.pair().manifolds.clear();
  scene.pair().state = "separated";
  trace::Sat& sat = scene.pair().sat.emplace();
  sat.face_a = trace::FaceAxis{.face = 2, .separation = -0.25};
  sat.face_b = trace::FaceAxis{.face = 3, .separation = 0.03};
  sat.chosen = "face_b";
  const Drawing drawing = code_of(scene);
  EXPECT_THAT(decided(drawing, kAxis), testing::ElementsAre("if (faceB > margin) return"));
  EXPECT_EQ(value_of(drawing, "faceB = QueryFaceDirections(B, A)"), "30.0 mm");
  EXPECT_THAT(texts(drawing), Not(Contains("edges = QueryEdgeDirections(A, B)")));
}

TEST(CodePanel, NamesWhatATraceOfAnotherEngineHasNot) {
  CrateOnSlab scene;
  EXPECT_THAT(texts(code_of(scene)), Contains(testing::HasSubstr("does not apply")));
  trace::Sat& sat = scene.pair().sat.emplace();
  sat.face_a = trace::FaceAxis{.face = 2, .separation = -0.002};
  sat.chosen = "face_a";
  const Drawing drawing = code_of(scene);
  EXPECT_EQ(value_of(drawing, "if (best − faceA ≤ tolerance)"), "0 m ≤ not recorded: yes");
  scene.pair().sat.reset();
  scene.pair().cache.emplace().hit = true;
  EXPECT_THAT(decided(code_of(scene), kAxis),
              testing::ElementsAre("return the last frame's result"));
}

}  // namespace
}  // namespace contactscope::draw
