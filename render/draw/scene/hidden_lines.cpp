#include "draw/scene/visibility.h"

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
constexpr int kColumns = 96, kRows = 64;
constexpr std::size_t kManyShadows = 12;

/// Column and row of the cell at or nearest to a place, in cells.
Eigen::Vector2i cell_at(const Eigen::Vector2d& place) {
  return {static_cast<int>(std::clamp(place.x(), 0.0, kColumns - 1.0)),
          static_cast<int>(std::clamp(place.y(), 0.0, kRows - 1.0))};
}

float float_below(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

float float_above(double value) { return -float_below(-value); }

/// The least distance of the points from the plane of the eye.
double nearest_depth(std::span<const Vec3d> points, const Camera& camera) {
  double depth = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : points) depth = std::min(depth, camera.to_camera(p).z());
  return depth;
}

/// A box in float around a box in double.
Eigen::AlignedBox2f around(const Eigen::AlignedBox2d& box) {
  return {Eigen::Vector2f(float_below(box.min().x()), float_below(box.min().y())),
          Eigen::Vector2f(float_above(box.max().x()), float_above(box.max().y()))};
}

/// Whether the intervals cover [0, 1].
bool covers_all(std::span<const std::pair<double, double>> intervals) {
  double reached = 0;
  for (bool grows = true; grows && reached < 1;) {
    grows = false;
    for (const auto& [first, last] : intervals) {
      if (first > reached || last <= reached) continue;
      reached = last;
      grows = true;
    }
  }
  return reached >= 1;
}

}  // namespace

double border_of_shadow(const Camera& camera, const Vec3d& middle, double size) {
  const double view = std::hypot(camera.viewport().width, camera.viewport().height) /
                      camera.pixels_per_metre(middle);
  return kBorder * std::min(size, view);
}

HiddenLines::HiddenLines(const Camera& camera, const Occluders& occluders,
                         const std::vector<ConvexShadow>& shadows)
    : camera_(camera), given_{occluders.size(), shadows.size()} {
  // Adds the shadow of the bounds from `begin` on, and puts it into the cells of the box around its
  // corners; without any it is everywhere. `depth`: that of its nearest point.
  const auto put = [&](std::size_t begin, std::span<const Point2> seen, double depth) -> Shadow& {
    const int index = count_of(shadows_);
    const Box box = box_of(seen);
    const std::size_t end = bounds_.size();
    shadows_.push_back({begin, end, end});
    if (seen.empty()) {
      everywhere_.push_back(index);
      return shadows_.back();
    }
    const Eigen::Vector2i first = cell_at(box.min()), last = cell_at(box.max());
    const Near near{around(box), float_below(depth), index, first.cast<std::int16_t>()};
    for (int row = first.y(); row <= last.y(); ++row)
      for (int column = first.x(); column <= last.x(); ++column)
        at(cells_, row * kColumns + column).push_back(near);
    return shadows_.back();
  };
  const bool many_shadows = shadows.size() >= kManyShadows;
  const bool few = occluders.size() < kManyOccluders;
  if (!few || many_shadows) cells_.resize(kColumns * kRows);
  for (const ConvexShadow& given : shadows) {
    const std::size_t begin = bounds_.size();
    bounds_.insert(bounds_.end(), given.bounds.begin(), given.bounds.end());
    const std::span<const Point2> corners = given.around;
    Shadow& shadow = put(begin, many_shadows ? corners : corners.first(0), given.depth);
    shadow.sides = begin + given.sides;
    shadow.behind = given.behind;
    if (given.opaque && begin < bounds_.size()) shadow.opaque_body = given.body;
  }
  for (const std::vector<Vec3d>& polygon : occluders) {
    if (polygon.size() < 3) continue;
    const Vec3d middle = mean_of(polygon);
    double size = 0;
    for (const Vec3d& p : polygon) size = std::max(size, (p - middle).norm());
    const double border = border_of_shadow(camera, middle, size);
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

    const std::size_t begin = bounds_.size();
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
    put(begin, seen, nearest_depth(polygon, camera));
  }
  for (std::vector<Near>& cell : cells_)
    std::ranges::sort(cell, {},
                      [](const Near& near) { return std::pair(near.depth, near.shadow); });
}

