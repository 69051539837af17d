#include "draw/depth_order.h"

#include <algorithm>
#include <cmath>
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
  double area = 0;  // twice, square metres
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
  return {std::move(surface), plane, length};
}

enum class Side { Front, Back, On, Cut };

class Orderer {
 public:
  Orderer(const Camera& camera, double tolerance) : camera_(camera), tolerance_(tolerance) {}

  void paint(std::vector<Item> items, std::vector<Surface>& result) const {
    if (items.empty()) return;
    if (items.size() == 1) {
      result.push_back(std::move(items.front().surface));
      return;
    }
    const Plane<double> plane =
        std::max_element(items.begin(), items.end(), [](const Item& a, const Item& b) {
          return a.area < b.area;
        })->plane;
    std::vector<Item> front, back, on;
    for (Item& item : items) {
      switch (side_of(plane, item.surface.polygon)) {
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
    const Vec3d on_plane = plane.normal * plane.offset;
    const bool eye_in_front = camera_.to_eye(on_plane).dot(plane.normal) > 0;
    paint(std::move(eye_in_front ? back : front), result);
    for (Item& item : on) result.push_back(std::move(item.surface));
    paint(std::move(eye_in_front ? front : back), result);
  }

 private:
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
  double tolerance_;
};

}  // namespace

std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera) {
  std::vector<Item> items;
  items.reserve(surfaces.size());
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  for (Surface& surface : surfaces) {
    if (surface.polygon.size() < 3) continue;
    for (const Vec3d& p : surface.polygon) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    Item item = item_of(std::move(surface));
    if (item.area > 0) items.push_back(std::move(item));
  }
  const double scale = items.empty() ? 0 : (high - low).maxCoeff();
  std::vector<Surface> result;
  result.reserve(items.size());
  Orderer(camera, kOnPlane * scale).paint(std::move(items), result);
  return result;
}

}  // namespace contactscope::draw
