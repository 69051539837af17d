#include "draw/scene/visibility.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/at.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// A line within this fraction of the occluders' size of a shadow's border is seen: it is an edge of
// the occluder itself, or touches it, and rounding must not decide.
constexpr double kBorder = 2e-4;
// Widest gap between two shadows, in borders, that counts as their seam: two borders seen at a
// slant.
constexpr double kSeam = 8;
// A terrain has thousands of occluders, of which few are near a line: they are found by where they
// are on the screen. Not worth it for fewer than these.
constexpr std::size_t kManyOccluders = 96;
constexpr int kColumns = 48, kRows = 32;

}  // namespace

HiddenLines::HiddenLines(const Camera& camera, const Occluders& occluders,
                         const std::vector<ConvexShadow>& shadows)
    : camera_(camera), shadows_(shadows), everywhere_(shadows.size()), cells_(kColumns * kRows) {
  std::iota(everywhere_.begin(), everywhere_.end(), 0);
  const bool few = occluders.size() < kManyOccluders;
  for (const std::vector<Vec3d>& polygon : occluders) {
    if (polygon.size() < 3) continue;
    const Vec3d middle = mean_of(polygon);
    double size = 0;
    for (const Vec3d& p : polygon) size = std::max(size, (p - middle).norm());
    const double border = kBorder * size;
    border_ = std::max(border_, border);
    Vec3d normal = newell_normal(polygon).normalized();
    if (normal.dot(camera.to_eye(middle)) < 0) normal = -normal;

    ConvexShadow shadow;
    shadow.push_back({normal, normal.dot(middle) - border});  // behind the polygon
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& p = polygon[i];
      const Vec3d& q = polygon[(i + 1) % polygon.size()];
      // The plane through the eye and the edge, facing away from the polygon's middle.
      Vec3d side = (q - p).cross(camera.to_eye(p));
      const double length = side.norm();
      if (length <= kBorder * (q - p).norm()) continue;
      side /= length;
      if (side.dot(middle - p) > 0) side = -side;
      shadow.push_back({side, side.dot(p) - border});
    }
    const int index = count_of(shadows_);
    shadows_.push_back(std::move(shadow));
    if (few) {
      everywhere_.push_back(index);
    } else {
      for (const int cell : cells_of(project_polygon(camera, polygon)))
        at(cells_, cell).push_back(index);
    }
  }
}

std::vector<int> HiddenLines::cells_of(std::span<const Point2> points) const {
  const Rect& view = camera_.viewport();
  Eigen::AlignedBox2i box;
  for (const Point2& at : points) {
    const double x = (at.x - view.x) / view.width * kColumns;
    const double y = (at.y - view.y) / view.height * kRows;
    box.extend(Eigen::Vector2i(static_cast<int>(std::clamp(x, 0.0, kColumns - 1.0)),
                               static_cast<int>(std::clamp(y, 0.0, kRows - 1.0))));
  }
  std::vector<int> cells;
  for (int row = box.min().y(); row <= box.max().y(); ++row) {
    for (int column = box.min().x(); column <= box.max().x(); ++column)
      cells.push_back(row * kColumns + column);
  }
  return cells;
}

std::vector<Span> HiddenLines::split(const Vec3d& from, const Vec3d& to) const {
  std::vector<int> candidates = everywhere_;
  if (candidates.size() < shadows_.size()) {
    if (const std::optional<Segment2> seen = project_segment(camera_, from, to)) {
      for (const int cell : cells_of(std::array{seen->from, seen->to}))
        candidates.insert(candidates.end(), at(cells_, cell).begin(), at(cells_, cell).end());
    }
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  }
  std::vector<std::pair<double, double>> hidden;
  for (const int index : candidates) {
    double first = 0, last = 1;
    for (const Plane<double>& bound : at(shadows_, index)) {
      const double d0 = bound.distance(from);
      const double d1 = bound.distance(to);
      if (d0 > 0 && d1 > 0) {
        first = 1;
        last = 0;
        break;
      }
      if (d0 > 0) first = std::max(first, d0 / (d0 - d1));
      if (d1 > 0) last = std::min(last, d0 / (d0 - d1));
    }
    if (first < last) hidden.emplace_back(first, last);
  }
  std::ranges::sort(hidden);

  // Shadows of neighbours stop short of each other by their borders; what is between them is
  // hidden.
  const double length = (to - from).norm();
  const double seam = length > 0 ? kSeam * border_ / length : 0;

  std::vector<Span> spans;
  double reached = 0;
  for (const auto& [first, last] : hidden) {
    if (last <= reached) continue;
    const double begin = reached > 0 && first - reached < seam ? reached : std::max(first, reached);
    if (begin > reached) spans.push_back({reached, begin, false});
    if (!spans.empty() && spans.back().hidden && spans.back().to == begin) {
      spans.back().to = last;
    } else {
      spans.push_back({begin, last, true});
    }
    reached = last;
  }
  if (reached < 1) spans.push_back({reached, 1, false});
  return spans;
}

}  // namespace contactscope::draw
