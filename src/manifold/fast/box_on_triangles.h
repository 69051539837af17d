#pragma once

#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/fast/box_triangle_sat.h"

namespace contactscope {

/// A box against triangles of a mesh, one at a time, without a record: the result of
/// collide_hull_hull() for the box and the triangle as a flat hull with the preferred face, bit for
/// bit, in a third of the time. The triangle stays three corners in registers; no hull is built.
///
/// Where rounding would decide between axes, the caller must use collide_hull_hull() instead.
template <class S> class BoxOnTriangles {
 public:
  /// All arguments must outlive this. `box` must be a box (Hull::is_box).
  BoxOnTriangles(const Hull<S>& box, const Mesh<S>& mesh, const Pose<S>& mesh_in_box,
                 const CollideOptions& options);

  /// Returns whether the triangle was handled. `contact` must be empty; it is filled unless the
  /// separation is above the margin.
  bool collide(int triangle, Contact<S>& contact) const;

  /// The contact with the front (0) or the back (1) of the triangle, whatever the deepest axis.
  bool collide_face(int triangle, int face, Contact<S>& contact) const;

 private:
  template <class Sum>
  bool face_of_triangle(const boxes::TriangleByBox<S>& triangle, int face, const Sum& sum,
                        Contact<S>& contact) const;
  bool face_of_box(const boxes::TriangleByBox<S>& triangle, int face, Contact<S>& contact) const;

  const Hull<S>& box_;
  const Mesh<S>& mesh_;
  Pose<S> mesh_in_box_;
  S margin_;
  Preference preference_;
  bool is_turn_;  // the rotation is unit
  boxes::TurnMatrix<S> turn_;
  boxes::Three<S> half_;                                     // half extents of the box
  mutable std::optional<boxes::TriangleByBox<S>> triangle_;  // the last one
  mutable int index_ = -1;
};

}  // namespace contactscope
