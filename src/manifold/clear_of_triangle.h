#pragma once

#include <cmath>
#include <limits>

#include "geometry/hull.h"
#include "geometry/mesh.h"
#include "query/box_pair.h"

namespace contactscope {

/// Tells of most triangles near a box that they do not touch it, before one is made a hull and placed: a
/// tree finds those whose bounds touch the box's bounds, and many of these are apart. Only the axes that
/// are at hand: the three of the box and the triangle's normal. What it says is certain: apart by more
/// than the margin and rounding, so that the separating axis test would say so, too.
template <class S>
class ClearOfTriangle {
 public:
  /// `box` is one (Hull::is_box). No coordinate of it in either frame is larger than `reach`, metres.
  ClearOfTriangle(const Hull<S>& box, const Mesh<S>& mesh, const Pose<S>& mesh_in_box, S margin,
                  S reach)
      : mesh_(mesh),
        apart_(margin + S(64) * std::numeric_limits<S>::epsilon() * reach),
        half_extents_(boxes::three(box.half_extents)),
        shift_(boxes::three(mesh_in_box.position)) {
    const Mat3<S> r = mesh_in_box.rotation.toRotationMatrix();
    for (int k = 0; k < 3; ++k) to_box_.of[k] = boxes::three(Vec3<S>(r.col(k)));
  }

  bool operator()(int triangle) const {
    using boxes::Three;
    Three<S> corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = turned(mesh_.corner(triangle, k)) + shift_;
    const Three<S> least = lanes::smaller(lanes::smaller(corners[0], corners[1]), corners[2]);
    const Three<S> most = lanes::larger(lanes::larger(corners[0], corners[1]), corners[2]);
    const Three<S> gaps = lanes::larger(least, Three<S>(-most)) - half_extents_;
    if ((boxes::lane_bits<S>(gaps > apart_) & 7U) != 0) return true;

    const Three<S> normal = turned(mesh_.normal(triangle));
    const Three<S> height = normal * corners[0];
    const Three<S> reach = boxes::absolute<S>(normal) * half_extents_;
    return std::abs(height[0] + height[1] + height[2]) - (reach[0] + reach[1] + reach[2]) > apart_;
  }

 private:
  [[gnu::always_inline]] boxes::Three<S> turned(const Vec3<S>& v) const {
    return to_box_.of[0] * v.x() + to_box_.of[1] * v.y() + to_box_.of[2] * v.z();
  }

  const Mesh<S>& mesh_;
  S apart_;
  boxes::Three<S> half_extents_, shift_;
  boxes::Columns<S> to_box_;
};

}  // namespace contactscope
