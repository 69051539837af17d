#include "draw/scene/depth_order.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/plane.h"

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

// Newell's normal: right for any flat polygon, also with collinear vertices.
Item item_of(Surface surface) {
  const std::vector<Vec3d>& polygon = surface.polygon;
  Vec3d normal = Vec3d::Zero();
  Vec3d middle = Vec3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& p = polygon[i];
    const Vec3d& q = polygon[(i + 1) % polygon.size()];
    normal += (p - polygon[0]).cross(q - polygon[0]);
    middle += p;
  }
  middle /= static_cast<double>(polygon.size());
  const double length = normal.norm();
  if (length > 0) normal /= length;
  const Plane<double> plane{normal, normal.dot(middle)};
  return {std::move(surface), plane, length, false};
}

enum class Side { Front, Back, On, Cut };

class Orderer {
 public:
  Orderer(const Camera& camera, const std::vector<RoundBody>& bodies, double tolerance)
      : camera_(camera), bodies_(bodies), tolerance_(tolerance) {}

  // What is small and beyond one of the planes has nothing to do with the rest.
  void paint_apart(std::vector<Item> items, const std::vector<Plane<double>>& box,
                   std::size_t first, std::vector<Surface>& result) const {
    if (first == box.size() || std::ranges::none_of(items, is_small)) {
      paint(std::move(items), result);
      return;
    }
    std::vector<Item> front, back, on;
    part(box[first], std::move(items), front, back, on);
    std::move(on.begin(), on.end(), std::back_inserter(back));
    const bool eye_in_front = in_front(box[first]);
    if (!eye_in_front) paint(std::move(front), result);
    paint_apart(std::move(back), box, first + 1, result);
    if (eye_in_front) paint(std::move(front), result);
  }

  void paint(std::vector<Item> items, std::vector<Surface>& result) const {
    if (items.empty()) return;
    if (items.size() == 1) {
      result.push_back(std::move(items.front().surface));
      return;
    }
    const auto largest = std::max_element(
        items.begin(), items.end(), [](const Item& a, const Item& b) { return a.area < b.area; });
    if (largest->surface.body != kFlatSurface) {
      paint_small(items, result);
      std::erase_if(items, is_small);
      paint_bodies(std::move(items), 0, 1, std::vector<int>(bodies_.size()), result);
      return;
    }
    const Plane<double> plane = largest->plane;
    largest->parts = true;
    std::vector<Item> front, back, on;
    part(plane, std::move(items), front, back, on);
    const bool eye_in_front = in_front(plane);
    paint(std::move(eye_in_front ? back : front), result);
    for (Item& item : on) result.push_back(std::move(item.surface));
    paint(std::move(eye_in_front ? front : back), result);
  }

 private:
  static bool is_small(const Item& item) { return item.surface.body == kSmallSurface; }

  // Farthest first, by the middle of each.
  void paint_small(const std::vector<Item>& items, std::vector<Surface>& result) const {
    std::vector<std::pair<double, const Item*>> sorted;
    for (const Item& item : items) {
      if (!is_small(item)) continue;
      Vec3d middle = Vec3d::Zero();
      for (const Vec3d& p : item.surface.polygon) middle += camera_.to_camera(p);
      middle /= static_cast<double>(item.surface.polygon.size());
      sorted.emplace_back(camera_.is_perspective() ? middle.norm() : middle.z(), &item);
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [distance, item] : sorted) result.push_back(item->surface);
  }

