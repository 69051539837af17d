#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "reduce/brute_force.h"

// Contact patches that change over time: one convex polygon slides, turns and tilts on another.
namespace contactscope::test {

struct LabelledCorner {
  Place place;
  FeatureRef edge;  // the edge that starts here
};

inline std::vector<LabelledCorner> regular_polygon(Owner owner, int corners, double radius,
                                                   double turned, const Place& centre) {
  std::vector<LabelledCorner> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = turned + 2 * std::numbers::pi * i / corners;
    polygon.push_back({{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)},
                       {owner, static_cast<std::uint32_t>(i)}});
  }
  return polygon;
}

/// The intersection of two convex polygons, clipped edge by edge.
inline std::vector<LabelledCorner> clipped(std::vector<LabelledCorner> polygon,
                                           const std::vector<LabelledCorner>& by) {
  for (std::size_t k = 0; k < by.size(); ++k) {
    const Place& from = by[k].place;
    const Place& to = by[(k + 1) % by.size()].place;
    std::vector<LabelledCorner> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const LabelledCorner& here = polygon[i];
      const Place& next = polygon[(i + 1) % polygon.size()].place;
      const double side = turn(from, to, here.place);
      const double next_side = turn(from, to, next);
      if (side >= 0) inside.push_back(here);
      if ((side >= 0) == (next_side >= 0)) continue;
      const double t = side / (side - next_side);
      const Place crossing = {here.place.x + t * (next.x - here.place.x),
                              here.place.y + t * (next.y - here.place.y)};
      inside.push_back({crossing, side >= 0 ? by[k].edge : here.edge});
    }
    polygon = inside;
  }
  return polygon;
}

/// One body on another over time. Everything changes smoothly with time in seconds.
struct Slide {
  int corners_a = 4;
  int corners_b = 4;
  double yaw_rate = 0.3;   // radians a second
  double tilt = 0.01;      // slope of the separations
  double tilt_rate = 0.2;  // radians a second, of its direction
  double sway = 0.1;       // metres, how far b moves back and forth
};

inline Slide random_slide(Random& random) {
  Slide slide;
  slide.corners_a = 4 + random.index(5);
  slide.corners_b = 4 + random.index(5);
  slide.yaw_rate = random.uniform(-1, 1);
  slide.tilt = random.chance(0.3) ? 0 : random.decade(-5, -1);
  slide.tilt_rate = random.uniform(-1, 1);
  slide.sway = random.uniform(0, 0.4);
  return slide;
}

/// The patch at a time, with noise of `noise` metres on places and separations.
template <class S>
std::vector<ContactPoint<S>> patch_at(const Slide& slide, double time, double noise,
                                      Random& random) {
  const Place centre = {slide.sway * std::sin(0.7 * time), slide.sway * std::sin(0.4 * time)};
  const double yaw = 0.2 + slide.yaw_rate * time;
  const auto a = regular_polygon(Owner::A, slide.corners_a, 1, 0, {0, 0});
  const auto b = regular_polygon(Owner::B, slide.corners_b, 0.95, yaw, centre);
  const auto polygon = clipped(b, a);
  const Place down = {slide.tilt * std::cos(slide.tilt_rate * time),
                      slide.tilt * std::sin(slide.tilt_rate * time)};
  std::vector<ContactPoint<S>> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place& p = polygon[i].place;
    const FeatureRef arriving = polygon[(i + polygon.size() - 1) % polygon.size()].edge;
    const Vec3d position(p.x + random.uniform(-noise, noise), p.y + random.uniform(-noise, noise),
                         0.3);
    const double separation = -0.005 + down.x * p.x + down.y * p.y + random.uniform(-noise, noise);
    points.push_back(
        {position.cast<S>(), static_cast<S>(separation), FeatureId::of(arriving, polygon[i].edge)});
  }
  return points;
}

}  // namespace contactscope::test
