#include "draw/hidden_lines.h"

#include <algorithm>
#include <limits>

namespace contactscope::draw {
namespace {

// A line within this fraction of the occluders' size of a shadow's border is seen: it is an edge of
// the occluder itself, or touches it, and rounding must not decide.
constexpr double kBorder = 2e-4;
// Widest gap between two shadows, in borders, that counts as their seam: two borders seen at a
// slant.
constexpr double kSeam = 8;

}  // namespace

HiddenLines::HiddenLines(const Camera& camera, const Occluders& occluders,
                         const std::vector<ConvexShadow>& shadows)
    : shadows_(shadows) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  for (const std::vector<Vec3d>& polygon : occluders) {
    for (const Vec3d& p : polygon) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  for (const std::vector<Vec3d>& polygon : occluders) {
    if (polygon.size() < 3) continue;
    Vec3d middle = Vec3d::Zero();
    Vec3d normal = Vec3d::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      middle += polygon[i];
      normal += (polygon[i] - polygon[0]).cross(polygon[(i + 1) % polygon.size()] - polygon[0]);
    }
    middle /= static_cast<double>(polygon.size());
    double size = 0;
    for (const Vec3d& p : polygon) size = std::max(size, (p - middle).norm());
    const double border = kBorder * size;
    border_ = std::max(border_, border);
    normal.normalize();
    if (normal.dot(camera.to_eye(middle)) < 0) normal = -normal;

    ConvexShadow shadow;
    shadow.push_back({normal, normal.dot(middle) - border});  // behind the polygon
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& p = polygon[i];
      const Vec3d& q = polygon[(i + 1) % polygon.size()];
      // The plane through the eye and the edge, facing away from the polygon's middle.
      Vec3d side = (q - p).cross(camera.to_eye(p));
      const double length = side.norm();
      if (length <= kBorder * (q - p).norm()) continue;
      side /= length;
      if (side.dot(middle - p) > 0) side = -side;
      shadow.push_back({side, side.dot(p) - border});
    }
    shadows_.push_back(std::move(shadow));
  }
}

std::vector<Span> HiddenLines::split(const Vec3d& from, const Vec3d& to) const {
  std::vector<std::pair<double, double>> hidden;
  for (const ConvexShadow& shadow : shadows_) {
    double first = 0, last = 1;
    for (const Plane<double>& bound : shadow) {
      const double d0 = bound.distance(from);
      const double d1 = bound.distance(to);
      if (d0 > 0 && d1 > 0) {
        first = 1;
        last = 0;
        break;
      }
      if (d0 > 0) first = std::max(first, d0 / (d0 - d1));
      if (d1 > 0) last = std::min(last, d0 / (d0 - d1));
    }
    if (first < last) hidden.emplace_back(first, last);
  }
  std::sort(hidden.begin(), hidden.end());

  // Shadows of neighbours stop short of each other by their borders; what is between them is
  // hidden.
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
