#pragma once

#include "core/manifold.h"

namespace contactscope {

/// Contact points while they are worked on: as in Manifold, but positions in A's frame.
template <class S>
using PointSet = StaticVector<ContactPoint<S>, kMaxManifoldPoints>;

/// What one pair of convex shapes gives, in A's frame, before it is reduced. Empty when the shapes
/// are apart by more than the margin.
template <class S>
struct Contact {
  AxisKind axis = AxisKind::FaceA;
  ContactType type = ContactType::FaceFace;
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B
  PointSet<S> points;
};

}  // namespace contactscope
