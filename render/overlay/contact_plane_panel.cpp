#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "draw/insets/panel_legend.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/whisker.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

constexpr float kReserve = 0.14f;    // of the map's size, free on every side
constexpr float kLeastMapLines = 5;  // lines of text that the map and its scale are high
constexpr float kCaptionLines = 2.4f;

// The contact plane as the reader sees it: u to the right of the camera, v up, so that panel and 3D
// view read alike.
struct PlaneFrame {
  Vec3d u, v;

  PlaneFrame(const Vec3d& normal, const draw::Camera& camera) {
    u = camera.right() - camera.right().dot(normal) * normal;
    u = u.norm() > 1e-3 ? Vec3d(u.normalized()) : any_perpendicular(normal);
    v = normal.cross(u);
    // Looked at along a wall, up on the screen is the better guide than depth.
    const Vec3d upwards = camera.up() - camera.up().dot(normal) * normal;
    if (v.dot(upwards) < 0) v = -v;
  }
  std::array<double, 2> map(const Vec3d& p) const { return {u.dot(p), v.dot(p)}; }
};

// Shapes of the pair that are round, in one frame: their outline along the normal is context for
// one or two points, which have no extent of their own.
std::vector<draw::PlacedShape> round_shapes(const PanelFacts& facts, const trace::Frame& frame,
                                            const trace::Pair& pair) {
  std::vector<draw::PlacedShape> placed = draw::place_shapes(facts.staging.meshes, frame);
  std::erase_if(placed, [&](const draw::PlacedShape& shape) {
    const trace::Shape& solid = *shape.mesh->shape;
    return solid.radius == 0 || (solid.name != pair.a && solid.name != pair.b);
  });
  return placed;
}

// What must be seen whole: the patch and the incident face. The reference face may be a whole
// floor, and is cut off at the map's border.
std::vector<Vec3d> patch_points(const trace::Pair& pair) {
  std::vector<Vec3d> points;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& p : manifold.points) points.push_back(p.position);
  }
  if (pair.clip) {
    const trace::Polygon& incident = pair.clip->incident.polygon;
    points.insert(points.end(), incident.begin(), incident.end());
  }
  return points;
}

