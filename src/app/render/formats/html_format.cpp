#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/render/formats/format.h"
#include "page/page.h"
#include "snapshot/store.h"
#include "vector/font_subset.h"

namespace contactscope::app {
namespace {

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

}  // namespace

const Format kHtmlFormat{
    .name = "html",
    .extension = ".html",
    .what = "a page with a slider and the trace's facts, one file per sequence",
    .begin = [](const ReelPlan& plan) -> std::unique_ptr<Reel> {
      return std::make_unique<HtmlReel>(plan);
    },
    .require = [] { vector::font_subset(FontWeight::Regular, {U'a'}); },
};

}  // namespace contactscope::app
