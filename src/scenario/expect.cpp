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

/// A computed number in six digits; in all of them where six do not tell it from the expected one.
std::string spell_got(double value, double expected) {
  constexpr int kDigits = 6;
  char buffer[32];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, kDigits).ptr;
  const std::string text(buffer, end);
  return text == spell(expected) && value != expected ? spell(value) : text;
}

std::string spell_got(const Vec3d& v, const Vec3d& expected) {
  return "[" + spell_got(v.x(), expected.x()) + ", " + spell_got(v.y(), expected.y()) + ", " +
         spell_got(v.z(), expected.z()) + "]";
}

/// One thing that is not as it should be.
struct Unmet {
  std::string wanted;  // "expected 4 points"
  std::string got;     // "2"; empty where the first says all
};

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

/// What `pair` does not meet.
std::vector<Unmet> unmet(const Expectation& expected, const trace::Pair& pair, double dt) {
  std::vector<Unmet> list;
  if (expected.state && pair.state != *expected.state)
    list.push_back({"expected " + *expected.state,
                    pair.state + " with separation " + spell_got(pair.separation, 0) + " m"});
  if (expected.points) {
    int count = 0;
    for (const trace::Manifold& manifold : pair.manifolds) count += count_of(manifold.points);
    const std::string wanted = std::to_string(*expected.points);
    if (count != *expected.points)
      list.push_back(
          {"expected " + wanted + (wanted == "1" ? " point" : " points"), std::to_string(count)});
  }
  const std::vector<Direction> directions = directions_of(pair);
  const auto wants_axis = [&] { return "expected axis " + *expected.axis; };
  const auto wants_normal = [&] { return "expected normal " + spell(*expected.normal); };
  if (expected.axis && directions.empty()) list.push_back({wants_axis(), "none"});
  if (expected.normal && directions.empty()) list.push_back({wants_normal(), "none"});
  const std::string tolerance = " (tolerance " + spell(expected.tolerance);
  for (const Direction& direction : directions) {
    if (expected.axis && direction.axis != *expected.axis)
      list.push_back({wants_axis(), direction.axis});
    // Written so that nan is never within the tolerance.
    if (expected.normal &&
        !((direction.normal - *expected.normal).cwiseAbs().array() <= expected.tolerance).all())
      list.push_back(
          {wants_normal(), spell_got(direction.normal, *expected.normal) + tolerance + ")"});
  }
  if (expected.type && pair.manifolds.empty())
    list.push_back({"expected type " + *expected.type, "none"});
  for (const trace::Manifold& manifold : pair.manifolds)
    if (expected.type && manifold.type != *expected.type)
      list.push_back({"expected type " + *expected.type, manifold.type});
  if (expected.separation &&
      !(std::abs(pair.separation - *expected.separation) <= expected.tolerance))
    list.push_back({"expected separation " + spell(*expected.separation) + " m",
                    spell_got(pair.separation, *expected.separation) + " m" + tolerance + ")"});
  if (expected.load) {
    const double load = load_of(pair, dt);
    if (!(std::abs(load - *expected.load) <= expected.tolerance * *expected.load))
      list.push_back({"expected load " + spell(*expected.load) + " N",
                      spell_got(load, *expected.load) + " N" + tolerance + " of it)"});
  }
  return list;
}

/// What of one expectation a frame does not meet.
std::vector<Unmet> unmet(const Scenario& scenario, const Expectation& expected,
                         const trace::Frame& frame) {
  if (frame.frame < expected.first_frame || frame.frame > expected.last_frame) return {};
  const std::string& a = scenario.shape(expected.a).name;
  const std::string& b = scenario.shape(expected.b).name;
  const auto pair = std::ranges::find_if(frame.pairs, [&](const trace::Pair& p) {
    return p.a == a && p.b == b && p.label == expected.label;
  });
  if (pair == frame.pairs.end() && !scenario.broad_phase.empty()) {
    trace::Pair apart;
    apart.state = "separated";
    if (expected.separation) return {{"the boxes of the two are apart", ""}};
    return unmet(expected, apart, scenario.dt);
  }
  if (pair == frame.pairs.end()) return {{"the frame has no such pair", ""}};
  return unmet(expected, *pair, scenario.dt);
}

/// "frame 3", "frames 0 to 2", "3 frames from 0 to 9". `frames` is in rising order.
std::string spell_frames(const std::vector<int>& frames) {
  const std::string first = std::to_string(frames.front()), last = std::to_string(frames.back());
  if (frames.size() == 1) return "frame " + first;
  const auto length = static_cast<std::size_t>(frames.back() - frames.front()) + 1;
  return (frames.size() == length ? "frames " : std::to_string(frames.size()) + " frames from ") +
         first + " to " + last;
}

/// The same thing unmet in several frames.
struct Repeated {
  Unmet first;
  std::vector<int> frames;
  bool alike = true;  // each frame got the same
};

}  // namespace

std::vector<std::string> unmet_expectations(const Scenario& scenario,
                                            const std::vector<trace::Frame>& frames) {
  std::vector<std::string> sentences;
  for (const Expectation& expected : scenario.expectations) {
    std::vector<Repeated> list;
    for (const trace::Frame& frame : frames) {
      for (Unmet& one : unmet(scenario, expected, frame)) {
        const auto known = std::ranges::find_if(
            list, [&](const Repeated& other) { return other.first.wanted == one.wanted; });
        if (known == list.end()) {
          list.push_back({std::move(one), {frame.frame}});
          continue;
        }
        known->alike = known->alike && known->first.got == one.got;
        if (known->frames.back() != frame.frame) known->frames.push_back(frame.frame);
      }
    }
    const std::string& a = scenario.shape(expected.a).name;
    const std::string& b = scenario.shape(expected.b).name;
    for (const Repeated& one : list) {
      std::string sentence = scenario.path + ":" + std::to_string(expected.line) + ": " +
                             spell_frames(one.frames) + ", " + a + "-" + b +
                             (expected.label.empty() ? "" : " (" + expected.label + ")") + ": " +
                             one.first.wanted;
      if (!one.first.got.empty()) sentence += ", got " + one.first.got;
      if (!one.alike) sentence += "; others differ";
      sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

}  // namespace contactscope
