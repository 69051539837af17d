#include "image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "image/encoding.h"
#include "image/test_picture.h"
#include "support/png_text.h"

namespace contactscope {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A new folder that is deleted when the test ends.
class Png : public ::testing::Test {
 protected:
  Png() {
    std::string name = (fs::temp_directory_path() / "contactscope_png_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~Png() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Image noise(int width, int height, unsigned seed) {
  Image image(width, height);
  std::mt19937 random(seed);
  for (std::uint8_t& value : image.rgb) value = static_cast<std::uint8_t>(random());
  return image;
}

TEST_F(Png, ReadsBackWhatItWroteAtEveryLevel) {
  Image picture(97, 31);
  testing::paint_all(picture, {255, 255, 255});
  testing::paint_dot(picture, 40, 15, 9, {213, 94, 0});
  for (int level = 0; level <= 12; ++level) {
    write_png(path("picture.png"), picture, level);
    EXPECT_EQ(read_png(path("picture.png")), picture) << level;
  }
  EXPECT_EQ(files(), 1u) << "nothing is left aside";
}

TEST_F(Png, EveryLevelButTheFirstOneCompresses) {
  Image picture(640, 360);
  testing::paint_all(picture, {255, 255, 255});
  testing::paint_dot(picture, 300, 200, 80, {213, 94, 0});
  EXPECT_GT(encode_png(picture, 0).size(), picture.rgb.size());
  for (int level = 1; level <= 12; ++level)
    EXPECT_LT(encode_png(picture, level).size(), picture.rgb.size() / 50) << level;
}

TEST_F(Png, KeepsNoiseAndOddSizes) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {333, 7}, {640, 360}}) {
    const Image picture = noise(width, height, 3);
    write_png(path("noise.png"), picture);
    EXPECT_EQ(read_png(path("noise.png")), picture) << width << "x" << height;
  }
}

TEST_F(Png, KeepsAlphaWhereThereIsSome) {
  Image picture = noise(33, 9, 7);
  picture.alpha.assign(33 * 9, 200);
  const std::vector<std::uint8_t> bytes = encode_png(picture);
  constexpr std::size_t kColorType = 25;
  EXPECT_EQ(int(bytes[kColorType]), 6) << "RGBA";
  write_png(path("clear.png"), picture);
  EXPECT_EQ(read_png(path("clear.png")).rgb, picture.rgb) << "colours are not premultiplied";
  picture.alpha.clear();
  EXPECT_EQ(int(encode_png(picture)[kColorType]), 2) << "RGB";
}

TEST_F(Png, EqualPicturesGiveEqualBytesFromManyThreads) {
  const Image picture = noise(160, 90, 5);
  const std::vector<std::uint8_t> fast = encode_png(picture, 1), small = encode_png(picture, 9);
  ASSERT_NE(fast, small);
  std::vector<int> equal(8, 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < equal.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 5; ++k) {
        equal[i] += encode_png(picture, i % 2 ? 9 : 1) == (i % 2 ? small : fast);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(equal, ::testing::Each(5));
}

TEST_F(Png, ReplacesAnOlderFileWhole) {
  write_png(path("a.png"), noise(64, 64, 1));
  write_png(path("a.png"), noise(8, 8, 2));
  EXPECT_EQ(read_png(path("a.png")), noise(8, 8, 2));
}

TEST_F(Png, AFailedWriteLeavesNothingAndNamesThePath) {
  try {
    write_png(path("no/such/folder/a.png"), noise(4, 4, 1));
    FAIL() << "wrote into a folder that is not there";
  } catch (const fs::filesystem_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/folder/a.png"));
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
  fs::create_directory(path("taken.png"));
  EXPECT_THROW(write_png(path("taken.png"), noise(4, 4, 1)), fs::filesystem_error);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Png, AFileThatCannotGrowIsAnErrorAndLeavesTheOldOne) {
  const std::vector<std::uint8_t> old(100, 7), large(100000, 8);
  write_whole_file(path("a.bin"), old);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // as on a full disk: write() then fails
  const rlimit small{5000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_whole_file(path("a.bin"), large), fs::filesystem_error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(fs::file_size(path("a.bin")), 100u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Png, AMissingFileIsASystemErrorWithThePath) {
  try {
    read_png(path("missing.png"));
    FAIL() << "read a file that is not there";
  } catch (const fs::filesystem_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing.png"));
  }
  EXPECT_THROW(read_png(folder_.string()), fs::filesystem_error) << "a folder";
}

TEST_F(Png, BrokenFilesAreErrorsWithThePath) {
  write_png(path("a.png"), noise(64, 64, 1));
  fs::resize_file(path("a.png"), 400);
  std::ofstream(path("empty.png")).close();
  std::ofstream(path("text.png")) << "not a picture";
  const auto record = [&](const std::string& name) -> std::string {
    try {
      read_png(path(name));
      return "read";
    } catch (const PngError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(record("a.png"), path("a.png") + ": cannot be read as a PNG: it is cut off or damaged");
  for (const char* name : {"empty.png", "text.png"})
    EXPECT_EQ(record(name), path(name) + ": cannot be read as a PNG: it is not one");
}

TEST_F(Png, HasItsTextBeforeItsPixels) {
  const PngText text = {{"Software", "contactscope 1.2.3"},
                        {"Title", "Über zwei Zeilen:\n–40 °C"},
                        {"Command", "contactscope render a --frames 1"}};
  const Image picture = noise(8, 8, 1);
  write_png(path("a.png"), picture, 1, text);
  EXPECT_EQ(test::texts_of_png(path("a.png")), text);
  EXPECT_EQ(read_png(path("a.png")), picture);
  EXPECT_EQ(encode_png(picture, 1, text), encode_png(picture, 1, text));
  EXPECT_NE(encode_png(picture, 1, text), encode_png(picture, 1));

  const std::vector<std::uint8_t> bytes = encode_png(picture, 1, text);
  const std::string all(bytes.begin(), bytes.end());
  EXPECT_LT(all.find("tEXtSoftware"), all.find("IDAT"));
  EXPECT_LT(all.find("iTXtTitle"), all.find("IDAT")) << "what is no ASCII is UTF-8";
}

TEST_F(Png, AlphaIsWrittenAndItsColoursRead) {
  Image picture = noise(9, 5, 1);
  picture.alpha.assign(45, 3);
  write_png(path("a.png"), picture);
  const Image back = read_png(path("a.png"));
  EXPECT_EQ(back.rgb, picture.rgb);
  EXPECT_EQ(encode_png(picture)[25], 6) << "colour type: RGB and alpha";
}

}  // namespace
}  // namespace contactscope
