#include "draw/scene/labels.h"

#include "draw/scene/camera.h"

namespace contactscope::draw {
namespace {

constexpr int kRings = 9;
// Rings on which labels avoid lines. A label with a fixed direction stays closer to its anchor.
constexpr int kUncrossedRings = 14, kUncrossedNearby = 6, kDirections = 16;
// Free space around a label's letters, pixels.
constexpr float kPadding = 2;
// A leader looks like part of a line if it starts within this distance, pixels, at a smaller angle.
constexpr float kLineGap = 7;
constexpr float kAlongLine = 0.9f;  // cosine

}  // namespace

void LabelPlacer::block(const Point2& center, float radius) {
  taken_.push_back({center.x - radius, center.y - radius, 2 * radius, 2 * radius});
}

void LabelPlacer::block(const Point2& from, const Point2& to, float width) {
  blocked_.push_back({from, to});
  // A chain of squares fits a slanted line better than its bounding box.
  const int wanted = static_cast<int>(distance(from, to) / std::max(width, 1.0f)) + 1;
  const int pieces = std::clamp(wanted, 1, 200);
  for (int i = 0; i <= pieces; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(pieces);
    block(from + t * (to - from), 0.5f * width);
  }
}

bool LabelPlacer::misleads(const Point2& anchor, const Point2& end) const {
  const float reach = distance(anchor, end);
  if (!(reach > 0)) return false;
  const Point2 offset = (end - anchor) / reach;
  const auto is_crossed = [&](const Rect& text) {
    return clip_segment(text, anchor, end).has_value();
  };
  const auto runs_along = [&](const Segment2& line) {
    const float length = distance(line.from, line.to);
    return length > 0 && distance(line.nearest(anchor), anchor) < kLineGap &&
           std::abs(dot(line.to - line.from, offset)) > kAlongLine * length;
  };
  return std::ranges::any_of(texts_, is_crossed) || std::ranges::any_of(blocked_, runs_along);
}

Eigen::Vector2d LabelPlacer::middle_of(const Point2& anchor, const Eigen::Vector2d& direction,
                                       double width, double height, double ring) {
  const double ux = direction.x(), aside = std::abs(ux);
  return {anchor.x + ux * (ring + 0.5 * width * aside) +
              (aside < 0.35 ? 0.0 : std::copysign(0.25 * width * (1 - aside), ux)),
          anchor.y + direction.y() * (ring + 0.5 * height)};
}

std::optional<LabelPlacer::Place> LabelPlacer::place(const Point2& anchor, float width,
                                                     float ascent, float descent,
                                                     const Wish& wish) {
  const auto& [clearance, direction, outwards, has_leader] = wish;
  const float height = ascent + descent;
  const double wanted = std::atan2(direction.y, direction.x);
  const auto is_free = [&](const Rect& box) {
    return view_.encloses(box) &&
           std::ranges::none_of(taken_, [&](const Rect& other) { return box.overlaps(other); });
  };
  const auto is_crossed = [&](const Rect& box) {
    return std::ranges::any_of(lines_, [&](const Segment2& line) {
      return clip_segment(box, line.from, line.to).has_value();
    });
  };
  // First the rings off lines, then all rings, then all rings with any leader.
  const int uncrossed_rings = outwards ? kUncrossedNearby : kUncrossedRings;
  for (int attempt = 0; attempt < uncrossed_rings + 2 * kRings; ++attempt) {
    const bool uncrossed = attempt < uncrossed_rings;
    const bool any_leader = attempt >= uncrossed_rings + kRings;
    const int ring = uncrossed ? attempt : (attempt - uncrossed_rings) % kRings;
    const double reach = clearance + ring * 0.75 * height;
    for (int i = 0; i < kDirections; ++i) {
      // 0, +1, -1, +2, -2, ... steps away from the wanted direction.
      const int step = (i % 2 == 1 ? 1 : -1) * ((i + 1) / 2);
      if (uncrossed && outwards && std::abs(step) > kDirections / 4) break;
      const double angle = wanted + step * 2 * std::numbers::pi / kDirections;
      const Eigen::Vector2d middle = middle_of(anchor, {std::cos(angle), std::sin(angle)},
                                               double{width}, double{height}, reach);
      const Rect box{middle.x() - 0.5 * width - kPadding, middle.y() - 0.5 * height - kPadding,
                     width + 2 * kPadding, height + 2 * kPadding};
      if (!is_free(box) || (uncrossed && is_crossed(box))) continue;
      const Point2 end = box.nearest(anchor);
      const bool needs_leader = distance(end, anchor) > clearance + 0.8 * height;
      if (!any_leader && (needs_leader || has_leader) && misleads(anchor, end)) continue;
      taken_.push_back(box);
      texts_.push_back(box);
      return Place{pixel(middle.x() - 0.5 * width, middle.y() + 0.5 * height - descent),
                   needs_leader, end};
    }
  }
  return std::nullopt;
}

}  // namespace contactscope::draw
