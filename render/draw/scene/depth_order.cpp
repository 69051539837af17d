#include "draw/scene/depth_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>

#include "core/at.h"
#include "core/plane.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// A vertex this near to a plane, as a fraction of the scene, lies in it. Well above the rounding of
// poses and clip points in float, well below a pixel.
constexpr double kOnPlane = 2e-6;

struct Item {
  Surface surface;
  Plane<double> plane;
  double area = 0;  // twice, square metres; -1 where the plane must not part others
  // Lies in the plane that parts now, for it is its own: also a polygon that is not flat, as a trace
  // from elsewhere may hold. So both sides have fewer items than the whole.
  bool parts = false;
};

Item item_of(Surface surface) {
  const Vec3d normal = newell_normal(surface.polygon);
  const double length = normal.norm();
  const Vec3d unit = length > 0 ? Vec3d(normal / length) : normal;
  const Plane<double> plane{unit, unit.dot(mean_of(surface.polygon))};
  return {std::move(surface), plane, length, false};
}

bool is_small(const Item& item) {
  return item.surface.body == kSmallSurface;
}

/// Paints into `result`, farthest first.
class Painter {
 public:
  Painter(const Camera& camera, const std::vector<RoundBody>& bodies, double tolerance,
          std::vector<Surface>& result)
      : camera_(camera), bodies_(bodies), tolerance_(tolerance), result_(result) {}

  // What is small and beyond one of the planes has nothing to do with the rest.
  void paint_apart(std::vector<Item> items, std::span<const Plane<double>> box) const {
    if (box.empty() || std::ranges::none_of(items, is_small)) {
      paint(std::move(items));
      return;
    }
    auto [front, back, on] = part(box.front(), std::move(items));
    std::ranges::move(on, std::back_inserter(back));
    const bool eye_in_front = in_front(box.front());
    if (!eye_in_front) paint(std::move(front));
    paint_apart(std::move(back), box.subspan(1));
    if (eye_in_front) paint(std::move(front));
  }

 private:
  struct Parts {
    std::vector<Item> front, back, on;
  };

  void paint(std::vector<Item> items) const {
    if (items.size() < 2) {
      put(items);
      return;
    }
    const auto largest = std::ranges::max_element(items, {}, &Item::area);
    if (largest->surface.body != kFlatSurface) {
      paint_small(items);
      std::erase_if(items, is_small);
      paint_bodies(std::move(items), 0, 1, std::vector<int>(bodies_.size()));
      return;
    }
    const Plane<double> plane = largest->plane;
    largest->parts = true;
    auto [front, back, on] = part(plane, std::move(items));
    const bool eye_in_front = in_front(plane);
    paint(std::move(eye_in_front ? back : front));
    put(on);
    paint(std::move(eye_in_front ? front : back));
  }

  void put(std::vector<Item>& items) const {
    for (Item& item : items) result_.push_back(std::move(item.surface));
  }

  // By the middle of each.
  void paint_small(const std::vector<Item>& items) const {
    std::vector<std::pair<double, const Item*>> sorted;
    for (const Item& item : items) {
      if (!is_small(item)) continue;
      Vec3d middle = Vec3d::Zero();
      for (const Vec3d& p : item.surface.polygon) middle += camera_.to_camera(p);
      middle /= static_cast<double>(item.surface.polygon.size());
      sorted.emplace_back(camera_.is_perspective() ? middle.norm() : middle.z(), &item);
    }
    std::ranges::stable_sort(sorted, std::ranges::greater(),
                             [](const auto& entry) { return entry.first; });
    for (const auto& [distance, item] : sorted) result_.push_back(item->surface);
  }

