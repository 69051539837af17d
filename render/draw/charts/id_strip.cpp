#include "draw/charts/id_strip.h"

#include <algorithm>
#include <map>

#include "draw/charts/series_chart.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {

IdHistory::IdHistory(const std::vector<std::vector<IdState>>& rows,
                     const std::vector<std::size_t>& pairs)
    : frames_(rows.empty() ? 0 : rows.front().size()) {
  const auto extend = [](std::vector<Run>& runs, std::size_t f, bool changes, const Run& run) {
    if (f == 0 || changes) runs.push_back(run);
    ++runs.back().length;
  };
  std::map<std::size_t, std::vector<std::size_t>> rows_of;  // of each pair
  for (std::size_t row = 0; row < rows.size(); ++row) rows_of[pairs[row]].push_back(row);
  for (const auto& [pair, own] : rows_of) {
    std::vector<std::size_t> kept(frames_);  // points, in each frame
    std::vector<bool> replaced(frames_);     // some are not those of the frame before
    for (const std::size_t row : own) {
      std::vector<Run>& runs = rows_.emplace_back();
      IdState before = IdState::Absent;
      for (std::size_t f = 0; f < frames_; ++f) {
        const IdState now = rows[row][f];
        extend(runs, f, now != before, {.from = f, .state = now});
        kept[f] += now == IdState::Kept;
        if ((now == IdState::Kept) != (before == IdState::Kept)) replaced[f] = true;
        before = now;
      }
    }
    std::vector<Run>& band = bands_.emplace_back();
    for (std::size_t f = 0; f < frames_; ++f)
      extend(band, f, replaced[f], {.from = f, .kept = kept[f]});
  }
}

Rect IdHistory::place_of(const Run& run, const Rect& strip, std::size_t until) const {
  const double column = strip.width / static_cast<double>(frames_);
  return {strip.x + column * static_cast<double>(run.from), strip.y,
          column * static_cast<double>(std::min(run.length, until - run.from)), strip.height};
}

void IdHistory::draw_rows(const Rect& strip, std::size_t moment, std::size_t until,
                          const Pen& pen) const {
  const double row = strip.height / static_cast<double>(rows_.size());
  const double gap = row > 2.5 ? 0.18 * row : 0;
  constexpr Color kThere = rgb(0xD5D8DC);
  double y = strip.y;
  for (const std::vector<Run>& runs : rows_) {
    for (const Run& run : runs) {
      if (run.from >= until) break;
      if (run.state == IdState::Absent) continue;
      const Rect place = place_of(run, strip, until);
      pen.fill({place.x, y + gap, place.width, row - 2 * gap},
               run.state == IdState::Kept ? kContact : kThere);
    }
    y += row;
  }
  draw_moment(strip, frames_, moment, pen);
}

void IdHistory::draw_bands(const Rect& strip, std::size_t moment, std::size_t count,
                           const Pen& pen) const {
  const std::size_t until = moment + 1;
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
      const Rect place = place_of(run, strip, until);
      const double height = 0.8 * pitch * static_cast<double>(run.kept) / static_cast<double>(most);
      if (run.kept > 0) pen.fill({place.x, low - height, place.width, height}, kContact);
      if (run.kept > 0 && kept_before > 0)
        pen.line(pixel(place.x, low), pixel(place.x, top + 0.1 * pitch),
                 std::min(1.6, 0.5 * column / pen.px(1)), kWhite);
      kept_before = run.kept;
    }
  }
  draw_moment(strip, frames_, moment, pen);
}

}  // namespace contactscope::draw
