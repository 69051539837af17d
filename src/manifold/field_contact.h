#pragma once

#include "field/distance_field.h"
#include "manifold/collide_options.h"
#include "trace/field_slice.h"

/// Points of a shape's surface inside a distance field. Everything in the field's frame, metres.
namespace contactscope {

/// A part of a surface, or of the core of a round shape: a point, a segment or a triangle.
struct FieldPiece {
  std::array<Vec3d, 3> corners;
  int count = 1;  // of the corners
  FeatureRef feature;
};

/// A point of the surface, or of the core, with a separation from the field up to the margin.
struct FieldTouch {
  Vec3d point;
  double separation;  // less the radius; negative inside
  Vec3d outward;      // unit: away from the field's surface
  FeatureRef feature;
};

struct FieldTouches {
  std::vector<FieldTouch> found;
  double least;  // separation; without points a lower bound, infinite if the shape is not near
};

/// Parameters of the search. Lengths in metres.
struct FieldSearchLimits {
  FieldSearch search = FieldSearch::Conservative;
  double radius = 0;                                 // around each piece
  double margin = 0;                                 // points up to this separation are found
  double spacing = 0;                                // of points on large pieces
  std::vector<trace::FieldProbe>* probes = nullptr;  // record of the samples; null: not recorded
};

/// Finds points of `pieces` at or inside the surface. Vertices are pieces of one point. Steps:
/// 1. skip a piece if the field's lower bound at its middle exceeds the piece's reach from there;
/// 2. subdivide the others down to the spacing and test their middles;
/// 3. conservative, if none was found: subdivide the piece of the least bound until a point is
///    inside, or all bounds exceed the margin, or a piece is so small that the surfaces are within
///    kFieldTolerance. Such a piece counts as a touch, with the separation of its middle. So no
///    overlap is missed, and a separation below the tolerance may count as touching;
/// 4. conservative: add the deepest point of all, in place of the result of 3. If the pieces do not
///    cross the surface, it is the nearest point, exactly (field_gap()). If they do, subdivide as
///    in 3 while a part may be deeper than the deepest touch by more than kFieldTolerance, by a
///    tangent at its middle. That is valid for fields of convex shapes, and for pieces that are
///    small compared with the field's hollows.
/// Sampled: only 2, for all pieces that the box around the field's surface reaches.
///
/// Sources: Piyavskii 1972 and Shubert 1972 for functions of bounded slope; for step 4 Kelley 1960,
/// "The Cutting-Plane Method for Solving Convex Programs".
FieldTouches find_touches(const PlacedField& field, std::span<const FieldPiece> pieces,
                          const FieldSearchLimits& limits);

/// As a fraction of a cell.
inline constexpr double kFieldTolerance = 0x1p-8;

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
/// Steps: 1. test each piece against the tree over the surface's triangles, near nodes first,
/// without those beyond the best distance; 2. GJK between the piece and each triangle left.
FieldGap field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double limit);

}  // namespace contactscope
