#include "query/simplex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S>
using Points = std::array<Vec3<S>, 4>;

template <class S>
const Vec3<S>& at(const Points<S>& points, int i) {
  return points[static_cast<std::size_t>(i)];
}

template <class S>
void on_vertex(const Points<S>& points, int i, NearestOnSimplex<S>& result) {
  result.count = 1;
  result.kept[0] = i;
  result.weights[0] = S(1);
  result.point = result.direction = at(points, i);
  result.squared_distance = result.point.squaredNorm();
}

/// False unless the foot of the perpendicular lies between both ends.
template <class S>
bool on_edge(const Points<S>& points, int i, int j, NearestOnSimplex<S>& result) {
  const Vec3<S>&p = at(points, i), &q = at(points, j);
  const Vec3<S> along = q - p;
  const S from_p = -p.dot(along);
  const S from_q = q.dot(along);
  if (!(from_p > S(0) && from_q > S(0))) return false;
  const S weight_q = from_p / (from_p + from_q);
  const S weight_p = from_q / (from_p + from_q);
  // From the nearer end: it is met exactly when the foot moves there.
  result.point =
      weight_q < weight_p ? Vec3<S>(p + weight_q * along) : Vec3<S>(q - weight_p * along);
  result.count = 2;
  result.kept[0] = i, result.kept[1] = j;
  result.weights[0] = weight_p, result.weights[1] = weight_q;
  result.squared_distance = result.point.squaredNorm();
  result.direction = result.point;
  return true;
}

/// A triangle seen from the corner at which its two shorter sides meet. There the cross product of
/// two sides is relatively exact even for a needle, whose sides from elsewhere are nearly parallel.
template <class S>
struct Triangle {
  Triangle(const Points<S>& points, int i, int j, int k) {
    const Vec3<S> ij = at(points, j) - at(points, i);
    const Vec3<S> jk = at(points, k) - at(points, j);
    const Vec3<S> ki = at(points, i) - at(points, k);
    const S ij2 = ij.squaredNorm(), jk2 = jk.squaredNorm(), ki2 = ki.squaredNorm();
    if (ij2 >= jk2 && ij2 >= ki2) {
      place = {2, 0, 1};
      corner = at(points, k), q = ki, r = -jk, squared_sides = ki2 * jk2;
    } else if (jk2 >= ki2) {
      place = {0, 1, 2};
      corner = at(points, i), q = ij, r = -ki, squared_sides = ij2 * ki2;
    } else {
      place = {1, 2, 0};
      corner = at(points, j), q = jk, r = -ij, squared_sides = jk2 * ij2;
    }
    normal = q.cross(r);
    squared_normal = normal.squaredNorm();
  }

  bool has_sine_above(S sine) const { return squared_normal > sine * sine * squared_sides; }

  std::array<int, 3> place;  // of corner, q and r among i, j and k
  Vec3<S> corner, q, r;      // q and r are sides, from the corner
  Vec3<S> normal;            // q x r = (j - i) x (k - i)
  S squared_sides;           // product of both squared lengths
  S squared_normal;
};

/// False unless the foot of the perpendicular lies inside.
template <class S>
bool on_triangle(const Triangle<S>& triangle, int i, int j, int k, S scale,
                 NearestOnSimplex<S>& result) {
  if (!triangle.has_sine_above(kParallelSine<S>)) return false;
  const Vec3<S>&q = triangle.q, &r = triangle.r, &normal = triangle.normal;
  S weight_q = 0, weight_r = 0;
  Vec3<S> foot = triangle.corner;
  const auto correct = [&] {
    weight_q += r.cross(foot).dot(normal) / triangle.squared_normal;
    weight_r += foot.cross(q).dot(normal) / triangle.squared_normal;
    foot = triangle.corner + weight_q * q + weight_r * r;
  };
  correct();
  // A flat triangle multiplies the rounding of the foot; the second time its error starts small.
  if (!triangle.has_sine_above(kNoisySine<S>)) correct();
  const S weight_corner = S(1) - weight_q - weight_r;
  if (!(weight_q > S(0) && weight_r > S(0) && weight_corner > S(0))) return false;

  result.weights[triangle.place[0]] = weight_corner;
  result.weights[triangle.place[1]] = weight_q;
  result.weights[triangle.place[2]] = weight_r;
  result.count = 3;
  result.kept[0] = i, result.kept[1] = j, result.kept[2] = k;
  result.point = foot;
  result.squared_distance = foot.squaredNorm();
  // The foot's direction is off by a rounding of `scale` over its length, the normal's by one over
  // the sine of the corner: compare both squared.
  const bool normal_is_better =
      triangle.squared_normal * scale * scale > result.squared_distance * triangle.squared_sides;
  result.direction = foot;
  if (normal_is_better) {
    const bool faces_origin = normal.dot(triangle.corner) < S(0);
    result.direction = faces_origin ? Vec3<S>(-normal) : normal;
  }
  return true;
}

/// Keeps the nearest of the faces of a simplex that it is shown, from triangles down to vertices. A
/// lesser face must be nearer by more than rounding: where the weights of a triangle are all
/// positive, that says more about the foot than a length can, to which it is second order.
template <class S>
class Nearest {
 public:
  /// The best is kept in `best`.
  Nearest(const Points<S>& points, S scale, NearestOnSimplex<S>& best)
      : points_(points), scale_(scale), best_(best) {
    best_.count = 0;
    best_.squared_distance = std::numeric_limits<S>::infinity();
  }

