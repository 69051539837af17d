#include "field/distance_field.h"

#include "query/closest_points.h"
#include "query/winding.h"

namespace contactscope {
namespace {

Vec3d unit_or(const Vec3d& v, double length, const Vec3d& otherwise) {
  return length > 0 ? Vec3d(v / length) : otherwise;
}

}  // namespace

template <class Visit> void DistanceField::for_nodes(const Place& place, const Visit& visit) const {
  const NodeLayout& layout = *place.layout;
  const double side = 1 << layout.side_bits, step = double{layout.step};
  const Vec3d corner = place.corner();
  for (int i = 0; i < 4; ++i) {
    const int y = i & 1, z = i >> 1;
    const auto& distances = place.first[y * layout.next_y + z * layout.next_z].distance;
    const Vec3d node(corner.x(), corner.y() + side * y, corner.z() + side * z);
    if (!visit(node, step * distances[0])) return;
    if (!visit(Vec3d(node.x() + side, node.y(), node.z()), step * distances[1])) return;
  }
}

std::span<const int> DistanceField::triangles_of(const Place& place) const {
  if (!place.fine || first_triangle_.empty()) return {};
  const int fine = (place.first_of_block - coarse_count_) / kPairs;
  const int cell = (place.cell[2] * kBlock + place.cell[1]) * kBlock + place.cell[0];
  const std::uint32_t* first = &at(first_triangle_, fine * kCells + cell);
  return {cell_triangles_.data() + first[0], cell_triangles_.data() + first[1]};
}

bool DistanceField::is_inside(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                              std::span<const int> around) const {
  if (regular_ && nearest.on_face)
    return front_ * triangles_.height_over(nearest.triangle, point) < 0;
  // No surface separates a point and a node if their distances to it sum to over |node - point|.
  const double distance = std::sqrt(nearest.squared);
  bool known = false, inside = false;
  for_nodes(place, [&](const Vec3d& node, double value) {
    known = std::abs(value) + distance - slack(place) > (node - point).norm() + 0x1p-32;
    inside = value < 0;
    return !known;
  });
  if (known) return inside;
  // At an edge or a corner the point is inside if it is behind all planes that meet there, outside
  // if in front of all: the first face on a path out of a solid is seen from behind.
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
  // If the difference is only rounding, the gradient is the normal of the face.
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

FieldSample DistanceField::exact_in_cell(const Vec3d& point) const {
  if (core_) return by_core(point);
  const Place place = locate(point);
  const std::span<const int> around = triangles_of(place);
  return exact_near(place, point, triangles_.nearest_of(around, point), around);
}

FieldSample DistanceField::sample_outside(const Vec3d& point) const {
  const Vec3d inside = clamped(point);
  const FieldSample there = sample(locate(inside), inside);
  if (inside == point) return there;  // on the border of the lattice
  // From the surface point nearest to the border point.
  const Vec3d from_surface = point - inside + there.distance * there.gradient;
  const double distance = from_surface.norm();
  return {distance, unit_or(from_surface, distance, there.gradient), FieldSample::Source::Outside};
}

FieldSample DistanceField::exact(const Vec3d& point) const {
  if (core_) return by_core(point);
  const Place place = locate(clamped(point));
  const std::span<const int> around = triangles_of(place);
  if (!around.empty() && in_lattice(point)) return exact_in_cell(point);
  return exact_near(place, point, triangles_.nearest(point), around);
}

FieldBounds DistanceField::bounds_by_nodes(const Place& place, const Vec3d& inside) const {
  FieldBounds bounds{-std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity()};
  const double rounding = slack(place);
  for_nodes(place, [&](const Vec3d& node, double value) {
    const double displacement = (node - inside).norm() + rounding;
    bounds.lower = std::max(bounds.lower, value - displacement);
    bounds.upper = std::min(bounds.upper, value + displacement);
    return true;
  });
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
    const double distance = exact_in_cell(inside).distance;
    bounds = {distance - kExactSlack, distance + kExactSlack};
  }
  if (inside != point) [[unlikely]] {
    const double displacement = (point - inside).norm() * (1 + 0x1p-50);
    const double beyond =
        (surface_box_.lower - point).cwiseMax(point - surface_box_.upper).cwiseMax(0.0).norm();
    bounds.lower = std::max(bounds.lower - displacement, beyond * (1 - 0x1p-50) - 0x1p-32);
    bounds.upper += displacement;
  }
  return bounds;
}

std::size_t DistanceField::bytes() const {
  return nodes_.size() * sizeof(NodePair) + first_node_of_block_.size() * sizeof(int) +
         first_triangle_.size() * sizeof(std::uint32_t) + cell_triangles_.size() * sizeof(int) +
         (core_ ? 0 : triangles_.bytes());
}

}  // namespace contactscope
