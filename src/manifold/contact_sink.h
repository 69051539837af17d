#pragma once

#include <vector>

#include "manifold/finish_contact.h"

namespace contactscope {

/// Takes the contacts of one pair, each of them from A's frame to the world and reduced, as a
/// manifold of its own: one for convex shapes, one a triangle for meshes.
template <class S>
class ContactSink {
 public:
  ContactSink(const ToWorld<S>& to_world, const CollideOptions<S>& options,
              std::vector<Manifold<S>>& manifolds, Recorder<S>* recorder)
      : to_world_(to_world), options_(options), manifolds_(manifolds), recorder_(recorder) {}

  /// A contact without points is none. `triangle`: of a mesh.
  void add(Contact<S>& contact, int triangle = -1) {
    if (contact.points.empty()) return;
    Manifold<S>& manifold = manifolds_.emplace_back();
    manifold.triangle = triangle;
    finish_contact(to_world_, options_, contact, manifold, recorder_);
  }

 private:
  ToWorld<S> to_world_;
  const CollideOptions<S>& options_;
  std::vector<Manifold<S>>& manifolds_;
  Recorder<S>* recorder_;
};

/// What collides a convex shape with the triangles of a mesh, in the frame of the first, and gives
/// each contact to the sink. Returns the least separation, metres.
template <class S, class A>
using CollideWithMesh = S(const A& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions<S>& options, ContactSink<S>& sink,
                          Recorder<S>* recorder);

}  // namespace contactscope
