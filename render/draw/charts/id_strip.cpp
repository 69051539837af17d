#include "draw/charts/id_strip.h"

#include <algorithm>
#include <map>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr Color kThere = rgb(0xD5D8DC);

}  // namespace

IdHistory::IdHistory(const std::vector<std::vector<IdState>>& rows,
                     const std::vector<std::size_t>& pairs)
    : frames_(rows.empty() ? 0 : rows.front().size()) {
  // A run for each stretch of equal values, made from where it begins.
  const auto runs_of = [](const auto& values, auto make) {
    std::vector<Run> runs;
    for (std::size_t from = 0; from < values.size(); from = runs.back().to) {
      runs.push_back(make(from));
      runs.back().from = from;
      runs.back().to = from + 1;
      while (runs.back().to < values.size() && values[runs.back().to] == values[from])
        ++runs.back().to;
    }
    return runs;
  };
  std::map<std::size_t, std::vector<std::size_t>> rows_of;  // of each pair
  for (std::size_t row = 0; row < rows.size(); ++row) rows_of[pairs[row]].push_back(row);
  for (const auto& [pair, own] : rows_of) {
    std::vector<std::vector<std::size_t>> kept(frames_);  // rows, in each frame
    for (const std::size_t row : own) {
      rows_.push_back(
          runs_of(rows[row], [&](std::size_t f) { return Run{.state = rows[row][f]}; }));
      for (std::size_t f = 0; f < frames_; ++f) {
        if (rows[row][f] == IdState::Kept) kept[f].push_back(row);
      }
    }
    bands_.push_back(runs_of(kept, [&](std::size_t f) { return Run{.kept = kept[f].size()}; }));
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
  double top = strip.y;
  for (std::size_t b = 0; b < count; ++b, top += pitch) {
    std::size_t most = 1;
    for (const Run& run : bands_[b]) most = std::max(most, run.from < until ? run.kept : 0);
    const double low = top + 0.9 * pitch;
    std::size_t kept_before = 0;
    for (const Run& run : bands_[b]) {
      if (run.from >= until) break;
      const double x = strip.x + column * static_cast<double>(run.from);
      const double height = 0.8 * pitch * static_cast<double>(run.kept) / static_cast<double>(most);
      const std::size_t length = std::min(run.to, until) - run.from;
      if (run.kept > 0)
        pen.fill({x, low - height, column * static_cast<double>(length), height}, kContact);
      if (run.kept > 0 && kept_before > 0)
        pen.line(pixel(x, low), pixel(x, top + 0.1 * pitch),
                 std::min(1.6, 0.5 * column / pen.px(1)), kWhite);
      kept_before = run.kept;
    }
  }
  draw_moment(strip, frames_, moment, pen);
}

void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen) {
  const double column = chart.width / static_cast<double>(frames);
  const double x = chart.x + column * (static_cast<double>(moment) + 0.5);
  const Point2 top = pixel(x, chart.y - pen.px(2)), low = pixel(x, chart.bottom() + pen.px(2));
  pen.line(top, low, 3.5, with_alpha(kWhite, 0.8f));
  pen.line(top, low, 1.5, kNormal);
}

}  // namespace contactscope::draw
