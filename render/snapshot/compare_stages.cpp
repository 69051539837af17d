#include "snapshot/compare_stages.h"

#include <algorithm>
#include <cstddef>

#include "snapshot/match.h"

namespace contactscope::snapshot {
namespace {

using Parts = std::vector<std::string>;

template <class List>
int count_of(const List& list) {
  return static_cast<int>(list.size());
}

std::vector<Vec3d> both_points(const trace::Simplex& simplex) {
  std::vector<Vec3d> all;
  for (const trace::SimplexVertex& vertex : simplex) all.insert(all.end(), {vertex.a, vertex.b});
  return all;
}

/// "20 -> 24 faces", or "face 7 (0 1 3) -> (0 3 1)" of the first that differs.
template <class Face>
void compare_faces(const std::vector<Face>& expected, const std::vector<Face>& actual,
                   Changes& changes) {
  if (expected.size() != actual.size()) {
    changes.add(spell_change(count_of(expected), count_of(actual)) + " faces");
    return;
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == actual[i]) continue;
    changes.add("face " + std::to_string(i) + " (" + spell_list(expected[i]) + ") -> (" +
                spell_list(actual[i]) + ")");
    return;
  }
}

/// "support 4 -> 3 points", "support point 2 moved ..".
void compare_polygon(const std::string& name, const trace::Polygon& expected,
                     const trace::Polygon& actual, const Tolerance& tolerance, Changes& changes) {
  Changes polygon("", tolerance);
  polygon.vertices(expected, actual);
  Parts parts;
  polygon.tell(parts);
  for (const std::string& part : parts) changes.add(name + part);
}

void compare_steps(const trace::Penetration& expected, const trace::Penetration& actual,
                   const Tolerance& tolerance, Parts& parts) {
  for (std::size_t i = 0; i < std::min(expected.polytopes.size(), actual.polytopes.size()); ++i) {
    const trace::Polytope& before = expected.polytopes[i];
    const trace::Polytope& after = actual.polytopes[i];
    Changes changes("polytope " + std::to_string(i) + ": ", tolerance);
    changes.vertices(both_points(before.vertices), both_points(after.vertices));
    compare_faces(before.faces, after.faces, changes);
    changes.exact("nearest face ", before.nearest, after.nearest);
    changes.length("distance ", before.distance, after.distance);
    changes.tell(parts);
  }
  for (std::size_t i = 0; i < std::min(expected.portals.size(), actual.portals.size()); ++i) {
    Changes changes("portal " + std::to_string(i) + ": ", tolerance);
    changes.vertices(both_points(expected.portals[i]), both_points(actual.portals[i]));
    changes.tell(parts);
  }
  for (std::size_t i = 0; i < std::min(expected.directions.size(), actual.directions.size()); ++i) {
    Changes changes("direction " + std::to_string(i) + ": ", tolerance);
    changes.direction("normal ", expected.directions[i].normal, actual.directions[i].normal);
    changes.length("separation ", expected.directions[i].separation,
                   actual.directions[i].separation);
    changes.tell(parts);
  }
}

}  // namespace

void compare_edge_pairs(const std::vector<trace::EdgePair>& expected,
                        const std::vector<trace::EdgePair>& actual, const Tolerance& tolerance,
                        Parts& parts) {
  const auto keys = [](const std::vector<trace::EdgePair>& pairs) {
    Parts names;
    for (const trace::EdgePair& pair : pairs)
      names.push_back(std::to_string(pair.a) + "-" + std::to_string(pair.b));
    return names;
  };
  const Parts expected_keys = keys(expected), actual_keys = keys(actual);
  const Match match = match_keys(expected_keys, actual_keys);
  if (match.reordered()) parts.push_back("sat edge pairs in another order");
  for (const std::size_t i : match.gone)
    parts.push_back("sat edge pair " + expected_keys[i] + " gone");
  for (const std::size_t i : match.added)
    parts.push_back("sat edge pair " + actual_keys[i] + " added");
  for (const auto& [i, j] : match.both) {
    Changes changes("sat edge pair " + expected_keys[i] + ": ", tolerance);
    changes.length("separation ", expected[i].separation, actual[j].separation);
    changes.direction("normal ", expected[i].normal, actual[j].normal);
    changes.tell(parts);
  }
}

void compare_penetration(const trace::Penetration& expected, const trace::Penetration& actual,
                         const Tolerance& tolerance, Parts& parts) {
  Changes changes("penetration: ", tolerance);
  changes.exact("method ", expected.method, actual.method);
  changes.exact("status ", expected.status, actual.status);
  changes.exact("fallback ", expected.fallback, actual.fallback);
  changes.exact("iterations ", expected.iterations, actual.iterations);
  changes.length("depth ", expected.depth, actual.depth);
  changes.direction("normal ", expected.normal, actual.normal);
  changes.position("point on a ", expected.point_a, actual.point_a);
  changes.position("point on b ", expected.point_b, actual.point_b);
  changes.exact("number of polytopes ", count_of(expected.polytopes), count_of(actual.polytopes));
  changes.exact("number of portals ", count_of(expected.portals), count_of(actual.portals));
  changes.exact("number of directions ", count_of(expected.directions),
                count_of(actual.directions));
  changes.tell(parts);
  compare_steps(expected, actual, tolerance, parts);
}

