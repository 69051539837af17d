#pragma once

#include "core/static_vector.h"
#include "geometry/mesh.h"

namespace contactscope {

/// The triangles whose boxes touch the box of a shape. Many later queries lie near the shape as
/// well; they test these few boxes instead of the tree, with the same answers in the same order.
template <class S>
class NearTriangles {
 public:
  /// `mesh` must outlive this. `box`: mesh frame.
  NearTriangles(const Mesh<S>& mesh, const Aabb<S>& box) : mesh_(mesh), box_(box) {
    is_whole_ = !mesh.tree.any_place_of(box, [&](int place) {
      if (places_.size() == places_.capacity()) return true;
      places_.push_back(place);
      return false;
    });
  }

  const Mesh<S>& mesh() const { return mesh_; }

  template <class Visit>
  void each(const Visit& visit) const {
    if (!is_whole_) return mesh_.tree.query(box_, visit);
    for (const int place : places_) visit(at(mesh_.tree.triangles, place));
  }

  /// As AabbTree::any_of, over all triangles of the mesh.
  template <class Holds>
  bool any_of(const Aabb<S>& box, const Holds& holds) const {
    const AabbTree<S>& tree = mesh_.tree;
    if (!is_whole_ || !box_.contains(box)) return tree.any_of(box, holds);
    const OverlapsWith<S> hit(box);
    for (const int place : places_) {
      if (hit(at(tree.boxes, place)) && holds(at(tree.triangles, place))) return true;
    }
    return false;
  }

 private:
  const Mesh<S>& mesh_;
  Aabb<S> box_;
  StaticVector<int, 128> places_;  // positions in the tree
  bool is_whole_;                  // all of them fit into places_
};

}  // namespace contactscope
