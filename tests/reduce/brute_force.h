#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/manifold.h"
#include "support/random_geometry.h"

// The best choice of points, by trying all in double. Shares no code with reducers or polygon_area.
namespace contactscope::test {

struct Place {
  double x, y;
};

/// Positions of points in any scalar, seen along the normal, relative to the first point.
template <class S>
std::vector<Place> seen_along(const std::vector<ContactPoint<S>>& points, const Vec3<S>& normal) {
  const Vec3d n = normal.template cast<double>().normalized();
  const Vec3d u = n.cross(std::abs(n.x()) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)).normalized();
  const Vec3d v = n.cross(u);
  std::vector<Place> places;
  for (const ContactPoint<S>& point : points) {
    const Vec3d offset =
        point.position.template cast<double>() - points[0].position.template cast<double>();
    places.push_back({offset.dot(u), offset.dot(v)});
  }
  return places;
}

inline double turn(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Area of the convex hull, from its upper and lower border by columns from left to right.
inline double hull_area(std::vector<Place> places) {
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  double area = 0;
  for (const double side : {1.0, -1.0}) {
    std::vector<Place> border;
    for (const Place& place : places) {
      while (border.size() > 1 &&
             side * turn(border[border.size() - 2], border.back(), place) >= 0) {
        border.pop_back();
      }
      border.push_back(place);
    }
    for (std::size_t i = 1; i < border.size(); ++i) {
      // Relative to the left end, so that trapezoids are no larger than the hull.
      const double height = 0.5 * (border[i].y + border[i - 1].y) - border[0].y;
      area += side * height * (border[i].x - border[i - 1].x);
    }
  }
  return area;
}

template <class Indices>
std::vector<Place> at(const std::vector<Place>& places, const Indices& indices) {
  std::vector<Place> chosen;
  for (const int i : indices) chosen.push_back(places[static_cast<std::size_t>(i)]);
  return chosen;
}

inline double distance(const Place& a, const Place& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Largest distance between two places.
inline double extent(const std::vector<Place>& places) {
  double most = 0;
  for (const Place& a : places) {
    for (const Place& b : places) most = std::max(most, distance(a, b));
  }
  return most;
}

/// The largest hull area of `size` places that `admits` accepts; minus infinity if it accepts none.
template <class Admits>
double largest_area(const std::vector<Place>& places, int size, const Admits& admits) {
  const int count = static_cast<int>(places.size());
  std::vector<bool> is_chosen(places.size(), false);
  std::fill_n(is_chosen.begin(), std::min(size, count), true);
  double best = -std::numeric_limits<double>::infinity();
  do {
    std::vector<int> chosen;
    for (int i = 0; i < count; ++i) {
      if (is_chosen[static_cast<std::size_t>(i)]) chosen.push_back(i);
    }
    if (admits(chosen)) best = std::max(best, hull_area(at(places, chosen)));
  } while (std::prev_permutation(is_chosen.begin(), is_chosen.end()));
  return best;
}

inline double largest_area(const std::vector<Place>& places, int size) {
  return largest_area(places, size, [](const std::vector<int>&) { return true; });
}

/// The largest area of four places, if there are too many places to try all choices: each pair with
/// the farthest place on each side of its line. (No choice has more than its best diagonal gives.)
inline double largest_quadrilateral(const std::vector<Place>& places) {
  double largest = 0;
  for (const Place& a : places) {
    for (const Place& b : places) {
      double left = 0, right = 0;
      for (const Place& c : places) {
        left = std::max(left, turn(a, b, c));
        right = std::max(right, -turn(a, b, c));
      }
      largest = std::max(largest, 0.5 * (left + right));
    }
  }
  return largest;
}

/// The same for choices that contain place `through`, over all triples of other places.
inline double largest_quadrilateral_with(const std::vector<Place>& places, int through) {
  const Place& p = places[static_cast<std::size_t>(through)];
  double largest = 0;
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t c = 0; c < b; ++c)
        largest = std::max(largest, hull_area({p, places[a], places[b], places[c]}));
    }
  }
  return largest;
}

