#pragma once

#include "core/pose.h"
#include "draw/scene/camera.h"

/// Visibility: painting order of surfaces, hidden parts of lines, and the visible part of round
/// bodies.
namespace contactscope::draw {

/// A convex body hides all points behind all of its bounds: normal . x <= offset.
struct ConvexShadow {
  std::vector<Plane<double>> bounds{};
  /// The bounds from this one on hold for what is behind all of `behind`, and need no test.
  std::size_t sides = 0;
  std::vector<Plane<double>> behind{};
  /// Corners of a region of the screen that holds the body; none if a part may be behind the eye.
  std::vector<Point2> around{};
  double depth = 0;     // of its nearest point, metres
  bool opaque = false;  // its surface covers others
  int body = -1;        // if round: number of the body
};

/// Width of a shadow's border, metres, in which lines are visible. `middle` and `size` of the body.
double border_of_shadow(const Camera& camera, const Vec3d& middle, double size);

/// A sphere or a capsule in the world: all points within a radius of a point or a segment. The
/// surface point with outward normal n is p + radius n, where p is the core's end farthest along n.
struct RoundBody {
  std::vector<Vec3d> core;  // one point or two, metres
  double radius = 0;
  /// One of many: a third of the corners, and a few polygons for each tone instead of facets.
  bool small = false;

  /// Points where view rays touch the surface, in order: a circle for a sphere, two arcs joined by
  /// straight lines for a capsule, or one circle for a capsule seen end-on. Empty for an eye
  /// inside.
  std::vector<Vec3d> outline(const Camera& camera) const;

  struct Facet {
    std::vector<Vec3d> polygon;  // world; corners on the surface
    double lit = 0;              // cosine between its middle's normal and the key light
  };
  /// The visible surface in tiny facets. No facet crosses a border of tones or the outline. If the
  /// body is small: convex polygons to be painted over each other, in this order.
  std::vector<Facet> front(const Camera& camera) const;

  /// The body hides all points behind all of these planes (normal . x <= offset). They touch the
  /// body on its front and along its outline; a convex body's shadow is convex.
  ConvexShadow shadow(const Camera& camera) const;
};

/// Plane of points with equal power with respect to two bodies, normal from `a` to `b`. It lies
/// between separated bodies, and contains the circle in which two spheres intersect.
Plane<double> power_plane(const RoundBody& a, const RoundBody& b);

/// Values for surfaces that are not facets of a round body.
inline constexpr int kFlatSurface = -1;   // splits others by its plane
inline constexpr int kSmallSurface = -2;  // one of many that cross nothing

/// A flat convex polygon in the world, metres.
struct Surface {
  std::vector<Vec3d> polygon;
  Color color;
  int body = kFlatSurface;  // facet of this round body, or one of the two above
  /// A body keeps its colour in front of marks on the ground behind it, such as the reference face:
  /// the mark is faint there. Overlays are visible through bodies.
  enum class Kind { Overlay, Body, Ground } kind = Kind::Overlay;
  std::size_t part = 0;  // of the sketch; set by compose() only
};

/// Orders surfaces for painting, farthest first, and cuts them where they intersect, so that
/// translucent colours blend correctly in every pixel. Surfaces in one plane keep their order: a
/// highlight after its face is painted over it.
///
/// Binary space partition after Fuchs, Kedem and Naylor 1980. Steps: take the largest surface as
/// the root, so that large surfaces cut small ones and not the reverse; cut the others by its
/// plane; do the same with both sides; walk the tree from the far side to the near side of each
/// plane.
///
/// Facets of round bodies are cut but never cut others, because they are many. Flat surfaces
/// separate them first, then the planes of equal power between every two bodies. In the region of
/// least power with respect to one body, this body is in front; the others are inside it or behind
/// it. This is exact for spheres and for separated bodies. For overlapping capsules the error is a
/// part of the overlap.
///
/// Small surfaces, such as the triangles of a terrain far from other shapes, are separated from the
/// others by the planes of a box and sorted by distance.
std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera,
                                   const std::vector<RoundBody>& bodies = {});

/// Flat convex polygons that hide points behind them, world metres.
using Occluders = std::vector<std::vector<Vec3d>>;

/// Part of a segment, as parameters along it.
struct Span {
  double from = 0, to = 1;
  bool hidden = false;
};

/// Finds the hidden parts of lines. The shadow of a convex polygon is a convex cone cut off by its
/// plane, so it hides one interval of a segment (Cyrus and Beck 1978). The union of these intervals
/// over all occluders is hidden. `shadows` hide in the same way.
class HiddenLines {
 public:
  HiddenLines(const Camera& camera, const Occluders& occluders,
              const std::vector<ConvexShadow>& shadows = {});

  /// Whether it was made for as many occluders and shadows, seen by the same camera.
  bool is_for(const Camera& camera, std::array<std::size_t, 2> counts) const {
    return camera == camera_ && counts == given_;
  }

  /// Visible and hidden parts in order, covering [0, 1]; valid inside the view. Not for two threads
  /// at once.
  std::vector<Span> split(const Vec3d& from, const Vec3d& to) const;

  /// Whether an opaque shadow, one of many, hides the whole surface; not that of its own body.
  bool hides(const Surface& surface) const;

 private:
  using Box = Eigen::AlignedBox2d;  // on the screen, in cells
  struct Shadow {
    std::size_t begin = 0, end = 0;  // of its bounds
    std::size_t sides = 0;           // the first bound that what is behind meets; or `end`
    std::vector<Plane<double>> behind{};
    int opaque_body = kNotOpaque;      // -1 if it is not round
    mutable std::size_t last = begin;  // the bound that a line was last found to be in front of
  };
  static constexpr int kNotOpaque = -2;
  /// A shadow in a cell; most of them are rejected by their boxes.
  struct Near {
    Eigen::AlignedBox2f box;  // around the shadow's corners
    float depth;              // of its nearest point
    int shadow;
    Eigen::Matrix<std::int16_t, 2, 1> first;  // the shadow's first cell
  };

  Box box_of(std::span<const Point2> points) const;

  Camera camera_;
  std::array<std::size_t, 2> given_;
  std::vector<Plane<double>> bounds_;  // of all shadows, concatenated
  std::vector<Shadow> shadows_;
  std::vector<int> everywhere_;           // shadows that are checked for all lines
  std::vector<std::vector<Near>> cells_;  // the other shadows, by screen cell, the nearest first
  double border_ = 0;                     // metres
  mutable std::vector<std::pair<double, double>> hidden_{};  // of the line being split
};

}  // namespace contactscope::draw
