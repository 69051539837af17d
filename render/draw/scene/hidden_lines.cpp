#include "draw/scene/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/at.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// A line within this fraction of the occluder's size of a shadow's border is visible: it is an edge
// of the occluder or touches it, and rounding must not decide. If the occluder is larger than the
// view, the view's size counts, so that shapes sunk into a wide floor are hidden.
constexpr double kBorder = 2e-4;
// Cosine: a polygon seen edge-on hides nothing, because rounding would decide what is inside it.
constexpr double kEdgeOn = 1e-12;
// Widest gap between two shadows, in borders, that counts as a seam: borders may be at a slant.
constexpr double kSeam = 8;
// If there are more occluders, as in a terrain, a grid on the screen finds those near a line.
constexpr std::size_t kManyOccluders = 96;
constexpr int kColumns = 48, kRows = 32;
constexpr std::size_t kManyBodies = 12;

/// Corners of a rectangle on the screen that holds the body; nothing if a part may be behind the eye.
std::vector<Point2> corners_around(const RoundBody& body, const Camera& camera) {
  constexpr double kWider = 1.2;  // a ball in perspective is an ellipse, off the middle
  std::vector<Point2> corners;
  for (const Vec3d& core : body.core) {
    const Vec3d near = core + body.radius * camera.to_eye(core).normalized();
    const std::optional<Point2> middle = camera.project(core);
    if (!middle || !camera.project(near)) return {};
    const double reach = kWider * body.radius * camera.pixels_per_metre(near);
    corners.push_back(pixel(middle->x - reach, middle->y - reach));
    corners.push_back(pixel(middle->x + reach, middle->y + reach));
  }
  return corners;
}

}  // namespace

HiddenLines::HiddenLines(const Camera& camera, const Occluders& occluders,
                         const std::vector<ConvexShadow>& shadows,
                         const std::vector<RoundBody>& bodies)
    : camera_(camera), begins_{0}, cells_(kColumns * kRows) {
  const bool many_bodies = shadows.size() >= kManyBodies && bodies.size() == shadows.size();
  for (std::size_t i = 0; i < shadows.size(); ++i) {
    bounds_.insert(bounds_.end(), shadows[i].begin(), shadows[i].end());
    const int index = end_shadow();
    const std::vector<Point2> seen =
        many_bodies ? corners_around(bodies[i], camera) : std::vector<Point2>();
    if (seen.empty())
      everywhere_.push_back(index);
    else
      each_cell(seen, [&](std::size_t cell) { cells_[cell].push_back(index); });
  }
  const bool few = occluders.size() < kManyOccluders;
  for (const std::vector<Vec3d>& polygon : occluders) {
    if (polygon.size() < 3) continue;
    const Vec3d middle = mean_of(polygon);
    double size = 0;
    for (const Vec3d& p : polygon) size = std::max(size, (p - middle).norm());
    const double view = std::hypot(camera.viewport().width, camera.viewport().height) /
                        camera.pixels_per_metre(middle);
    const double border = kBorder * std::min(size, view);
    border_ = std::max(border_, border);
    std::vector<Point2> seen;
    if (!few) {
      seen = project_polygon(camera, polygon);
      if (seen.empty()) continue;  // no visible line is near it
    }
    Vec3d normal = newell_normal(polygon).normalized();
    const Vec3d to_eye = camera.to_eye(middle);
    const double facing = normal.dot(to_eye);
    if (std::abs(facing) <= kEdgeOn * to_eye.norm()) continue;
    if (facing < 0) normal = -normal;

    bounds_.push_back({normal, normal.dot(middle) - border});  // behind the polygon
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& p = polygon[i];
      const Vec3d& q = polygon[(i + 1) % polygon.size()];
      // The plane through the eye and the edge; its normal points out of the polygon. The winding
      // decides, because the middle of a sliver that is not quite flat may be beyond an edge.
      Vec3d side = (q - p).cross(camera.to_eye(p));
      const double length = side.norm();
      if (length <= kBorder * (q - p).norm()) continue;
      side /= length;
      if (facing < 0) side = -side;
      bounds_.push_back({side, side.dot(p) - border});
    }
    const int index = end_shadow();
    if (few)
      everywhere_.push_back(index);
    else
      each_cell(seen, [&](std::size_t cell) { cells_[cell].push_back(index); });
  }
}

int HiddenLines::end_shadow() {
  begins_.push_back(bounds_.size());
  return count_of(begins_) - 2;
}

template <class Visit>
void HiddenLines::each_cell(std::span<const Point2> points, const Visit& visit) const {
  const Rect& view = camera_.viewport();
  Eigen::AlignedBox2i box;
  for (const Point2& at : points) {
    const double x = (at.x - view.x) / view.width * kColumns;
    const double y = (at.y - view.y) / view.height * kRows;
    box.extend(Eigen::Vector2i(static_cast<int>(std::clamp(x, 0.0, kColumns - 1.0)),
                               static_cast<int>(std::clamp(y, 0.0, kRows - 1.0))));
  }
  for (int row = box.min().y(); row <= box.max().y(); ++row) {
    for (int column = box.min().x(); column <= box.max().x(); ++column)
      visit(static_cast<std::size_t>(row * kColumns + column));
  }
}

std::vector<Span> HiddenLines::split(const Vec3d& from, const Vec3d& to) const {
  std::vector<std::pair<double, double>> hidden;
  const auto look = [&](int index) {
    const auto shadow = static_cast<std::size_t>(index);
    double first = 0, last = 1;
    for (std::size_t i = begins_[shadow]; i < begins_[shadow + 1]; ++i) {
      const double d0 = bounds_[i].distance(from);
      const double d1 = bounds_[i].distance(to);
      if (d0 > 0 && d1 > 0) return;
      if (d0 > 0) first = std::max(first, d0 / (d0 - d1));
      if (d1 > 0) last = std::min(last, d0 / (d0 - d1));
    }
    if (first < last) hidden.emplace_back(first, last);
  };
  std::ranges::for_each(everywhere_, look);
  if (everywhere_.size() + 1 < begins_.size()) {
    // A shadow is examined in each of its cells. Its repeated interval changes nothing.
    if (const std::optional<Segment2> seen = project_segment(camera_, from, to))
      each_cell(std::array{seen->from, seen->to},
                [&](std::size_t cell) { std::ranges::for_each(cells_[cell], look); });
  }
  std::ranges::sort(hidden);

  // Shadows of neighbours stop short of each other by their borders; the gap is hidden too.
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
