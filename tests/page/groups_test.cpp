#include "page/page.h"

#include <gmock/gmock.h>

#include "draw/scene/drawing.h"
#include "vector/svg.h"

namespace contactscope::page {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// A dot at `x` for every named layer.
draw::Drawing dots(const std::vector<std::string>& layers, float x) {
  draw::Drawing drawing{.width = 100, .height = 50};
  for (const std::string& layer : layers) {
    drawing.begin(layer, "table <crate>", "mark");
    drawing.primitives.push_back(draw::Disc{{x, 20}, 0, 5, {1, 0, 0, 1}});
  }
  return drawing;
}

std::vector<SvgGroup> groups_of(const draw::Drawing& drawing) {
  return groups_in(vector::svg_of(drawing, {.embed_font = false}));
}

TEST(Groups, AreThePartsOfADrawing) {
  const std::vector<SvgGroup> groups = groups_of(dots({"contacts", "reference_face"}, 30));
  ASSERT_THAT(groups, SizeIs(2));
  EXPECT_EQ(groups[0].layer, "contacts");
  EXPECT_EQ(groups[0].pair, "table &lt;crate&gt;");
  EXPECT_EQ(groups[0].role, "mark");
  EXPECT_THAT(groups[0].markup, testing::StartsWith("<circle cx=\"30\" cy=\"20\""));
  EXPECT_THAT(groups[0].markup, testing::Not(HasSubstr("<g")));
  EXPECT_EQ(groups[1].layer, "reference_face");
}

TEST(Groups, APictureWithoutPartsHasNone) {
  EXPECT_THAT(groups_of({.width = 10, .height = 10}), SizeIs(0));
}

TEST(GroupStore, HoldsWhatFramesShareOnce) {
  GroupStore store;
  EXPECT_THAT(store.add(groups_of(dots({"contacts", "ids"}, 30))), ElementsAre(0, 1));
  EXPECT_THAT(store.add(groups_of(dots({"contacts", "ids"}, 31))), ElementsAre(2, 3));
  EXPECT_THAT(store.add(groups_of(dots({"ids", "contacts"}, 30))), ElementsAre(1, 0));
  EXPECT_EQ(store.size(), 4);
  EXPECT_THAT(store.text(2), testing::StartsWith("<g id=\"g2\" data-layer=\"contacts\" "
                                                 "data-pair=\"table &lt;crate&gt;\" "
                                                 "data-role=\"mark\">\n<circle cx=\"31\""));
  EXPECT_THAT(store.text(2), testing::EndsWith("</g>\n"));
}

TEST(GroupStore, DistinguishesEqualGroupsOfAPicture) {
  GroupStore store;
  EXPECT_THAT(store.add(groups_of(dots({"ids", "contacts", "ids"}, 30))), ElementsAre(0, 1, 2));
  EXPECT_EQ(store.text(0).substr(9), store.text(2).substr(9));  // except for the number
  EXPECT_THAT(store.add(groups_of(dots({"ids"}, 30))), ElementsAre(0));
  EXPECT_THAT(store.add(groups_of(dots({"ids", "contacts", "ids", "contacts", "ids"}, 30))),
              ElementsAre(0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace contactscope::page
