#include "core/convex_polygon.h"
#include "reduce/grow.h"

namespace contactscope {
namespace {

template <class S> constexpr S kHandicap = S(0.95);

/// Two points, the largest triangle with them, the most area outside it; one if they coincide.
template <class S>
KeptIndices grow_to_four(const Candidates<S>& points, int first, int second, S handicap,
                         const ReduceOptions& options) {
  KeptIndices kept;
  kept.push_back(first);
  if (second == first) return kept;
  kept.push_back(second);
  steps::grow<steps::Added::Area>(points, kept, {.max_points = 4}, handicap);
  return steps::first_of(kept, options);
}

/// Like Box3D for the manifold of two hulls. Steps: the point with the largest sum of depth and
/// offset along a fixed direction in the plane; the farthest from it; the largest triangle; the
/// most area outside. A later point must beat an earlier one by 5%, so that near ties do not
/// flicker. At most four points. Deviations: the offset is from the centre of the points, because a
/// reducer has no bodies; no point is dropped for a large separation.
constexpr auto reduce_like_box3d = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  const Vec3<S> direction = any_perpendicular(points.normal);
  const Vec3<S> middle = points.centre();
  const auto far_and_deep = [&](int i) {
    return direction.dot(Vec3<S>(points[i] - middle)) - points.separation(i);
  };
  const int first = points.highest(far_and_deep, -std::numeric_limits<S>::infinity(), kHandicap<S>);
  const int second = points.farthest_from(first, kHandicap<S>);
  return grow_to_four(points, first, second, kHandicap<S>, options);
};

/// Like Box3D for a cluster of contacts with a mesh. Steps: the farthest pair; the largest
/// triangle; the most area outside. At most four points. Deviation: depth does not break near ties,
/// because Box3D's tolerances for that are lengths.
constexpr auto reduce_like_box3d_mesh = []<class S>(const Candidates<S>& points,
                                                    const ReduceOptions& options) {
  const auto [a, b] = steps::farthest_two<S>(
      points.count(), [&](int i, int k) { return (points[k] - points[i]).squaredNorm(); });
  return grow_to_four(points, a, b, S(1), options);
};

/// Like Jolt's pruning of contact points. Steps: the point of the largest distance times depth from
/// the centre; then from that one; the farthest on either side of the line through both. Both
/// factors have a lower bound. At most four points. Deviations: the centre is that of the points;
/// factors are not squared; the bound, 1 mm in Jolt, is a thousandth of the patch.
constexpr auto reduce_like_jolt = []<class S>(const Candidates<S>& points,
                                              const ReduceOptions& options) {
  const Vec3<S> middle = points.centre();
  const auto reach = [&](const Vec3<S>& from, int i) {
    const Vec3<S> offset = points[i] - from;
    return Vec3<S>(offset - points.normal.dot(offset) * points.normal).norm();
  };
  S patch = S(0);
  for (int i = 0; i < points.count(); ++i) patch = std::max(patch, reach(middle, i));
  const S floor = S(0.001) * patch;
  const auto farthest_and_deep = [&](const Vec3<S>& from) {
    return points.highest([&](int i) {
      return std::max(floor, reach(from, i)) * std::max(floor, -points.separation(i));
    });
  };
  const int first = farthest_and_deep(middle);
  return points.two_and_both_sides(first, farthest_and_deep(points[first]), options);
};

constexpr int kPlaces = 4;

/// Four times the squared area of the quadrilateral a b c d in any order of its corners.
template <class S>
S squared_area(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, const Vec3<S>& d) {
  return std::max({(a - b).cross(c - d).squaredNorm(), (a - c).cross(b - d).squaredNorm(),
                   (a - d).cross(b - c).squaredNorm()});
}

/// Like Bullet's persistent manifold, which takes points one by one. Steps: the first four points
/// fill the four places. For each further point, find the deepest of the five, then replace the
/// point, other than the deepest, whose removal leaves the largest quadrilateral. The arriving
/// point is never rejected, so area is lost, more with more points. The deepest is always kept; the
/// rest depends on the order of the points. At most four points. Deviations: areas of all three
/// pairings of diagonals, the more careful of Bullet's two methods; if no replacement gives an
/// area, the first replaceable point is replaced.
constexpr auto reduce_like_bullet = []<class S>(const Candidates<S>& points,
                                                const ReduceOptions& options) {
  const auto separation = [&](int i) { return points.separation(i); };
  std::array<int, kPlaces> places = {0, 1, 2, 3};
  for (int arriving = kPlaces; arriving < points.count(); ++arriving) {
    // -1: the arriving point is the deepest
    const int deepest = steps::highest(
        kPlaces, [&](int k) { return -separation(at(places, k)); }, -separation(arriving));
    const auto left_area = [&](int k) {
      if (k == deepest) return S(-1);
      const auto other = [&](int turn) { return points[at(places, (k + turn) % kPlaces)]; };
      return squared_area<S>(points[arriving], other(1), other(2), other(3));
    };
    const int best = steps::highest(kPlaces, left_area, S(-1));
    if (best >= 0) at(places, best) = arriving;  // areas are NaN if floats overflow
  }

  const std::span<const int> held(places.data(), std::min<std::size_t>(points.points.size(), 4));
  KeptIndices choices;
  choices.push_back(*std::ranges::min_element(held, {}, separation));
  for (const int place : held) steps::add_once(choices, place);
  return steps::first_of(choices, options);
};

template <class S> struct Corner {
  Vec2<S> place;
  int index = 0;
};

template <class S> using Corners = StaticVector<Corner<S>, 2 * kMaxManifoldPoints>;

/// The corners of the points' convex hull in their plane, counter-clockwise, none on edges.
template <class S>
Corners<S> convex_corners(const Candidates<S>& points, const PlaneFrame<S>& plane) {
  Corners<S> sorted;
  for (int i = 0; i < points.count(); ++i) sorted.push_back({plane.seen(points[i]), i});
  std::ranges::sort(sorted, {}, [](const Corner<S>& corner) {
    return std::tuple(corner.place.x(), corner.place.y(), corner.index);
  });
  return convex_chain(sorted, [](const Corner<S>& a, const Corner<S>& b, const Corner<S>& c) {
    return cross(b.place - a.place, c.place - b.place) > S(0);
  });
}

/// The centroid of the points' convex hull; the mean of its corners if the area is zero.
template <class S> Vec3<S> centroid(const Candidates<S>& points) {
  const PlaneFrame<S> plane(points[0], points.normal);
  const Corners<S> hull = convex_corners(points, plane);
  const Vec2<S> origin = hull[0].place;
  Vec2<S> mean = Vec2<S>::Zero();
  Vec2<S> moment = Vec2<S>::Zero();
  S area = S(0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2<S> a = hull[i].place - origin;
    const Vec2<S> b = hull[(i + 1) % hull.size()].place - origin;
    const S triangle = cross(a, b);
    mean += a;
    moment += triangle * (a + b);
    area += triangle;
  }
  return plane.place(origin + (area > S(0) ? Vec2<S>(moment / (S(3) * area))
                                           : Vec2<S>(mean / static_cast<S>(hull.size()))));
}

/// Like ODE's culling of the contacts of two boxes. Steps: angles of all points around the area's
/// centroid, relative to the deepest; the deepest, which is therefore always kept; for 90, 180 and
/// 270 degrees the nearest remaining point by angle. Deviation: the area is the convex hull's.
constexpr auto reduce_like_ode = []<class S>(const Candidates<S>& points,
                                             const ReduceOptions& options) {
  constexpr S kTurn = S(2) * std::numbers::pi_v<S>;
  const int deepest = points.deepest();
  const Vec3<S> middle = centroid(points);
  const Vec3<S> u = points[deepest] - middle;
  const Vec3<S> v = points.normal.cross(u);
  StaticVector<S, kMaxManifoldPoints> angles;
  for (const ContactPoint<S>& point : points.points) {
    const Vec3<S> offset = point.position - middle;
    const S turned = std::atan2(v.dot(offset), u.dot(offset));
    angles.push_back(turned < S(0) ? turned + kTurn : turned);
  }

  KeptIndices choices;
  choices.push_back(deepest);
  for (int quarter = 1; quarter < 4; ++quarter) {
    const S wanted = S(quarter) * (kTurn / S(4));
    steps::add_once(choices, points.highest([&](int i) {
      if (steps::contains(choices, i)) return -std::numeric_limits<S>::infinity();
      const S gap = std::abs(wanted - at(angles, i));
      return -std::min(gap, kTurn - gap);
    }));
  }
  return steps::first_of(choices, options);
};

/// Like PhysX's reduction of a batch of contacts. Steps: the deepest point, which is therefore
/// always kept; the farthest from it; the farthest on either side of the line through both. At most
/// four points. Deviation: three points if a side is empty.
constexpr auto reduce_like_physx = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  const int first = points.deepest();
  return points.two_and_both_sides(first, points.farthest_from(first), options);
};

