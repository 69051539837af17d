#include "field/distance_field.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "query/closest_points.h"
#include "query/winding.h"

namespace contactscope {
namespace {

using Pack = lanes::Pack<float>;

Pack lerp(const Pack& from, const Pack& to, float t) {
  return from + lanes::all(t) * (to - from);
}

/// What Hermite's cubic between two nodes adds to the line between them, given how much node one has
/// more than node zero (`rise` of the distance, `bend` of the slope) and the slope in between, at `t`.
float hermite_excess(float rise, float bend, float slope, float t) {
  const float mean_slope = slope + (0.5F - t) * bend;
  return t * (1 - t) * ((1 - 2 * t) * (mean_slope - rise) - 0.5F * bend);
}

Vec3d unit_or(const Vec3d& v, double length, const Vec3d& otherwise) {
  return length > 0 ? Vec3d(v / length) : otherwise;
}

}  // namespace

DistanceField::Place DistanceField::locate(const Vec3d& inside) const {
  Place place;
  const auto along = [&](int axis) {
    const auto i = static_cast<std::size_t>(axis);
    return place.block[i] = std::min(static_cast<int>(inside[axis]) / kBlock, blocks_[i] - 1);
  };
  const int x = along(0), y = along(1), z = along(2);
  place.fine = at(fine_of_block_, (z * blocks_[1] + y) * blocks_[0] + x);
  place.corner = kBlock * Vec3d(x, y, z);
  if (place.fine >= 0) {
    const auto cell_along = [&](int axis) {
      return std::min(static_cast<int>(inside[axis] - place.corner[axis]), kBlock - 1);
    };
    const int i = cell_along(0), j = cell_along(1), k = cell_along(2);
    place.cell = (k * kBlock + j) * kBlock + i;
    place.corner += Vec3d(i, j, k);
    place.side = 1;
    place.next_y = kSide;
    place.next_z = kSide * kSide;
    place.nodes = fine_.data() + static_cast<std::ptrdiff_t>(place.fine) * kNodes +
                  k * place.next_z + j * place.next_y + i;
  } else {
    place.cell = 0;
    place.side = kBlock;
    place.next_y = blocks_[0] + 1;
    place.next_z = place.next_y * (blocks_[1] + 1);
    place.nodes = coarse_.data() + static_cast<std::ptrdiff_t>(z) * place.next_z +
                  static_cast<std::ptrdiff_t>(y) * place.next_y + x;
  }
  return place;
}

FieldSample DistanceField::blend(const Place& place, const Vec3d& inside) const {
  const double scale = place.side == 1 ? 1.0 : 1.0 / kBlock;
  const auto tx = static_cast<float>((inside.x() - place.corner.x()) * scale);
  const auto ty = static_cast<float>((inside.y() - place.corner.y()) * scale);
  const auto tz = static_cast<float>((inside.z() - place.corner.z()) * scale);
  const Node* near = place.nodes;
  const Node* far = near + place.next_z;
  const int y = place.next_y;
  const Pack x00 = lerp(near[0], near[1], tx), x10 = lerp(near[y], near[y + 1], tx);
  const Pack x01 = lerp(far[0], far[1], tx), x11 = lerp(far[y], far[y + 1], tx);
  const Pack y0 = lerp(x00, x10, ty), y1 = lerp(x01, x11, ty);
  const Pack all = lerp(y0, y1, tz);
  float distance = all[0];
  if (settings_.interpolation == FieldInterpolation::Cubic) {
    const auto side = static_cast<float>(place.side);
    const Pack rise_x = lerp(lerp(near[1] - near[0], near[y + 1] - near[y], ty),
                             lerp(far[1] - far[0], far[y + 1] - far[y], ty), tz);
    const Pack rise_y = lerp(x10 - x00, x11 - x01, tz);
    const Pack rise_z = y1 - y0;
    distance += hermite_excess(rise_x[0], side * rise_x[1], side * all[1], tx) +
                hermite_excess(rise_y[0], side * rise_y[2], side * all[2], ty) +
                hermite_excess(rise_z[0], side * rise_z[3], side * all[3], tz);
  }
  return {distance,
          {all[1], all[2], all[3]},
          place.fine >= 0 ? FieldSample::Source::Fine : FieldSample::Source::Coarse};
}

std::span<const int> DistanceField::triangles_of(const Place& place) const {
  if (place.fine < 0 || first_triangle_.empty()) return {};
  const std::uint32_t* first = &at(first_triangle_, place.fine * kCells + place.cell);
  return {cell_triangles_.data() + first[0], cell_triangles_.data() + first[1]};
}

bool DistanceField::is_inside(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                              std::span<const int> around) const {
  if (regular_ && nearest.on_face)
    return front_ * triangles_.height_over(nearest.triangle, point) < 0;
  // No surface is between a point and a node where both are farther from it than from each other.
  const double distance = std::sqrt(nearest.squared);
  for (int i = 0; i < 8; ++i) {
    const Vec3d node = place.corner + place.side * Vec3d(i & 1, (i >> 1) & 1, i >> 2);
    const double value =
        double{place.nodes[(i & 1) + ((i >> 1) & 1) * place.next_y + (i >> 2) * place.next_z][0]};
    if (std::abs(value) + distance - slack(value) > (node - point).norm() + 0x1p-32)
      return value < 0;
  }
  // At an edge or a corner the point is inside if it is behind all planes that meet there, and outside if
  // it is before all of them: the first face on a way out of a solid is seen from behind.
  if (regular_ && !around.empty()) {
    bool before = false, behind = false;
    for (const int triangle : around) {
      const NearestPoint own = triangles_.nearest_of({&triangle, 1}, point);
      if (own.squared > nearest.squared * (1 + 0x1p-40) + 0x1p-80) continue;
      const double height = front_ * triangles_.height_over(triangle, point);
      (height < 0 ? behind : before) = true;
    }
    if (before != behind) return behind;
  }
  return winding_number(triangles_.mesh(), point).number != 0;
}

FieldSample DistanceField::exact_near(const Place& place, const Vec3d& point,
                                      const NearestPoint& nearest,
                                      std::span<const int> around) const {
  const double distance = std::sqrt(nearest.squared);
  const double sign = is_inside(place, point, nearest, around) ? -1 : 1;
  const Vec3d normal = front_ * triangles_.normal(nearest.triangle);
  // So near that the difference is rounding: the normal of the face is the gradient.
  const Vec3d gradient =
      distance > 0x1p-30 ? Vec3d(sign / distance * (point - nearest.point)) : normal;
  return {sign * distance, gradient, FieldSample::Source::Exact};
}

FieldSample DistanceField::by_core(const Vec3d& point) const {
  const auto& [ends, radius] = *core_;
  const Vec3d offset = point - closest_on_segment<double>(point, ends[0], ends[1]).point;
  const double length = offset.norm();
  const Vec3d along = ends[1] - ends[0];
  const Vec3d across = along.isZero(0) ? Vec3d(Vec3d::UnitY()) : any_perpendicular(along);
  return {length - radius, unit_or(offset, length, across), FieldSample::Source::Exact};
}

FieldSample DistanceField::sample(const Vec3d& point) const {
  const Vec3d inside = clamped(point);
  const Place place = locate(inside);
  FieldSample result;
  const std::span<const int> around = triangles_of(place);
  if (around.empty()) {
    result = blend(place, inside);
  } else if (core_) {
    result = by_core(inside);
  } else {
    result = exact_near(place, inside, triangles_.nearest_of(around, inside), around);
  }
  if (inside != point) [[unlikely]] {
    // From the surface's point that is nearest to where the lattice ends.
    const Vec3d from_surface = point - inside + result.distance * result.gradient;
    result.distance = from_surface.norm();
    result.gradient = unit_or(from_surface, result.distance, result.gradient);
    result.source = FieldSample::Source::Outside;
  }
  return result;
}

FieldSample DistanceField::exact(const Vec3d& point) const {
  if (core_) return by_core(point);
  const Place place = locate(clamped(point));
  return exact_near(place, point, triangles_.nearest(point), triangles_of(place));
}

FieldBounds DistanceField::bounds_by_nodes(const Place& place, const Vec3d& inside) const {
  FieldBounds bounds{-std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 8; ++i) {
    const Vec3d node = place.corner + place.side * Vec3d(i & 1, (i >> 1) & 1, i >> 2);
    const double value =
        double{place.nodes[(i & 1) + ((i >> 1) & 1) * place.next_y + (i >> 2) * place.next_z][0]};
    const double way = (node - inside).norm() + slack(value);
    bounds.lower = std::max(bounds.lower, value - way);
    bounds.upper = std::min(bounds.upper, value + way);
  }
  return bounds;
}

FieldBounds DistanceField::bounds(const Vec3d& point) const {
  const Vec3d inside = clamped(point);
  const Place place = locate(inside);
  const std::span<const int> around = triangles_of(place);
  FieldBounds bounds;
  if (around.empty()) {
    bounds = bounds_by_nodes(place, inside);
  } else {
    const double distance =
        core_ ? by_core(inside).distance
              : exact_near(place, inside, triangles_.nearest_of(around, inside), around).distance;
    bounds = {distance - kExactSlack, distance + kExactSlack};
  }
  if (inside != point) [[unlikely]] {
    const double way = (point - inside).norm() * (1 + 0x1p-50);
    const double beyond =
        (surface_box_.lower - point).cwiseMax(point - surface_box_.upper).cwiseMax(0.0).norm();
    bounds.lower = std::max(bounds.lower - way, beyond * (1 - 0x1p-50) - 0x1p-32);
    bounds.upper += way;
  }
  return bounds;
}

std::size_t DistanceField::bytes() const {
  return (coarse_.size() + fine_.size()) * sizeof(Node) + fine_of_block_.size() * sizeof(int) +
         first_triangle_.size() * sizeof(std::uint32_t) + cell_triangles_.size() * sizeof(int) +
         (core_ ? 0 : triangles_.bytes());
}

}  // namespace contactscope
