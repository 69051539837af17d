#pragma once

#include <span>
#include <vector>

#include "field/distance_field.h"
#include "manifold/collide_options.h"
#include "trace/field_slice.h"

/// Where the surface of one shape is inside a distance field. Everything in the field's frame, metres.
namespace contactscope {

/// A part of a surface, or of the core of a round shape: a point, a segment or a triangle.
struct FieldPiece {
  std::array<Vec3d, 3> corners;
  int count = 1;  // of the corners
  FeatureRef feature;
};

/// A point of the surface, or of the core, that is no farther from the field's than the margin.
struct FieldTouch {
  Vec3d point;
  double separation;  // less the radius; negative inside
  Vec3d outward;      // unit: away from the field's surface
  FeatureRef feature;
};

struct FieldTouches {
  std::vector<FieldTouch> found;
  double least;  // separation; where no point was found a lower bound, infinite where none was near
};

/// How the search goes about it. Lengths in metres.
struct FieldSearchLimits {
  FieldSearch search = FieldSearch::Conservative;
  double radius = 0;   // around each piece
  double margin = 0;   // points up to this separation are found
  double spacing = 0;  // of points on large pieces
  std::vector<trace::FieldProbe>* probes =
      nullptr;  // record of what is asked; null: nobody watches
};

/// Points of `pieces` at or inside the surface. Corners that are vertices come as pieces of one point.
///
/// Steps: 1. a piece is left out where the field's lower bound at its middle is larger than what reaches
/// it from there; 2. others are cut until they are no larger than the spacing, and their middles are
/// looked at; 3. conservative, and none was found: the piece of the least bound is cut, again and again,
/// until a point is inside, or all bounds are larger than the margin, or a piece is so small that the
/// surfaces are within kFieldTolerance: it counts as a touch, with what its middle has for a separation.
/// So an overlap is never missed, and what is apart by less than the tolerance may be called touching;
/// 4. conservative: the deepest point of all is added, in the place of what 3 found. Where the pieces do not cross the surface, it is
/// the nearest, exactly (field_gap.h). Where they do, parts are cut as in 3 while they may be deeper than
/// the deepest touch by more than kFieldTolerance, by a tangent at their middles: that holds for fields
/// of convex shapes, and where pieces are small compared with the field's hollows.
/// Sampled: only 2, of all pieces that the box around the field's surface reaches.
///
/// Source of the search: Piyavskii 1972 and Shubert 1972 for functions of bounded slope; 4 Kelley 1960, "The
/// Cutting-Plane Method for Solving Convex Programs", for convex ones.
FieldTouches find_touches(const PlacedField& field, std::span<const FieldPiece> pieces,
                          const FieldSearchLimits& limits);

/// Part of a cell.
inline constexpr double kFieldTolerance = 0x1p-8;

}  // namespace contactscope
