#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <future>

#include "draw/scene/palette.h"
#include "draw/staging.h"
#include "gl/context.h"
#include "gl/rasterizer.h"
#include "image/compare.h"
#include "image/png.h"
#include "overlay/panels.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "support/temporary_folder.h"
#include "vector/svg.h"

/// Every scenario's first stored picture as SVG and PDF, read by librsvg and poppler, which share
/// no code with ours, and compared with our pixels.
namespace contactscope::vector {
namespace {

constexpr int kWidth = 640, kHeight = 360;

/// Half as large: each pixel is the mean of four.
Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2);
  const auto at = [&](int x, int y, int channel) {
    return int{image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x)) +
                         static_cast<std::size_t>(channel)]};
  };
  auto out = half.rgb.begin();
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int channel = 0; channel < 3; ++channel)
        *out++ = static_cast<std::uint8_t>(
            (at(2 * x, 2 * y, channel) + at(2 * x + 1, 2 * y, channel) +
             at(2 * x, 2 * y + 1, channel) + at(2 * x + 1, 2 * y + 1, channel) + 2) /
            4);
    }
  }
  return half;
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Makes Fontconfig see only the fonts that the SVG embeds, as on a machine without fonts: librsvg
/// uses only installed ones. So the letters are read from the subsets, without kerning.
std::string with_fonts_of(const std::string& svg, const std::string& folder) {
  std::filesystem::create_directories(folder);
  constexpr std::string_view kBegin = "base64,";
  int number = 0;
  for (std::size_t at = svg.find(kBegin); at != std::string::npos; at = svg.find(kBegin, at)) {
    at += kBegin.size();
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (; svg[at] != ')' && svg[at] != '='; ++at) {
      constexpr std::string_view kDigits =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      bits = bits << 6 | static_cast<unsigned>(kDigits.find(svg[at]));
      count += 6;
      if (count < 8) continue;
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xFF);
    }
    write(folder + "/" + std::to_string(number++) + ".ttf", bytes);
  }
  write(folder + "/fonts.conf",
        "<fontconfig><dir>" + folder + "</dir><cachedir>" + folder + "</cachedir></fontconfig>");
  return "FONTCONFIG_FILE='" + folder + "/fonts.conf'";
}

// Both programs draw at twice the size, so that letters and thin lines are at their exact places
// and not on the next pixel. Everything is compared at half of our size. The remaining differences
// were reviewed, picture by picture: soft edges, which our fills lack; in poppler lines of one
// pixel, which it snaps to whole pixels; coincident edges of boxes, which add up in pixels and
// which a vector file has once; and the end of a long title, which is off by a quarter of a pixel
// in poppler. With 96 of 255 steps allowed, no two adjacent pixels differed. Strips of ids are
// stripes two pixels wide. The rasterizer puts them on whole rows of pixels, so their widths
// differ, while the vector files have them equal. At a quarter of the size, where stripes are one
// grey, no pixel differed by more than 64 in librsvg, or 87 in poppler and in dense strips. A
// missing dot of a contact differs by 150.
struct Limits {
  const char* reader;
  PixelLimits half, quarter;
};
constexpr Limits kSvgLimits{"rsvg-convert",
                            {.channel = 96, .cluster = 5, .total = 30},
                            {.channel = 72, .cluster = 1, .total = 0}};
constexpr Limits kPdfLimits{"pdftoppm",
                            {.channel = 96, .cluster = 18, .total = 60},
                            {.channel = 96, .cluster = 1, .total = 0}};

constexpr int kStripes = 96;  // of a channel, in librsvg too

/// The pictures of one scenario, for the two programs.
struct Trial {
  std::string name;
  std::string stem;  // of the files, without ".svg"
  Image ours;
  bool has_strips = false;  // of ids
  bool svg = true, pdf = true;
};

/// Describes the differences; empty if there are none.
std::string judge(const Trial& trial, const std::string& file, const Limits& limits) {
  const Image ours = halved(trial.ours), read = halved(halved(read_png(file)));
  PixelLimits quarter = limits.quarter;
  if (trial.has_strips) quarter.channel = std::max(quarter.channel, kStripes);
  PixelComparison found = compare_pixels(halved(ours), halved(read), quarter);
  int scale = 4;
  if (found.passed() && !trial.has_strips) {
    found = compare_pixels(ours, read, limits.half);
    scale = 2;
  }
  if (found.passed()) return {};
  const PixelBox& box = found.largest_cluster_at;
  return trial.name + ", as " + limits.reader + " shows it at 1/" + std::to_string(scale) + ": " +
         std::to_string(found.differing) + " pixels differ, by up to " +
         std::to_string(found.largest_channel_difference) + ", " +
         std::to_string(found.largest_cluster) + " of them in one place, at " +
         std::to_string(scale * box.left) + ", " + std::to_string(scale * box.top) + "\n";
}

std::string judged(const Trial& trial) {
  const std::string& stem = trial.stem;
  std::string wrong;
  const auto read_by = [&](const std::string& command, const char* file, const Limits& limits) {
    if (std::system(command.c_str()) != 0)
      wrong += trial.name + ": failed: " + command + "\n";
    else
      wrong += judge(trial, stem + file, limits);
  };
  if (trial.svg) {
    const std::string fonts = with_fonts_of(read_text(stem + ".svg"), stem + "_fonts");
    read_by(fonts + " rsvg-convert -z 2 '" + stem + ".svg' -o '" + stem + "_svg.png'", "_svg.png",
            kSvgLimits);
  }
  if (trial.pdf)
    read_by("pdftoppm -r 192 -png -singlefile '" + stem + ".pdf' '" + stem + "_pdf'", "_pdf.png",
            kPdfLimits);
  return wrong;
}

