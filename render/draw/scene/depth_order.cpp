#include "draw/scene/visibility.h"

#include <deque>

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// A vertex within this distance of a plane, as a fraction of the scene, lies in it. It is well
// above the rounding of poses and clip points in float, and well below a pixel.
constexpr double kOnPlane = 2e-6;

struct Item {
  Surface surface;
  Plane<double> plane;
  double area = -1;  // twice the area, square metres; -1 if the plane must not split others
  // Its own plane is the splitting plane. Such items are not cut even if the polygon is not flat,
  // as in traces of other programs. Both sides then have fewer items than the whole.
  bool parts = false;
};

/// Items are large, so lists hold pointers to them, and what most comparisons need.
struct Listed {
  Item* item;
  Vec3d middle;  // of a ball around the polygon
  double reach;  // its radius
  double area;   // of the item

  Item* operator->() const { return item; }
};
using Items = std::vector<Listed>;

bool is_small(const Listed& item) { return item->surface.body == kSmallSurface; }

/// Appends to `result` in painting order, farthest first.
struct Painter {
  const Camera& camera;
  const std::vector<RoundBody>& bodies;
  double tolerance;
  std::vector<Surface>& result;
  std::deque<Item> pieces{};                 // cut pieces, at stable addresses
  std::vector<std::pair<int, int>> sides{};  // of the current region: nearer and farther body
  std::vector<Items> spare{};                // empty lists, so that few are allocated

  // Small surfaces outside of the box around all others are sorted separately.
  void paint_separately(Items items, std::span<const Plane<double>> box) {
    if (box.empty() || std::ranges::none_of(items, is_small)) {
      paint(std::move(items));
      return;
    }
    auto [front, back, on] = part(box.front(), std::move(items));
    back.insert(back.end(), on.begin(), on.end());
    const bool eye_in_front = in_front(box.front());
    if (!eye_in_front) paint(std::move(front));
    paint_separately(std::move(back), box.subspan(1));
    if (eye_in_front) paint(std::move(front));
  }

  struct Parts {
    Items front, back, on;
  };

  void paint(Items items) {
    if (items.size() < 2) return put(std::move(items));
    const Listed largest = *std::ranges::max_element(items, {}, &Listed::area);
    if (largest->surface.body != kFlatSurface) {
      paint_small(items);
      std::erase_if(items, is_small);
      paint_bodies(std::move(items), 0, 1);
      return;
    }
    const Plane<double> plane = largest->plane;
    largest->parts = true;
    auto [front, back, on] = part(plane, std::move(items));
    if (in_front(plane)) std::swap(front, back);
    paint(std::move(front));
    put(std::move(on));
    paint(std::move(back));
  }

  void put(Items items) {
    for (const Listed& item : items) result.push_back(std::move(item->surface));
    items.clear();
    spare.push_back(std::move(items));
  }

  Items empty_list() {
    if (spare.empty()) return {};
    Items list = std::move(spare.back());
    spare.pop_back();
    return list;
  }

  // Sorts small surfaces by their middles.
  void paint_small(const Items& items) {
    std::vector<std::pair<double, Listed>> sorted;
    for (const Listed& item : items) {
      if (!is_small(item)) continue;
      Vec3d sum = Vec3d::Zero();
      for (const Vec3d& p : item->surface.polygon) sum += camera.to_camera(p);
      const Vec3d middle = sum / static_cast<double>(item->surface.polygon.size());
      sorted.emplace_back(camera.is_perspective() ? middle.norm() : middle.z(), item);
    }
    std::ranges::stable_sort(sorted, std::ranges::greater(),
                             [](const auto& entry) { return entry.first; });
    for (const auto& [distance, item] : sorted) result.push_back(std::move(item->surface));
  }

