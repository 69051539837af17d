#pragma once

#include <optional>
#include <vector>

#include "core/vec3.h"

namespace contactscope::draw {

/// Axes of a camera that looks against `direction`.
struct ViewAxes {
  Vec3d right, up, towards_eye;

  ViewAxes(const Vec3d& direction, const Vec3d& world_up);
};

struct ViewFit {
  Vec3d target;
  double distance;  // of the eye from the target, metres
};

/// The middle of the box around points; at least one.
Vec3d center_of(const std::vector<Vec3d>& points);

/// The nearest eye from which the points fill at most `share` of the view both ways, with the points
/// in the middle unless the target is given. `half_height`: tangent of half the field of view;
/// `aspect`: width by height.
ViewFit fit_view(const std::vector<Vec3d>& points, const ViewAxes& axes,
                 const std::optional<Vec3d>& target, double half_height, double aspect,
                 double share);

}  // namespace contactscope::draw