  // Facets of round bodies alone: parted by the planes of the pairs from (first, second) on. `won`
  // counts for each body the pairs in which this region is on its side.
  void paint_bodies(std::vector<Item> items, std::size_t first, std::size_t second,
                    std::vector<int> won) const {
    std::vector<bool> present(bodies_.size());
    for (const Item& item : items) present[static_cast<std::size_t>(item.surface.body)] = true;
    for (; first < bodies_.size(); ++first, second = first + 1) {
      for (; present[first] && second < bodies_.size(); ++second) {
        if (!present[second]) continue;
        const Plane<double> plane = power_plane(bodies_[first], bodies_[second]);
        auto [front, back, on] = part(plane, std::move(items));
        std::ranges::move(on, std::back_inserter(back));
        std::vector<int> won_front = won;
        ++won_front[second];
        ++won[first];
        const bool eye_in_front = in_front(plane);
        if (!eye_in_front) paint_bodies(std::move(front), first, second + 1, won_front);
        paint_bodies(std::move(back), first, second + 1, won);
        if (eye_in_front) paint_bodies(std::move(front), first, second + 1, won_front);
        return;
      }
    }
    std::ranges::stable_sort(items, {},
                             [&](const Item& item) { return at(won, item.surface.body); });
    put(items);
  }

  bool in_front(const Plane<double>& plane) const {
    const Vec3d on_plane = plane.normal * plane.offset;
    return camera_.to_eye(on_plane).dot(plane.normal) > 0;
  }

  Parts part(const Plane<double>& plane, std::vector<Item> items) const {
    Parts parts;
    for (Item& item : items) {
      bool front = false, back = false;
      for (const Vec3d& p : item.surface.polygon) {
        if (item.parts) break;
        const double d = plane.distance(p);
        front = front || d > tolerance_;
        back = back || d < -tolerance_;
      }
      if (!front || !back) {
        (front ? parts.front : back ? parts.back : parts.on).push_back(std::move(item));
        continue;
      }
      for (const int sign : {1, -1}) {
        Item piece = item;
        piece.surface.polygon = part(plane, item.surface.polygon, sign);
        if (piece.surface.polygon.size() < 3) continue;
        (sign > 0 ? parts.front : parts.back).push_back(std::move(piece));
      }
    }
    return parts;
  }

  // The part of a polygon on one side (sign +1 or -1). New vertices are made from the lower to the
  // higher end, so that both parts get the very same point and no gap opens between them.
  std::vector<Vec3d> part(const Plane<double>& plane, const std::vector<Vec3d>& polygon,
                          int sign) const {
    std::vector<Vec3d> result;
    const auto crossing = [](const Vec3d& low, const Vec3d& high, double dl, double dh) -> Vec3d {
      return low + dl / (dl - dh) * (high - low);
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& p = polygon[i];
      const Vec3d& q = polygon[(i + 1) % polygon.size()];
      const double dp = plane.distance(p);
      const double dq = plane.distance(q);
      if (sign * dp >= -tolerance_) result.push_back(p);
      if (dp < -tolerance_ && dq > tolerance_) result.push_back(crossing(p, q, dp, dq));
      if (dq < -tolerance_ && dp > tolerance_) result.push_back(crossing(q, p, dq, dp));
    }
    return result;
  }

  const Camera& camera_;
  const std::vector<RoundBody>& bodies_;
  double tolerance_;
  std::vector<Surface>& result_;
};

}  // namespace

std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera,
                                   const std::vector<RoundBody>& bodies) {
  std::vector<Item> items;
  items.reserve(surfaces.size());
  Eigen::AlignedBox3d whole, middle;  // of all, and of all that is not small
  for (Surface& surface : surfaces) {
    if (surface.polygon.size() < 3) continue;
    const Eigen::AlignedBox3d own = box_around(surface.polygon);
    whole.extend(own);
    if (surface.body != kSmallSurface) middle.extend(own);
    Item item = item_of(std::move(surface));
    if (item.area > 0 && item.surface.body != kFlatSurface) item.area = -1;
    if (item.area != 0) items.push_back(std::move(item));
  }
  std::vector<Plane<double>> sides;
  for (int axis = 0; axis < 3 && !middle.isEmpty(); ++axis) {
    sides.push_back({Vec3d::Unit(axis), middle.max()[axis]});
    sides.push_back({-Vec3d::Unit(axis), -middle.min()[axis]});
  }
  std::vector<Surface> result;
  result.reserve(items.size());
  const double scale = items.empty() ? 0 : whole.sizes().maxCoeff();
  Painter(camera, bodies, kOnPlane * scale, result).paint_apart(std::move(items), sides);
  return result;
}

}  // namespace contactscope::draw
