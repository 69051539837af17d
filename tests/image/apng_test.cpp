#include "image/webp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "image/png.h"
#include "image/test_picture.h"

namespace contactscope {
namespace {

using testing::dot_on_white;
using ::testing::ElementsAre;

struct Chunk {
  std::string type;
  Bytes data;
};

std::uint32_t number(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes.at(at + i);
  return value;
}

std::vector<Chunk> chunks_of(const Bytes& file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t length = number(file, at, 4);
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at);
    chunks.push_back({std::string(begin + 4, begin + 8),
                      Bytes(begin + 8, begin + 8 + static_cast<std::ptrdiff_t>(length))});
    at += 12 + length;
  }
  return chunks;
}

struct Shown {
  Image image;
  PixelBox box;
  double seconds = 0;
};

/// The pictures that a viewer shows: each as a PNG, composed over the previous one.
std::vector<Shown> play(const Bytes& file) {
  std::vector<Shown> all;
  const std::vector<Chunk> chunks = chunks_of(file);
  std::uint32_t expected = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (chunks[i].type != "fcTL") continue;
    const Bytes& control = chunks[i].data;
    EXPECT_EQ(number(control, 0, 4), expected++);
    const int width = static_cast<int>(number(control, 4, 4)),
              height = static_cast<int>(number(control, 8, 4)),
              left = static_cast<int>(number(control, 12, 4)),
              top = static_cast<int>(number(control, 16, 4));
    Bytes pixels = chunks.at(i + 1).data;
    if (chunks[i + 1].type == "fdAT") {
      EXPECT_EQ(number(pixels, 0, 4), expected++);
      pixels.erase(pixels.begin(), pixels.begin() + 4);
    }
    Bytes png;
    append_png_begin(Image(width, height), png);
    append_chunk("IDAT", pixels, png);
    append_chunk("IEND", {}, png);
    const Image part = decode_png(png, "part");
    Shown shown{all.empty() ? part : all.back().image,
                {left, top, left + width, top + height},
                double(number(control, 20, 2)) / number(control, 22, 2)};
    for (int y = 0; y < height; ++y)
      std::copy_n(part.rgb.begin() + 3 * y * width, 3 * width,
                  shown.image.rgb.begin() + 3 * ((top + y) * shown.image.width + left));
    all.push_back(shown);
  }
  return all;
}

TEST(Apng, ShowsEachPictureAsItWas) {
  const std::vector<Image> pictures = {dot_on_white(10), dot_on_white(20), dot_on_white(20),
                                       dot_on_white(70)};
  const std::vector<int> times = {40, 1000, 16, 70000};
  ApngEncoder encoder;
  for (std::size_t i = 0; i < pictures.size(); ++i) encoder.add(pictures[i], times[i]);
  const Bytes file = encoder.finish();
  const std::vector<Shown> shown = play(file);
  ASSERT_EQ(shown.size(), pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ(shown[i].image, pictures[i]) << i;
    EXPECT_DOUBLE_EQ(shown[i].seconds, 0.001 * times[i]) << i;
  }
  EXPECT_EQ(decode_png(file, "still"), pictures.front()) << "what knows no animations sees";
}

TEST(Apng, KeepsOnlyWhatChanged) {
  ApngEncoder encoder;
  for (const double x : {10.0, 20.0, 20.0}) encoder.add(dot_on_white(x), 40);
  const std::vector<Shown> shown = play(encoder.finish());
  EXPECT_EQ(shown[0].box, (PixelBox{0, 0, 97, 41}));
  EXPECT_EQ(shown[1].box, changed_box(dot_on_white(10), dot_on_white(20)));
  EXPECT_GE(shown[1].box.left, 3);
  EXPECT_LE(shown[1].box.right, 27);
  EXPECT_GE(shown[1].box.top, 13);
  EXPECT_LE(shown[1].box.bottom, 27);
  EXPECT_EQ(shown[2].box, (PixelBox{0, 0, 1, 1})) << "nothing changed";
}

TEST(Apng, HasTheNumberOfPicturesAndPlaysForever) {
  ApngEncoder encoder;
  encoder.add(dot_on_white(10), 40);
  encoder.add(dot_on_white(20), 40);
  const Bytes file = encoder.finish({{"Software", "test"}});
  std::vector<std::string> types;
  for (const Chunk& chunk : chunks_of(file)) types.push_back(chunk.type);
  EXPECT_THAT(types, ElementsAre("IHDR", "acTL", "tEXt", "fcTL", "IDAT", "fcTL", "fdAT", "IEND"));
  EXPECT_EQ(number(chunks_of(file)[1].data, 0, 4), 2u);
  EXPECT_EQ(number(chunks_of(file)[1].data, 4, 4), 0u);
  ApngEncoder again;
  again.add(dot_on_white(10), 40);
  again.add(dot_on_white(20), 40);
  EXPECT_EQ(again.finish({{"Software", "test"}}), file);
}

TEST(Apng, ChangesInAlphaAloneAreSeen) {
  Image clear = dot_on_white(10);
  clear.alpha.assign(97 * 41, 255);
  Image faint = clear;
  faint.alpha[static_cast<std::size_t>(97 * 30 + 50)] = 7;
  EXPECT_EQ(changed_box(clear, faint), (PixelBox{50, 30, 51, 31}));
}

}  // namespace
}  // namespace contactscope
