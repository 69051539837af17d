#include "lint/solid.h"

#include "geometry/hull_builder.h"
#include "query/closest_points.h"
#include "query/penetration.h"

namespace contactscope::lint {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Faces at less than this sine to a direction are its sides. A contact point on an edge lies in
/// their planes, so only rounding decides where it would leave through them.
constexpr double kSide = 0.25;
/// Share of a distance field's size. Its contacts are as accurate as its cells, unknown in traces.
constexpr double kFieldVagueness = 0.05;

std::vector<std::array<int, 3>> fans(const std::vector<std::vector<int>>& faces) {
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      triangles.push_back({face[0], face[i - 1], face[i]});
  return triangles;
}

}  // namespace

Solid::Solid(const trace::Shape& shape)
    : radius_(shape.radius + shape.margin),
      center_of_mass_(shape.center_of_mass),
      vertices_(shape.vertices) {
  if (shape.half_space) {
    kind_ = Kind::Plane;
    plane_ = {shape.half_space->normal.normalized(), shape.half_space->offset};
    size_ = kInfinity;
    shape_ = HalfSpace<double>{plane_};
    return;
  }
  const Aabb<double> box = box_around(vertices_);
  lower_ = box.lower.array() - radius_;
  upper_ = box.upper.array() + radius_;
  size_ = (upper_ - lower_).norm() / 2;
  const bool is_field = shape.type == "sdf";
  if (is_field) vagueness_ = kFieldVagueness * size_;
  if (vertices_.size() <= 2 && radius_ > 0) {
    kind_ = Kind::Round;
    if (vertices_.size() == 1) vertices_.push_back(vertices_.front());
    shape_ = Capsule<double>{{vertices_[0], vertices_[1]}, radius_};
  } else if (shape.type == "mesh" || (is_field && !shape.faces.empty())) {
    kind_ = Kind::Surface;
    const auto mesh =
        std::make_shared<const Mesh<double>>(build_mesh(vertices_, fans(shape.faces)));
    triangles_ = std::make_shared<const NearestTriangles>(mesh);
    shape_ = *mesh;
  } else {
    hull_ = build_hull(vertices_, {.weld_duplicates = true, .allow_flat = true});
    shape_ = hull_;
  }
}

SupportSet<double> Solid::core() const {
  if (kind_ == Kind::Hull) return support_set(hull_);
  const bool is_ball = vertices_[0] == vertices_[1];
  return {vertices_.data(), is_ball ? 1 : 2, nullptr};
}

double Solid::distance(const Vec3d& point) const {
  if (kind_ == Kind::Plane) return plane_.normal.dot(point) - plane_.offset;
  if (kind_ == Kind::Surface) return std::sqrt(triangles_->nearest(point).squared);
  if (kind_ == Kind::Round)
    return (point - closest_on_segment(point, vertices_[0], vertices_[1]).point).norm() - radius_;
  double highest = -kInfinity;
  for (const Plane<double>& face : hull_.planes)
    highest = std::max(highest, face.normal.dot(point) - face.offset);
  if (highest <= 0) return highest - radius_;
  const GjkResult<double> gap = gjk(support_set(hull_), support_set(point), Pose<double>{});
  return std::max(gap.distance, 0.0) - radius_;
}

std::optional<double> Solid::exit_of_round(const Vec3d& point, const Vec3d& direction) const {
  const Vec3d from = vertices_[0] - point, axis = vertices_[1] - vertices_[0];
  const Vec3d across_from = from - direction * direction.dot(from);
  const Vec3d across_axis = axis - direction * direction.dot(axis);
  // The exit is from the ball at an end, or from one between them where
  // along + sqrt(r^2 - across^2) is largest.
  const double squared = across_axis.squaredNorm();
  const double crossing = squared > 0 ? -across_axis.dot(across_from) / squared : 0.0;
  std::optional<double> last;
  const auto leave_ball = [&](double where) {
    const Vec3d center = from + where * axis;
    const double along = direction.dot(center);
    const double squared_across = (center - along * direction).squaredNorm();
    if (squared_across <= radius_ * radius_)
      last = std::max(last.value_or(-kInfinity),
                      along + std::sqrt(radius_ * radius_ - squared_across));
  };
  leave_ball(0);
  leave_ball(1);
  const double lean = direction.dot(axis);
  const double room = radius_ * radius_ - (across_from + crossing * across_axis).squaredNorm();
  if (squared > 0 && room >= 0) {
    const double shift = lean * std::sqrt(room / (squared * (squared + lean * lean)));
    if (crossing + shift > 0 && crossing + shift < 1) leave_ball(crossing + shift);
  }
  // No ball is hit: use the nearest one.
  if (!last) last = direction.dot(from + std::clamp(crossing, 0.0, 1.0) * axis);
  return last;
}

std::optional<double> Solid::exit_by_core(const Vec3d& point, const Vec3d& direction) const {
  if (kind_ != Kind::Round) return std::nullopt;
  const Vec3d axis = vertices_[1] - vertices_[0];
  constexpr double kLeaning = 0.75;  // sine: beyond some 50 degrees it stands on end
  if (std::abs(direction.dot(axis)) > kLeaning * axis.norm()) return std::nullopt;
  const Vec3d from = vertices_[0] - point;
  const Vec3d across = axis - direction * direction.dot(axis);
  const double squared = across.squaredNorm();
  const double where = squared > 0 ? std::clamp(-across.dot(from) / squared, 0.0, 1.0) : 0.0;
  return direction.dot(from + where * axis) + radius_;
}

