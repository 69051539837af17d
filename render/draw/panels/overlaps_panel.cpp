#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "draw/panels/panel.h"
#include "draw/scene/contact_facts.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kMinBars = 40, kMaxBars = 120, kBelowBars = 20, kAboveBars = 18, kBinLabel = 13;

constexpr int kShownDecades = 4;  // below the deepest overlap of the sequence; the rest share a bin
constexpr std::array kBinEnds = {1.0, 2.0, 5.0};
constexpr int kBins = kShownDecades * static_cast<int>(kBinEnds.size()) + 1;

using Bins = std::array<std::size_t, kBins>;

/// Histogram of the overlaps of a frame's points. The bins end at 1, 2 and 5 times powers of ten,
/// and are the same in all frames of a sequence, as is their height for a point.
class OverlapsPanel : public PanelContent {
 public:
  OverlapsPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    double deepest = 0;  // metres
    each_overlap(frames, [&](double overlap) { deepest = std::max(deepest, overlap); });
    if (deepest <= 0) return;
    // Upper ends, from the least; the last one is at least the deepest overlap.
    int last = static_cast<int>(std::floor(3 * std::log10(deepest))) - 2;
    while (end_at(last) < deepest) ++last;
    first_ = last - kBins + 1;
    for (const trace::Frame& frame : frames)
      most_ = std::max(most_, std::ranges::max(bins_of(frame)));
  }

  PanelNeed need(const PanelMoment&) const override {
    const auto high = [&](double bars) {
      return Sheet::heading_height(scale_) +
             scale_ * static_cast<float>(bars + kAboveBars + kBelowBars);
    };
    return {high(kMinBars), high(1.5 * kMinBars), high(kMaxBars), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    const Bins bins = bins_of(frame);
    const auto overlapping = std::accumulate(bins.begin(), bins.end(), std::int64_t{0});
    double deepest = 0;
    each_overlap({&frame, 1}, [&](double overlap) { deepest = std::max(deepest, overlap); });
    const auto points = static_cast<std::int64_t>(count_contacts(frame).points);
    sheet.heading(points == 0 ? "overlaps: no contact points"
                              : "overlaps of " + spell_count(overlapping) + " of " +
                                    spell_count(points) + " points");
    if (most_ == 0) {
      sheet.line("no point overlaps in any frame", kText);
      return {};
    }
    const Pen pen(sheet.pen().drawing(), sheet.pen().scale(), kBinLabel);
    const Rect rest = sheet.rest();
    const double top = rest.y + pen.px(kAboveBars);
    const double height =
        std::min<double>(pen.px(kMaxBars), rest.bottom() - pen.px(kBelowBars) - top);
    const double foot = top + height, width = rest.width / kBins;
    const int marked = deepest > 0 ? bin_of(deepest) : -1;
    for (int i = 0; i < kBins; ++i) {
      const std::size_t count = bins[static_cast<std::size_t>(i)];
      const double left = rest.x + i * width;
      const double high = height * static_cast<double>(count) / static_cast<double>(most_);
      const Rect bar = {left + pen.px(1), foot - high, width - pen.px(2), high};
      pen.fill(bar, i == marked ? kContact : with_alpha(kContact, 0.45f));
      if (count > 0)
        pen.text(Said{std::to_string(count)}, pixel(left + 0.5 * width, bar.y - pen.px(4)),
                 Align::Center, i == marked ? kContact : kQuietText,
                 i == marked ? Weight::Bold : Weight::Regular);
      // A label at each power of ten.
      const int end = first_ + i;
      if (((end % 3) + 3) % 3 != 0) continue;
      const double right = left + width;
      pen.line(pixel(right, foot), pixel(right, foot + pen.px(4)), 1, kQuietText);
      if (right > rest.right() - pen.px(12)) continue;
      const Prefix unit = staging_.scales.length.value_or(prefix_for(end_at(end)));
      pen.text(Said{spell_number(end_at(end) / unit.size) + " " + unit.name + "m"},
               pixel(right, foot + pen.px(17)), Align::Center, kQuietText);
    }
    pen.line(pixel(rest.x, foot), pixel(rest.right(), foot), 1.2, kQuietText);
    sheet.skip_to(foot + pen.px(kBelowBars));
    return {};
  }

 private:
  template <class Visit>
  static void each_overlap(std::span<const trace::Frame> frames, const Visit& visit) {
    for (const trace::Frame& frame : frames)
      for (const trace::Pair& pair : frame.pairs)
        for (const auto& [manifold, point] : all_points(pair))
          if (point->separation < 0) visit(-point->separation);
  }

  /// 1, 2 or 5 times a power of ten, metres; 0 is 1 m.
  static double end_at(int index) {
    const int decade = static_cast<int>(std::floor(index / 3.0));
    return kBinEnds[static_cast<std::size_t>(index - 3 * decade)] * std::pow(10.0, decade);
  }

  int bin_of(double overlap) const {
    int bin = 0;
    while (bin + 1 < kBins && end_at(first_ + bin) < overlap) ++bin;
    return bin;
  }

  Bins bins_of(const trace::Frame& frame) const {
    Bins bins{};
    each_overlap({&frame, 1},
                 [&](double overlap) { ++bins[static_cast<std::size_t>(bin_of(overlap))]; });
    return bins;
  }

  int first_ = 0;         // end of the first bin
  std::size_t most_ = 0;  // points in a bin
};

}  // namespace

const PanelDrawing kOverlapsPanel{.make = make_panel<OverlapsPanel>};

}  // namespace contactscope::draw