/// Like PhysX's reduction of contacts by clusters. Steps: the point farthest from the centre, the
/// farthest from it, and the farthest on either side of the line through both; every point joins
/// the nearest of these; the deepest of each cluster is kept, so the deepest of all is always kept,
/// first. At most four points. Deviations: the centre is that of the points, because a reducer has
/// no shape frame; three points if a side is empty; the clusters are listed by depth.
constexpr auto reduce_like_physx_cluster = []<class S>(const Candidates<S>& points,
                                                       const ReduceOptions& options) {
  const Vec3<S> middle = points.centre();
  const auto separation = [&](int i) { return points.separation(i); };
  const int first =
      std::max(0, points.highest([&](int i) { return (points[i] - middle).squaredNorm(); }, S(0)));
  const KeptIndices centres = points.two_and_both_sides(first, points.farthest_from(first), {});

  KeptIndices deepest = centres;
  for (int i = 0; i < points.count(); ++i) {
    const auto from_centre = [&](int centre) { return (points[i] - points[centre]).squaredNorm(); };
    const auto nearest = std::ranges::min_element(centres, {}, from_centre) - centres.begin();
    int& deepest_there = deepest.begin()[nearest];
    if (separation(i) < separation(deepest_there)) deepest_there = i;
  }
  std::ranges::stable_sort(deepest, {}, separation);
  return steps::first_of(deepest, options);
};

