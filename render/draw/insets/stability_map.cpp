#include "draw/insets/stability_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/charts/series_chart.h"
#include "draw/scene/marks.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr float kMapDot = 5.2f;  // pixels
constexpr float kMapSquare = 4.6f;
constexpr float kMapCenter = 7.5f;

void map_stroke(const Point2& from, const Point2& to, float width, const Color& color, float dash,
                Drawing& drawing) {
  Stroke result{from, to, width, color, dash > 0 ? Cap::Butt : Cap::Round};
  result.dash = dash;
  result.gap = 0.65f * dash;
  drawing.primitives.push_back(result);
}

Point2 nearest_on(const Point2& from, const Point2& to, const Point2& p) {
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float squared = dx * dx + dy * dy;
  if (!(squared > 0)) return from;
  const float t = std::clamp(((p.x - from.x) * dx + (p.y - from.y) * dy) / squared, 0.0f, 1.0f);
  return {from.x + t * dx, from.y + t * dy};
}

void arrow_head(const Point2& tip, const Point2& from, float size, const Color& color,
                Drawing& drawing) {
  const float length = std::hypot(tip.x - from.x, tip.y - from.y);
  if (!(length > 0)) return;
  const Point2 back{size * (from.x - tip.x) / length, size * (from.y - tip.y) / length};
  drawing.primitives.push_back(
      Fill{{tip,
            {tip.x + back.x - 0.45f * back.y, tip.y + back.y + 0.45f * back.x},
            {tip.x + back.x + 0.45f * back.y, tip.y + back.y - 0.45f * back.x}},
           color});
}

}  // namespace

std::vector<Vec3d> stability_extent(const trace::Pair& pair) {
  std::vector<Vec3d> points;
  if (!pair.stability || pair.stability->verdict == "no contact") return points;
  points = pair.stability->support;
  points.push_back(pair.stability->projection);
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) points.push_back(point.position);
  }
  return points;
}

StabilityMap::StabilityMap(const Vec3d& normal, const Camera& camera, const Rect& rect)
    : rect_(rect) {
  u_ = camera.right() - camera.right().dot(normal) * normal;
  u_ = u_.norm() > 1e-3 ? Vec3d(u_.normalized()) : any_perpendicular(normal);
  v_ = normal.cross(u_);
  if (v_.dot(camera.up()) < 0) v_ = -v_;
}

void StabilityMap::show(const std::array<double, 2>& center, double pixels_per_metre) {
  center_ = center;
  scale_ = pixels_per_metre;
}

Point2 StabilityMap::at(const Vec3d& point) const {
  const std::array<double, 2> p = flat(point);
  return {static_cast<float>(rect_.x + 0.5 * rect_.width + scale_ * (p[0] - center_[0])),
          static_cast<float>(rect_.y + 0.5 * rect_.height - scale_ * (p[1] - center_[1]))};
}

// From the projection to the nearest place of the border, with its length.
void StabilityMap::draw_margin(const trace::Stability& stability, float pixel,
                               Drawing& drawing) const {
  const Point2 from = at(stability.projection);
  Point2 nearest = from;
  float least = std::numeric_limits<float>::max();
  const std::size_t corners = stability.support.size();
  for (std::size_t i = 0; i < corners; ++i) {
    const Point2 place =
        nearest_on(at(stability.support[i]), at(stability.support[(i + 1) % corners]), from);
    const float length = std::hypot(place.x - from.x, place.y - from.y);
    if (length < least) {
      least = length;
      nearest = place;
    }
  }
  if (least > 14 * pixel) {
    map_stroke(from, nearest, 2.2f * pixel, kAxis, 0, drawing);
    arrow_head(nearest, from, 8 * pixel, kAxis, drawing);
  }
}

void StabilityMap::draw_axis(const std::array<Vec3d, 2>& axis, float pixel,
                             Drawing& drawing) const {
  const Point2 a = at(axis[0]), b = at(axis[1]);
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0)) return;
  const float reach = static_cast<float>(rect_.width + rect_.height) / length;
  const Point2 far_a{a.x - reach * (b.x - a.x), a.y - reach * (b.y - a.y)};
  const Point2 far_b{b.x + reach * (b.x - a.x), b.y + reach * (b.y - a.y)};
  const std::optional<Segment2> seen = clip_segment(rect_, far_a, far_b);
  if (seen) map_stroke(seen->from, seen->to, 2.2f * pixel, kNormal, 7 * pixel, drawing);
}

void StabilityMap::draw(const trace::Pair& pair, bool plain, float pixel, Drawing& drawing) const {
  const trace::Stability& stability = *pair.stability;
  std::vector<Point2> corners;
  for (const Vec3d& corner : stability.support) corners.push_back(at(corner));
  if (corners.size() > 2) {
    drawing.primitives.push_back(Fill{corners, with_alpha(kClipPolygon, 0.25f)});
  }
  if (stability.axis && stability.verdict != "stable") draw_axis(*stability.axis, pixel, drawing);
  for (std::size_t i = 0; corners.size() > 1 && i < corners.size(); ++i) {
    map_stroke(corners[i], corners[(i + 1) % corners.size()], 2.6f * pixel, kClipPolygon, 0,
               drawing);
  }
  draw_margin(stability, pixel, drawing);
  const auto dot = [&](const Vec3d& position, const std::string& state) {
    draw_state_dot(state, at(position), kMapDot * pixel, kContact, drawing);
  };
  if (pair.incremental) {
    for (const trace::PersistentPoint& point : pair.incremental->points) {
      if (point.state != "broken") dot(point.point.position, point.state);
    }
  } else {
    for (const trace::Manifold& manifold : pair.manifolds) {
      for (const trace::Point& point : manifold.points) {
        if (plain) dot(point.position, "");
        if (!plain) draw_square(at(point.position), kMapSquare * pixel, kContact, drawing);
      }
    }
  }
  draw_quartered_disc(at(stability.projection), kMapCenter * pixel, 1.4f * pixel, drawing);
}

}  // namespace contactscope::draw