class Map {
 public:
  Map(const PanelFacts& facts, const PlaneFrame& plane, ImVec2 corner, float width, float height)
      : plane_(plane), middle_{corner.x + 0.5f * width, corner.y + 0.5f * height} {
    // One scale for the sequence: the largest frame fits.
    std::array<double, 2> low{std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::max()};
    std::array<double, 2> high{-low[0], -low[1]};
    for (const trace::Frame& frame : facts.frames) {
      const trace::Pair* pair = draw::pair_of_contact_plane(frame);
      if (pair == nullptr) continue;
      std::vector<Vec3d> points = patch_points(*pair);
      // The smaller round shape; a larger one is cut off like a floor.
      const std::vector<draw::PlacedShape> round = round_shapes(facts, frame, *pair);
      const auto smallest = std::ranges::min_element(
          round, {}, [](const draw::PlacedShape& shape) { return shape.mesh->radius; });
      if (smallest != round.end()) {
        const double radius = smallest->mesh->shape->radius;
        for (const Vec3d& center : smallest->vertices) {
          for (const Vec3d& side : {plane.u, plane.v}) {
            points.push_back(center + radius * side);
            points.push_back(center - radius * side);
          }
        }
      }
      for (const Vec3d& point : points) {
        const std::array<double, 2> at = plane.map(point);
        for (std::size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
    }
    center_ = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
    const double w = std::max(high[0] - low[0], 1e-12);
    const double h = std::max(high[1] - low[1], 1e-12);
    scale_ = static_cast<float>(
        std::min(width * (1 - 2 * kReserve) / w, height * (1 - 2 * kReserve) / h));
  }

  ImVec2 at(const Vec3d& p) const {
    const std::array<double, 2> m = plane_.map(p);
    return {middle_.x + scale_ * static_cast<float>(m[0] - center_[0]),
            middle_.y - scale_ * static_cast<float>(m[1] - center_[1])};
  }
  float pixels_per_metre() const { return scale_; }

 private:
  const PlaneFrame& plane_;
  ImVec2 middle_;
  std::array<double, 2> center_{};
  float scale_ = 1;
};

class PlanePainter {
 public:
  PlanePainter(const Map& map, float scale)
      : map_(map), px_(scale), list_(ImGui::GetWindowDrawList()) {}

  void polygon(const trace::Polygon& polygon, const draw::Color& color, float fill, float width,
               bool dashed) {
    if (polygon.size() < 2) return;
    std::vector<ImVec2> points;
    for (const Vec3d& p : polygon) points.push_back(map_.at(p));
    // Dear ImGui fills clockwise on the screen; the other winding would lose its smooth border.
    double twice_area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ImVec2 a = points[i], b = points[(i + 1) % points.size()];
      twice_area += a.x * b.y - b.x * a.y;
    }
    if (twice_area < 0) std::reverse(points.begin(), points.end());
    const int count = static_cast<int>(points.size());
    list_->AddConvexPolyFilled(points.data(), count, packed(draw::with_alpha(color, fill)));
    if (!dashed) {
      list_->AddPolyline(points.data(), count, packed(color), ImDrawFlags_Closed, width * px_);
      return;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      dashes(points[i], points[(i + 1) % points.size()], color, width);
    }
  }

  // A sphere or capsule seen along the normal, and its core.
  void outline(const draw::PlacedShape& shape) {
    const std::vector<Vec3d>& core = shape.vertices;
    const float radius = map_.pixels_per_metre() * static_cast<float>(shape.mesh->shape->radius);
    const ImVec2 first = map_.at(core.front()), last = map_.at(core.back());
    constexpr int kSteps = 96;
    std::vector<ImVec2> points;
    for (int i = 0; i < kSteps; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSteps;
      const ImVec2 out{std::cos(angle), std::sin(angle)};
      const bool at_first =
          out.x * (first.x - last.x) + out.y * (first.y - last.y) > 0 || core.size() == 1;
      const ImVec2& end = at_first ? first : last;
      points.push_back({end.x + radius * out.x, end.y + radius * out.y});
    }
    const draw::Color& color = shape.is_a ? draw::kShapeA : draw::kShapeB;
    list_->AddConvexPolyFilled(points.data(), kSteps, packed(draw::with_alpha(color, 0.55f)));
    list_->AddPolyline(points.data(), kSteps, packed(draw::with_alpha(draw::kShapeEdge, 0.5f)),
                       ImDrawFlags_Closed, 1.5f * px_);
    if (core.size() == 2) dashes(first, last, draw::with_alpha(draw::kShapeEdge, 0.5f), 1);
  }

  void cross(const Vec3d& at) {
    const ImVec2 p = map_.at(at);
    const float r = 4.5f * px_;
    for (const auto& [color, width] : {std::pair{draw::kWhite, 5.0f}, {draw::kDropped, 2.0f}}) {
      list_->AddLine({p.x - r, p.y - r}, {p.x + r, p.y + r}, packed(color), width * px_);
      list_->AddLine({p.x - r, p.y + r}, {p.x + r, p.y - r}, packed(color), width * px_);
    }
  }

  void dot(const trace::Point& point, const draw::SequenceScales& scales) {
    const ImVec2 p = map_.at(point.position);
    const bool apart = draw::stands_off(point, scales);
    list_->AddCircleFilled(p, 7.0f * px_, packed(draw::kWhite), 32);
    list_->AddCircleFilled(p, 5.2f * px_,
                           packed(draw::with_alpha(draw::kContact, apart ? 0.3f : 1.0f)), 32);
    if (apart) list_->AddCircle(p, 4.7f * px_, packed(draw::kContact), 32, 1.2f * px_);
  }

  void choice(const Vec3d& at, int number, const ImVec2& away_from) {
    const ImVec2 p = map_.at(at);
    list_->AddCircle(p, 9.5f * px_, packed(draw::kContact), 32, 2.2f * px_);
    ImVec2 out{p.x - away_from.x, p.y - away_from.y};
    const float length = std::hypot(out.x, out.y);
    out = length > 1 ? ImVec2{out.x / length, out.y / length} : ImVec2{0, -1};
    const ImVec2 place{p.x + 21 * px_ * out.x, p.y + 21 * px_ * out.y};
    centered_text(list_, place, draw::kContact, std::to_string(number).c_str());
  }

 private:
  void dashes(ImVec2 from, ImVec2 to, const draw::Color& color, float width) {
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    const float dash = 8 * px_, gap = 5 * px_;
    for (float s = 0; s < length; s += dash + gap) {
      const float e = std::min(length, s + dash);
      const auto along = [&](float t) {
        return ImVec2{from.x + t / length * (to.x - from.x), from.y + t / length * (to.y - from.y)};
      };
      list_->AddLine(along(s), along(e), packed(color), width * px_);
    }
  }

  const Map& map_;
  float px_;
  ImDrawList* list_;
};

// A length that fits the map, 1, 2 or 5 times a power of ten.
void scale_bar(const Map& map, ImVec2 corner, float width, float scale) {
  const double wanted = 0.3 * width / map.pixels_per_metre();
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  double length = decade;
  for (const double step : {2.0, 5.0}) {
    if (step * decade <= wanted) length = step * decade;
  }
  const float pixels = static_cast<float>(length) * map.pixels_per_metre();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImU32 color = packed(draw::kQuietText);
  const float x = corner.x + width - pixels;
  list->AddLine({x, corner.y}, {x + pixels, corner.y}, color, 1.5f * scale);
  for (const float end : {x, x + pixels}) {
    list->AddLine({end, corner.y - 3 * scale}, {end, corner.y + 3 * scale}, color, 1.5f * scale);
  }
  const std::string text = draw::spell_length(length);
  const float text_width = ImGui::CalcTextSize(text.c_str()).x;
  list->AddText({x - text_width - 8 * scale, corner.y - 0.5f * ImGui::GetTextLineHeight()}, color,
                text.c_str());
}

}  // namespace

