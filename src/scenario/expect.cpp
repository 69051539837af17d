#include "scenario/expect.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace contactscope {
namespace {

/// Shortest spelling that reads back to the same number.
std::string spell(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string spell(const Vec3d& v) {
  return std::string("[") + spell(v.x()) + ", " + spell(v.y()) + ", " + spell(v.z()) + "]";
}

std::string spell_points(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

/// Axis and normal of a pair.
struct Direction {
  std::string axis;
  Vec3d normal;
};

/// One for each manifold, or of the separating axis; none when nothing says.
std::vector<Direction> directions_of(const trace::Pair& pair) {
  std::vector<Direction> directions;
  for (const trace::Manifold& manifold : pair.manifolds)
    directions.push_back({manifold.axis, manifold.normal});
  if (!directions.empty()) return directions;
  if (pair.cache && pair.cache->normal)
    directions.push_back({pair.cache->axis, *pair.cache->normal});
  if (!pair.sat) return directions;
  const trace::Sat& sat = *pair.sat;
  if (sat.chosen == "face_a" && sat.face_a) directions.push_back({sat.chosen, sat.face_a->normal});
  if (sat.chosen == "face_b" && sat.face_b) directions.push_back({sat.chosen, sat.face_b->normal});
  if (sat.chosen == "edge_edge" && sat.edge) directions.push_back({sat.chosen, sat.edge->normal});
  return directions;
}

/// Newtons, mean over `dt` seconds.
double load_of(const trace::Pair& pair, double dt) {
  double impulse = 0;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points)
      if (point.impulse) impulse += point.impulse->normal;
  return impulse / dt;
}

/// What `pair` does not meet, without the place that each sentence begins with.
std::vector<std::string> unmet(const Expectation& expected, const trace::Pair& pair, double dt) {
  std::vector<std::string> sentences;
  if (expected.state) {
    const std::string state = *expected.state == ExpectedState::Touching ? "touching" : "separated";
    if (pair.state != state)
      sentences.push_back("expected " + state + ", got " + pair.state + " with separation " +
                          spell(pair.separation) + " m");
  }
  if (expected.points) {
    std::size_t count = 0;
    for (const trace::Manifold& manifold : pair.manifolds) count += manifold.points.size();
    if (count != static_cast<std::size_t>(*expected.points))
      sentences.push_back("expected " + spell_points(static_cast<std::size_t>(*expected.points)) +
                          ", got " + std::to_string(count));
  }
  const std::vector<Direction> directions = directions_of(pair);
  if (expected.axis && directions.empty())
    sentences.push_back("expected axis " + *expected.axis + ", got none");
  if (expected.normal && directions.empty())
    sentences.push_back("expected normal " + spell(*expected.normal) + ", got none");
  for (const Direction& direction : directions) {
    if (expected.axis && direction.axis != *expected.axis)
      sentences.push_back("expected axis " + *expected.axis + ", got " + direction.axis);
    // Written so that nan is never within the tolerance.
    if (expected.normal &&
        !((direction.normal - *expected.normal).cwiseAbs().array() <= expected.tolerance).all())
      sentences.push_back("expected normal " + spell(*expected.normal) + ", got " +
                          spell(direction.normal) + " (tolerance " + spell(expected.tolerance) +
                          ")");
  }
  if (expected.type && pair.manifolds.empty())
    sentences.push_back("expected type " + *expected.type + ", got none");
  for (const trace::Manifold& manifold : pair.manifolds)
    if (expected.type && manifold.type != *expected.type)
      sentences.push_back("expected type " + *expected.type + ", got " + manifold.type);
  if (expected.separation &&
      !(std::abs(pair.separation - *expected.separation) <= expected.tolerance))
    sentences.push_back("expected separation " + spell(*expected.separation) + " m, got " +
                        spell(pair.separation) + " m (tolerance " + spell(expected.tolerance) +
                        ")");
  if (expected.load) {
    const double load = load_of(pair, dt);
    if (!(std::abs(load - *expected.load) <= expected.tolerance * *expected.load))
      sentences.push_back("expected load " + spell(*expected.load) + " N, got " + spell(load) +
                          " N (tolerance " + spell(expected.tolerance) + " of it)");
  }
  return sentences;
}

}  // namespace

std::vector<std::string> unmet_expectations(const Scenario& scenario, const trace::Frame& frame) {
  std::vector<std::string> sentences;
  for (const Expectation& expected : scenario.expectations) {
    if (frame.frame < expected.first_frame || frame.frame > expected.last_frame) continue;
    const std::string& a = scenario.shapes[static_cast<std::size_t>(expected.a)].name;
    const std::string& b = scenario.shapes[static_cast<std::size_t>(expected.b)].name;
    const std::string place = scenario.path + ":" + std::to_string(expected.line) + ": frame " +
                              std::to_string(frame.frame) + ", " + a + "-" + b +
                              (expected.label.empty() ? "" : " (" + expected.label + ")") + ": ";
    const auto pair = std::ranges::find_if(frame.pairs, [&](const trace::Pair& p) {
      return p.a == a && p.b == b && p.label == expected.label;
    });
    if (pair == frame.pairs.end()) {
      sentences.push_back(place + "the frame has no such pair");
      continue;
    }
    for (const std::string& sentence : unmet(expected, *pair, scenario.dt))
      sentences.push_back(place + sentence);
  }
  return sentences;
}

}  // namespace contactscope
