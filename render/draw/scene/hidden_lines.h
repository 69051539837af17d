#pragma once

#include <span>
#include <vector>

#include "core/plane.h"
#include "core/vec3.h"
#include "draw/scene/camera.h"

namespace contactscope::draw {

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
  // The cells of the view in the box around points.
  std::vector<int> cells_of(std::span<const Point2> points) const;

  Camera camera_;
  std::vector<ConvexShadow> shadows_;
  std::vector<int> everywhere_;          // shadows that any line may be in
  std::vector<std::vector<int>> cells_;  // the others, by where they are on the screen
  double border_ = 0;                    // metres
};

}  // namespace contactscope::draw
