#pragma once

#include <span>

#include "field/distance_field.h"
#include "manifold/field_contact.h"

namespace contactscope {

/// The closest points of a shape's pieces and of the surface from which a field was built.
struct FieldGap {
  double distance;  // metres, between the surface and the pieces without their radius
  Vec3d on_piece = Vec3d::Zero();  // the field's frame, metres
  Vec3d outward =
      Vec3d::UnitY();    // unit, from the surface to the piece; undefined if distance is 0
  FeatureRef feature{};  // of the piece
};

/// Distance between pieces of a shape and the surface from which a field was built, caps included:
/// exact up to rounding, where the field itself only has bounds. 0 where the pieces cross the
/// surface; unsigned for pieces wholly inside. `limit` (metres) ends the search early: if nothing
/// is nearer, or without pieces, the distance is the limit and the other members are undefined.
///
/// Steps: 1. test each piece against the tree over the surface's triangles, near nodes first; skip
/// nodes whose box is farther than the best distance; 2. GJK between the piece and each triangle
/// left.
FieldGap field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double limit);

}  // namespace contactscope
