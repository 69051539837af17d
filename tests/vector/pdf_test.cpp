#include "vector/svg.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "draw/crate_on_slab.h"

namespace contactscope::vector {
namespace {

using draw::crate_sample::CrateOnSlab;
using testing::HasSubstr;

draw::Drawing sample() {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Normals, Layer::Contacts, Layer::Ids};
  return draw::illustrate(scene.staged(), scene.frames[0]);
}

/// Cairo before 1.18 omits the D that begins a date; readers accept this.
auto created(const std::string& date) {
  return testing::AnyOf(HasSubstr("/CreationDate (" + date), HasSubstr("/CreationDate (D:" + date));
}

TEST(Pdf, OnePageWithItsFontAndItsSize) {
  const std::string pdf = pdf_of(sample());
  EXPECT_THAT(pdf, testing::StartsWith("%PDF-1."));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 960 540 ]"));
  EXPECT_THAT(pdf, HasSubstr("Roboto"));
  EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));
  draw::Drawing smaller = sample();
  smaller.points_per_pixel = 0.5;
  EXPECT_THAT(pdf_of(smaller), HasSubstr("/MediaBox [ 0 0 640 360 ]"));
}

TEST(Pdf, EqualDrawingsGiveEqualBytesWithAPinnedDate) {
  EXPECT_EQ(pdf_of(sample()), pdf_of(sample()));
  EXPECT_THAT(pdf_of(sample()), created("19700101000000"));
  setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  EXPECT_THAT(pdf_of(sample()), created("20231114221320"));
  unsetenv("SOURCE_DATE_EPOCH");
}

TEST(Pdf, OriginIsInTheMetadata) {
  const PictureOrigin origin{.version = "1.2.3",
                             .scenario = "hull/face_contact",
                             .title = "Boxes",
                             .frame = 3,
                             .view = "main",
                             .sha256 = "ab12",
                             .command = "contactscope render hull/face_contact"};
  const std::string pdf = pdf_of(sample(), {.origin = &origin});
  EXPECT_THAT(pdf, HasSubstr("/Title (Boxes)"));
  EXPECT_THAT(pdf, HasSubstr("/Subject (contactscope render hull/face_contact)"));
  EXPECT_THAT(pdf, HasSubstr("/Creator (contactscope 1.2.3)"));
  EXPECT_THAT(pdf, HasSubstr("Scenario SHA-256: ab12"));
}

}  // namespace
}  // namespace contactscope::vector
