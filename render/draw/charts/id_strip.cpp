#include "draw/charts/id_strip.h"

#include <algorithm>
#include <set>

#include "draw/scene/palette.h"

namespace contactscope::draw {

void draw_id_strip(const std::vector<std::vector<IdState>>& rows, std::size_t frames,
                   std::size_t moment, const Rect& strip, float pixel, Drawing& drawing) {
  const double row = strip.height / static_cast<double>(rows.size());
  const double column = strip.width / static_cast<double>(frames);
  const auto bar = [&](std::size_t id, std::size_t from, std::size_t to, const Color& color) {
    const double gap = row > 2.5 ? 0.18 * row : 0;
    const auto x0 = static_cast<float>(strip.x + column * static_cast<double>(from));
    const auto x1 = static_cast<float>(strip.x + column * static_cast<double>(to));
    const auto y0 = static_cast<float>(strip.y + row * static_cast<double>(id) + gap);
    const auto y1 = static_cast<float>(strip.y + row * static_cast<double>(id + 1) - gap);
    drawing.primitives.push_back(Fill{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, color});
  };
  for (std::size_t id = 0; id < rows.size(); ++id) {
    const std::vector<IdState>& states = rows[id];
    std::size_t from = 0;
    while (from < states.size()) {
      std::size_t to = from + 1;
      while (to < states.size() && states[to] == states[from]) ++to;
      if (states[from] == IdState::Kept) bar(id, from, to, kContact);
      if (states[from] == IdState::Dropped) bar(id, from, to, rgb(0xD5D8DC));
      from = to;
    }
  }
  draw_moment(strip, frames, moment, pixel, drawing);
}

void draw_id_bands(const std::vector<std::vector<IdState>>& rows,
                   const std::vector<std::size_t>& pairs, std::size_t frames, std::size_t moment,
                   const Rect& strip, float pixel, Drawing& drawing) {
  const std::set<std::size_t> all(pairs.begin(), pairs.end());
  const double pitch = strip.height / static_cast<double>(all.size());
  const double column = strip.width / static_cast<double>(frames);
  double top = strip.y;
  for (const std::size_t pair : all) {
    // The rows that are kept, of each frame.
    std::vector<std::vector<std::size_t>> kept(frames);
    std::size_t most = 1;
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t row = 0; row < rows.size(); ++row) {
        if (pairs[row] == pair && rows[row][f] == IdState::Kept) kept[f].push_back(row);
      }
      most = std::max(most, kept[f].size());
    }
    const double low = top + 0.9 * pitch, high = top + 0.1 * pitch;
    const auto level = [&](std::size_t f) {
      const double share = static_cast<double>(kept[f].size()) / static_cast<double>(most);
      return static_cast<float>(low - share * (low - high));
    };
    const auto y0 = static_cast<float>(low);
    std::size_t from = 0;
    while (from < frames) {
      std::size_t to = from + 1;
      while (to < frames && kept[to] == kept[from]) ++to;
      const auto x0 = static_cast<float>(strip.x + column * static_cast<double>(from));
      const auto x1 = static_cast<float>(strip.x + column * static_cast<double>(to));
      if (!kept[from].empty()) {
        drawing.primitives.push_back(
            Fill{{{x0, level(from)}, {x1, level(from)}, {x1, y0}, {x0, y0}}, kContact});
        if (from > 0 && !kept[from - 1].empty()) {
          const auto width = static_cast<float>(std::min(1.6 * pixel, 0.5 * column));
          drawing.primitives.push_back(
              Stroke{{x0, y0}, {x0, static_cast<float>(high)}, width, kWhite, Cap::Butt});
        }
      }
      from = to;
    }
    top += pitch;
  }
  draw_moment(strip, frames, moment, pixel, drawing);
}

void draw_moment(const Rect& strip, std::size_t frames, std::size_t moment, float pixel,
                 Drawing& drawing) {
  const double column = strip.width / static_cast<double>(frames);
  const auto x = static_cast<float>(strip.x + column * (static_cast<double>(moment) + 0.5));
  const auto y0 = static_cast<float>(strip.y - 2 * pixel);
  const auto y1 = static_cast<float>(strip.y + strip.height + 2 * pixel);
  drawing.primitives.push_back(
      Stroke{{x, y0}, {x, y1}, 3.5f * pixel, with_alpha(kWhite, 0.8f), Cap::Butt});
  drawing.primitives.push_back(Stroke{{x, y0}, {x, y1}, 1.5f * pixel, kNormal, Cap::Butt});
}

}  // namespace contactscope::draw
