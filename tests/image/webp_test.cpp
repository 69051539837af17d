#include "image/webp.h"

#include <gtest/gtest.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include <string>

#include "image/test_picture.h"

namespace contactscope {
namespace {

Image decoded(const Bytes& file) {
  Image image;
  std::uint8_t* const rgb = WebPDecodeRGB(file.data(), file.size(), &image.width, &image.height);
  if (rgb == nullptr) return {};
  image.rgb.assign(rgb, rgb + 3 * image.width * image.height);
  WebPFree(rgb);
  return image;
}

TEST(Webp, LosesNothing) {
  const Bytes file = encode_webp(testing::dot_on_white(30));
  EXPECT_EQ(decoded(file), testing::dot_on_white(30));
  EXPECT_EQ(encode_webp(testing::dot_on_white(30)), file) << "equal pictures give equal bytes";
}

TEST(Webp, KeepsAlphaAndTheColoursUnderIt) {
  Image image = testing::dot_on_white(30);
  image.alpha.resize(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    image.alpha[i] = static_cast<std::uint8_t>(i);
  const Bytes file = encode_webp(image);
  int width = 0, height = 0;
  std::uint8_t* const rgba = WebPDecodeRGBA(file.data(), file.size(), &width, &height);
  ASSERT_NE(rgba, nullptr);
  ASSERT_EQ(width * height, 97 * 41);
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    ASSERT_EQ(rgba[4 * i + 3], image.alpha[i]) << i;
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(rgba[4 * i + c], image.rgb[3 * i + c]) << i;
  }
  WebPFree(rgba);
}

TEST(Webp, ContainsItsDescription) {
  const Bytes file = encode_webp(testing::dot_on_white(30), "<x>about</x>");
  EXPECT_EQ(decoded(file), testing::dot_on_white(30));
  EXPECT_NE(std::string(file.begin(), file.end()).find("<x>about</x>"), std::string::npos);
}

TEST(Webp, AnimationShowsEachPictureForItsTime) {
  const std::vector<Image> pictures = {testing::dot_on_white(10), testing::dot_on_white(20),
                                       testing::dot_on_white(80)};
  const std::vector<int> times = {40, 1000, 17};
  WebpAnimation animation;
  for (std::size_t i = 0; i < pictures.size(); ++i) animation.add(pictures[i], times[i]);
  const Bytes file = animation.finish("about");
  const WebPData data{file.data(), file.size()};
  WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder, &info));
  EXPECT_EQ(info.frame_count, 3u);
  EXPECT_EQ(info.loop_count, 0u) << "forever";
  int end = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    std::uint8_t* rgba = nullptr;
    int shown_until = 0;
    ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &rgba, &shown_until));
    EXPECT_EQ(shown_until, end += times[i]);
    Image image(97, 41);
    for (std::size_t p = 0; p < image.rgb.size(); ++p) image.rgb[p] = rgba[p / 3 * 4 + p % 3];
    EXPECT_EQ(image, pictures[i]) << i;
  }
  WebPAnimDecoderDelete(decoder);
}

TEST(Webp, TooLargePicturesAreRefused) { EXPECT_THROW(encode_webp(Image(16384, 1)), WebpError); }

}  // namespace
}  // namespace contactscope
