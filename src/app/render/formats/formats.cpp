#include <future>
#include <iostream>

#include "app/cli/verbs.h"
#include "app/render/formats/format.h"
#include "image/webp.h"
#include "page/page.h"
#include "snapshot/store.h"
#include "vector/svg.h"
#include "viewer/viewer.h"

namespace contactscope::app {
namespace {

/// For frames whose times do not increase.
constexpr double kNoTime = 1.0 / 25;

template <class MadeReel> std::unique_ptr<Reel> reel_of(const ReelPlan& plan) {
  return std::make_unique<MadeReel>(plan);
}

/// Feeds pictures to an encoder on another thread, one behind the caller. Each is shown until the
/// time of the next frame; the last as long as the one before it. The milliseconds of a sequence
/// add up to its rounded duration. The file has `kAbout` of its origin in it.
template <class Encoder, auto kAbout> class AnimationReel : public Reel {
 public:
  explicit AnimationReel(const ReelPlan& plan)
      : fps_(plan.fps), path_(plan.path), origin_(plan.origin) {}

  void add(const Shot& shot, const trace::Frame& frame) override {
    if (held_) show(frame.time - time_);
    held_ = shot.image;
    time_ = frame.time;
  }

  void finish() override {
    if (held_) show(last_);
    wait();
    write_whole_file(path_, encoder_.finish(kAbout(origin_)));
  }

 private:
  /// Adds the held picture for a number of seconds of frame time.
  void show(double seconds) {
    last_ = seconds > 0 ? seconds : kNoTime;
    const double shown = fps_ ? 1 / *fps_ : last_;
    const auto milliseconds = [](double time) { return std::lround(1000 * time); };
    const auto duration = static_cast<int>(milliseconds(begin_ + shown) - milliseconds(begin_));
    begin_ += shown;
    wait();
    running_ = std::async(std::launch::async, [this, image = std::move(held_), duration] {
      encoder_.add(*image, duration);
    });
    held_.reset();
  }

  void wait() {
    if (running_.valid()) running_.get();
  }

  std::optional<double> fps_;
  std::string path_;
  PictureOrigin origin_;
  Encoder encoder_;
  std::shared_ptr<const Image> held_{};
  double time_ = 0, last_ = kNoTime, begin_ = 0;  // seconds
  std::future<void> running_{};                   // declared last: its destructor waits
};

/// Origin metadata as XMP (ISO 16684-1), one line per entry in the description, which viewers show.
std::string xmp_of(const PictureOrigin& origin) {
  std::string all =
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
      "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\">"
      "<dc:description><rdf:Alt><rdf:li xml:lang=\"x-default\">";
  for (const auto& [key, value] : entries_of(origin))
    all += vector::escaped(key + ": " + value) + "\n";
  return all + "</rdf:li></rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>";
}

class HtmlReel : public Reel {
 public:
  explicit HtmlReel(const ReelPlan& plan)
      : path_(plan.path), frames_(plan.frames.size()), page_(*plan.staging, plan.origin) {}

  void add(const Shot& shot, const trace::Frame& frame) override {
    page_.add(frame, *shot.drawing);
    const double megabytes = 1e-6 * double(page_.size()) / double(++added_) * double(frames_);
    if (has_warned_ || added_ < std::min(frames_, kFramesOfEstimate) || megabytes < kLargePage)
      return;
    has_warned_ = true;
    std::cerr << path_ << " will have about " << std::lround(megabytes)
              << " MB; --format viewer writes a small page of the same frames that can be turned\n";
  }
  void finish() override { snapshot::write_text(path_, page_.html()); }

 private:
  static constexpr std::size_t kFramesOfEstimate = 4;
  static constexpr double kLargePage = 30;  // MB

  std::string path_;
  std::size_t frames_, added_ = 0;
  bool has_warned_ = false;
  page::Page page_;
};

class ViewerReel : public Reel {
 public:
  explicit ViewerReel(const ReelPlan& plan)
      : path_(plan.path), viewer_(*plan.staging, plan.origin, plan.to_lint, plan.is_known) {}

  void add(const Shot&, const trace::Frame& frame) override { viewer_.add(frame); }
  void finish() override { snapshot::write_text(path_, viewer_.html()); }

 private:
  std::string path_;
  viewer::Viewer viewer_;
};

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {
          .name = "png",
          .extension = ".png",
          .what = "pixels, one file per frame",
          .needs_pixels = true,
          .encode =
              [](const Shot& shot) {
                return encode_png(*shot.image, kFastestDeflate, entries_of(shot.origin));
              },
      },
      {
          .name = "svg",
          .extension = ".svg",
          .what = "vectors with live text, one file per frame",
          .encode =
              [](const Shot& shot) {
                static vector::FontFaces faces;  // shared: pictures of a run use the same glyphs
                const std::string svg =
                    vector::svg_of(*shot.drawing, {.origin = &shot.origin, .fonts = &faces});
                return std::vector<std::uint8_t>(svg.begin(), svg.end());
              },
          .require = &vector::require_font_subsets,
      },
      {
          .name = "pdf",
          .extension = ".pdf",
          .what = "a page of vectors, one file per frame",
          .encode =
              [](const Shot& shot) {
                const std::string pdf = vector::pdf_of(*shot.drawing, {.origin = &shot.origin});
                return std::vector<std::uint8_t>(pdf.begin(), pdf.end());
              },
          .require = &vector::require_pdf,
      },
      {
          .name = "html",
          .extension = ".html",
          .what = "a page with a slider and the trace's facts, one file per sequence",
          .begin = &reel_of<HtmlReel>,
          .require = [] { vector::font_subset(FontWeight::Regular, {U'a'}); },
      },
      {
          .name = "apng",
          .extension = ".apng",
          .what = "an animated PNG, one file per sequence",
          .needs_pixels = true,
          .begin = &reel_of<AnimationReel<ApngEncoder, entries_of>>,
      },
      {
          .name = "webp",
          .extension = ".webp",
          .what = "lossless WebP, animated if there are several frames",
          .needs_pixels = true,
          .encode = [](const Shot& shot) { return encode_webp(*shot.image, xmp_of(shot.origin)); },
          .begin = &reel_of<AnimationReel<WebpAnimation, xmp_of>>,
      },
      {
          .name = "viewer",
          .extension = ".viewer.html",
          .what = "a page in 3D with a timeline, facts and search, one file per sequence",
          .needs_drawings = false,
          .begin = &reel_of<ViewerReel>,
          .require =
              [] {
                if (viewer::three_script().empty())
                  throw UsageError(
                      "--format viewer: the program was built without three.js; install it "
                      "(apt-get install libjs-three) and build again");
              },
      },
  };
  return all;
}

std::vector<const Format*> formats_named(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::find(formats(), name, &Format::name) == formats().end())
      throw UsageError("--format '" + name + "' is not known; " +
                       near_or_all(name, names_in(formats())));
  }
  std::vector<const Format*> chosen;
  for (const Format& format : formats())
    if (std::ranges::find(names, format.name) != names.end()) chosen.push_back(&format);
  return chosen;
}

}  // namespace contactscope::app
