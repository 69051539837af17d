#pragma once

#include "geometry/mesh.h"
#include "query/fast/packed_vectors.h"

namespace contactscope {

/// Rejects most triangles near a hull that do not touch it, before they become placed hulls: many
/// of the triangles whose bounds touch the hull's bounds are separated. Tests only cheap axes: the
/// triangle's normal and the hull's faces; for hulls other than boxes also those of the hull's box
/// in its own frame and one direction from the triangle to the centre. A rejection is certain: the
/// separation exceeds the margin and rounding, so the separating axis test would also reject it.
///
/// That test measures along faces and edges alone. For corners separated by a margin it may find
/// only half the margin. So other axes are used only without a margin, and must be clearer, because
/// the test finds only a small part of the separation of sharp corners.
template <class S> class ClearOfTriangle {
 public:
  /// `reach`, metres: no coordinate of the hull in either frame is larger.
  ClearOfTriangle(const Hull<S>& hull, const Mesh<S>& mesh, const Pose<S>& mesh_in_hull, S margin,
                  S reach)
      : hull_(hull),
        mesh_(mesh),
        separation_(margin + kRounding * reach),
        other_axes_(margin > S(0) ? std::numeric_limits<S>::infinity() : S(0)),
        shift_(boxes::three(mesh_in_hull.position)),
        vertices_(hull.is_box() ? 0 : 3 * padded(hull.vertex_count())) {
    const Mat3<S> r = mesh_in_hull.rotation.toRotationMatrix();
    for (int k = 0; k < 3; ++k) to_hull_.of[k] = boxes::three(Vec3<S>(r.col(k)));
    if (hull.is_box()) {
      upper_ = boxes::three(hull.half_extents);
      lower_ = -upper_;
    } else {
      lay_vertices();
    }
  }

  bool operator()(int triangle) const {
    Three corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = turned(mesh_.corner(triangle, k)) + shift_;
    const Three least = lanes::smaller(lanes::smaller(corners[0], corners[1]), corners[2]);
    const Three most = lanes::larger(lanes::larger(corners[0], corners[1]), corners[2]);
    // A triangle may be much larger than the hull; then its own corners decide the rounding.
    const Three far = lanes::larger(most, Three(-least));
    const S separation = separation_ + kRounding * std::max(std::max(far[0], far[1]), far[2]);
    const Three gaps = lanes::larger(Three(least - upper_), Three(lower_ - most));
    const S clearly = hull_.is_box() ? separation : kSharp * separation + other_axes_;
    const bool is_outside = (boxes::lane_bits<S>(gaps > clearly) & 7U) != 0;
    if (is_outside && !hull_.is_box()) return true;
    const Three normal = turned(mesh_.normal(triangle));
    const Three heights = normal * corners[0];
    const S height = heights[0] + heights[1] + heights[2];
    if (hull_.is_box()) {
      const Three reach = boxes::absolute<S>(normal) * upper_;
      // No short circuit: it would be mispredicted.
      return is_outside | (std::abs(height) - (reach[0] + reach[1] + reach[2]) > separation);
    }
    return off_plane(normal, height, separation) || outside_face(corners, separation) ||
           outside_outline(corners, clearly);
  }

 private:
  using Three = boxes::Three<S>;
  using Pack = lanes::Pack<S>;
  static constexpr S kRounding = S(64) * std::numeric_limits<S>::epsilon();
  static constexpr S kSharp = S(8);

  [[gnu::always_inline]] Three turned(const Vec3<S>& v) const {
    return to_hull_.of[0] * v.x() + to_hull_.of[1] * v.y() + to_hull_.of[2] * v.z();
  }

  /// The hull's lanes, padded with a vertex instead of zeros, which may be outside.
  void lay_vertices() {
    const int count = hull_.vertex_count(), stride = padded(count);
    const S* const from = hull_.lanes.vertices.data();
    for (int k = 0; k < 3; ++k) {
      const S* const of_hull = from + k * stride;
      S* const of_this = vertices_.data() + k * stride;
      Pack least = lanes::all(of_hull[0]), most = least;
      for (int i = 0; i < stride; i += lanes::kWidth<S>) {
        Pack pack = lanes::load(of_hull + i);
        if (i + lanes::kWidth < S >> count)
          pack = lanes::each<S>([&](int lane) { return of_hull[i + lane < count ? i + lane : 0]; });
        lanes::store(pack, of_this + i);
        least = lanes::smaller(least, pack);
        most = lanes::larger(most, pack);
      }
      lower_[k] = lanes::smallest<S>(least)[0];
      upper_[k] = lanes::largest<S>(most)[0];
    }
  }

  /// Extent of the hull's vertices.
  struct Heights {
    S least, most;
  };
  Heights heights_along(const Three& offset) const {
    const int stride = padded(hull_.vertex_count());
    const Pack x = lanes::all(offset[0]), y = lanes::all(offset[1]), z = lanes::all(offset[2]);
    Pack least = lanes::all(std::numeric_limits<S>::infinity()), most = -least;
    for (int i = 0; i < stride; i += lanes::kWidth<S>) {
      const S* const from = vertices_.data() + i;
      const Pack along = x * lanes::load(from) + y * lanes::load(from + stride) +
                         z * lanes::load(from + 2 * stride);
      least = lanes::smaller(least, along);
      most = lanes::larger(most, along);
    }
    return {lanes::smallest<S>(least)[0], lanes::largest<S>(most)[0]};
  }

  /// `height`: of the triangle's plane along its normal.
  bool off_plane(const Three& normal, S height, S separation) const {
    const Heights heights = heights_along(normal);
    return heights.least - height > separation || height - heights.most > separation;
  }

  bool outside_face(const Three (&corners)[3], S separation) const {
    const int stride = padded(hull_.face_count());
    const S* const normals = hull_.lanes.normals.data();
    lanes::Flags<S> outside = {};
    for (int i = 0; i < stride; i += lanes::kWidth<S>) {
      const Pack x = lanes::load(normals + i), y = lanes::load(normals + stride + i),
                 z = lanes::load(normals + 2 * stride + i);
      const auto along = [&](const Three& corner) {
        return x * corner[0] + y * corner[1] + z * corner[2];
      };
      const Pack least =
          lanes::smaller(lanes::smaller(along(corners[0]), along(corners[1])), along(corners[2]));
      outside |= least - lanes::load(hull_.lanes.offsets.data() + i) > separation;
    }
    return lanes::bits<S>(outside) != 0;
  }

  /// Along the direction to the hull's centre from the nearest point of the triangle's outline. If
  /// edges, or a corner and any feature, are closest, a separating axis is near this direction.
  bool outside_outline(const Three (&corners)[3], S separation) const {
    const auto& [c0, c1, c2] = corners;
    const boxes::Coordinates<S> from(c0, c1, c2, c2), to(c1, c2, c0, c0);
    const Three along[] = {to.x - from.x, to.y - from.y, to.z - from.z};
    const Vec3<S>& middle = hull_.centroid;
    const Three rest[] = {middle.x() - from.x, middle.y() - from.y, middle.z() - from.z};
    const Three ahead = rest[0] * along[0] + rest[1] * along[1] + rest[2] * along[2];
    const Three squared = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    const Three zero = {}, one = boxes::all_of(S(1));
    const Three part = lanes::smaller(lanes::larger(Three(ahead / squared), zero), one);
    const Three feet[] = {rest[0] - part * along[0], rest[1] - part * along[1],
                          rest[2] - part * along[2]};
    const Three far = feet[0] * feet[0] + feet[1] * feet[1] + feet[2] * feet[2];
    const int nearest = far[0] <= far[1] ? (far[0] <= far[2] ? 0 : 2) : (far[1] <= far[2] ? 1 : 2);
    const Three offset = {feet[0][nearest], feet[1][nearest], feet[2][nearest], S(0)};
    S highest = -std::numeric_limits<S>::infinity();
    for (const Three& corner : corners) {
      const Three terms = offset * corner;
      highest = std::max(highest, terms[0] + terms[1] + terms[2]);
    }
    const S gap = heights_along(offset).least - highest;
    return gap > S(0) && gap * gap > separation * separation * far[nearest];
  }

  const Hull<S>& hull_;
  const Mesh<S>& mesh_;
  S separation_;
  S other_axes_;         // infinity to allow only the separating axis test's axes
  Three lower_, upper_;  // box around the hull, own frame
  Three shift_;
  boxes::Columns<S> to_hull_;
  Scratch<S, 3 * 64> vertices_;  // unused for boxes
};

}  // namespace contactscope
