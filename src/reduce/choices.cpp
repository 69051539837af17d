#include "reduce/choices.h"

#include <algorithm>

#include "reduce/steps.h"

namespace contactscope {
namespace {

using Points = std::span<const ContactPoint<double>>;

double signed_area(Points points, const Vec3d& normal, int q, int a, int b) {
  return 0.5 * steps::doubled_area(steps::position(points, q), steps::position(points, a),
                                   steps::position(points, b), normal);
}

bool among(std::span<const int> kept, int point) {
  return std::ranges::find(kept, point) != kept.end();
}

trace::Choice support_choice(Points points, const Vec3d& direction) {
  trace::Choice choice;
  choice.rule = "support";
  choice.direction = direction;
  for (int q = 0; q < count_of(points); ++q) {
    const Vec3d arm = steps::position(points, q) - steps::position(points, 0);
    choice.measures.push_back({q, trace::kNoEdge, direction.dot(arm)});
  }
  return choice;
}

trace::Choice first_choice(std::string_view reducer, Points points, const Vec3d& normal) {
  trace::Choice choice;
  if (reducer == "area_deepest") {
    choice.rule = "deepest";
    for (int q = 0; q < count_of(points); ++q) {
      choice.measures.push_back({q, trace::kNoEdge, -at(points, q).separation});
    }
    return choice;
  }
  return support_choice(points, steps::fixed_direction(normal).normalized());
}

/// A support point of each end of both axes; a point that is extreme twice was chosen the first
/// time.
std::vector<trace::Choice> extreme_choices(Points points, const Vec3d& normal,
                                           std::span<const int> kept) {
  const Vec3d u = any_perpendicular(normal);
  const Vec3d v = normal.cross(u);
  std::vector<trace::Choice> choices;
  std::vector<int> chosen;
  for (const Vec3d& direction : {Vec3d(-u), u, Vec3d(-v), v}) {
    const int point = steps::support_point(points, direction);
    if (among(chosen, point) || !among(kept, point)) continue;
    chosen.push_back(point);
    choices.push_back(support_choice(points, direction));
  }
  // Where float took another of two points that lie equally far, nothing is told.
  if (choices.size() != kept.size()) choices.clear();
  return choices;
}

trace::Choice second_choice(Points points, int first) {
  trace::Choice choice;
  choice.rule = "farthest";
  for (int q = 0; q < count_of(points); ++q) {
    if (q == first) continue;
    choice.measures.push_back(
        {q, trace::kNoEdge, (steps::position(points, q) - steps::position(points, first)).norm()});
  }
  return choice;
}

trace::Choice third_choice(Points points, const Vec3d& normal, int first, int second) {
  trace::Choice choice;
  choice.rule = "triangle";
  for (int q = 0; q < count_of(points); ++q) {
    if (q == first || q == second) continue;
    choice.measures.push_back(
        {q, {{first, second}}, signed_area(points, normal, q, first, second)});
  }
  return choice;
}

/// How an edge values a point.
using EdgeMeasure = double (*)(Points points, const Vec3d& normal, int q, int a, int b);

double signed_distance(Points points, const Vec3d& normal, int q, int a, int b) {
  const double length = (steps::position(points, b) - steps::position(points, a)).norm();
  return 2 * signed_area(points, normal, q, a, b) / length;
}

/// The kept points as a polygon, counter-clockwise seen against the normal, from the first on. Each
/// goes behind the edge that it was chosen for.
std::vector<int> ring_of(Points points, const Vec3d& normal, std::span<const int> kept,
                         EdgeMeasure measure) {
  std::vector<int> ring(kept.begin(), kept.begin() + 3);
  if (signed_area(points, normal, ring[0], ring[1], ring[2]) < 0) std::swap(ring[1], ring[2]);
  for (const int next : kept.subspan(3)) {
    std::size_t after = 0;
    double least = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const double value = measure(points, normal, next, ring[k], ring[(k + 1) % ring.size()]);
      if (value < least) {
        least = value;
        after = k;
      }
    }
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(after) + 1, next);
  }
  return ring;
}

trace::Choice later_choice(std::string_view reducer, Points points, const Vec3d& normal,
                           std::span<const int> before, int chosen) {
  const bool by_distance = reducer == "distance";
  const EdgeMeasure measure = by_distance ? &signed_distance : &signed_area;
  trace::Choice choice;
  choice.rule = by_distance ? "distance" : "outside";
  const std::vector<int> ring = ring_of(points, normal, before, measure);
  for (int q = 0; q < count_of(points); ++q) {
    if (among(before, q)) continue;
    std::vector<trace::Measure> all;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[k];
      const int b = ring[(k + 1) % ring.size()];
      all.push_back({q, {{a, b}}, measure(points, normal, q, a, b)});
    }
    if (q == chosen) {
      choice.measures.insert(choice.measures.end(), all.begin(), all.end());
    } else {
      choice.measures.push_back(*std::ranges::min_element(all, {}, &trace::Measure::value));
    }
  }
  return choice;
}

}  // namespace

std::vector<trace::Choice> choices_made(std::string_view reducer, Points points,
                                        const Vec3d& normal, std::span<const int> kept) {
  std::vector<trace::Choice> choices;
  const bool talk = reducer == "area" || reducer == "area_deepest" || reducer == "distance";
  if (kept.size() >= points.size() || kept.empty()) return choices;
  if (reducer == "extremes") return extreme_choices(points, normal, kept);
  if (!talk) return choices;
  choices.push_back(first_choice(reducer, points, normal));
  if (kept.size() > 1) choices.push_back(second_choice(points, kept[0]));
  if (kept.size() > 2) choices.push_back(third_choice(points, normal, kept[0], kept[1]));
  for (std::size_t k = 3; k < kept.size(); ++k) {
    choices.push_back(later_choice(reducer, points, normal, kept.first(k), kept[k]));
  }
  return choices;
}

}  // namespace contactscope
