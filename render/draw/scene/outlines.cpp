#include "draw/scene/outlines.h"

#include <map>
#include <utility>

#include "core/at.h"
#include "core/convex_polygon.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kMaxBodySides =
    160;  // faces of bodies; with more, as on a landscape, nothing counts as hidden

/// The part of `polygon` to the left of the line through two points, or to its right.
Outline cut(const Outline& polygon, const Vec2d& from, const Vec2d& to, bool left) {
  const double sign = left ? 1 : -1;
  return clipped(
      polygon, [&](const Vec2d& p) { return sign * turn(from, to, p); },
      [](const Vec2d& p, const Vec2d& q, double at_p, double at_q) -> Vec2d {
        return p + at_p / (at_p - at_q) * (q - p);
      });
}

}  // namespace

Outline as_outline(const std::vector<Point2>& polygon) {
  return convex_polygon(mapped(polygon, flat));
}

Outline outline_around(const Camera& camera, std::span<const Vec3d> points) {
  std::vector<Vec2d> seen = projected(camera, points);
  return seen.size() < 3 ? Outline() : convex_polygon(std::move(seen));
}

// Separating axis test.
bool overlap(const Outline& polygon, const Eigen::AlignedBox2d& box) {
  if (polygon.size() < 3) return false;
  Eigen::AlignedBox2d around;
  for (const Vec2d& p : polygon) around.extend(p);
  if (!around.intersects(box)) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto is_outside = [&](int corner) {
      return turn(polygon[i], polygon[(i + 1) % polygon.size()],
                  box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner))) < 0;
    };
    if (is_outside(0) && is_outside(1) && is_outside(2) && is_outside(3)) return false;
  }
  return true;
}

bool lies_on(const Outline& polygon, const Eigen::AlignedBox2d& box) {
  if (polygon.size() < 3) return false;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2d at = box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner));
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (turn(polygon[i], polygon[(i + 1) % polygon.size()], at) < 0) return false;
  }
  return true;
}

std::vector<Outline> without(const std::vector<Outline>& polygons, const Outline& hole) {
  constexpr double kMinArea = 0.25;  // square pixels
  std::vector<Outline> result;
  for (Outline rest : polygons) {
    for (std::size_t i = 0; i < hole.size() && rest.size() > 2; ++i) {
      const Vec2d &from = hole[i], &to = hole[(i + 1) % hole.size()];
      Outline outside = cut(rest, from, to, false);
      if (outside.size() > 2 && area_of(outside) > kMinArea) result.push_back(std::move(outside));
      rest = cut(rest, from, to, true);
    }
  }
  return result;
}

std::vector<Outline> outlines_before(const std::vector<Point2>& polygon, const Camera& camera,
                                     std::span<const Surface> surfaces) {
  const Outline whole = as_outline(polygon);
  Eigen::AlignedBox2d box;
  for (const Vec2d& p : whole) box.extend(p);
  std::vector<Outline> found;
  std::map<int, std::vector<Vec2d>> round;
  for (const Surface& surface : surfaces) {
    // An opaque body hides the polygon by itself.
    if (surface.kind != Surface::Kind::Body || surface.color.a >= 1) continue;
    std::vector<Point2> seen = project_polygon(camera, surface.polygon);
    if (seen.empty()) continue;
    if (surface.body >= 0) {
      for (const Point2& p : seen) round[surface.body].push_back(flat(p));
      continue;
    }
    Eigen::AlignedBox2d own;
    for (const Point2& p : seen) own.extend(flat(p));
    if (!own.intersects(box)) continue;
    if (found.size() == kMaxBodySides) return {};
    found.push_back(as_outline(seen));
  }
  for (auto& [body, points] : round) found.push_back(convex_polygon(std::move(points)));
  std::erase_if(found, [](const Outline& outline) { return outline.size() < 3; });
  return found;
}

}  // namespace contactscope::draw
