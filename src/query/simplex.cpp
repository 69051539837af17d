#include "query/gjk.h"

#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S> using Points = std::array<Vec3<S>, 4>;

template <class S> void on_vertex(const Points<S>& points, int i, NearestOnSimplex<S>& result) {
  result.count = 1;
  result.kept[0] = i;
  result.weights[0] = S(1);
  result.point = result.direction = at(points, i);
  result.squared_distance = result.point.squaredNorm();
}

/// Returns false unless the foot of the perpendicular lies between both ends.
template <class S>
bool on_edge(const Points<S>& points, int i, int j, NearestOnSimplex<S>& result) {
  const Vec3<S>&p = at(points, i), &q = at(points, j);
  const Vec3<S> along = q - p;
  const S from_p = -p.dot(along);
  const S from_q = q.dot(along);
  if (!(from_p > S(0) && from_q > S(0))) return false;
  const S squared_length = from_p + from_q;
  S weight_q = from_p / squared_length;
  S weight_p = from_q / squared_length;
  // From the nearer end, which is exact if the foot moves there.
  const Vec3<S> foot =
      weight_q < weight_p ? Vec3<S>(p + weight_q * along) : Vec3<S>(q - weight_p * along);
  // The foot is off along the edge by a rounding of its end's coordinates. Near the origin that
  // would tilt the direction a lot, and a long edge would hide points beyond its other end.
  const S correction = foot.dot(along) / squared_length;
  weight_q -= correction;
  weight_p += correction;
  result.point = foot - correction * along;
  result.count = 2;
  result.kept[0] = i, result.kept[1] = j;
  result.weights[0] = weight_p, result.weights[1] = weight_q;
  result.squared_distance = result.point.squaredNorm();
  result.direction = result.point;
  return weight_p > S(0) && weight_q > S(0);
}

/// A triangle relative to one of its corners.
template <class S> struct Triangle {
  /// Starts at k, unless the triangle is a needle there.
  Triangle(const Points<S>& points, int i, int j, int k) {
    see_from(points, k, i, j, {2, 0, 1});
    if (!has_sine_above(kNoisySine<S>)) see_from_widest(points, i, j, k);
  }

  void see_from(const Points<S>& points, int from, int to_q, int to_r,
                const std::array<std::size_t, 3>& places) {
    place = places;
    corner = at(points, from);
    q = at(points, to_q) - corner;
    r = at(points, to_r) - corner;
    normal = q.cross(r);
    squared_normal = normal.squaredNorm();
    squared_sides = q.squaredNorm() * r.squaredNorm();
  }
  /// Uses the corner with the largest of three measures.
  void see_from_largest(const Points<S>& points, int i, int j, int k, S at_i, S at_j, S at_k) {
    if (at_k >= at_i && at_k >= at_j) {
      see_from(points, k, i, j, {2, 0, 1});
    } else if (at_i >= at_j) {
      see_from(points, i, j, k, {0, 1, 2});
    } else {
      see_from(points, j, k, i, {1, 2, 0});
    }
  }
  /// Uses the corner between the two shorter sides. Its cross product is relatively exact even for
  /// a needle, whose sides are nearly parallel elsewhere.
  void see_from_widest(const Points<S>& points, int i, int j, int k) {
    see_from_largest(points, i, j, k, (at(points, k) - at(points, j)).squaredNorm(),
                     (at(points, i) - at(points, k)).squaredNorm(),
                     (at(points, j) - at(points, i)).squaredNorm());
  }
  void see_from_nearest(const Points<S>& points, int i, int j, int k) {
    see_from_largest(points, i, j, k, -at(points, i).squaredNorm(), -at(points, j).squaredNorm(),
                     -at(points, k).squaredNorm());
  }

  bool has_sine_above(S sine) const { return squared_normal > sine * sine * squared_sides; }

  std::array<std::size_t, 3> place;  // index of corner, q and r among i, j and k
  Vec3<S> corner, q, r;              // q and r are sides, relative to the corner
  Vec3<S> normal;                    // q x r, the same at every corner but for rounding
  S squared_sides;                   // product of both squared lengths
  S squared_normal;
};

/// Foot of the perpendicular from the origin, inside or outside the triangle.
template <class S> struct Foot {
  explicit Foot(const Triangle<S>& triangle) : point(triangle.corner) {
    correct(triangle);
    // A flat triangle amplifies the rounding; the second pass starts with a small error.
    if (!triangle.has_sine_above(kNoisySine<S>)) correct(triangle);
    weight_corner = S(1) - weight_q - weight_r;
  }

  void correct(const Triangle<S>& triangle) {
    weight_q += triangle.r.cross(point).dot(triangle.normal) / triangle.squared_normal;
    weight_r += point.cross(triangle.q).dot(triangle.normal) / triangle.squared_normal;
    point = triangle.corner + weight_q * triangle.q + weight_r * triangle.r;
  }
  S least_weight() const { return std::min(std::min(weight_q, weight_r), weight_corner); }

  Vec3<S> point;
  S weight_q = 0, weight_r = 0, weight_corner;
};

