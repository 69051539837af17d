#include "draw/scene/labels.h"

namespace contactscope::draw {
namespace {

constexpr int kRounds = 4, kDirections = 24;
constexpr std::array<double, 11> kRings = {9, 13, 18, 25, 34, 46, 62, 84, 112, 150, 200};
constexpr double kLeaderFrom = 15;  // pixels at 720 lines; nearer labels need no leader
constexpr double kMarkerRadius = 6;
constexpr double kPadding = 1.5;  // free space around a label
constexpr double kBetween = 5;    // more between labels: two names must not read as one
// Costs of a pixel of a covered line, a covered marker and so on, in pixels of distance.
constexpr double kCoveredPixel = 1.2, kCoveredMarker = 45, kLeaderCrossesLine = 16;
constexpr double kLeaderCrossesMarker = 30, kOtherEnd = 10;
constexpr double kAgainstTheLine = 8;  // label is not to the right of its anchor

/// Length of the part of a segment inside a box. Liang and Barsky 1984.
double length_inside(const Point2& from, const Point2& to, const Rect& box) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  double enter = 0, leave = 1;
  const auto clip = [&](double step, double room) {
    if (step == 0 && room < 0) leave = -1;
    if (step < 0) enter = std::max(enter, room / step);
    if (step > 0) leave = std::min(leave, room / step);
  };
  clip(-dx, from.x - box.x);
  clip(dx, box.right() - from.x);
  clip(-dy, from.y - box.y);
  clip(dy, box.bottom() - from.y);
  return leave > enter ? (leave - enter) * std::hypot(dx, dy) : 0;
}

double turn(const Point2& a, const Point2& b, const Point2& c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) -
         static_cast<double>(b.y - a.y) * (c.x - a.x);
}

bool cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

struct Placement {
  const std::vector<LineLabel>& labels;
  const LabelObstacles& obstacles;
  const Rect& frame;
  double height, scale;
  std::vector<std::optional<PlacedLabel>> places{};

  std::vector<PlacedLabel> run() {
    places.resize(labels.size());
    for (int round = 0; round < kRounds; ++round)
      for (std::size_t i = 0; i < labels.size(); ++i) places[i] = best(i);
    return mapped(places, [](const std::optional<PlacedLabel>& place) { return *place; });
  }

  PlacedLabel placed(const Rect& box, const Point2& anchor) const {
    PlacedLabel place{box, anchor, box.nearest(anchor), false};
    place.needs_leader = distance(place.leader_end, anchor) > kLeaderFrom * scale;
    return place;
  }

  static bool leader_meets(const PlacedLabel& place, const Rect& box) {
    return place.needs_leader && length_inside(place.anchor, place.leader_end, box) > 0;
  }
  static bool leader_crosses(const PlacedLabel& place, const Point2& from, const Point2& to) {
    return place.needs_leader && cross(place.anchor, place.leader_end, from, to);
  }

  double cost(const PlacedLabel& place, std::size_t label, bool first_anchor) const {
    const Rect room = place.box.grown(kPadding * scale);
    double sum = distance(place.leader_end, place.anchor);
    if (!first_anchor) sum += kOtherEnd * scale;
    if (place.box.x < place.anchor.x) sum += kAgainstTheLine * scale;
    for (const auto& [from, to, weight] : obstacles.lines) {
      sum += kCoveredPixel * weight * length_inside(from, to, room);
      if (leader_crosses(place, from, to)) sum += kLeaderCrossesLine * weight * scale;
    }
    for (const Point2& marker : obstacles.markers) {
      const double radius = kMarkerRadius * scale;
      const Rect box{marker.x - radius, marker.y - radius, 2 * radius, 2 * radius};
      if (distance(room.nearest(marker), marker) < radius) sum += kCoveredMarker * scale;
      if (distance(marker, place.anchor) >= 1 && leader_meets(place, box))
        sum += kLeaderCrossesMarker * scale;
    }
    for (std::size_t other = 0; other < places.size(); ++other) {
      if (other == label || !places[other]) continue;
      const PlacedLabel& fixed = *places[other];
      if (leader_meets(place, fixed.box)) sum += 4 * kCoveredMarker * scale;
      if (leader_meets(fixed, room)) sum += 4 * kCoveredMarker * scale;
      if (fixed.needs_leader && leader_crosses(place, fixed.anchor, fixed.leader_end))
        sum += kCoveredMarker * scale;
    }
    return sum;
  }

  bool allowed(const Rect& box, std::size_t label) const {
    if (!frame.encloses(box)) return false;
    const double between = kBetween * scale;
    const Rect padded = box.grown(kPadding * scale);
    const Rect room{padded.x - between, padded.y, padded.width + 2 * between, padded.height};
    const auto takes_room = [&](const Rect& taken) { return room.overlaps(taken); };
    if (std::ranges::any_of(obstacles.boxes, takes_room)) return false;
    for (std::size_t other = 0; other < places.size(); ++other)
      if (other != label && places[other] && takes_room(places[other]->box)) return false;
    return true;
  }

  PlacedLabel best(std::size_t label) const {
    const float width = labels[label].width, clearance = labels[label].clearance;
    const double high = labels[label].height > 0 ? labels[label].height : height;
    const std::vector<Point2>& anchors = labels[label].anchors;
    std::optional<PlacedLabel> found;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](double center_x, double center_y, std::size_t anchor) {
      const Rect box{center_x - 0.5 * width, center_y - 0.5 * high, width, high};
      if (!allowed(box, label)) return;
      const PlacedLabel place = placed(box, anchors[anchor]);
      const double sum = cost(place, label, anchor == 0);
      if (sum >= least) return;
      least = sum;
      found = place;
    };
    for (std::size_t anchor = 0; anchor < anchors.size(); ++anchor) {
      const Point2& at = anchors[anchor];
      for (const double ring : kRings) {
        for (int i = 0; i < kDirections; ++i) {
          const double angle = 2 * std::numbers::pi * i / kDirections;
          consider(at.x + std::cos(angle) * (ring * scale + clearance + 0.5 * width),
                   at.y + std::sin(angle) * (ring * scale + clearance + 0.5 * high), anchor);
        }
      }
    }
    if (found) return *found;
    for (double y = frame.y + 0.5 * high; y < frame.bottom(); y += 0.5 * high)
      for (double x = frame.x + 0.5 * width; x < frame.right(); x += height) consider(x, y, 0);
    if (found) return *found;
    // No free place: at the anchor, pushed into the frame.
    const Point2& at = anchors.front();
    const double most_x = std::max(frame.x, frame.right() - width);
    const double most_y = std::max(frame.y, frame.bottom() - height);
    return placed({std::clamp(at.x + kRings[0], frame.x, most_x),
                   std::clamp(at.y - 0.5 * height, frame.y, most_y), width, height},
                  at);
  }
};

}  // namespace

std::vector<PlacedLabel> place_line_labels(const std::vector<LineLabel>& labels,
                                           const LabelObstacles& obstacles, const Rect& frame,
                                           float height, float scale) {
  return Placement{labels, obstacles, frame, height, scale}.run();
}

}  // namespace contactscope::draw
