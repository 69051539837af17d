#include "vector/svg.h"

#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "draw/crate_on_slab.h"

namespace contactscope::vector {
namespace {

using draw::crate_sample::CrateOnSlab;
using testing::HasSubstr;
using testing::Not;

struct Sample {
  CrateOnSlab scene;
  draw::Drawing drawing;

  Sample() {
    scene.view.layers = {Layer::Shapes, Layer::Normals, Layer::Contacts, Layer::Ids};
    drawing = draw::illustrate(scene.staged(), scene.frames[0]);
  }
};

std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

TEST(Svg, GroupsAreNamedByLayerPairAndRole) {
  const Sample sample;
  const std::string svg = svg_of(sample.drawing);
  EXPECT_THAT(svg, HasSubstr("<g id=\"contacts\" class=\"layer contacts\" "
                             "data-pair=\"slab crate\" data-role=\"line\">"));
  EXPECT_THAT(svg, HasSubstr("<g id=\"contacts-2\" class=\"layer contacts\" "
                             "data-pair=\"slab crate\" data-role=\"mark\">"));
  EXPECT_THAT(svg, HasSubstr("<g id=\"title\" class=\"layer title\">"));
  EXPECT_THAT(svg, HasSubstr("<g id=\"legend\""));
  const std::vector<std::string> ids = all_of(svg, " id=\"([^\"]*)\"");
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_EQ(all_of(svg, "(<g )").size(), all_of(svg, "(</g>)").size());
}

TEST(Svg, IdsTakeAPrefixWhereSeveralStandInOnePage) {
  const Sample sample;
  for (const std::string& id :
       all_of(svg_of(sample.drawing, {.id_prefix = "f3-"}), " id=\"([^\"]*)"))
    EXPECT_THAT(id, testing::StartsWith("f3-"));
}

TEST(Svg, TextIsLiveAndItsFontEmbedded) {
  const Sample sample;
  const std::string svg = svg_of(sample.drawing);
  EXPECT_THAT(svg, HasSubstr(">A crate on a slab</text>"));
  EXPECT_THAT(svg, HasSubstr("font-weight:400;src:url(data:font/ttf;base64,AAEAAA"));
  EXPECT_THAT(svg, HasSubstr("font-weight:700;src:url(data:font/ttf;base64,AAEAAA"));
  EXPECT_THAT(svg_of(sample.drawing, {.embed_font = false}), Not(HasSubstr("@font-face")));
}

TEST(Svg, EqualDrawingsGiveEqualBytes) {
  const Sample one, two;
  FontFaces faces;
  const std::string first = svg_of(one.drawing, {.fonts = &faces});
  EXPECT_EQ(first, svg_of(two.drawing, {.fonts = &faces}));
  EXPECT_EQ(first, svg_of(two.drawing));
}

TEST(Svg, OriginIsInTheMetadata) {
  const Sample sample;
  const PictureOrigin origin{.version = "1.2.3",
                             .scenario = "hull/face_contact",
                             .title = "Boxes <and> crates",
                             .frame = 3,
                             .view = "main",
                             .sha256 = "ab12",
                             .command = "contactscope render hull/face_contact --frames 3"};
  const std::string svg = svg_of(sample.drawing, {.origin = &origin});
  EXPECT_THAT(svg, HasSubstr("<title>Boxes &lt;and&gt; crates</title>"));
  EXPECT_THAT(svg, HasSubstr("command=\"contactscope render hull/face_contact --frames 3\""));
  EXPECT_THAT(svg, HasSubstr("scenario-sha-256=\"ab12\""));
  EXPECT_THAT(svg, HasSubstr("frame=\"3\""));
  EXPECT_THAT(svg, HasSubstr("software=\"contactscope 1.2.3\""));
}

TEST(Svg, ASizeOnPaperIsInPoints) {
  draw::Drawing drawing{.width = 992, .height = 500};
  EXPECT_THAT(svg_of(drawing), HasSubstr("width=\"992\" height=\"500\" viewBox=\"0 0 992 500\""));
  drawing.points_per_pixel = 0.24;  // 300 pixels an inch: 84 mm
  EXPECT_THAT(svg_of(drawing),
              HasSubstr("width=\"238.08pt\" height=\"120pt\" viewBox=\"0 0 992 500\""));
}

TEST(Svg, NoPlaceIsOutsideOfTheCanvas) {
  const Sample sample;
  const std::string svg = svg_of(sample.drawing);
  int places = 0;
  for (const std::string& at : all_of(svg, "(?:M| x=\"| cx=\")(-?[0-9.]+)")) {
    EXPECT_GE(std::stod(at), -8);  // half of a line's width
    EXPECT_LE(std::stod(at), sample.drawing.width + 8);
    ++places;
  }
  EXPECT_GT(places, 30);
}

TEST(Svg, TransparentIsNotWritten) {
  draw::Drawing drawing{.width = 20, .height = 20, .background = {1, 1, 1, 0}};
  drawing.primitives.push_back(draw::Disc{{5, 5}, 0, 3, {1, 0, 0, 0}});
  const std::string svg = svg_of(drawing, {.embed_font = false});
  EXPECT_THAT(svg, Not(HasSubstr("circle")));
  EXPECT_THAT(svg, Not(HasSubstr("rect")));  // no background either
  drawing.background = {0, 0, 0, 0.5f};
  EXPECT_THAT(svg_of(drawing), HasSubstr("fill=\"#000\" fill-opacity=\".5\""));
}

TEST(Svg, ShapesAreWrittenBriefly) {
  draw::Drawing drawing{.width = 40, .height = 20};
  drawing.primitives = {draw::Fill{{{1, 2}, {11.5f, 2}, {11.5f, 12}, {1, 12.256f}}, {1, 0, 0, 1}},
                        draw::Disc{{5, 6}, 2, 4, {0, 0, 1, 1}},
                        draw::Stroke{{2, 3}, {9, 3}, 2, {0, 1, 0, 1}, draw::Cap::Round, 4, 2, 1}};
  const std::string svg = svg_of(drawing);
  EXPECT_THAT(svg, HasSubstr("<path d=\"M1 2h10.5v10l-10.5 .26z\" fill=\"#f00\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"5\" cy=\"6\" r=\"3\" fill=\"none\" stroke=\"#00f\" "
                             "stroke-width=\"2\"/>"));
  EXPECT_THAT(svg, HasSubstr("stroke-linecap=\"round\" stroke-dasharray=\"4 2\" "
                             "stroke-dashoffset=\"1\""));
}

TEST(Svg, NumbersHaveTwoDecimalsAtMost) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.004), "0");
  EXPECT_EQ(number(-0.5), "-.5");
  EXPECT_EQ(number(12.345678), "12.35");
  EXPECT_EQ(number(3.10), "3.1");
  EXPECT_EQ(number(-7), "-7");
  EXPECT_EQ(hex({1, 1, 1, 1}), "#fff");
  EXPECT_EQ(hex({0, 0x72 / 255.0f, 0xB2 / 255.0f, 1}), "#0072b2");
  EXPECT_EQ(escaped("a<b & \"c\"\n"), "a&lt;b &amp; &quot;c&quot; ");
}

}  // namespace
}  // namespace contactscope::vector
