#include "image/glyph_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contactscope {
namespace {

/// Accumulates the edges of an outline. Each edge covers the pixels on its right, positive if it
/// goes down and negative if it goes up; the prefix sum of a row is its coverage. Two extra columns
/// take the contributions of edges at the right border.
struct CoverageSums {
  int width, height;
  std::vector<double> sums = std::vector<double>(index(height, 0));

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width + 2) +
           static_cast<std::size_t>(column);
  }

  void add_edge(ContourPoint from, ContourPoint to) {
    if (from.y == to.y) return;
    const double direction = from.y < to.y ? 1 : -1;
    if (direction < 0) std::swap(from, to);
    const double slope = (to.x - from.x) / (to.y - from.y);
    const auto x_at = [&](double y) {
      return std::clamp(from.x + slope * (y - from.y), 0.0, static_cast<double>(width));
    };
    const int first = std::max(0, static_cast<int>(std::floor(from.y)));
    const int last = std::min(height, static_cast<int>(std::ceil(to.y)));
    for (int row = first; row < last; ++row) {
      const double top = std::max<double>(from.y, row), bottom = std::min<double>(to.y, row + 1);
      add_to_row(row, x_at(top), x_at(bottom), direction * (bottom - top));
    }
  }

  /// Adds a part of an edge within one row, with its signed height `rise`.
  void add_to_row(int row, double x0, double x1, double rise) {
    const auto [left, right] = std::minmax(x0, x1);
    const int first = static_cast<int>(std::floor(left));
    for (int column = first; column == first || column < right; ++column) {
      // Split at columns: this part covers its pixel from the mean of its ends to the right, and
      // all pixels to the right fully.
      const double from = std::max<double>(left, column), to = std::min<double>(right, column + 1);
      const double part = right > left ? rise * (to - from) / (right - left) : rise;
      const double uncovered = part * (0.5 * (from + to) - column);
      sums[index(row, column)] += part - uncovered;
      sums[index(row, column + 1)] += uncovered;
    }
  }
};

}  // namespace

std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height) {
  CoverageSums all{width, height};
  for (const Contour& contour : outline) {
    for (std::size_t i = 0; i < contour.size(); ++i)
      all.add_edge(contour[i], contour[(i + 1) % contour.size()]);
  }
  std::vector<std::uint8_t> coverage;
  coverage.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    double sum = 0;
    for (int column = 0; column < width; ++column) {
      sum += all.sums[all.index(row, column)];
      coverage.push_back(static_cast<std::uint8_t>(std::min(1.0, std::abs(sum)) * 255 + 0.5));
    }
  }
  return coverage;
}

}  // namespace contactscope