/// Shamos 1978, "Computational Geometry": the farthest pair is antipodal. As the edge from corner i
/// turns, the corner farthest from it only advances.
template <class S> std::array<int, 2> diameter(const Corners<S>& hull) {
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
    const Vec2<S> edge = hull[after(i)].place - hull[i].place;
    measure(i, k);
    // Never past corner i, in case rounding hides a turn.
    while (after(k) != i && cross(edge, hull[after(k)].place - hull[k].place) > S(0)) {
      k = after(k);
      measure(i, k);
    }
    measure(after(i), k);
  }
  return best;
}

/// Like Newton's pruning of contacts: the convex hull of the points in the plane; its diameter by
/// rotating calipers; the farthest points on either side of it. Three if a side is empty.
constexpr auto reduce_like_newton = []<class S>(const Candidates<S>& points,
                                                const ReduceOptions& options) {
  const PlaneFrame<S> plane(points[0], points.normal);
  const auto [a, b] = diameter(convex_corners(points, plane));
  return points.two_and_both_sides(a, b, options);
};

/// Like MJX's reduction of a clip polygon. Steps: the first given point; the farthest from it; the
/// farthest from the line through both, on either side; the farthest from the triangle's other two
/// edges, on either side of them, by area. A corner of the triangle may win, which leaves three
/// points. Deviation: it is not reported twice.
constexpr auto reduce_like_mjx = []<class S>(const Candidates<S>& points,
                                             const ReduceOptions& options) {
  const int a = 0;
  const int b = points.farthest_from(a);
  const auto area = [&](int q, int from, int to) {
    return std::abs(points.doubled_area(q, from, to));
  };
  const int c = points.highest([&](int q) { return area(q, a, b); }, points.negligible_area(a, b));
  KeptIndices choices;
  choices.push_back(a);  // one by one, as in steps::grow()
  steps::add_once(choices, b);
  steps::add_once(choices, c);
  if (c >= 0)
    steps::add_once(
        choices,
        points.highest([&](int q) { return std::max(area(q, b, c), area(q, a, c)); }, S(0)));
  return steps::first_of(choices, options);
};

