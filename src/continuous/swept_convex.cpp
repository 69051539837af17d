#include "continuous/swept_convex.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"

namespace contactscope {
namespace {

/// Whether the triangle meets the segment from the origin to `segment`, which is not in its plane.
bool is_pierced(const std::array<Vec3d, 3>& triangle, const Vec3d& segment) {
  const Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  const double height = normal.dot(triangle[0]), rise = normal.dot(segment);
  if (rise == 0 || !(height / rise >= 0 && height / rise <= 1)) return false;
  const Vec3d point = height / rise * segment;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& from = at(triangle, i);
    const Vec3d along = at(triangle, (i + 1) % 3) - from;
    if (along.cross(point - from).dot(normal) < 0) return false;
  }
  return true;
}

/// Prism of a triangle swept against a segment, from `near` to `far`. Finds which of its five faces
/// (near, far, one per edge) a ball at the origin can meet first.
///
/// A solid prism is convex: a ball beyond the plane of one face is separated from all of it. At the
/// first contact the ball moves against the outward normal of a face there. If it overlaps at the
/// start, the nearest point is on a face whose plane is near. All other faces are skipped.
struct PrismFaces {
  bool is_solid = false;
  bool is_separated = false;  // at all times
  std::array<bool, 5> can_be_first = {true, true, true, true, true};

  PrismFaces(const std::array<Vec3d, 3>& near, const Vec3d& segment, const Vec3d& offset,
             double radius) {
    // Rounding may hide the outer side of a flatter prism.
    constexpr double kFlat = 1e-12;
    const Vec3d normal = (near[1] - near[0]).cross(near[2] - near[0]);
    const double volume = normal.dot(segment);
    is_solid = std::abs(volume) > kFlat * normal.norm() * segment.norm();
    if (!is_solid) return;
    const Vec3d out = volume > 0 ? segment : Vec3d(-segment);
    const Vec3d upright = volume > 0 ? normal : Vec3d(-normal);
    const auto look_at = [&](int face, const Vec3d& outward, const Vec3d& point) {
      const double reach = radius * outward.norm();
      const double height = -outward.dot(point), toward = -outward.dot(offset);
      is_separated = is_separated || (height > reach && height - reach > toward);
      at(can_be_first, face) = height >= -reach && (toward >= 0 || height <= reach);
    };
    look_at(0, upright, near[0]);
    look_at(1, -upright, near[0] - segment);
    for (int i = 0; i < 3; ++i)
      look_at(2 + i, (at(near, (i + 1) % 3) - at(near, i)).cross(out), at(near, i));
  }
};

/// Time span in which two intervals on an axis overlap, narrowed axis by axis.
class OverlapTime {
 public:
  OverlapTime(const std::array<Vec3d, 3>& corners, const Vec3d& centre, const Vec3d& offset)
      : corners_(corners), centre_(centre), offset_(offset) {}

  /// `axis` has any length > 0; `reach` is the box's extent along it. False if they never overlap.
  bool narrow(const Vec3d& axis, double reach) {
    double low = axis.dot(corners_[0]), high = low;
    for (const Vec3d& corner : corners_) {
      low = std::min(low, axis.dot(corner));
      high = std::max(high, axis.dot(corner));
    }
    const double centre = axis.dot(centre_), speed = axis.dot(offset_);
    const double below = (low - reach) - centre, above = centre - (high + reach);  // gaps
    if (below > 0 || above > 0) {
      const bool is_below = below > 0;
      const double gap = is_below ? below : above, closing = is_below ? speed : -speed;
      if (!(closing >= gap)) return false;
      const double time = gap / closing;
      if (time >= first_) {
        first_ = time;
        normal_ = is_below ? Vec3d(-axis) : axis;
      }
    }
    // The overlap ends at the other side.
    if (speed != 0)
      last_ = std::min(
          last_, (speed > 0 ? (high + reach) - centre : centre - (low - reach)) / std::abs(speed));
    return first_ <= last_;
  }

  double first() const { return first_; }
  Vec3d normal() const { return normal_.normalized(); }

 private:
  const std::array<Vec3d, 3>& corners_;
  const Vec3d &centre_, &offset_;
  double first_ = 0, last_ = 1;
  Vec3d normal_ = Vec3d::UnitX();
};

}  // namespace

