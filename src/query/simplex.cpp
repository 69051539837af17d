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
NearestOnSimplex<S> on_vertex(const Points<S>& points, int i) {
  const Vec3<S>& p = points[static_cast<std::size_t>(i)];
  return {1, {i}, {S(1)}, p, p.squaredNorm(), p};
}

/// False unless the foot of the perpendicular lies between both ends.
template <class S>
bool on_edge(const Points<S>& points, int i, int j, NearestOnSimplex<S>& result) {
  const Vec3<S>& p = points[static_cast<std::size_t>(i)];
  const Vec3<S>& q = points[static_cast<std::size_t>(j)];
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
  result.kept = {i, j};
  result.weights = {weight_p, weight_q};
  result.squared_distance = result.point.squaredNorm();
  result.direction = result.point;
  return true;
}

/// A triangle seen from the corner at which its two shorter sides meet. There the cross product of
/// two sides is relatively exact even for a needle, whose sides from elsewhere are nearly parallel.
template <class S>
struct Triangle {
  Triangle(const Points<S>& points, int i, int j, int k) {
    const auto at = [&](int n) -> const Vec3<S>& { return points[static_cast<std::size_t>(n)]; };
    const Vec3<S> ij = at(j) - at(i);
    const Vec3<S> jk = at(k) - at(j);
    const Vec3<S> ki = at(i) - at(k);
    const S ij2 = ij.squaredNorm(), jk2 = jk.squaredNorm(), ki2 = ki.squaredNorm();
    if (ij2 >= jk2 && ij2 >= ki2) {
      place = {2, 0, 1};
      corner = at(k), q = ki, r = -jk, squared_sides = ki2 * jk2;
    } else if (jk2 >= ki2) {
      place = {0, 1, 2};
      corner = at(i), q = ij, r = -ki, squared_sides = ij2 * ki2;
    } else {
      place = {1, 2, 0};
      corner = at(j), q = jk, r = -ij, squared_sides = jk2 * ij2;
    }
    normal = q.cross(r);
    squared_normal = normal.squaredNorm();
  }

  bool is_degenerate() const {
    return !(squared_normal > kParallelSine<S> * kParallelSine<S> * squared_sides);
  }

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
  if (triangle.is_degenerate()) return false;
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
  if (triangle.squared_normal < kNoisySine<S> * kNoisySine<S> * triangle.squared_sides) correct();
  const S weight_corner = S(1) - weight_q - weight_r;
  if (!(weight_q > S(0) && weight_r > S(0) && weight_corner > S(0))) return false;

  const S weights[] = {weight_corner, weight_q, weight_r};
  for (std::size_t n = 0; n < 3; ++n) {
    result.weights[static_cast<std::size_t>(triangle.place[n])] = weights[n];
  }
  result.count = 3;
  result.kept = {i, j, k};
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
  Nearest(const Points<S>& points, S scale) : points_(points), scale_(scale) {
    best_.count = 0;
    best_.squared_distance = std::numeric_limits<S>::infinity();
  }

  const NearestOnSimplex<S>& best() const { return best_; }

  void offer_triangle(const Triangle<S>& triangle, int i, int j, int k) {
    NearestOnSimplex<S> found;
    if (on_triangle(triangle, i, j, k, scale_, found)) offer(found);
  }
  void offer_triangle(int i, int j, int k) {
    offer_triangle(Triangle<S>(points_, i, j, k), i, j, k);
  }
  void offer_edge(int i, int j) {
    NearestOnSimplex<S> found;
    if (on_edge(points_, i, j, found)) offer(found);
  }
  void offer_vertex(int i) { offer(on_vertex(points_, i)); }

 private:
  void offer(const NearestOnSimplex<S>& found) {
    if (!(found.squared_distance < best_.squared_distance)) return;
    if (best_.count > found.count) {
      const S nearer = std::sqrt(best_.squared_distance) - std::sqrt(found.squared_distance);
      if (nearer <= tie_tolerance(scale_)) return;
    }
    best_ = found;
  }

  const Points<S>& points_;
  S scale_;
  NearestOnSimplex<S> best_;
};

/// Barycentric weights from the volumes that the origin makes with each triangle. False when the
/// origin is outside of one, or so near to it that rounding decides.
template <class S>
bool origin_inside(const Points<S>& points, const Triangle<S> (&opposite)[4], S scale,
                   NearestOnSimplex<S>& result) {
  S volumes[4];
  for (std::size_t n = 0; n < 4; ++n) {
    const Triangle<S>& triangle = opposite[n];
    const S origin_height = -triangle.normal.dot(triangle.corner);  // all times |normal|
    const S height = triangle.normal.dot(points[n] - triangle.corner);
    const S least = tie_tolerance(scale) * std::sqrt(triangle.squared_normal);
    const bool same_side = height > S(0) ? origin_height > least : origin_height < -least;
    if (!same_side || std::abs(height) <= least) return false;
    volumes[n] = std::abs(origin_height);
  }
  const S sum = (volumes[0] + volumes[1]) + (volumes[2] + volumes[3]);
  result = {4,
            {0, 1, 2, 3},
            {volumes[0] / sum, volumes[1] / sum, volumes[2] / sum, volumes[3] / sum},
            Vec3<S>::Zero(),
            S(0),
            Vec3<S>::Zero()};
  return true;
}

template <class S>
NearestOnSimplex<S> on_tetrahedron(const Points<S>& points, S scale) {
  const Triangle<S> opposite[4] = {Triangle<S>(points, 1, 2, 3), Triangle<S>(points, 0, 2, 3),
                                   Triangle<S>(points, 0, 1, 3), Triangle<S>(points, 0, 1, 2)};
  NearestOnSimplex<S> inside;
  if (origin_inside(points, opposite, scale, inside)) return inside;
  Nearest<S> nearest(points, scale);
  nearest.offer_triangle(opposite[0], 1, 2, 3);
  nearest.offer_triangle(opposite[1], 0, 2, 3);
  nearest.offer_triangle(opposite[2], 0, 1, 3);
  nearest.offer_edge(0, 3);
  nearest.offer_edge(1, 3);
  nearest.offer_edge(2, 3);
  nearest.offer_vertex(3);
  return nearest.best();
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
NearestOnSimplex<S> nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale) {
  if (count == 1) return on_vertex(points, 0);
  if (count == 4) return on_tetrahedron(points, scale);
  Nearest<S> nearest(points, scale);
  if (count == 3) {
    nearest.offer_triangle(0, 1, 2);
    nearest.offer_edge(0, 2);
    nearest.offer_edge(1, 2);
    nearest.offer_vertex(2);
  } else {
    nearest.offer_edge(0, 1);
    nearest.offer_vertex(1);
  }
  return nearest.best();
}

template NearestOnSimplex<float> nearest_on_simplex(const std::array<Vec3<float>, 4>&, int, float);
template NearestOnSimplex<double> nearest_on_simplex(const std::array<Vec3<double>, 4>&, int,
                                                     double);

}  // namespace contactscope
