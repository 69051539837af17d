#pragma once

#include "field/nearest_point.h"
#include "manifold/dispatch.h"
#include "query/support_set.h"

namespace contactscope::lint {

/// A shape of a trace for measuring claims: in its own frame, metres, double, by planes, segments
/// and nearest triangles. Shares no code with the stages that create contacts.
class Solid {
 public:
  /// Throws ShapeError for degenerate vertices.
  explicit Solid(const trace::Shape& shape);

  /// From a point to the surface, negative inside; never negative for a mesh, which may be open.
  double distance(const Vec3d& point) const;

  /// Distance from `point` along `direction` (unit) to the exit of the solid, negative if behind.
  /// Faces towards the direction extend as planes, so that points on an edge have an exit. For a
  /// mesh, the crossing nearest to the point. Empty if the direction does not exit.
  std::optional<double> exit(const Vec3d& point, const Vec3d& direction) const;

  /// Like exit(), as pipelines measure a capsule that leans against a face: the point of its
  /// segment plus the radius. Up to r (1 / cos - 1) less than to its surface. Empty for other
  /// solids and upright capsules.
  std::optional<double> exit_by_core(const Vec3d& point, const Vec3d& direction) const;

  /// Unit normal of a mesh's triangle nearest to the point; empty for others.
  std::optional<Vec3d> face_normal(const Vec3d& point) const;

  /// The maximum of direction . x over its points; infinite in unbounded directions.
  double extent(const Vec3d& direction) const;

  /// Half the diagonal of its box; infinite for a plane.
  double size() const { return size_; }
  /// Allowed error of claims because the engine's own shape only approximates this one, metres.
  double vagueness() const { return vagueness_; }
  bool is_convex() const { return kind_ == Kind::Round || kind_ == Kind::Hull; }
  bool is_plane() const { return kind_ == Kind::Plane; }

  /// The points of a convex solid: it is their hull, expanded by radius().
  SupportSet<double> core() const;
  double radius() const { return radius_; }
  const Plane<double>& plane() const { return plane_; }
  const Vec3d& center_of_mass() const { return center_of_mass_; }
  const Vec3d& lower() const { return lower_; }  // corners of its box, own frame; unset for a plane
  const Vec3d& upper() const { return upper_; }

  /// For the collision pipeline, when claims are missing altogether; without rounding().
  const Shape<double>& shape() const { return shape_; }
  /// Metres to expand shape() by: hulls of the pipeline are not rounded.
  double rounding() const { return kind_ == Kind::Hull ? radius_ : 0; }

 private:
  enum class Kind { Round, Hull, Plane, Surface };

  std::optional<double> exit_of_round(const Vec3d& point, const Vec3d& direction) const;
  std::optional<double> exit_of_hull(const Vec3d& point, const Vec3d& direction) const;
  std::optional<double> exit_of_surface(const Vec3d& point, const Vec3d& direction) const;

  Kind kind_ = Kind::Hull;
  double radius_ = 0;
  double size_ = 0;
  double vagueness_ = 0;
  Vec3d center_of_mass_ = Vec3d::Zero();
  Vec3d lower_ = Vec3d::Zero(), upper_ = Vec3d::Zero();
  std::vector<Vec3d> vertices_;
  Plane<double> plane_{};
  Hull<double> hull_;
  std::shared_ptr<const NearestTriangles> triangles_;
  Shape<double> shape_;
};

/// A solid with its pose in a frame, scaled by `scale`, then enlarged by `margin`, metres.
struct Placed {
  const Solid* solid = nullptr;
  Pose<double> pose{};
  double scale = 1, margin = 0;

  double distance(const Vec3d& point) const {
    return scale * solid->distance(pose.inverse_transform(point) / scale) - margin;
  }
  std::optional<double> exit(const Vec3d& point, const Vec3d& direction,
                             bool by_core = false) const;
  double extent(const Vec3d& direction) const {
    return scale * solid->extent(pose.inverse_rotate(direction)) + direction.dot(pose.position);
  }
  double size() const { return scale * solid->size(); }
  Vec3d middle() const { return pose.transform(solid->center_of_mass()); }
};

/// Metres between the solids along a direction (unit, from a to b), negative if they overlap: minus
/// the displacement of b along it until a perpendicular plane separates them.
double separation_along(const Placed& a, const Placed& b, const Vec3d& normal);

struct Separation {
  double distance = 0;           // metres, negative in overlap
  Vec3d normal = Vec3d::Zero();  // unit, world, from a to b: its direction
};

/// The largest separation_along(): the distance of separated solids, or minus their penetration
/// depth. For convex solids and planes at their own scale; empty for others, and for two planes.
std::optional<Separation> best_separation(const Placed& a, const Placed& b);

/// Contacts from our own pipeline, for meshes, which best_separation() does not support.
struct OwnContacts {
  Manifolds<double> manifolds;  // all points; hulls without rounding
  double separation = 0;  // metres, of the deepest point, with rounding; infinite without points
};

/// At their own scale. Empty for kinds of shapes that do not collide here.
std::optional<OwnContacts> own_contacts(const Placed& a, const Placed& b);

/// For shapes of any kind; empty if it cannot be computed, as for two meshes. For a mesh the normal
/// is zero, and the distance is infinite if nothing touches it.
std::optional<Separation> separation_of(const Placed& a, const Placed& b);

}  // namespace contactscope::lint
