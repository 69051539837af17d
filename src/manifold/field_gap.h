#pragma once

#include <span>

#include "field/distance_field.h"
#include "manifold/field_contact.h"

namespace contactscope {

/// Distance, metres, between pieces of a shape and the surface that a field was made of, caps
/// included: exact up to rounding, where the field itself has only bounds. `radius` (metres) lies
/// around each piece. 0 where the pieces cross the surface; pieces wholly inside are as far as
/// outside. No more than `limit` (metres), which ends the search early; infinite without a piece.
///
/// Steps: 1. the pieces in turn, each against the tree over the surface's triangles, near nodes first;
/// nodes whose box is farther than the best distance are left out; 2. GJK between the piece and each
/// triangle that is left.
double field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double radius,
                 double limit);

}  // namespace contactscope
