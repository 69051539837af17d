#pragma once

#include <memory>
#include <optional>

#include "core/pose.h"
#include "field/nearest_point.h"
#include "geometry/hull.h"
#include "geometry/shape.h"
#include "query/support_set.h"
#include "trace/shape.h"

namespace contactscope::lint {

/// A shape of a trace as claims about it are measured: in its own frame, metres, double, by planes, segments
/// and nearest triangles. It shares nothing with the stages that make contacts.
class Solid {
 public:
  /// Throws ShapeError of vertices that bound nothing.
  explicit Solid(const trace::Shape& shape);

  /// Of a point from the surface, negative inside; of a mesh, which need not have an inside, never negative.
  double distance(const Vec3d& point) const;

  /// How far from `point` along `direction` (unit) one leaves the solid, negative where it lies behind. Beside
  /// the solid the faces that look along the direction go on as planes, so that a point on an edge has an
  /// answer too. Of a mesh the crossing nearest to the point. Empty where the direction does not leave it.
  std::optional<double> exit(const Vec3d& point, const Vec3d& direction) const;

  /// The same as pipelines measure a capsule that leans against a face: the point of its segment, and the
  /// radius beyond it. Up to r (1 / cos - 1) less than to its surface. Empty of other solids, and where it
  /// stands on end.
  std::optional<double> exit_by_core(const Vec3d& point, const Vec3d& direction) const;

  /// Of a mesh, where its triangle that is nearest to the point looks to (unit); empty of others.
  std::optional<Vec3d> face_normal(const Vec3d& point) const;

  /// The largest direction . x of its points; infinite along what has no end.
  double extent(const Vec3d& direction) const;

  /// Half the diagonal of its box; infinite of a plane.
  double size() const { return size_; }
  /// How far off a claim may be because the engine's own shape is an approximation of this one, metres.
  double vagueness() const { return vagueness_; }
  bool is_convex() const { return kind_ == Kind::Round || kind_ == Kind::Hull; }
  bool is_plane() const { return kind_ == Kind::Plane; }

  /// Of a convex one: the points whose hull, grown by radius(), it is.
  SupportSet<double> core() const;
  double radius() const { return radius_; }
  const Plane<double>& plane() const { return plane_; }
  const Vec3d& center_of_mass() const { return center_of_mass_; }
  const Vec3d& lower() const { return lower_; }  // corners of its box, own frame; of a plane none
  const Vec3d& upper() const { return upper_; }

  /// For the collision pipeline, where claims are missing altogether; without rounding().
  const Shape<double>& shape() const { return shape_; }
  /// Metres that shape() has to be grown by: hulls of the pipeline are not rounded.
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

/// A solid where a frame has it, maybe larger than the trace says by `scale`.
struct Placed {
  const Solid* solid = nullptr;
  Pose<double> pose{};
  double scale = 1;

  double distance(const Vec3d& point) const {
    return scale * solid->distance(pose.inverse_transform(point) / scale);
  }
  std::optional<double> exit(const Vec3d& point, const Vec3d& direction) const;
  std::optional<double> exit_by_core(const Vec3d& point, const Vec3d& direction) const;
  double extent(const Vec3d& direction) const {
    return scale * solid->extent(pose.inverse_rotate(direction)) + direction.dot(pose.position);
  }
  double size() const { return scale * solid->size(); }
};

/// Metres between them along a direction (unit, from a to b), negative in overlap: by how much b has to be
/// moved along it until a plane across it parts them, with the sign turned.
double separation_along(const Placed& a, const Placed& b, const Vec3d& normal);

struct Separation {
  double distance = 0;           // metres, negative in overlap
  Vec3d normal = Vec3d::Zero();  // unit, world, from a to b: along which it is
};

/// The largest of these: the distance of two solids that are apart, or how deep they are in each other. Of
/// convex solids and planes at their own scale; empty of others, and of two planes.
std::optional<Separation> best_separation(const Placed& a, const Placed& b);

}  // namespace contactscope::lint
