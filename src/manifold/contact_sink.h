#pragma once

#include <span>
#include <vector>

#include "manifold/recorder.h"

namespace contactscope {

/// The last two stages of every pair: `contact` moves from A's frame to the world, where it stays,
/// and what the reducer keeps of it becomes `manifold`. Gregorius 2015, "Contact Point Reduction".
/// Without a reducer, or one that has nothing to do, the points stay as they are.
template <class S>
void finish_contact(const ToWorld<S>& to_world, const CollideOptions<S>& options,
                    Contact<S>& contact, Manifold<S>& manifold, Recorder<S>* recorder) {
  if (contact.points.empty()) return;
  manifold.axis = contact.axis;
  manifold.type = contact.type;
  manifold.normal = to_world.direction(contact.normal);
  for (ContactPoint<S>& point : contact.points) point.position = to_world.point(point.position);
  if (options.reducer == nullptr) {
    manifold.points = contact.points;
    return;
  }
  const std::span<const ContactPoint<S>> points(contact.points.data(), contact.points.size());
  const Reduction reduced =
      recorder ? recorder->reduce(options, points, manifold.normal)
               : reduce(options.reducer, points, manifold.normal, options.reduction);
  for (const int index : reduced.kept) manifold.points.push_back(at(points, index));
}

/// Takes the contacts of one pair and finishes each as a manifold of its own: one for convex shapes,
/// one a triangle for meshes.
template <class S>
struct ContactSink {
  ToWorld<S> to_world;
  const CollideOptions<S>& options;
  std::vector<Manifold<S>>& manifolds;
  Recorder<S>* recorder;  // null when nobody watches

  /// A contact without points is none. `triangle`: of a mesh.
  void add(Contact<S>& contact, int triangle = -1) {
    if (contact.points.empty()) return;
    Manifold<S>& manifold = manifolds.emplace_back();
    manifold.triangle = triangle;
    finish_contact(to_world, options, contact, manifold, recorder);
  }
};

}  // namespace contactscope