  // Facets of round bodies alone: parted by the planes of the pairs from (first, second) on. `won`
  // counts for each body the pairs in which this region is on its side.
  void paint_bodies(std::vector<Item> items, std::size_t first, std::size_t second,
                    std::vector<int> won, std::vector<Surface>& result) const {
    std::vector<bool> present(bodies_.size());
    for (const Item& item : items) present[static_cast<std::size_t>(item.surface.body)] = true;
    for (; first < bodies_.size(); ++first, second = first + 1) {
      for (; present[first] && second < bodies_.size(); ++second) {
        if (!present[second]) continue;
        const Plane<double> plane = power_plane(bodies_[first], bodies_[second]);
        std::vector<Item> front, back, on;
        part(plane, std::move(items), front, back, on);
        std::move(on.begin(), on.end(), std::back_inserter(back));
        std::vector<int> won_front = won;
        ++won_front[second];
        ++won[first];
        const bool eye_in_front = in_front(plane);
        if (!eye_in_front) paint_bodies(std::move(front), first, second + 1, won_front, result);
        paint_bodies(std::move(back), first, second + 1, won, result);
        if (eye_in_front) paint_bodies(std::move(front), first, second + 1, won_front, result);
        return;
      }
    }
    std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      return won[static_cast<std::size_t>(a.surface.body)] <
             won[static_cast<std::size_t>(b.surface.body)];
    });
    for (Item& item : items) result.push_back(std::move(item.surface));
  }

  bool in_front(const Plane<double>& plane) const {
    const Vec3d on_plane = plane.normal * plane.offset;
    return camera_.to_eye(on_plane).dot(plane.normal) > 0;
  }

  void part(const Plane<double>& plane, std::vector<Item> items, std::vector<Item>& front,
            std::vector<Item>& back, std::vector<Item>& on) const {
    for (Item& item : items) {
      switch (item.parts ? Side::On : side_of(plane, item.surface.polygon)) {
        case Side::Front:
          front.push_back(std::move(item));
          break;
        case Side::Back:
          back.push_back(std::move(item));
          break;
        case Side::On:
          on.push_back(std::move(item));
          break;
        case Side::Cut: {
          Item one = item, two = item;
          one.surface.polygon = part(plane, item.surface.polygon, 1);
          two.surface.polygon = part(plane, item.surface.polygon, -1);
          if (one.surface.polygon.size() >= 3) front.push_back(std::move(one));
          if (two.surface.polygon.size() >= 3) back.push_back(std::move(two));
          break;
        }
      }
    }
  }

  Side side_of(const Plane<double>& plane, const std::vector<Vec3d>& polygon) const {
    bool front = false, back = false;
    for (const Vec3d& p : polygon) {
      const double d = plane.distance(p);
      front = front || d > tolerance_;
      back = back || d < -tolerance_;
    }
    if (front && back) return Side::Cut;
    if (front) return Side::Front;
    return back ? Side::Back : Side::On;
  }

  // The part of a polygon on one side (sign +1 or -1). New vertices are made from the lower to the
  // higher end, so that both parts get the very same point and no gap opens between them.
  std::vector<Vec3d> part(const Plane<double>& plane, const std::vector<Vec3d>& polygon,
                          int sign) const {
    std::vector<Vec3d> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& p = polygon[i];
      const Vec3d& q = polygon[(i + 1) % polygon.size()];
      const double dp = plane.distance(p);
      const double dq = plane.distance(q);
      if (sign * dp >= -tolerance_) result.push_back(p);
      if ((dp > tolerance_ && dq < -tolerance_) || (dp < -tolerance_ && dq > tolerance_)) {
        const bool forward = dp < dq;
        const Vec3d& low = forward ? p : q;
        const Vec3d& high = forward ? q : p;
        const double dl = forward ? dp : dq;
        const double dh = forward ? dq : dp;
        result.push_back(low + dl / (dl - dh) * (high - low));
      }
    }
    return result;
  }

  const Camera& camera_;
  const std::vector<RoundBody>& bodies_;
  double tolerance_;
};

}  // namespace

std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera,
                                   const std::vector<RoundBody>& bodies) {
  std::vector<Item> items;
  items.reserve(surfaces.size());
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  Vec3d middle_low = low, middle_high = high;  // of all that is not small
  for (Surface& surface : surfaces) {
    if (surface.polygon.size() < 3) continue;
    for (const Vec3d& p : surface.polygon) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      if (surface.body == kSmallSurface) continue;
      middle_low = middle_low.cwiseMin(p);
      middle_high = middle_high.cwiseMax(p);
    }
    Item item = item_of(std::move(surface));
    if (item.area > 0 && item.surface.body != kFlatSurface) item.area = -1;
    if (item.area != 0) items.push_back(std::move(item));
  }
  const double scale = items.empty() ? 0 : (high - low).maxCoeff();
  std::vector<Surface> result;
  result.reserve(items.size());
  const Orderer orderer(camera, bodies, kOnPlane * scale);
  std::vector<Plane<double>> box;
  if (middle_low.x() <= middle_high.x()) {
    for (int axis = 0; axis < 3; ++axis) {
      box.push_back({Vec3d::Unit(axis), middle_high[axis]});
      box.push_back({-Vec3d::Unit(axis), -middle_low[axis]});
    }
  }
  orderer.paint_apart(std::move(items), box, 0, result);
  return result;
}

}  // namespace contactscope::draw
