#include "draw/scene/hatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace contactscope::draw {
namespace {

using Interval = std::pair<double, double>;

/// Where a line runs inside a convex polygon (Cyrus and Beck 1978).
std::optional<Interval> inside(const std::vector<Vec2d>& polygon, const Vec2d& origin,
                               const Vec2d& direction) {
  if (polygon.size() < 3) return std::nullopt;
  Interval t{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double distance = cross(edge, origin - polygon[i]);  // positive inside
    const double speed = cross(edge, direction);
    if (speed == 0) {
      if (distance < 0) return std::nullopt;
    } else if (speed > 0) {
      t.first = std::max(t.first, -distance / speed);
    } else {
      t.second = std::min(t.second, -distance / speed);
    }
  }
  if (t.first >= t.second) return std::nullopt;
  return t;
}

}  // namespace

void hatch(const std::vector<Vec2d>& whole, const std::vector<Vec2d>& hole, double spacing,
           float width, const Color& color, Drawing& drawing) {
  if (whole.size() < 3) return;
  const Vec2d direction = Vec2d(1, -1) / std::sqrt(2.0);
  const Vec2d across = Vec2d(1, 1) / std::sqrt(2.0);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2d& corner : whole) {
    low = std::min(low, across.dot(corner));
    high = std::max(high, across.dot(corner));
  }
  const auto line = [&](const Vec2d& origin, double from, double to) {
    if (!(to > from)) return;
    const Vec2d a = origin + from * direction;
    const Vec2d b = origin + to * direction;
    drawing.primitives.push_back(Stroke{{static_cast<float>(a.x()), static_cast<float>(a.y())},
                                        {static_cast<float>(b.x()), static_cast<float>(b.y())},
                                        width,
                                        color,
                                        Cap::Butt});
  };
  // Lines at multiples of the spacing, so that neighbouring regions continue each other.
  for (double offset = std::ceil(low / spacing) * spacing; offset < high; offset += spacing) {
    const Vec2d origin = offset * across;
    const std::optional<Interval> seen = inside(whole, origin, direction);
    if (!seen) continue;
    const std::optional<Interval> gone = inside(hole, origin, direction);
    if (!gone) {
      line(origin, seen->first, seen->second);
    } else {
      line(origin, seen->first, std::min(seen->second, gone->first));
      line(origin, std::max(seen->first, gone->second), seen->second);
    }
  }
}

}  // namespace contactscope::draw
