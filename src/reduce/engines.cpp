#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reduce/convex_corners.h"
#include "reduce/grow.h"

namespace contactscope {
namespace {

template <class S>
constexpr S kHandicap = S(0.95);

/// Two points, the largest triangle with them, the most area outside it; one where the two are one.
template <class S>
KeptIndices grow_to_four(ContactPoints<S> points, const Vec3<S>& normal, int first, int second,
                         S handicap, const ReduceOptions& options) {
  KeptIndices kept;
  kept.push_back(first);
  if (second == first) return kept;
  kept.push_back(second);
  steps::grow<steps::Added::Area>(points, normal, 4, kept, handicap);
  return steps::first_of(kept, options);
}

/// As Box3D reduces the manifold of two hulls. Steps: the point with
/// the largest sum of depth and way along a fixed direction in the plane; the farthest from it; the
/// largest triangle; the most area outside. A later point must beat an earlier one by 5%, so that
/// near ties do not flicker. Four points at most. Deviations: the way is measured from the centre
/// of the points, because a reducer knows no bodies; no point is left out for being too far apart.
template <class S>
KeptIndices reduce_like_box3d(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const Vec3<S> direction = any_perpendicular(normal);
  const Vec3<S> middle = steps::centre(points);
  const int first = steps::highest(
      points, -std::numeric_limits<S>::infinity(),
      [&](int i) {
        return direction.dot(Vec3<S>(steps::position(points, i) - middle)) -
               at(points, i).separation;
      },
      kHandicap<S>);
  const int second = steps::farthest_from(points, first, kHandicap<S>);
  return grow_to_four(points, normal, first, second, kHandicap<S>, options);
}

/// As Box3D reduces a cluster of contacts with a mesh. Steps: the
/// farthest pair; the largest triangle; the most area outside. Four points at most. Deviation:
/// depth does not decide between near ties, because Box3D's tolerances for that are lengths.
template <class S>
KeptIndices reduce_like_box3d_mesh(ContactPoints<S> points, const Vec3<S>& normal,
                                   const ReduceOptions& options) {
  const auto [a, b] = steps::farthest_two<S>(count_of(points), [&](int i, int k) {
    return (steps::position(points, k) - steps::position(points, i)).squaredNorm();
  });
  return grow_to_four(points, normal, a, b, S(1), options);
}

/// As Jolt prunes contact points. Steps: the point with the largest
/// distance from the centre times depth; the point with the largest distance from that one times
/// depth; the farthest on either side of the line through both. Neither factor counts as less than
/// a floor. Four points at most. Deviations: the centre is that of the points, because a reducer
/// knows no bodies; factors are not squared, which chooses the same and does not underflow; the
/// floor, 1 mm in Jolt, is a thousandth of the patch.
template <class S>
KeptIndices reduce_like_jolt(ContactPoints<S> points, const Vec3<S>& normal,
                             const ReduceOptions& options) {
  const Vec3<S> middle = steps::centre(points);
  const auto reach = [&](const Vec3<S>& from, int i) {
    const Vec3<S> offset = steps::position(points, i) - from;
    return Vec3<S>(offset - normal.dot(offset) * normal).norm();
  };
  S patch = S(0);
  for (int i = 0; i < count_of(points); ++i) patch = std::max(patch, reach(middle, i));
  const S floor = S(0.001) * patch;
  const auto farthest_and_deep = [&](const Vec3<S>& from) {
    return steps::highest(points, -std::numeric_limits<S>::infinity(), [&](int i) {
      const S depth = -at(points, i).separation;
      return std::max(floor, reach(from, i)) * std::max(floor, depth);
    });
  };
  const int first = farthest_and_deep(middle);
  const int second = farthest_and_deep(steps::position(points, first));
  return steps::two_and_both_sides(points, normal, first, second, options);
}

constexpr int kPlaces = 4;

/// Four times the squared area of the quadrilateral a b c d in any order: whichever two of its
/// segments cross span the most.
template <class S>
S squared_area(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, const Vec3<S>& d) {
  return std::max({(a - b).cross(c - d).squaredNorm(), (a - c).cross(b - d).squaredNorm(),
                   (a - d).cross(b - c).squaredNorm()});
}

/// As Bullet's persistent manifold takes points one by one. Steps: the
/// first four points take the four places; every further one looks which of the five is the
/// deepest, and takes the place, other than that one's, which leaves the largest quadrilateral. The
/// arriving point is never turned away, so that area gets lost, the more the more points there are.
/// The deepest is always kept; the rest depends on the order of the points. Four points at most.
/// Deviations: areas of all three pairings of diagonals, the more careful of Bullet's two ways;
/// where no place gives an area, the first that is free to go is taken.
template <class S>
KeptIndices reduce_like_bullet(ContactPoints<S> points, const Vec3<S>& /*normal*/,
                               const ReduceOptions& options) {
  const auto separation = [&](int i) { return at(points, i).separation; };
  std::array<int, kPlaces> places = {0, 1, 2, 3};
  const int all = count_of(points);
  for (int arriving = kPlaces; arriving < all; ++arriving) {
    int deepest = kPlaces;  // the arriving point
    S least = separation(arriving);
    for (int k = 0; k < kPlaces; ++k) {
      if (separation(at(places, k)) < least) {
        least = separation(at(places, k));
        deepest = k;
      }
    }
    const int best = steps::highest(kPlaces, S(-1), [&](int k) {
      if (k == deepest) return S(-1);
      const auto other = [&](int turn) -> const Vec3<S>& {
        return steps::position(points, at(places, (k + turn) % kPlaces));
      };
      return squared_area(steps::position(points, arriving), other(1), other(2), other(3));
    });
    if (best >= 0) at(places, best) = arriving;  // no area is a number where float overflows
  }

  const std::span<const int> held(places.data(), std::min<std::size_t>(points.size(), kPlaces));
  KeptIndices choices;
  choices.push_back(*std::ranges::min_element(held, {}, separation));
  for (const int place : held) steps::add_once(choices, place);
  return steps::first_of(choices, options);
}

/// Of the area of the points' convex hull; of the corners when that has none.
template <class S>
Vec3<S> centroid(ContactPoints<S> points, const Vec3<S>& normal) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  const steps::Corners<S> hull = steps::convex_corners(points, u, v);
  const steps::Vec2<S> origin = hull[0].place;
  steps::Vec2<S> mean = steps::Vec2<S>::Zero();
  steps::Vec2<S> moment = steps::Vec2<S>::Zero();
  S area = S(0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const steps::Vec2<S> a = hull[i].place - origin;
    const steps::Vec2<S> b = hull[(i + 1) % hull.size()].place - origin;
    const S triangle = steps::cross(a, b);
    mean += a;
    moment += triangle * (a + b);
    area += triangle;
  }
  const steps::Vec2<S> found =
      origin + (area > S(0) ? steps::Vec2<S>(moment / (S(3) * area))
                            : steps::Vec2<S>(mean / static_cast<S>(hull.size())));
  return steps::position(points, 0) + found.x() * u + found.y() * v;
}

/// As ODE culls the contacts of two boxes. Steps: angles of all points
/// around the centroid of the area, from the deepest one; the deepest, which is therefore always
/// kept; for 90, 180 and 270 degrees the point not yet taken whose angle is nearest. Four points.
/// Deviation: the area is that of the convex hull, so that the order in which the points come does
/// not matter.
template <class S>
KeptIndices reduce_like_ode(ContactPoints<S> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  constexpr S kTurn = S(2) * std::numbers::pi_v<S>;
  const int deepest = steps::deepest_point(points);
  const Vec3<S> middle = centroid(points, normal);
  const Vec3<S> u = steps::position(points, deepest) - middle;
  const Vec3<S> v = normal.cross(u);
  const auto angle = [&](int i) {
    const Vec3<S> offset = steps::position(points, i) - middle;
    const S turned = std::atan2(v.dot(offset), u.dot(offset));
    return turned < S(0) ? turned + kTurn : turned;
  };
  StaticVector<S, kMaxManifoldPoints> angles;
  for (int i = 0; i < count_of(points); ++i) angles.push_back(angle(i));

  KeptIndices choices;
  choices.push_back(deepest);
  for (int quarter = 1; quarter < 4; ++quarter) {
    const S wanted = S(quarter) * (kTurn / S(4));
    const int nearest = steps::highest(points, -std::numeric_limits<S>::infinity(), [&](int i) {
      if (steps::contains(choices, i)) return -std::numeric_limits<S>::infinity();
      const S apart = std::abs(wanted - at(angles, i));
      return -std::min(apart, kTurn - apart);
    });
    steps::add_once(choices, nearest);
  }
  return steps::first_of(choices, options);
}

/// As PhysX reduces a batch of contacts. Steps: the deepest point,
/// which is therefore always kept; the farthest from it; the farthest on either side of the line
/// through both. Four points at most. Deviation: where a side is empty three points come back.
template <class S>
KeptIndices reduce_like_physx(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const int first = steps::deepest_point(points);
  const int second = steps::farthest_from(points, first);
  return steps::two_and_both_sides(points, normal, first, second, options);
}

/// As PhysX reduces contacts by clusters. Steps: the point farthest
/// from the centre, the farthest from it, and the farthest on either side of the line through both;
/// every point joins the nearest of these; the deepest of each cluster is kept, so that the deepest
/// of all always is, first. Four points at most. Deviations: the centre is that of the points,
/// because a reducer knows no frame of a shape; where a side is empty three points come back; the
/// clusters are listed by depth.
template <class S>
KeptIndices reduce_like_physx_cluster(ContactPoints<S> points, const Vec3<S>& normal,
                                      const ReduceOptions& options) {
  const Vec3<S> middle = steps::centre(points);
  const auto separation = [&](int i) { return at(points, i).separation; };
  const auto apart = [&](int i, const Vec3<S>& from) {
    return (steps::position(points, i) - from).squaredNorm();
  };
  const int first =
      std::max(0, steps::highest(points, S(0), [&](int i) { return apart(i, middle); }));
  const int second = steps::farthest_from(points, first);
  KeptIndices centres;
  centres.push_back(first);
  steps::add_once(centres, second);
  for (const int side : steps::both_sides(points, normal, first, second)) {
    steps::add_once(centres, side);
  }

  KeptIndices deepest = centres;
  for (int i = 0; i < count_of(points); ++i) {
    const auto from_centre = [&](int centre) { return apart(i, steps::position(points, centre)); };
    const auto nearest = std::ranges::min_element(centres, {}, from_centre) - centres.begin();
    int& deepest_there = deepest.begin()[nearest];
    if (separation(i) < separation(deepest_there)) deepest_there = i;
  }
  std::ranges::stable_sort(deepest, {}, separation);
  return steps::first_of(deepest, options);
}

/// Shamos 1978, "Computational Geometry": the farthest pair is antipodal. As the edge from corner i
/// turns, the corner farthest from it only moves on.
template <class S>
std::array<int, 2> diameter(const steps::Corners<S>& hull) {
  std::array<int, 2> best = {hull[0].index, hull[0].index};
  S most = S(0);
  const auto measure = [&](std::size_t i, std::size_t k) {
    const S length = (hull[i].place - hull[k].place).squaredNorm();
    if (length > most) {
      most = length;
      best = {hull[i].index, hull[k].index};
    }
  };
  const auto after = [&](std::size_t i) { return i + 1 < hull.size() ? i + 1 : 0; };
  std::size_t k = after(0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const steps::Vec2<S> edge = hull[after(i)].place - hull[i].place;
    measure(i, k);
    // Never past corner i, should rounding hold a turn for none.
    while (after(k) != i &&
           steps::cross(edge, steps::Vec2<S>(hull[after(k)].place - hull[k].place)) > S(0)) {
      k = after(k);
      measure(i, k);
    }
    measure(after(i), k);
  }
  return best;
}

/// As Newton prunes contacts. Steps: the convex hull of the points in
/// the plane; its diameter by rotating calipers; the farthest points on either side of it. Four
/// points at most. Deviation: where a side is empty three points come back.
template <class S>
KeptIndices reduce_like_newton(ContactPoints<S> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  const Vec3<S> u = any_perpendicular(normal);
  const auto [a, b] = diameter(steps::convex_corners(points, u, Vec3<S>(normal.cross(u))));
  return steps::two_and_both_sides(points, normal, a, b, options);
}

/// As MJX reduces a clip polygon. Steps: the first point given; the
/// farthest from it; the farthest from the line through both, on either side; the farthest from the
/// other two edges of that triangle, on either side of them, by area. A corner of the triangle may
/// win, which wastes the fourth choice: three points are left. Four points at most. Deviation: that
/// corner is not reported twice.
template <class S>
KeptIndices reduce_like_mjx(ContactPoints<S> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  const int a = 0;
  const int b = steps::farthest_from(points, a);
  const auto area = [&](int q, int from, int to) {
    return std::abs(steps::doubled_area(steps::position(points, q), steps::position(points, from),
                                        steps::position(points, to), normal));
  };
  KeptIndices choices;
  choices.push_back(a);
  steps::add_once(choices, b);
  const int c = steps::highest(points, steps::negligible_area(points, a, b),
                               [&](int q) { return area(q, a, b); });
  if (c >= 0) {
    choices.push_back(c);
    steps::add_once(choices, steps::highest(points, S(0), [&](int q) {
                      return std::max(area(q, b, c), area(q, a, c));
                    }));
  }
  return steps::first_of(choices, options);
}

}  // namespace