  /// True when the foot is inside of a triangle whose shape leaves no doubt of that.
  bool offer(const Triangle<S>& triangle, int i, int j, int k) {
    NearestOnSimplex<S> found;
    if (!on_triangle(triangle, i, j, k, scale_, found)) return false;
    keep_nearer(found);
    return triangle.has_sine_above(kNoisySine<S>);
  }
  void offer_edge(int i, int j) {
    NearestOnSimplex<S> found;
    if (on_edge(points_, i, j, found)) keep_nearer(found);
  }
  void offer_vertex(int i) {
    NearestOnSimplex<S> found;
    on_vertex(points_, i, found);
    keep_nearer(found);
  }

 private:
  void keep_nearer(const NearestOnSimplex<S>& found) {
    if (!(found.squared_distance < best_.squared_distance)) return;
    if (best_.count > found.count) {
      const S nearer = std::sqrt(best_.squared_distance) - std::sqrt(found.squared_distance);
      if (nearer <= tie_tolerance(scale_)) return;
    }
    best_ = found;
  }

  const Points<S>& points_;
  S scale_;
  NearestOnSimplex<S>& best_;
};

/// On which side of a triangle of the tetrahedron the origin lies.
enum class Side {
  Inner,  // that of the opposite point, by more than rounding; or the other side, as surely
  Outer,
  Unsure  // origin or opposite point within rounding of the plane
};

/// `origin_height` is the origin's distance times the length of the normal.
template <class S>
Side side_of_origin(const Triangle<S>& triangle, const Vec3<S>& opposite, S scale,
                    S& origin_height) {
  origin_height = -triangle.normal.dot(triangle.corner);
  const S height = triangle.normal.dot(opposite - triangle.corner);
  const S least = tie_tolerance(scale) * tie_tolerance(scale) * triangle.squared_normal;
  if (origin_height * origin_height <= least || height * height <= least) return Side::Unsure;
  return (origin_height > S(0)) == (height > S(0)) ? Side::Inner : Side::Outer;
}

template <class S>
void on_tetrahedron(const Points<S>& points, S scale, NearestOnSimplex<S>& result) {
  constexpr int kTriangles[3][4] = {{0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};  // and opposite
  Nearest<S> nearest(points, scale, result);
  S volumes[4];
  bool is_inside = true;
  for (const auto& [i, j, k, opposite] : kTriangles) {
    const Triangle<S> triangle(points, i, j, k);
    const Side side = side_of_origin(triangle, at(points, opposite), scale, volumes[opposite]);
    if (side == Side::Inner) continue;
    is_inside = false;
    const bool is_clear = nearest.offer(triangle, i, j, k);
    if (is_clear && side == Side::Outer) return;  // its plane keeps all the rest farther away
  }
  if (is_inside) {
    const Triangle<S> first(points, 0, 1, 2);
    is_inside = side_of_origin(first, at(points, 3), scale, volumes[3]) == Side::Inner;
  }
  if (is_inside) {
    const S sum = (std::abs(volumes[0]) + std::abs(volumes[1])) +
                  (std::abs(volumes[2]) + std::abs(volumes[3]));
    result.count = 4;
    for (std::size_t i = 0; i < 4; ++i) {
      result.kept[i] = static_cast<int>(i);
      result.weights[i] = std::abs(volumes[i]) / sum;
    }
    result.point = result.direction = Vec3<S>::Zero();
    result.squared_distance = S(0);
    return;
  }
  nearest.offer_edge(0, 3);
  nearest.offer_edge(1, 3);
  nearest.offer_edge(2, 3);
  nearest.offer_vertex(3);
}

}  // namespace

/// A deviation from the signed volumes of Montanari, Petrinic and Barbieri, "Improving the GJK
/// Algorithm for Faster and More Reliable Distance Queries Between Convex Objects", 2017, and from
/// the Voronoi regions of Ericson 2005, section 9.5.2: both walk a tree of sign tests down to one
/// face, and one sign that rounding got wrong on a flat simplex leads to a face far off. We measure
/// every face that may carry the nearest point and take the nearest. Each is a true point of the
/// simplex whatever the rounding, so a wrong sign can only lose what a rounding is worth.
///
/// Steps: 1. is the origin inside? 2. for each triangle, edge and vertex with the last point, the
/// foot of the perpendicular, if inside; 3. of those the nearest, see Nearest.
template <class S>
void nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale,
                        NearestOnSimplex<S>& result) {
  if (count == 1) return on_vertex(points, 0, result);
  if (count == 4) return on_tetrahedron(points, scale, result);
  Nearest<S> nearest(points, scale, result);
  if (count == 3) {
    if (nearest.offer(Triangle<S>(points, 0, 1, 2), 0, 1, 2)) return;
    nearest.offer_edge(0, 2);
    nearest.offer_edge(1, 2);
    nearest.offer_vertex(2);
  } else {
    nearest.offer_edge(0, 1);
    nearest.offer_vertex(1);
  }
}

template void nearest_on_simplex(const std::array<Vec3<float>, 4>&, int, float,
                                 NearestOnSimplex<float>&);
template void nearest_on_simplex(const std::array<Vec3<double>, 4>&, int, double,
                                 NearestOnSimplex<double>&);

}  // namespace contactscope
