#include "draw/scene/hidden_lines.h"

#include <algorithm>
#include <limits>

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
    : camera_(camera), shadows_(shadows), cells_(kColumns * kRows) {
  for (std::size_t i = 0; i < shadows.size(); ++i) everywhere_.push_back(static_cast<int>(i));
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  for (const std::vector<Vec3d>& polygon : occluders) {
    for (const Vec3d& p : polygon) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const bool few = occluders.size() < kManyOccluders;
  for (const std::vector<Vec3d>& polygon : occluders) {
    if (polygon.size() < 3) continue;
    Vec3d middle = Vec3d::Zero();
    Vec3d normal = Vec3d::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      middle += polygon[i];
      normal += (polygon[i] - polygon[0]).cross(polygon[(i + 1) % polygon.size()] - polygon[0]);
    }
    middle /= static_cast<double>(polygon.size());
    double size = 0;
    for (const Vec3d& p : polygon) size = std::max(size, (p - middle).norm());
    const double border = kBorder * size;
    border_ = std::max(border_, border);
    normal.normalize();
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
    const int index = static_cast<int>(shadows_.size());
    shadows_.push_back(std::move(shadow));
    if (few) {
      everywhere_.push_back(index);
      continue;
    }
    const Cells cells = cells_of(project_polygon(camera, polygon));
    for (int row = cells.first[1]; row <= cells.last[1]; ++row) {
      for (int column = cells.first[0]; column <= cells.last[0]; ++column) {
        cells_[static_cast<std::size_t>(row * kColumns + column)].push_back(index);
      }
    }
  }
}

HiddenLines::Cells HiddenLines::cells_of(std::span<const Point2> points) const {
  const Rect& view = camera_.viewport();
  Cells cells{{kColumns, kRows}, {-1, -1}};
  for (const Point2& at : points) {
    const double x = (at.x - view.x) / view.width * kColumns;
    const double y = (at.y - view.y) / view.height * kRows;
    const std::array<int, 2> cell = {static_cast<int>(std::clamp(x, 0.0, kColumns - 1.0)),
                                     static_cast<int>(std::clamp(y, 0.0, kRows - 1.0))};
    for (std::size_t k = 0; k < 2; ++k) {
      cells.first[k] = std::min(cells.first[k], cell[k]);
      cells.last[k] = std::max(cells.last[k], cell[k]);
    }
  }
  return cells;
}

std::vector<int> HiddenLines::candidates(const Vec3d& from, const Vec3d& to) const {
  std::vector<int> found = everywhere_;
  if (found.size() == shadows_.size()) return found;
  const std::optional<Segment2> seen = project_segment(camera_, from, to);
  if (!seen) return found;
  const Cells cells = cells_of(std::array{seen->from, seen->to});
  for (int row = cells.first[1]; row <= cells.last[1]; ++row) {
    for (int column = cells.first[0]; column <= cells.last[0]; ++column) {
      const std::vector<int>& here = cells_[static_cast<std::size_t>(row * kColumns + column)];
      found.insert(found.end(), here.begin(), here.end());
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Span> HiddenLines::split(const Vec3d& from, const Vec3d& to) const {
  std::vector<std::pair<double, double>> hidden;
  for (const int index : candidates(from, to)) {
    double first = 0, last = 1;
    for (const Plane<double>& bound : shadows_[static_cast<std::size_t>(index)]) {
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
  std::sort(hidden.begin(), hidden.end());

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