std::optional<double> Solid::exit_of_hull(const Vec3d& point, const Vec3d& direction) const {
  double first = kInfinity;
  for (const Plane<double>& face : hull_.planes) {
    const double slope = face.normal.dot(direction);
    if (slope < kSide) continue;
    first = std::min(first, (face.offset + radius_ - face.normal.dot(point)) / slope);
  }
  // The solid ends at its farthest vertex, even if all faces there are steep.
  const double farthest = extent(direction) - direction.dot(point);
  return std::min(first, farthest);
}

std::optional<double> Solid::exit_of_surface(const Vec3d& point, const Vec3d& direction) const {
  const Mesh<double>& mesh = triangles_->mesh();
  const NearestPoint nearest = triangles_->nearest(point);
  const double near = std::sqrt(nearest.squared);
  std::optional<double> found;
  // No crossing is closer than the nearest point; much farther ones belong to other parts.
  const double reach = 4 * near + 1e-3 * size_;
  Aabb<double> box;
  box.include(point - reach * direction);
  box.include(point + reach * direction);
  mesh.tree.query(box, [&](int t) {
    const double slope = mesh.normal(t).dot(direction);
    if (std::abs(slope) < kSide) return;
    const double where = mesh.normal(t).dot(mesh.corner(t, 0) - point) / slope;
    if (std::abs(where) > std::abs(found.value_or(reach))) return;
    const Vec3d crossing = point + where * direction;
    for (int k = 0; k < 3; ++k) {
      const Vec3d edge = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
      const double inward = mesh.normal(t).cross(edge).dot(crossing - mesh.corner(t, k));
      if (inward < -1e-9 * edge.norm() * size_) return;
    }
    found = where;
  });
  if (!found) found = direction.dot(nearest.point - point);
  return found;
}

std::optional<double> Solid::exit(const Vec3d& point, const Vec3d& direction) const {
  if (kind_ == Kind::Round) return exit_of_round(point, direction);
  if (kind_ == Kind::Hull) return exit_of_hull(point, direction);
  if (kind_ == Kind::Surface) return exit_of_surface(point, direction);
  const double slope = plane_.normal.dot(direction);
  if (slope < kSide) return std::nullopt;
  return (plane_.offset - plane_.normal.dot(point)) / slope;
}

std::optional<Vec3d> Solid::face_normal(const Vec3d& point) const {
  if (kind_ != Kind::Surface) return std::nullopt;
  return triangles_->normal(triangles_->nearest(point).triangle);
}

double Solid::extent(const Vec3d& direction) const {
  if (kind_ == Kind::Plane) {
    constexpr double kSame = 1e-6;  // precision of numbers with seven digits
    return (plane_.normal - direction).norm() <= kSame ? plane_.offset : kInfinity;
  }
  double most = -kInfinity;
  for (const Vec3d& vertex : vertices_) most = std::max(most, direction.dot(vertex));
  return most + radius_;
}

std::optional<double> Placed::exit(const Vec3d& point, const Vec3d& direction, bool by_core) const {
  const Vec3d from = pose.inverse_transform(point) / scale, along = pose.inverse_rotate(direction);
  const std::optional<double> own =
      by_core ? solid->exit_by_core(from, along) : solid->exit(from, along);
  return own ? std::optional(scale * *own + margin) : own;
}

double separation_along(const Placed& a, const Placed& b, const Vec3d& normal) {
  return -b.extent(-normal) - a.extent(normal);
}

std::optional<Separation> best_separation(const Placed& a, const Placed& b) {
  const auto along = [&](const Vec3d& normal) {
    return Separation{separation_along(a, b, normal), normal};
  };
  if (a.solid->is_plane() && b.solid->is_convex())
    return along(a.pose.rotate(a.solid->plane().normal));
  if (b.solid->is_plane() && a.solid->is_convex())
    return along(-b.pose.rotate(b.solid->plane().normal));
  if (!a.solid->is_convex() || !b.solid->is_convex()) return std::nullopt;
  const double radii = a.solid->radius() + b.solid->radius();
  const SupportSet<double> core_a = a.solid->core(), core_b = b.solid->core();
  const Pose<double> b_in_a = relative_pose(a.pose, b.pose);
  const GjkResult<double> gap = gjk(core_a, core_b, b_in_a);
  const Separation separation{gap.distance - radii, a.pose.rotate(gap.normal)};
  if (!may_overlap(gap, core_a, core_b, b_in_a)) return separation;
  const PenetrationResult<double> deep = penetration(PenetrationMethod::Epa, core_a, core_b, b_in_a,
                                                     PenetrationOptions<double>{}, &gap.simplex);
  if (!has_depth(deep.status)) return separation;
  return Separation{-deep.depth - radii, a.pose.rotate(deep.normal)};
}

std::optional<OwnContacts> own_contacts(const Placed& a, const Placed& b) {
  const Shape<double>&shape_a = a.solid->shape(), &shape_b = b.solid->shape();
  if (!can_collide(kind_of(shape_a), kind_of(shape_b))) return std::nullopt;
  const double rounding = a.solid->rounding() + b.solid->rounding();
  CollideOptions options;
  options.margin += rounding;
  OwnContacts found;
  collide(shape_a, a.pose, shape_b, b.pose, options, found.manifolds);
  found.separation = std::numeric_limits<double>::infinity();
  for (const Manifold<double>& manifold : found.manifolds)
    for (const ContactPoint<double>& point : manifold.points)
      found.separation = std::min(found.separation, point.separation - rounding);
  return found;
}

std::optional<Separation> separation_of(const Placed& a, const Placed& b) {
  if (const std::optional<Separation> best = best_separation(a, b)) return best;
  const std::optional<OwnContacts> own = own_contacts(a, b);
  return own ? std::optional(Separation{own->separation}) : std::nullopt;
}

}  // namespace contactscope::lint
