#pragma once

#include <span>

#include "field/distance_field.h"
#include "manifold/field_contact.h"

namespace contactscope {

/// The closest points of a shape's pieces and of the surface that a field was made of.
struct FieldGap {
  double distance;                 // metres, of the pieces without their radius
  Vec3d on_piece = Vec3d::Zero();  // the field's frame, metres
  Vec3d outward =
      Vec3d::UnitY();    // unit, from the surface to the piece; meaningless where distance is 0
  FeatureRef feature{};  // of the piece
};

/// Distance between pieces of a shape and the surface that a field was made of, caps included: exact up
/// to rounding, where the field itself has only bounds. 0 where the pieces cross the surface; pieces
/// wholly inside are as far as outside. `limit` (metres) ends the search early: where nothing is nearer,
/// it is the distance, and the rest is meaningless. So it is with an infinite limit and no piece.
///
/// Steps: 1. the pieces in turn, each against the tree over the surface's triangles, near nodes first;
/// nodes whose box is farther than the best distance are left out; 2. GJK between the piece and each
/// triangle that is left.
FieldGap field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double limit);

}  // namespace contactscope