/// The first stored picture of a scenario's first view.
draw::Drawing picture_of(const Scenario& scenario) {
  const View& view = scenario.views.front();
  Runner runner(scenario, draw::stages_shown({view}));
  const trace::Header header = runner.header();
  std::vector<trace::Frame> frames;
  for (int number = 0; number <= scenario.snapshots.frames.front(); ++number)
    frames.push_back(runner.frame(number));
  const draw::Staging staging = draw::stage(header, frames, view, kWidth, kHeight);
  draw::Drawing drawing = draw::illustrate(staging, frames.back());
  if (!staging.view.panels.empty()) {
    overlay::PanelColumn(staging, frames).add({frames.size() - 1, {}}, drawing);
  }
  return drawing;
}

bool has_strips(const draw::Drawing& drawing) {
  return std::ranges::any_of(drawing.primitives, [](const draw::Primitive& primitive) {
    const auto* text = std::get_if<draw::Text>(&primitive);
    return text != nullptr && (text->text.starts_with("points over time") ||
                               text->text.starts_with("points by pair") ||
                               text->text.starts_with("points of the first"));
  });
}

void write_files(const draw::Drawing& drawing, const Trial& trial, FontFaces& faces) {
  if (trial.svg) write(trial.stem + ".svg", svg_of(drawing, {.fonts = &faces}));
  if (trial.pdf) write(trial.stem + ".pdf", pdf_of(drawing));
}

TEST(EveryScenario, AMissingSignIsSeen) {
  const TemporaryFolder folder;
  const Scenario scenario =
      load_scenario(CONTACTSCOPE_SOURCE_DIR "/scenarios/hull/face_contact.toml");
  const draw::Drawing drawing = picture_of(scenario);
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  rasterizer.paint(drawing);
  FontFaces faces;
  const Trial whole{"whole", folder / "whole", rasterizer.read()};
  write_files(drawing, whole, faces);
  EXPECT_EQ(judged(whole), "");
  const auto wrong_without = [&](const std::string& name, const auto& is_gone) {
    draw::Drawing less = drawing;
    const auto gone = std::ranges::find_if(less.primitives, is_gone);
    ASSERT_NE(gone, less.primitives.end());
    std::visit([](auto& shape) { shape.color.a = 0; }, *gone);
    const Trial trial{name, folder / name, whole.ours};
    write_files(less, trial, faces);
    const std::string wrong = judged(trial);
    EXPECT_NE(wrong.find("rsvg-convert"), std::string::npos) << name;
    EXPECT_NE(wrong.find("pdftoppm"), std::string::npos) << name;
  };
  wrong_without("dot", [](const draw::Primitive& primitive) {
    const auto* disc = std::get_if<draw::Disc>(&primitive);
    return disc != nullptr && disc->color.r == draw::kContact.r &&
           disc->color.b == draw::kContact.b;
  });
  wrong_without("title", [](const draw::Primitive& primitive) {
    const auto* text = std::get_if<draw::Text>(&primitive);
    return text != nullptr && text->text.starts_with("Face contact");
  });
}

// Each picture is read back in one format, SVG and PDF in turn: every group has both, and what draws
// them is the same for all scenarios of a group.
TEST(EveryScenario, SvgAndPdfShowWhatThePixelsDo) {
  // For reviews: the folder is kept.
  const char* kept = std::getenv("CONTACTSCOPE_LOOK");
  const TemporaryFolder folder;
  const std::filesystem::path out = kept != nullptr ? kept : folder.path();
  std::filesystem::create_directories(out);
  const std::filesystem::path scenarios = CONTACTSCOPE_SOURCE_DIR "/scenarios";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenarios))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  ASSERT_GT(files.size(), 60u);

  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  FontFaces faces;
  std::deque<std::future<std::string>> running;  // one per processor, while the next is drawn
  const auto take_first = [&] {
    const std::string wrong = running.front().get();
    running.pop_front();
    EXPECT_TRUE(wrong.empty()) << wrong;
  };
  bool is_svg_next = true;
  for (const std::filesystem::path& file : files) {
    const Scenario scenario = load_scenario(file.string());
    if (scenario.views.empty() || scenario.snapshots.frames.empty()) continue;
    const draw::Drawing drawing = picture_of(scenario);
    rasterizer.paint(drawing);
    Trial trial{std::filesystem::relative(file, scenarios).string(),
                {},
                rasterizer.read(),
                has_strips(drawing),
                is_svg_next,
                !is_svg_next};
    is_svg_next = !is_svg_next;
    std::string flat = trial.name;
    std::ranges::replace(flat, '/', '_');
    trial.stem = (out / flat).string();
    write_files(drawing, trial, faces);
    if (kept != nullptr) write_png(trial.stem + "_ours.png", trial.ours);
    if (running.size() >= 2) take_first();
    running.push_back(std::async(std::launch::async, judged, std::move(trial)));
  }
  while (!running.empty()) take_first();
}

}  // namespace
}  // namespace contactscope::vector