/// Smaller weights are computed again from the corner closest to the origin, where the others are
/// exact relative to its distance. Any fraction well above rounding works.
template <class S> constexpr S kDoubtfulWeight = S(1) / S(32);

/// Returns false unless the foot of the perpendicular lies inside.
template <class S>
bool on_triangle(const Points<S>& points, Triangle<S>& triangle, int i, int j, int k, S scale,
                 NearestOnSimplex<S>& result) {
  if (!triangle.has_sine_above(kParallelSine<S>)) return false;
  Foot<S> foot(triangle);
  if (foot.least_weight() < -kDoubtfulWeight<S>) return false;
  if (foot.least_weight() < kDoubtfulWeight<S> && triangle.has_sine_above(kNoisySine<S>)) {
    Triangle<S> nearest = triangle;
    nearest.see_from_nearest(points, i, j, k);
    if (nearest.has_sine_above(kNoisySine<S>)) {
      triangle = nearest;
      foot = Foot<S>(triangle);
    }
  }
  if (!(foot.least_weight() > S(0))) return false;

  result.weights[triangle.place[0]] = foot.weight_corner;
  result.weights[triangle.place[1]] = foot.weight_q;
  result.weights[triangle.place[2]] = foot.weight_r;
  result.count = 3;
  result.kept[0] = i, result.kept[1] = j, result.kept[2] = k;
  result.point = result.direction = foot.point;
  result.squared_distance = foot.point.squaredNorm();
  // The foot's direction is off by a rounding of `scale` over its length, the normal's by one over
  // the sine of the corner: compare both squared.
  const bool normal_is_better =
      triangle.squared_normal * scale * scale > result.squared_distance * triangle.squared_sides;
  if (normal_is_better) {
    const bool faces_origin = triangle.normal.dot(triangle.corner) < S(0);
    result.direction = faces_origin ? Vec3<S>(-triangle.normal) : triangle.normal;
  }
  return true;
}

/// Keeps the nearest of the offered faces of a simplex, from triangles down to vertices. A lower
/// face must be nearer by more than rounding: if the weights of a triangle are all positive, this
/// locates the foot better than a length, which is second order in it.
template <class S> class Nearest {
 public:
  /// Stores the nearest face in `best`.
  Nearest(const Points<S>& points, S scale, NearestOnSimplex<S>& best)
      : points_(points), scale_(scale), best_(best) {
    best_.count = 0;
    best_.squared_distance = std::numeric_limits<S>::infinity();
  }

  /// True if the foot is inside a triangle whose shape makes this certain.
  bool offer(Triangle<S>& triangle, int i, int j, int k) {
    NearestOnSimplex<S> found;
    if (!on_triangle(points_, triangle, i, j, k, scale_, found)) return false;
    keep_nearer(found);
    return triangle.has_sine_above(kNoisySine<S>);
  }
  /// Offers the edges that end in the last point, and that point.
  void offer_edges_and_vertex(int last) {
    NearestOnSimplex<S> found;
    for (int i = 0; i < last; ++i)
      if (on_edge(points_, i, last, found)) keep_nearer(found);
    on_vertex(points_, last, found);
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

/// Side of a triangle of the tetrahedron on which the origin lies.
enum class Side {
  Inner,  // on the side of the opposite point by more than rounding; Outer: on the other side
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
    Triangle<S> triangle(points, i, j, k);
    const Side side = side_of_origin(triangle, at(points, opposite), scale, volumes[opposite]);
    if (side == Side::Inner) continue;
    is_inside = false;
    const bool is_clear = nearest.offer(triangle, i, j, k);
    if (is_clear && side == Side::Outer) return;  // all other faces are farther, behind its plane
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
  nearest.offer_edges_and_vertex(3);
}

}  // namespace

/// Deviates from the signed volumes of Montanari, Petrinic and Barbieri, "Improving the GJK
/// Algorithm for Faster and More Reliable Distance Queries Between Convex Objects", 2017, and from
/// the Voronoi regions of Ericson 2005, section 9.5.2. Both descend a tree of sign tests to one
/// face, and one sign that is wrong by rounding on a flat simplex leads to a distant face. We
/// measure every face that may carry the closest point and take the nearest. Each result is a true
/// point of the simplex, so a wrong sign costs no more than a rounding.
///
/// Steps: 1. test if the origin is inside; 2. for each triangle, edge and vertex with the last
/// point, find the foot of the perpendicular, if inside; 3. take the nearest of those, see Nearest.
template <class S>
void nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale,
                        NearestOnSimplex<S>& result) {
  if (count == 1) return on_vertex(points, 0, result);
  if (count == 4) return on_tetrahedron(points, scale, result);
  Nearest<S> nearest(points, scale, result);
  if (count == 3) {
    Triangle<S> triangle(points, 0, 1, 2);
    if (nearest.offer(triangle, 0, 1, 2)) return;
  }
  nearest.offer_edges_and_vertex(count - 1);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(nearest_on_simplex);

}  // namespace contactscope
