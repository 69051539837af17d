#include "draw/id_strip.h"

#include "draw/palette.h"

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
