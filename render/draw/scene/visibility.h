#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plane.h"
#include "core/vec3.h"
#include "draw/scene/camera.h"

/// What is in front of what: surfaces in the order in which to paint them, the hidden parts of
/// lines, and round bodies, of which both need to know what the eye sees.
namespace contactscope::draw {

/// A sphere or a capsule in the world: all that is within a radius of a point or a segment. Its
/// outward normals name its surface points: where the normal is n, the surface is at p + radius n,
/// p being the end of the core that is farthest along n.
struct RoundBody {
  std::vector<Vec3d> core;  // one point or two, metres
  double radius = 0;

  /// Where the view rays touch the surface, in order around it: a circle for a sphere, two arcs
  /// joined by straight lines for a capsule, or one circle where a capsule is seen end on. Empty
  /// for an eye inside of the body.
  std::vector<Vec3d> outline(const Camera& camera) const;

  struct Facet {
    std::vector<Vec3d> polygon;  // world, corners on the surface
    double lit = 0;              // cosine of its middle to the key light
  };
  /// What the eye sees of the surface, in facets so small that nobody sees them. No facet crosses
  /// a border between two tones, nor the outline.
  std::vector<Facet> front(const Camera& camera) const;

  /// The body hides what is behind all of these planes (normal . x <= offset): a convex body's
  /// shadow is convex, and bounded by the planes that touch the body on its front and along its
  /// outline.
  std::vector<Plane<double>> shadow(const Camera& camera) const;
};

/// The plane on which points have equal power over two bodies, normal from `a` to `b`: it parts
/// them where they are apart, and goes through the curve in which two spheres meet.
Plane<double> power_plane(const RoundBody& a, const RoundBody& b);

/// Surfaces that are no facet of a round body.
inline constexpr int kFlatSurface = -1;   // parts others by its plane
inline constexpr int kSmallSurface = -2;  // one of many that do not cross anything

/// A flat convex polygon in the world, metres.
struct Surface {
  std::vector<Vec3d> polygon;
  Color color;
  int body = kFlatSurface;  // facet of this round body, or one of the two above
  /// A body keeps its own colour before what is marked on the ground behind it, as the reference
  /// face is: there the mark is faint. What else lies on a face is seen through bodies.
  enum class Kind { Overlay, Body, Ground } kind = Kind::Overlay;
  std::size_t part = 0;  // of the sketch; known to compose() alone
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

/// Flat convex polygons that hide what is behind them, world metres.
using Occluders = std::vector<std::vector<Vec3d>>;

/// Planes behind all of which a convex body hides everything: normal . x <= offset.
using ConvexShadow = std::vector<Plane<double>>;

/// Part of a segment, as parameters along it.
struct Span {
  double from = 0, to = 1;
  bool hidden = false;
};

/// Decides which parts of lines are hidden. What a convex polygon hides is a convex cone cut off by
/// its plane, so it hides one interval of a segment (Cyrus and Beck 1978); the union of these
/// intervals over all occluders is hidden, the rest is seen. `shadows` hide as they are.
class HiddenLines {
 public:
  HiddenLines(const Camera& camera, const Occluders& occluders,
              const std::vector<ConvexShadow>& shadows = {});

  /// Seen and hidden parts in order, covering [0, 1]; right for what is inside of the view.
  std::vector<Span> split(const Vec3d& from, const Vec3d& to) const;

 private:
  // Ends the shadow whose bounds were written last, and gives its number.
  int end_shadow();
  // The cells of the view in the box around points.
  template <class Visit>
  void each_cell(std::span<const Point2> points, const Visit& visit) const;

  Camera camera_;
  std::vector<Plane<double>> bounds_;    // of all shadows, one after the other
  std::vector<std::size_t> begins_;      // of each shadow in `bounds_`, and the end of the last
  std::vector<int> everywhere_;          // shadows that any line may be in
  std::vector<std::vector<int>> cells_;  // the others, by where they are on the screen
  double border_ = 0;                    // metres
};

}  // namespace contactscope::draw
