#include "draw/charts/id_strip.h"

#include <algorithm>
#include <numeric>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr Color kThere = rgb(0xD5D8DC);

/// The end of the run of equal values that begins at `from`.
template <class Values>
std::size_t end_of_run(const Values& values, std::size_t from) {
  std::size_t to = from + 1;
  while (to < values.size() && values[to] == values[from]) ++to;
  return to;
}

}  // namespace

IdHistory::IdHistory(const std::vector<std::vector<IdState>>& rows,
                     const std::vector<std::size_t>& pairs)
    : frames_(rows.empty() ? 0 : rows.front().size()) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t row) { return pairs[row]; });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    std::vector<std::vector<std::size_t>> kept(frames_);  // rows of the pair, in each frame
    for (; end < order.size() && pairs[order[end]] == pairs[order[begin]]; ++end) {
      const std::vector<IdState>& states = rows[order[end]];
      std::vector<Run>& runs = rows_.emplace_back();
      for (std::size_t from = 0; from < frames_; from = runs.back().to) {
        runs.push_back({from, end_of_run(states, from), states[from], 0});
      }
      for (std::size_t f = 0; f < frames_; ++f) {
        if (states[f] == IdState::Kept) kept[f].push_back(end);
      }
    }
    std::vector<Run>& band = bands_.emplace_back();
    for (std::size_t from = 0; from < frames_; from = band.back().to) {
      band.push_back({from, end_of_run(kept, from), IdState::Absent, kept[from].size()});
    }
    begin = end;
  }
}

void IdHistory::draw_rows(const Rect& strip, std::size_t moment, std::size_t until,
                          const Pen& pen) const {
  const double row = strip.height / static_cast<double>(rows_.size());
  const double column = strip.width / static_cast<double>(frames_);
  const double gap = row > 2.5 ? 0.18 * row : 0;
  double y = strip.y;
  for (const std::vector<Run>& runs : rows_) {
    for (const Run& run : runs) {
      if (run.from >= until) break;
      if (run.state == IdState::Absent) continue;
      const std::size_t length = std::min(run.to, until) - run.from;
      pen.fill({strip.x + column * static_cast<double>(run.from), y + gap,
                column * static_cast<double>(length), row - 2 * gap},
               run.state == IdState::Kept ? kContact : kThere);
    }
    y += row;
  }
  draw_moment(strip, frames_, moment, pen);
}

void IdHistory::draw_bands(const Rect& strip, std::size_t moment, std::size_t until,
                           std::size_t count, const Pen& pen) const {
  count = std::min(count, bands_.size());
  const double pitch = strip.height / static_cast<double>(count);
  const double column = strip.width / static_cast<double>(frames_);
  const auto begun = [&](const Run& run) { return run.from < until; };
  double top = strip.y;
  for (std::size_t b = 0; b < count; ++b, top += pitch) {
    std::size_t most = 1;
    for (const Run& run : bands_[b]) most = std::max(most, begun(run) ? run.kept : 0);
    const double low = top + 0.9 * pitch;
    const Run* before = nullptr;
    for (const Run& run : bands_[b]) {
      if (!begun(run)) break;
      const double x = strip.x + column * static_cast<double>(run.from);
      const double height = 0.8 * pitch * static_cast<double>(run.kept) / static_cast<double>(most);
      const std::size_t length = std::min(run.to, until) - run.from;
      if (run.kept > 0)
        pen.fill({x, low - height, column * static_cast<double>(length), height}, kContact);
      if (run.kept > 0 && before != nullptr && before->kept > 0) {
        const auto at = static_cast<float>(x);
        const double width = std::min(1.6, 0.5 * column / pen.px(1));
        pen.line({at, static_cast<float>(low)}, {at, static_cast<float>(top + 0.1 * pitch)}, width,
                 kWhite);
      }
      before = &run;
    }
  }
  draw_moment(strip, frames_, moment, pen);
}

void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen) {
  const double column = chart.width / static_cast<double>(frames);
  const auto x = static_cast<float>(chart.x + column * (static_cast<double>(moment) + 0.5));
  const auto y0 = static_cast<float>(chart.y - pen.px(2));
  const auto y1 = static_cast<float>(chart.y + chart.height + pen.px(2));
  pen.line({x, y0}, {x, y1}, 3.5, with_alpha(kWhite, 0.8f));
  pen.line({x, y0}, {x, y1}, 1.5, kNormal);
}

}  // namespace contactscope::draw
