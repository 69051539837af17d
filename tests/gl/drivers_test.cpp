// The same drawing through another route, another number of threads, another driver.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "gl/painting.h"
#include "gl/sample_drawing.h"
#include "image/compare.h"
#include "support/osmesa.h"

namespace contactscope::gl {
namespace {

constexpr int kWidth = 640, kHeight = 360;

struct Painted {
  Image image{kWidth, kHeight};
  std::string renderer;
};

/// The sample drawing, painted by a process with these variables ("NAME=value ...") set.
Painted paint_elsewhere(const std::string& route, const std::string& variables) {
  const std::string command = "env " + variables + " '" PAINT_SAMPLE "' " + route + " " +
                              std::to_string(kWidth) + " " + std::to_string(kHeight);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  Painted painted;
  std::vector<std::uint8_t>& rgb = painted.image.rgb;
  if (std::fread(rgb.data(), 1, rgb.size(), pipe.get()) != rgb.size()) {
    throw std::runtime_error("no picture from " + command);
  }
  char name[256] = "";
  if (std::fgets(name, sizeof name, pipe.get())) painted.renderer = name;
  return painted;
}

Image paint_here(Backend backend) {
  const auto context = open_context(backend);
  Rasterizer rasterizer(*context, kWidth, kHeight);
  return testing::paint(rasterizer, testing::sample_drawing(kWidth, kHeight));
}

TEST(Drivers, EglAndOsmesaGiveIdenticalBytesInOneProcess) {
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
  const Image egl = paint_here(Backend::Egl);
  EXPECT_EQ(paint_here(Backend::Osmesa), egl);
  EXPECT_EQ(paint_here(Backend::Egl), egl);
  EXPECT_NE(egl, Image(kWidth, kHeight)) << "something is painted";
}

TEST(Drivers, NumberOfThreadsDoesNotMatter) {
  const Image expected = paint_here(Backend::Egl);
  for (const std::string& route : {std::string("egl"), std::string("osmesa")}) {
    if (route == "osmesa" && !test::osmesa_is_installed()) continue;
    for (const char* threads : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2"}) {
      EXPECT_EQ(paint_elsewhere(route, threads).image, expected) << route << " " << threads;
    }
  }
}

TEST(Drivers, AProcessorOfSse2AlonePassesTheVerdict) {
  const PixelComparison result =
      compare_pixels(paint_here(Backend::Egl), paint_elsewhere("egl",
                                                               "GALLIUM_OVERRIDE_CPU_CAPS=sse2 "
                                                               "MESA_SHADER_CACHE_DISABLE=true")
                                                   .image);
  EXPECT_TRUE(result.passed());
  EXPECT_LE(result.largest_channel_difference, kChannelTolerance);
}

TEST(Drivers, SoftpipePassesTheVerdict) {
  const Painted softpipe = paint_elsewhere("egl", "GALLIUM_DRIVER=softpipe");
  if (softpipe.renderer.find("softpipe") == std::string::npos) {
    GTEST_SKIP() << "this Mesa has no softpipe: " << softpipe.renderer;
  }
  const PixelComparison result = compare_pixels(paint_here(Backend::Egl), softpipe.image);
  EXPECT_TRUE(result.passed()) << result.differing << " pixels, largest group "
                               << result.largest_cluster;
}

}  // namespace
}  // namespace contactscope::gl
