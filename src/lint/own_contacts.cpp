#include "lint/own_contacts.h"

#include <algorithm>
#include <limits>

namespace contactscope::lint {

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
