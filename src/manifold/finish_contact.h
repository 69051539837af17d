#pragma once

#include <span>

#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "manifold/recorder.h"
#include "manifold/to_world.h"

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
  for (const int index : reduced.kept) {
    manifold.points.push_back(points[static_cast<std::size_t>(index)]);
  }
}

}  // namespace contactscope