template <class S>
SweptHit sweep_capsule_triangle(const std::array<Vec3<S>, 2>& ends, const Vec3<S>& displacement,
                                S radius, const std::array<Vec3<S>, 3>& triangle) {
  // Relative to the first end: a ball there, and the triangle swept against the segment.
  const Vec3d origin = ends[0].template cast<double>();
  const Vec3d segment = ends[1].template cast<double>() - origin;
  const Vec3d offset = displacement.template cast<double>();
  const auto size = static_cast<double>(radius);
  std::array<Vec3d, 3> near, far;
  for (int i = 0; i < 3; ++i) {
    at(near, i) = at(triangle, i).template cast<double>() - origin;
    at(far, i) = at(near, i) - segment;
  }
  SweptHit first;
  const PrismFaces faces(near, segment, offset, size);
  if (faces.is_separated) return first;
  if (is_pierced(near, segment)) {
    first.status = SweptStatus::Overlapping;
    first.time = 0;
    return first;
  }
  bool is_settled = false;
  const auto meet = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    if (is_settled) return;
    const SweptSphereHit hit =
        sweep_sphere_triangle<double>(Vec3d::Zero(), offset, size, {a, b, c});
    const bool is_first = hit.status == SweptStatus::Overlapping ||
                          (hit.status == SweptStatus::Hit &&
                           (first.status == SweptStatus::Separated || hit.time < first.time));
    if (is_first) first = {hit.status, hit.time, hit.normal};
    // The whole prism is behind the plane of a face that is hit in its interior.
    is_settled =
        hit.status == SweptStatus::Overlapping ||
        (hit.status == SweptStatus::Hit && hit.feature == TriangleFeature::Face && faces.is_solid);
  };
  if (faces.can_be_first[0]) meet(near[0], near[1], near[2]);
  if (segment.isZero(0)) return first;
  if (faces.can_be_first[1]) meet(far[0], far[1], far[2]);
  for (int i = 0; i < 3; ++i) {
    if (!at(faces.can_be_first, 2 + i)) continue;
    const int next = (i + 1) % 3;
    meet(at(near, i), at(near, next), at(far, next));
    meet(at(near, i), at(far, next), at(far, i));
  }
  return first;
}

template <class S>
SweptHit sweep_box_triangle(const Obb<S>& box, const Vec3<S>& displacement,
                            const std::array<Vec3<S>, 3>& triangle) {
  const Vec3d origin = triangle[0].template cast<double>();
  std::array<Vec3d, 3> corners;
  for (int i = 0; i < 3; ++i) at(corners, i) = at(triangle, i).template cast<double>() - origin;
  const Vec3d centre = box.center.template cast<double>() - origin;
  const Vec3d offset = displacement.template cast<double>();
  const Mat3<double> axes = box.axes.template cast<double>();
  const Vec3d half = box.half_extents.template cast<double>();
  OverlapTime overlap(corners, centre, offset);
  const auto narrow = [&](const Vec3d& axis) {
    return overlap.narrow(axis, (axes.transpose() * axis).cwiseAbs().dot(half));
  };
  const SweptHit separated;
  for (int k = 0; k < 3; ++k)
    if (!narrow(axes.col(k))) return separated;
  const Vec3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (normal.squaredNorm() > 0 && !narrow(normal)) return separated;
  for (int i = 0; i < 3; ++i) {
    const Vec3d edge = at(corners, (i + 1) % 3) - at(corners, i);
    for (int k = 0; k < 3; ++k) {
      const Vec3d axis = edge.cross(axes.col(k));
      // Parallel edges give no axis. Nearly parallel ones give a rounded axis, which is valid too.
      if (axis.squaredNorm() > 0 && !narrow(axis)) return separated;
    }
  }
  SweptHit hit;
  hit.time = overlap.first();
  hit.status = hit.time > 0 ? SweptStatus::Hit : SweptStatus::Overlapping;
  hit.normal = overlap.normal();
  return hit;
}

template decltype(sweep_capsule_triangle<float>) sweep_capsule_triangle<float>;
template decltype(sweep_capsule_triangle<double>) sweep_capsule_triangle<double>;
template decltype(sweep_box_triangle<float>) sweep_box_triangle<float>;
template decltype(sweep_box_triangle<double>) sweep_box_triangle<double>;

}  // namespace contactscope
