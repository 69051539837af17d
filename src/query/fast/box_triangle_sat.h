#pragma once

#include "geometry/mesh.h"
#include "query/fast/packed_vectors.h"
#include "query/sat.h"
#include "query/tolerance.h"

/// The separating axis test for a box and a mesh triangle, which is a flat hull: three faces of the
/// box, the triangle's face, and nine cross products of edges (the thirteen axes of Akenine-Moeller
/// 2001, "Fast 3D Triangle-Box Overlap Testing"). The method of box_sat.h: faces are bitwise equal
/// to sat(), edges are estimated, three per register, and a winning edge is measured again as in
/// sat(). If rounding would decide, the result is Undecided.
namespace contactscope::boxes {

/// A triangle in the box's frame. Every number equals that of a HullPair with a TriangleHull.
template <class S> struct TriangleByBox {
  /// `box_radius` is the radius of the box's hull.
  [[gnu::always_inline]] TriangleByBox(const Mesh<S>& mesh, int triangle,
                                       const Pose<S>& mesh_in_box, const TurnMatrix<S>& turn,
                                       S box_radius) {
    const Three<S> origin = three(mesh.corner(triangle, 0));
    const Three<S> position =
        Turn<S>{four_of<S, 0>(mesh_in_box.rotation)}.of(origin) + three(mesh_in_box.position);
    const Three<S> second = three(mesh.corner(triangle, 1)) - origin;
    const Three<S> third = three(mesh.corner(triangle, 2)) - origin;
    corners[0] = position;
    corners[1] = turn.of_placed(second) + position;
    corners[2] = turn.of_placed(third) + position;
    normal = turn.of_placed(three(mesh.normal(triangle)));
    const Three<S> along = normal * position;
    offset = (along[0] + along[1]) + along[2];

    const Three<S> centroid = (second + third) / S(3);
    const Coordinates<S> offsets(centroid, second - centroid, third - centroid, position);
    const Three<S> lengths = square_roots<S>(offsets.dot(offsets));
    radius = largest_of<S>(lengths);
    scale = ((box_radius + lengths[0]) + radius) + lengths[3];

    directions[0] = turn.of(second);
    directions[1] = turn.of(third - second);
    directions[2] = turn.of(-third);
    const Coordinates<S> edges(directions[0], directions[1], directions[2], directions[2]);
    const Three<S> edge_lengths = square_roots<S>(edges.dot(edges));
    directions[0] /= spread<0>(edge_lengths);
    directions[1] /= spread<1>(edge_lengths);
    directions[2] /= spread<2>(edge_lengths);
  }

  Three<S> corners[3];
  Three<S> directions[3];  // unit, of the half-edges 0, 2 and 4: from corner to corner
  Three<S> normal;         // of the front face
  S offset;                // of the front face's plane
  S radius, scale;
};

/// One of two crossing edges, with the interface that closest_points() needs.
template <class S> struct MetEdge {
  [[gnu::always_inline]] Vec3<S> direction(int) const { return along; }
  [[gnu::always_inline]] Vec3<S> origin(int half_edge) const {
    return half_edge == edge ? from : to;
  }

  int edge;  // half-edge
  Vec3<S> along, from, to;
};

/// The edge along axis i of a box that is farthest along a normal, as the even half-edge.
template <class S>
[[gnu::always_inline]] inline MetEdge<S> edge_of_box(const Three<S>& half, int i,
                                                     const Vec3<S>& normal) {
  int vertex = 0;
  for (int k = 0; k < 3; ++k) vertex |= k != i && normal[k] > S(0) ? 1 << k : 0;
  const int edge = kBox.leaving[static_cast<std::size_t>(vertex)][static_cast<std::size_t>(i)] & ~1;
  const int from = kBox.origin(edge), to = kBox.origin(edge ^ 1);
  return {edge, Vec3<S>::Unit(i) * (to > from ? S(1) : S(-1)),
          vector<S>(vertex_of_box<S>(half, from)), vector<S>(vertex_of_box<S>(half, to))};
}

/// The half-edge 2 k or 2 k + 1 of a triangle that falls along a normal; `falls`: 2 k does.
template <class S>
[[gnu::always_inline]] inline MetEdge<S> edge_of_triangle(const TriangleByBox<S>& triangle, int k,
                                                          bool falls) {
  const Vec3<S> along = vector<S>(triangle.directions[k]);
  const Vec3<S> from = vector<S>(triangle.corners[k]);
  const Vec3<S> to = vector<S>(triangle.corners[k == 2 ? 0 : k + 1]);
  if (falls) return {2 * k, along, from, to};
  return {2 * k + 1, Vec3<S>(-along), to, from};
}

/// Cross products of the box's axes, one per lane, with one edge of the triangle.
template <class S> struct EdgeAxes {
  Three<S> displacement;  // from the edge to the third corner along the cross product
  Three<S> sine;
  Three<S> lower, upper;  // metres: bounds of the separation
};

/// A corner's projection on a cross product a x e is the entry for a of e x corner; both corners of
/// the edge have the same. The axis points from the box to the triangle, and also from the edge to
/// the third corner; otherwise the edge would not be the triangle's closest. `off` bounds the error
/// of a separation times the sine of the edges. For nearly parallel edges see crosses() in
/// box_sat.h; a triangle seen along an edge is a segment.
template <class S>
[[gnu::always_inline]] inline EdgeAxes<S> edge_axes(const TriangleByBox<S>& triangle, int k,
                                                    const Three<S>& half, S off, S floor) {
  const Three<S>& along = triangle.directions[k];
  const Three<S> edge = cross<S>(along, triangle.corners[k]);
  EdgeAxes<S> axes;
  axes.displacement = cross<S>(along, triangle.corners[(k + 2) % 3]) - edge;
  const Three<S> size = absolute<S>(along);
  const Three<S> reach = next(half) * after_next(size) + after_next(half) * next(size);
  const Three<S> gap = (axes.displacement > S(0) ? edge : -edge) - reach;
  // If the side of the third corner is uncertain, allow both.
  const Three<S> most = absolute<S>(axes.displacement) > off ? gap : absolute<S>(edge) - reach;
  const Three<S> squares = along * along;
  axes.sine = square_roots<S>(next(squares) + after_next(squares));
  axes.lower = (gap - off) / axes.sine;
  axes.upper = lanes::smaller<Three<S>>((most + off) / axes.sine,
                                        floor + S(2.1) * triangle.scale * axes.sine);
  return axes;
}

template <class S> struct BoxTriangleAxis {
  enum Verdict {
    Undecided,
    Separated,  // by more than `margin`
    Face,       // `face` of `reference` makes the contact; A is the box
    Edge,       // `edge` makes the contact, between edge_a and edge_b
  } verdict = Undecided;
  Owner reference = Owner::B;
  int face = 0;
  EdgeQuery<S> edge{};
  MetEdge<S> edge_a{}, edge_b{};
  S deepest = 0;  // metres: largest separation of all axes, or a lower value if irrelevant
};

/// sat() of a box and a triangle, whose face is preferred. Metres; `margin` >= 0.
template <class S>
[[gnu::always_inline]] inline BoxTriangleAxis<S> box_triangle_sat(const Three<S>& half,
                                                                  S box_radius,
                                                                  const TriangleByBox<S>& triangle,
                                                                  S margin, Preference preference) {
  using Axis = BoxTriangleAxis<S>;
  const bool relative = preference == Preference::Relative;
  const S tie = relative ? tie_tolerance(triangle.scale) : S(0);
  const auto tolerance = [&](S axis) {
    return relative ? preference_tolerance(axis, std::min(box_radius, triangle.radius)) : S(0);
  };
  Axis result;

  const auto& corners = triangle.corners;
  const Three<S> least = lanes::smaller(lanes::smaller(corners[0], corners[1]), corners[2]);
  const Three<S> most = lanes::larger(lanes::larger(corners[0], corners[1]), corners[2]);
  const Three<S> up = least - half, down = -most - half;
  const S face_a = largest_of<S>(lanes::larger(up, down));
  if (face_a > margin + tie) {
    result.verdict = Axis::Separated;
    return result;
  }
  const std::uint32_t best_faces =
      (lane_bits<S>(up + tie >= face_a) & 7U) | (lane_bits<S>(down + tie >= face_a) & 7U) << 4;
  if ((best_faces & (best_faces - 1)) != 0) return result;

  const Three<S> sizes = absolute<S>(triangle.normal * half);
  const S reach = (sizes[0] + sizes[1]) + sizes[2];
  const S front = -reach - triangle.offset, back = -reach + triangle.offset;
  const int side = back > front + tie ? 1 : 0;
  const S face_b = side == 0 ? front : back;
  if (face_b > margin) {
    result.verdict = Axis::Separated;
    return result;
  }
  const S floor = std::max(face_a, face_b);
  if (!(floor <= S(0))) return result;

  const S off = S(32) * std::numeric_limits<S>::epsilon() * triangle.scale;
  const EdgeAxes<S> axes[] = {edge_axes(triangle, 0, half, off, floor),
                              edge_axes(triangle, 1, half, off, floor),
                              edge_axes(triangle, 2, half, off, floor)};
  const S most_lower = largest_of<S>(axes[0].lower, axes[1].lower, axes[2].lower);
  const S handicap = edge_handicap(triangle.scale, preference);  // as in sat()
  if (most_lower > margin + tie + handicap) {
    result.verdict = Axis::Separated;
    return result;
  }
  const S most_upper = largest_of<S>(axes[0].upper, axes[1].upper, axes[2].upper);
  if (!(most_upper <= margin)) return result;

  // The same as choose() of sat.cpp.
  const auto choose = [&](S deepest) {
    const S enough = deepest - tolerance(deepest);
    if (face_b >= enough) return AxisKind::FaceB;
    return face_a >= enough ? AxisKind::FaceA : AxisKind::EdgeEdge;
  };
  AxisKind chosen = choose(std::max(floor, most_upper));
  result.deepest = floor;
  if (chosen == AxisKind::EdgeEdge || chosen != choose(floor)) {
    const S rival = most_lower - S(2) * tie;
    const std::uint32_t near =
        bits_of_nine<S>(axes[0].upper >= rival, axes[1].upper >= rival, axes[2].upper >= rival);
    const std::uint32_t best = bits_of_nine<S>(
        axes[0].lower == most_lower, axes[1].lower == most_lower, axes[2].lower == most_lower);
    if (near != best || (best & (best - 1)) != 0 || !(most_lower > floor + tie + handicap))
      return result;
    const int bit = std::countr_zero(best | 0x1000U), i = bit % 4, k = bit / 4;
    const S displacement = axes[k].displacement[i], sine = axes[k].sine[i];
    if (!(sine > S(1.1) * kNoisySine<S> && std::abs(displacement) > off)) return result;

    // Measured as in query_edges(): B's half-edge runs in the direction of the arc of A's edge on
    // the Gauss map, from the normal of its left face to the other.
    const Vec3<S> across = Vec3<S>::Unit(i).cross(vector<S>(triangle.directions[k]));
    const auto along_face = [](int face, const Vec3<S>& v) {
      return face % 2 == 0 ? v[face / 2] : -v[face / 2];
    };
    result.edge_a = edge_of_box<S>(half, i, displacement > S(0) ? across : Vec3<S>(-across));
    const int first = kBox.face(result.edge_a.edge), second = kBox.face(result.edge_a.edge ^ 1);
    const bool falls = along_face(second, vector<S>(triangle.directions[k])) < S(0);
    result.edge_b = edge_of_triangle(triangle, k, falls);
    const Vec3<S> cross = result.edge_a.along.cross(result.edge_b.along);
    const S orientation =
        along_face(first, cross) + along_face(second, cross) >= S(0) ? S(1) : S(-1);
    result.edge = {result.edge_a.edge, result.edge_b.edge, S(0), cross * (orientation / sine)};
    result.edge.separation =
        result.edge.normal.dot(Vec3<S>(result.edge_b.from - result.edge_a.from));
    if (!(result.edge.separation <= S(0))) return result;
    result.deepest = result.edge.separation;
    chosen = choose(result.deepest);
  }
  result.verdict = chosen == AxisKind::EdgeEdge ? Axis::Edge : Axis::Face;
  if (chosen == AxisKind::FaceA) {
    const int lane = std::countr_zero(best_faces | 0x80U);
    result.reference = Owner::A;
    result.face = 2 * (lane & 3) + (lane >> 2);
  } else {
    result.face = side;
  }
  return result;
}

}  // namespace contactscope::boxes