HiddenLines::Box HiddenLines::box_of(std::span<const Point2> points) const {
  const Rect& view = camera_.viewport();
  Box box;
  for (const Point2& at : points)
    box.extend(Eigen::Vector2d((at.x - view.x) / view.width * kColumns,
                               (at.y - view.y) / view.height * kRows));
  return box;
}

bool HiddenLines::hides(const Surface& surface) const {
  if (cells_.empty() || surface.polygon.empty()) return false;
  const Vec3d& first = surface.polygon.front();
  const std::optional<Point2> seen = camera_.project(first);
  if (!seen) return false;
  const Box place = box_of(std::array{*seen});
  const Eigen::AlignedBox2f rounded = around(place);
  const float depth = float_above(camera_.to_camera(first).z());
  const Eigen::Vector2i cell = cell_at(place.min());
  for (const Near& near : at(cells_, cell.y() * kColumns + cell.x())) {
    if (near.depth > depth) return false;
    const Shadow& shadow = at(shadows_, near.shadow);
    if (shadow.opaque_body == kNotOpaque || !near.box.intersects(rounded) ||
        (shadow.opaque_body >= 0 && shadow.opaque_body == surface.body) ||
        bounds_[shadow.last].distance(first) > 0)
      continue;
    const auto is_behind = [&](const Vec3d& corner) {
      return std::all_of(bounds_.begin() + std::ptrdiff_t(shadow.begin),
                         bounds_.begin() + std::ptrdiff_t(shadow.end),
                         [&](const Plane<double>& bound) { return bound.distance(corner) <= 0; });
    };
    if (std::ranges::all_of(surface.polygon, is_behind)) return true;
  }
  return false;
}

std::vector<Span> HiddenLines::split(const Vec3d& from, const Vec3d& to) const {
  std::vector<std::pair<double, double>>& hidden = hidden_;
  hidden.clear();
  // Whether the shadows so far hide the whole line, so that no other one matters.
  const auto hides_all = [&](const Shadow& shadow) {
    double first = 0, last = 1;
    const auto is_before = [&](std::size_t i) {
      return bounds_[i].distance(from) > 0 && bounds_[i].distance(to) > 0;
    };
    if (shadow.begin < shadow.end && is_before(shadow.last)) return false;
    for (std::size_t i = shadow.begin; i < shadow.end; ++i) {
      if (i == shadow.sides && std::ranges::all_of(shadow.behind, [&](const Plane<double>& plane) {
            return plane.distance(from) <= 0 && plane.distance(to) <= 0;
          }))
        break;
      const double d0 = bounds_[i].distance(from);
      const double d1 = bounds_[i].distance(to);
      if (d0 > 0 && d1 > 0) {
        shadow.last = i;  // often that of the next line too
        return false;
      }
      if (d0 > 0) first = std::max(first, d0 / (d0 - d1));
      if (d1 > 0) last = std::min(last, d0 / (d0 - d1));
      if (!(first < last)) return false;
    }
    hidden.emplace_back(first, last);
    return covers_all(hidden);
  };
  const Span whole{0, 1, true};
  for (const int index : everywhere_)
    if (hides_all(at(shadows_, index))) return {whole};
  if (const auto seen = everywhere_.size() == shadows_.size()
                            ? std::nullopt
                            : project_segment(camera_, from, to)) {
    const Box line = box_of(std::array{seen->from, seen->to});
    const Eigen::AlignedBox2f rounded = around(line);
    const float farthest =
        float_above(std::max(camera_.to_camera(from).z(), camera_.to_camera(to).z()));
    const Eigen::Vector2i first = cell_at(line.min()), last = cell_at(line.max());
    for (int row = first.y(); row <= last.y(); ++row)
      for (int column = first.x(); column <= last.x(); ++column)
        for (const Near& near : at(cells_, row * kColumns + column)) {
          if (near.depth > farthest) break;  // it hides only what is farther than itself
          // A shadow counts only in the first cell that it shares with the line. No test depends on
          // another one, because processors predict them badly.
          const bool meets = bool(near.box.min().x() <= rounded.max().x()) &
                             bool(near.box.min().y() <= rounded.max().y()) &
                             bool(near.box.max().x() >= rounded.min().x()) &
                             bool(near.box.max().y() >= rounded.min().y()) &
                             bool(std::max<int>(near.first.x(), first.x()) == column) &
                             bool(std::max<int>(near.first.y(), first.y()) == row);
          if (meets && hides_all(at(shadows_, near.shadow))) return {whole};
        }
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
