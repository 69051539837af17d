#include "image/glyph_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contactscope {
namespace {

/// What the edges of an outline add to the pixels of a bitmap. Each edge covers what is on its
/// right, downwards positive and upwards negative: the sum from the left is the coverage of a pixel.
/// Two columns more take up what edges at the right border leave behind it.
class CoverageSums {
 public:
  CoverageSums(int width, int height)
      : width_(width),
        height_(height),
        sums_(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height)) {}

  void add_edge(ContourPoint from, ContourPoint to) {
    if (from.y == to.y) return;
    const double direction = from.y < to.y ? 1 : -1;
    if (direction < 0) std::swap(from, to);
    const double slope = (to.x - from.x) / (to.y - from.y);
    const auto x_at = [&](double y) {
      return std::clamp(from.x + slope * (y - from.y), 0.0, static_cast<double>(width_));
    };
    const int first = std::max(0, static_cast<int>(std::floor(from.y)));
    const int last = std::min(height_, static_cast<int>(std::ceil(to.y)));
    for (int row = first; row < last; ++row) {
      const double top = std::max<double>(from.y, row), bottom = std::min<double>(to.y, row + 1);
      add_to_row(row, x_at(top), x_at(bottom), direction * (bottom - top));
    }
  }

  std::vector<std::uint8_t> coverage() const {
    std::vector<std::uint8_t> result;
    result.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row) {
      double sum = 0;
      for (int column = 0; column < width_; ++column) {
        sum += sums_[index(row, column)];
        result.push_back(static_cast<std::uint8_t>(std::min(1.0, std::abs(sum)) * 255 + 0.5));
      }
    }
    return result;
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 2) +
           static_cast<std::size_t>(column);
  }

  /// Part of an edge within one row, `height` high with its sign.
  void add_to_row(int row, double x0, double x1, double height) {
    const double left = std::min(x0, x1), right = std::max(x0, x1);
    const int first = static_cast<int>(std::floor(left));
    for (int column = first; column == first || column < right; ++column) {
      // The part within this column. What is on its right covers the pixel to the mean of both
      // ends, and all pixels after it whole.
      const double from = std::max<double>(left, column), to = std::min<double>(right, column + 1);
      const double part = right > left ? height * (to - from) / (right - left) : height;
      const double uncovered = part * (0.5 * (from + to) - column);
      sums_[index(row, column)] += part - uncovered;
      sums_[index(row, column + 1)] += uncovered;
    }
  }

  int width_, height_;
  std::vector<double> sums_;
};

}  // namespace

std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height) {
  CoverageSums sums(width, height);
  for (const Contour& contour : outline) {
    for (std::size_t i = 0; i < contour.size(); ++i)
      sums.add_edge(contour[i], contour[(i + 1) % contour.size()]);
  }
  return sums.coverage();
}

}  // namespace contactscope
