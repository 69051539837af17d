#include "app/compare/page_cells.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace contactscope::app {

draw::Staging stage_cell(const trace::Header& header, const std::vector<trace::Frame>& frames,
                         const View& view, const draw::Rect& cell) {
  draw::FigureStyle on_page;
  on_page.scale = 1.4;  // text on a small canvas must be legible on the page
  int width = static_cast<int>(1.2 * cell.width), height = static_cast<int>(1.5 * cell.height);
  for (int round = 0; round < 2; ++round) {
    const draw::Rect room = draw::stage(header, frames, view, width, height, on_page).layout.view;
    width += static_cast<int>(std::ceil(cell.width - room.width));
    height += static_cast<int>(std::ceil(cell.height - room.height));
  }
  return draw::stage(header, frames, view, width, height, on_page);
}

void paste(const Image& from, const draw::Rect& part, const draw::Rect& cell, Image& to) {
  const int columns = static_cast<int>(std::min(part.width, cell.width));
  const int rows = static_cast<int>(std::min(part.height, cell.height));
  const auto begin = [&](const draw::Rect& rect) {
    return std::pair(static_cast<int>(rect.x + (rect.width - columns) / 2),
                     static_cast<int>(rect.y + (rect.height - rows) / 2));
  };
  const auto [from_x, from_y] = begin(part);
  const auto [x, y] = begin(cell);
  const auto pixel = [](const Image& image, int column, int row) {
    return 3 * static_cast<std::size_t>(row * image.width + column);
  };
  for (int row = 0; row < rows; ++row)
    std::memcpy(&to.rgb[pixel(to, x, y + row)], &from.rgb[pixel(from, from_x, from_y + row)],
                3 * static_cast<std::size_t>(columns));
}

}  // namespace contactscope::app
