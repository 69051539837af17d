#pragma once

#include <vector>

#include "manifold/finish_contact.h"

namespace contactscope {

/// Takes the contacts of one pair, each of them from A's frame to the world, reduced and recorded,
/// as a manifold of its own: one for convex shapes, one a triangle for meshes.
template <class S, class Recorder>
class ContactSink {
 public:
  ContactSink(const ToWorld<S>& to_world, const CollideOptions<S>& options,
              std::vector<Manifold<S>>& manifolds, Recorder& recorder)
      : to_world_(to_world), options_(options), manifolds_(manifolds), recorder_(recorder) {}

  /// A contact without points is none. `triangle`: of a mesh.
  void add(Contact<S>& contact, int triangle = -1) {
    if (contact.points.empty()) return;
    Manifold<S>& manifold = manifolds_.emplace_back();
    manifold.triangle = triangle;
    finish_contact(to_world_, options_, contact, manifold, recorder_);
    recorder_.manifold(manifold);
  }

 private:
  ToWorld<S> to_world_;
  const CollideOptions<S>& options_;
  std::vector<Manifold<S>>& manifolds_;
  Recorder& recorder_;
};

}  // namespace contactscope
