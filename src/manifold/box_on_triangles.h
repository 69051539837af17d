#pragma once

#include "geometry/mesh.h"
#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/box_triangle_sat.h"

namespace contactscope {

/// A box and one triangle of a mesh after the other, where nobody watches: what collide_hull_hull() gives
/// for the box and the triangle as a flat hull, whose face is preferred, bit for bit, in a third of the
/// time. The triangle stays what it is, three corners in registers, and no hull is made of it.
///
/// Where rounding would choose between axes nothing is done, and collide_hull_hull() is to be asked.
template <class S>
class BoxOnTriangles {
 public:
  /// All outlive this. `box` is one (Hull::is_box).
  BoxOnTriangles(const Hull<S>& box, const Mesh<S>& mesh, const Pose<S>& mesh_in_box,
                 const CollideOptions& options);

  /// Whether the triangle was done: `contact`, empty when it is called, is filled, or stays so where it is
  /// apart by more than the margin.
  bool collide(int triangle, Contact<S>& contact) const;

  /// The contact with the front (0) or the back (1) of the triangle, whatever the deepest axis is.
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
  bool is_turn_;  // the rotation is one
  boxes::TurnMatrix<S> turn_;
  boxes::Three<S> half_;  // extents of the box
};

}  // namespace contactscope