PanelNeed contact_plane_need(const PanelFacts& facts) {
  const float lines = (kLeastMapLines + kCaptionLines) * ImGui::GetTextLineHeightWithSpacing();
  const float least = panel_frame() + heading_height(facts.staging.layout.scale) + lines;
  return {least, least, 0, 2};
}

void contact_plane_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const float top = ImGui::GetCursorPosY();
  heading("contact plane, seen along the normal", scale);
  const trace::Pair* pair = draw::pair_of_contact_plane(facts.frames[facts.current]);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float width = ImGui::GetContentRegionAvail().x;
  const float map_height = height - (ImGui::GetCursorPosY() - top) - kCaptionLines * line;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (pair == nullptr) {
    ImGui::TextColored(ImColor(packed(draw::kQuietText)), "no contact in this frame");
    return;
  }

  const trace::Manifold& manifold = pair->manifolds.front();
  const PlaneFrame plane(manifold.normal, facts.staging.camera);
  const Map map(facts, plane, corner, width, map_height - line);
  PlanePainter paint(map, scale);
  ImGui::GetWindowDrawList()->PushClipRect(corner, {corner.x + width, corner.y + map_height - line},
                                           true);
  for (const draw::PlacedShape& shape : round_shapes(facts, facts.frames[facts.current], *pair)) {
    paint.outline(shape);
  }
  if (pair->clip && pair->manifolds.size() == 1) {
    const trace::Clip& clip = *pair->clip;
    paint.polygon(clip.reference.polygon, draw::kReferenceFace, 0.18f, 2.5f, false);
    if (!clip.steps.empty()) {
      paint.polygon(clip.steps.back().polygon, draw::kClipPolygon, 0.25f, 2.5f, false);
    }
    // Its dashes leave an equal clip polygon visible.
    paint.polygon(clip.incident.polygon, draw::kIncidentFace, 0.18f, 2.5f, true);
    for (const trace::DroppedPoint& dropped : clip.dropped) {
      if (!draw::is_kept(*pair, dropped)) paint.cross(dropped.position);
    }
  }

  Vec3d middle = Vec3d::Zero();
  for (const trace::Point& p : manifold.points) middle += p.position;
  middle /= static_cast<double>(std::max<std::size_t>(1, manifold.points.size()));
  std::string caption;
  if (pair->manifolds.size() > 1) {
    // Each was reduced by itself, and the record holds one of these reductions.
    std::size_t points = 0;
    for (const trace::Manifold& one : pair->manifolds) {
      for (const trace::Point& p : one.points) paint.dot(p, facts.staging.scales);
      points += one.points.size();
    }
    caption = std::to_string(points) + " points in " + std::to_string(pair->manifolds.size()) +
              " manifolds";
  } else if (draw::reduction_in_contact_plane(*pair)) {
    const trace::Reduction& reduction = *pair->reduction;
    const bool fewer = reduction.kept.size() < reduction.points.size();
    for (std::size_t i = 0; i < reduction.points.size(); ++i) {
      const auto found =
          std::find(reduction.kept.begin(), reduction.kept.end(), static_cast<int>(i));
      const Vec3d& at = reduction.points[i].position;
      if (found == reduction.kept.end()) {
        paint.cross(at);
        continue;
      }
      paint.dot(reduction.points[i], facts.staging.scales);
      if (fewer) {
        paint.choice(at, static_cast<int>(found - reduction.kept.begin()) + 1, map.at(middle));
      }
    }
    caption = "area of the kept points " + draw::spell_area(reduction.area);
    if (fewer && reduction.best_area > 0) {
      std::array<char, 64> percent{};
      std::snprintf(percent.data(), percent.size(), "\n%.1f %% of the best %zu of %zu points",
                    100 * reduction.area / reduction.best_area, reduction.kept.size(),
                    reduction.points.size());
      caption += percent.data();
    }
  } else {
    for (const trace::Point& p : manifold.points) paint.dot(p, facts.staging.scales);
    caption = std::to_string(manifold.points.size()) +
              (manifold.points.size() == 1 ? " point, no area" : " points");
    if (manifold.points.size() == 2) {
      const Vec3d apart = manifold.points[1].position - manifold.points[0].position;
      caption += ", " + draw::spell_length(apart.norm()) + " apart";
    }
  }
  ImGui::GetWindowDrawList()->PopClipRect();
  scale_bar(map, {corner.x, corner.y + map_height - 0.2f * line}, width, scale);
  ImGui::SetCursorPosY(top + height - 2.0f * line);
  ImGui::TextUnformatted(caption.c_str());
}

}  // namespace contactscope::overlay