/// How engines reduce, each written from a description.
std::vector<ReducerInfo> engine_reducers() {
  return {{"box3d", "far and deep, farthest, largest triangle, most area, near ties to the earlier",
           &reduce_like_box3d<float>, &reduce_like_box3d<double>},
          {"box3d_mesh", "the farthest pair, largest triangle, most area",
           &reduce_like_box3d_mesh<float>, &reduce_like_box3d_mesh<double>},
          {"jolt", "twice distance times depth, then both sides", &reduce_like_jolt<float>,
           &reduce_like_jolt<double>},
          {"bullet", "one by one, the deepest protected, largest area", &reduce_like_bullet<float>,
           &reduce_like_bullet<double>},
          {"ode", "the deepest, then every 90 degrees", &reduce_like_ode<float>,
           &reduce_like_ode<double>},
          {"physx", "the deepest, farthest, then both sides", &reduce_like_physx<float>,
           &reduce_like_physx<double>},
          {"physx_cluster", "the deepest of each of four clusters",
           &reduce_like_physx_cluster<float>, &reduce_like_physx_cluster<double>},
          {"newton", "the diameter, then both sides", &reduce_like_newton<float>,
           &reduce_like_newton<double>},
          {"mjx", "the first, farthest from it, from the line, from the edges",
           &reduce_like_mjx<float>, &reduce_like_mjx<double>}};
}

}  // namespace contactscope