/// Points on a circle for the oracle above, in order except for one swap in every third case. In
/// even cases most are crowded at one place, so that short diagonals matter too.
inline std::vector<Place> crowd(Random& random, int count, int number) {
  std::vector<double> angles;
  for (int k = 0; k < count; ++k) {
    const bool crowded = number % 2 == 0 && k > 5;
    angles.push_back(crowded ? random.uniform(0, 0.2) : random.uniform(0, 6.28));
  }
  std::sort(angles.begin(), angles.end());
  std::vector<Place> places;
  for (const double angle : angles) places.push_back({std::cos(angle), std::sin(angle)});
  if (number % 3 == 0) std::swap(places[3], places[11]);
  return places;
}

/// Effect of rounding to S on an area: a few ulps of the coordinates along the whole patch.
template <class S>
double area_rounding(const std::vector<ContactPoint<S>>& points, const std::vector<Place>& places) {
  const double length = extent(places);
  const double coordinate = static_cast<double>(points[0].position.cwiseAbs().maxCoeff()) + length;
  return 16 * static_cast<double>(std::numeric_limits<S>::epsilon()) * coordinate * length;
}

enum class Shape {
  Polygon,      // convex, counter-clockwise
  Clockwise,    // the same, clockwise
  Shuffled,     // the same in random order
  Scattered,    // points inside
  Lattice,      // many on one line, many duplicates, all exact
  Sliver,       // 1e-9 thick
  OffThePlane,  // a polygon with noise along the normal
};
inline constexpr Shape kShapes[] = {Shape::Polygon,    Shape::Clockwise, Shape::Shuffled,
                                    Shape::Scattered,  Shape::Lattice,   Shape::Sliver,
                                    Shape::OffThePlane};

template <class S> struct RandomPatch {
  std::vector<ContactPoint<S>> points;
  Vec3<S> normal;
};

/// Points with the separations of a tilted plane, moved to a random pose, 1e-4 to 1e4 metres in
/// size. Their ids are all different.
template <class S> RandomPatch<S> random_patch(Random& random, Shape shape, int count) {
  std::vector<Place> places;
  const double flat = random.uniform(0.2, 1);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.9)) / count;
    Place place = {std::cos(angle), flat * std::sin(angle)};
    if (shape == Shape::Scattered) place = {random.uniform(-1, 1), random.uniform(-1, 1)};
    if (shape == Shape::Lattice) {
      place = {0.25 * (random.index(4) - 2), 0.25 * (random.index(4) - 2)};
    }
    if (shape == Shape::Sliver) place = {random.uniform(-1, 1), random.uniform(-1e-9, 1e-9)};
    places.push_back(place);
  }
  if (shape == Shape::Clockwise) std::reverse(places.begin(), places.end());
  if (shape == Shape::Shuffled) {
    for (int i = count; i > 1; --i) {
      std::swap(places[static_cast<std::size_t>(i - 1)],
                places[static_cast<std::size_t>(random.index(i))]);
    }
  }
  const double scale = random.decade(-4, 4);
  const bool stays = shape == Shape::Lattice && random.chance(0.5);
  const Pose<double> pose = stays ? Pose<double>{} : random.pose(5 * scale);
  const Place tilt = {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)};
  RandomPatch<S> patch;
  patch.normal = pose.rotate(Vec3d::UnitZ()).template cast<S>();
  for (const Place& place : places) {
    const double height = shape == Shape::OffThePlane ? random.uniform(-0.05, 0.05) : 0;
    const Vec3d local = scale * Vec3d(place.x, place.y, height);
    const double separation = scale * (tilt.x * place.x + tilt.y * place.y - 0.02);
    const auto edge = static_cast<std::uint32_t>(patch.points.size());
    patch.points.push_back({pose.transform(local).template cast<S>(), static_cast<S>(separation),
                            FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return patch;
}

}  // namespace contactscope::test