  // Splits the facets of round bodies by the planes of the pairs from (first, second) on.
  void paint_bodies(Items items, int first, int second) {
    std::vector<int> present;
    for (const Listed& item : items)
      if (present.empty() || present.back() != item->surface.body)
        present.push_back(item->surface.body);
    std::ranges::sort(present);
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (auto one = std::ranges::lower_bound(present, first); one != present.end(); ++one) {
      const auto other =
          std::lower_bound(one + 1, present.end(), *one == first ? second : *one + 1);
      if (other == present.end()) continue;
      const Plane<double> plane = power_plane(at(bodies, *one), at(bodies, *other));
      auto [front, back, on] = part(plane, std::move(items));
      back.insert(back.end(), on.begin(), on.end());
      const auto paint_side = [&](Items& side, int nearer, int farther) {
        sides.emplace_back(nearer, farther);
        paint_bodies(std::move(side), *one, *other + 1);
        sides.pop_back();
      };
      const bool eye_in_front = in_front(plane);
      if (!eye_in_front) paint_side(front, *other, *one);
      paint_side(back, *one, *other);
      if (eye_in_front) paint_side(front, *other, *one);
      return;
    }
    // Bodies that are not in the region were not compared with each other, so they do not count.
    if (present.size() > 1) {
      std::vector<int> before(bodies.size());
      for (const auto& [nearer, farther] : sides)
        at(before, nearer) += std::ranges::binary_search(present, farther);
      std::ranges::stable_sort(items, {},
                               [&](const Listed& item) { return at(before, item->surface.body); });
    }
    put(std::move(items));
  }

  bool in_front(const Plane<double>& plane) const {
    const Vec3d on_plane = plane.normal * plane.offset;
    return camera.to_eye(on_plane).dot(plane.normal) > 0;
  }

  Parts part(const Plane<double>& plane, Items items) {
    Parts parts{empty_list(), empty_list(), empty_list()};
    for (const Listed& item : items) {
      const double middle = plane.distance(item.middle);
      if (std::abs(middle) > item.reach + 2 * tolerance) {
        (middle > 0 ? parts.front : parts.back).push_back(item);
        continue;
      }
      bool front = false, back = false;
      for (const Vec3d& p : item->surface.polygon) {
        if (item->parts) break;
        const double d = plane.distance(p);
        front = front || d > tolerance;
        back = back || d < -tolerance;
      }
      if (!front || !back) {
        (front ? parts.front : back ? parts.back : parts.on).push_back(item);
        continue;
      }
      const std::vector<Vec3d> whole = std::move(item->surface.polygon);
      for (const int sign : {1, -1}) {
        std::vector<Vec3d> polygon = clipped(
            whole, [&](const Vec3d& p) { return sign * plane.distance(p); },
            [&](const Vec3d& p, const Vec3d& q, double at_p, double at_q) {
              return zero_between(p, q, sign * at_p, sign * at_q);
            },
            tolerance);
        if (polygon.size() < 3) continue;
        Item& piece = pieces.emplace_back(*item.item);
        piece.surface.polygon = std::move(polygon);
        (sign > 0 ? parts.front : parts.back)
            .push_back({&piece, item.middle, item.reach, item.area});
      }
    }
    items.clear();
    spare.push_back(std::move(items));
    return parts;
  }
};

}  // namespace

std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera,
                                   const std::vector<RoundBody>& bodies) {
  std::vector<Item> items;
  items.reserve(surfaces.size());  // lists hold pointers to them
  Items all;
  Eigen::AlignedBox3d whole, middle;  // around all surfaces, and without small ones
  for (Surface& surface : surfaces) {
    if (surface.polygon.size() < 3) continue;
    const Eigen::AlignedBox3d own = box_around(surface.polygon);
    whole.extend(own);
    if (surface.body != kSmallSurface) middle.extend(own);
    const Vec3d normal = newell_normal(surface.polygon);
    if (!(normal.squaredNorm() > 0)) continue;
    Item& item = items.emplace_back();
    if (surface.body == kFlatSurface) {
      item.area = normal.norm();
      const Vec3d unit = normal / item.area;
      item.plane = {unit, unit.dot(mean_of(surface.polygon))};
    }
    item.surface = std::move(surface);
    all.push_back({&item, own.center(), 0.5 * own.diagonal().norm(), item.area});
  }
  std::vector<Plane<double>> sides;
  for (int axis = 0; axis < 3 && !middle.isEmpty(); ++axis) {
    sides.push_back({Vec3d::Unit(axis), middle.max()[axis]});
    sides.push_back({-Vec3d::Unit(axis), -middle.min()[axis]});
  }
  std::vector<Surface> result;
  result.reserve(items.size());
  const double scale = items.empty() ? 0 : whole.sizes().maxCoeff();
  Painter{camera, bodies, kOnPlane * scale, result}.paint_separately(std::move(all), sides);
  return result;
}

}  // namespace contactscope::draw
