#pragma once

#include <vector>

#include "core/vec3.h"
#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/round_body.h"

namespace contactscope::draw {

/// Surfaces that are no facet of a round body.
inline constexpr int kFlatSurface = -1;   // parts others by its plane
inline constexpr int kSmallSurface = -2;  // one of many that do not cross anything

/// A flat convex polygon in the world, metres.
struct Surface {
  std::vector<Vec3d> polygon;
  Color color;
  int body = kFlatSurface;  // facet of this round body, or one of the two above
};

/// The surfaces in the order in which to paint them, farthest first, cut where they pass through
/// each other, so that translucent colours blend right in every pixel. Surfaces in one plane keep
/// their given order: a highlight that follows the face on which it lies is painted over it.
///
/// Binary space partition after Fuchs, Kedem and Naylor 1980. Steps: take the largest surface as
/// the root, so that small ones are cut by large ones and not the reverse; cut the others by its
/// plane; do the same with both sides; walk the tree from the far side to the near side of each
/// plane.
///
/// Facets of round bodies are cut but never cut others, for there are many: flat surfaces part them
/// first, then the planes of equal power between every two bodies. In a region of least power over
/// one body this body is in front, for the others are inside of it or behind. That is exact for
/// spheres and for all bodies that are apart; where capsules overlap, it is off by a part of the
/// overlap.
///
/// Small surfaces, such as the triangles of a terrain far from what stands on it, are parted from
/// the others by the planes of a box and sorted by distance.
std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera,
                                   const std::vector<RoundBody>& bodies = {});

}  // namespace contactscope::draw