void compare_minkowski(const trace::Minkowski& expected, const trace::Minkowski& actual,
                       const Tolerance& tolerance, Parts& parts) {
  Changes changes("minkowski: ", tolerance);
  changes.vertices(expected.vertices, actual.vertices);
  compare_faces(expected.faces, actual.faces, changes);
  changes.tell(parts);
}

void compare_incremental(const trace::Incremental& expected, const trace::Incremental& actual,
                         const Tolerance& tolerance, Parts& parts) {
  Changes settings("incremental: ", tolerance);
  settings.exact("confirm ", expected.confirm, actual.confirm);
  settings.exact("query ", expected.query, actual.query);
  settings.length("margin of a ", expected.margin_a, actual.margin_a);
  settings.length("margin of b ", expected.margin_b, actual.margin_b);
  settings.tell(parts);
  const auto ids = [](const std::vector<trace::PersistentPoint>& points) {
    Parts keys;
    for (const trace::PersistentPoint& point : points) keys.push_back(point.point.id);
    return keys;
  };
  Match match = match_keys(ids(expected.points), ids(actual.points));
  if (match.reordered()) parts.push_back("persistent points in another order");
  match_rest_by_index(match);
  const auto name = [](std::size_t index) { return "persistent point " + std::to_string(index); };
  for (const std::size_t i : match.gone)
    parts.push_back(name(i) + " (" + expected.points[i].point.id + ") gone");
  for (const std::size_t i : match.added)
    parts.push_back(name(i) + " (" + actual.points[i].point.id + ") added at " +
                    spell_vector(actual.points[i].point.position));
  for (const auto& [i, j] : match.both) {
    const trace::PersistentPoint& before = expected.points[i];
    const trace::PersistentPoint& after = actual.points[j];
    Changes changes(name(i) + " ", tolerance);
    changes.position("", before.point.position, after.point.position);
    changes.length("separation ", before.point.separation, after.point.separation);
    changes.exact("id ", before.point.id, after.point.id);
    changes.exact("state ", before.state, after.state);
    changes.exact("reason ", before.reason, after.reason);
    changes.exact("age ", before.age, after.age);
    changes.position("place on a ", before.on_a, after.on_a);
    changes.position("place on b ", before.on_b, after.on_b);
    changes.tell(parts);
  }
}

void compare_stability(const trace::Stability& expected, const trace::Stability& actual,
                       const Tolerance& tolerance, Parts& parts) {
  Changes changes("stability: ", tolerance);
  changes.exact("verdict ", expected.verdict, actual.verdict);
  changes.exact("shape ", expected.shape, actual.shape);
  changes.position("centre of mass ", expected.center_of_mass, actual.center_of_mass);
  changes.position("projection ", expected.projection, actual.projection);
  changes.length("margin ", expected.margin, actual.margin);
  compare_polygon("support ", expected.support, actual.support, tolerance, changes);
  if (expected.axis && actual.axis) {
    changes.position("first point of the axis ", (*expected.axis)[0], (*actual.axis)[0]);
    changes.position("second point of the axis ", (*expected.axis)[1], (*actual.axis)[1]);
  } else if (expected.axis || actual.axis) {
    changes.add(expected.axis ? "axis gone" : "axis added");
  }
  changes.tell(parts);
}

void compare_solver(const trace::Solver& expected, const trace::Solver& actual, Parts& parts) {
  Changes changes("solver: ", Tolerance{});
  changes.exact("position correction ", expected.position_correction, actual.position_correction);
  changes.exact("iterations ", expected.iterations, actual.iterations);
  changes.exact("sub-steps ", expected.substeps, actual.substeps);
  changes.exact("warm start ", std::string(expected.warm_start ? "on" : "off"),
                std::string(actual.warm_start ? "on" : "off"));
  changes.length("slop ", expected.slop, actual.slop);
  changes.length("speculative margin ", expected.speculative_margin, actual.speculative_margin);
  changes.tell(parts);
}

BodyScale largest(const std::vector<trace::Body>& bodies) {
  BodyScale scale;
  for (const trace::Body& body : bodies) {
    scale.speed = std::max(scale.speed, body.velocity.norm());
    scale.spin = std::max(scale.spin, body.angular_velocity.norm());
    scale.energy =
        std::max({scale.energy, std::abs(body.kinetic_energy), std::abs(body.potential_energy)});
  }
  return scale;
}

Parts compare_body(const trace::Body& expected, const trace::Body& actual, const BodyScale& scale,
                   const Tolerance& tolerance) {
  Changes changes("body: ", tolerance);
  changes.relative("mass ", expected.mass, actual.mass, expected.mass);
  changes.position("centre of mass ", expected.center_of_mass, actual.center_of_mass);
  changes.relative("velocity ", expected.velocity, actual.velocity, scale.speed);
  changes.relative("angular velocity ", expected.angular_velocity, actual.angular_velocity,
                   scale.spin);
  changes.relative("kinetic energy ", expected.kinetic_energy, actual.kinetic_energy, scale.energy);
  changes.relative("potential energy ", expected.potential_energy, actual.potential_energy,
                   scale.energy);
  Parts parts;
  changes.tell(parts);
  return parts;
}

}  // namespace contactscope::snapshot
