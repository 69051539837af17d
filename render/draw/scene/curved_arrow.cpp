#include "draw/scene/curved_arrow.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/palette.h"

namespace contactscope::draw {

void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch) {
  constexpr double kStep = 0.08;  // radians
  constexpr double kHead = 12;    // pixels
  const Vec3d to_eye = camera.to_eye(center);
  Vec3d front = to_eye - to_eye.dot(axis) * axis;
  front = front.norm() > 0.1 ? Vec3d(front.normalized())
                             : Vec3d(camera.right() - camera.right().dot(axis) * axis).normalized();
  const Vec3d side = axis.cross(front);
  const auto at = [&](double turn) -> Vec3d {
    const double a = turn - 0.5 * angle;
    return center + radius * (std::cos(a) * front + std::sin(a) * side);
  };
  // The head is straight: the arc ends where it begins.
  const double head =
      std::min(0.6 * angle, kHead / std::max(1e-9, radius * camera.pixels_per_metre(center)));
  Curve arc;
  const int steps = std::max(2, static_cast<int>(std::ceil((angle - head) / kStep)));
  for (int i = 0; i <= steps; ++i) arc.points.push_back(at((angle - head) * i / steps));
  arc.style = {width + 3.5f, with_alpha(kWhite, 0.85f), false, LineStyle::Hidden::Same};
  sketch.curves.push_back(arc);
  arc.style = {width, color, false, LineStyle::Hidden::Same};
  sketch.curves.push_back(arc);
  Arrow tip;
  tip.from = at(angle - head);
  tip.to = at(angle);
  tip.width = width;
  tip.head = static_cast<float>(kHead);
  tip.head_share = 1;
  tip.color = color;
  tip.halo = false;
  sketch.arrows.push_back(tip);
}

}  // namespace contactscope::draw