/// The first max_points points in the order of clipping: a fixed-size buffer. No source.
constexpr auto reduce_to_first = []<class S>(const Candidates<S>& /*points*/,
                                             const ReduceOptions& options) {
  return steps::numbers_up_to(options.max_points);
};

/// The deepest max_points points, deepest first, then by index. No source: the obvious choice, and
/// a bad one. Deep points are next to each other, and the manifold jumps if depths change places.
constexpr auto reduce_to_deepest = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  KeptIndices order = steps::numbers_up_to(points.count());
  std::partial_sort(
      order.begin(), order.begin() + options.max_points, order.end(), [&](int a, int b) {
        return std::pair(points.separation(a), a) < std::pair(points.separation(b), b);
      });
  return steps::first_of(order, options);
};

/// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": any seed works.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15;
  std::uint64_t mixed = state;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  return mixed ^ (mixed >> 31);
}

/// Any max_points of the points, equally likely, by options.seed. The same on every platform.
///
/// Fisher and Yates 1938, stopped after max_points. Steps: exchange position i with a random
/// position >= i, drawn by multiplying 32 random bits by the number of positions. The bias is below
/// 1e-7. A standard distribution would differ between libraries.
constexpr auto reduce_at_random = []<class S>(const Candidates<S>& points,
                                              const ReduceOptions& options) {
  const int all = points.count();
  KeptIndices order = steps::numbers_up_to(all);
  std::uint64_t state = options.seed;
  for (int i = 0; i < options.max_points; ++i) {
    const std::uint64_t places = static_cast<std::uint64_t>(all - i);
    const std::uint64_t drawn = ((split_mix(state) >> 32) * places) >> 32;
    std::swap(at(order, i), order[static_cast<std::size_t>(i) + drawn]);
  }
  return steps::first_of(order, options);
};

}  // namespace

/// Reducers like those of engines, each written from a description.
std::vector<ReducerInfo> engine_reducers() {
  return {
      listed("box3d",
             "far and deep, farthest, largest triangle, most area, near ties to the earlier",
             reduce_like_box3d),
      listed("box3d_mesh", "the farthest pair, largest triangle, most area",
             reduce_like_box3d_mesh),
      listed("jolt", "twice distance times depth, then both sides", reduce_like_jolt),
      listed("bullet", "one by one, the deepest protected, largest area", reduce_like_bullet),
      listed("ode", "the deepest, then every 90 degrees", reduce_like_ode),
      listed("physx", "the deepest, farthest, then both sides", reduce_like_physx),
      listed("physx_cluster", "the deepest of each of four clusters", reduce_like_physx_cluster),
      listed("newton", "the diameter, then both sides", reduce_like_newton),
      listed("mjx", "the first, farthest from it, from the line, from the edges", reduce_like_mjx)};
}

/// Reducers without geometry, for comparison.
std::vector<ReducerInfo> simple_reducers() {
  return {listed("deepest", "the deepest", reduce_to_deepest),
          listed("first", "the first, in the order of clipping", reduce_to_first),
          listed("random", "any, by the seed", reduce_at_random)};
}

}  // namespace contactscope
