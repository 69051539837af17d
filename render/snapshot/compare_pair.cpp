#include "snapshot/compare_pair.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "snapshot/compare_stages.h"
#include "snapshot/match.h"

namespace contactscope::snapshot {
namespace {

using Parts = std::vector<std::string>;

/// For a record that may be absent: says "<name> gone" or "<name> added"; true when both are there.
template <class T>
bool both_there(const std::string& name, const std::optional<T>& expected,
                const std::optional<T>& actual, Parts& parts) {
  if (expected && !actual) parts.push_back(name + " gone");
  if (!expected && actual) parts.push_back(name + " added");
  return expected && actual;
}

std::vector<std::string> ids(const std::vector<trace::Point>& points) {
  std::vector<std::string> keys;
  for (const trace::Point& point : points) keys.push_back(point.id);
  return keys;
}

void compare_impulses(const std::optional<trace::Impulse>& expected,
                      const std::optional<trace::Impulse>& actual, double largest,
                      Changes& changes) {
  if (expected && !actual) changes.add("impulse gone");
  if (!expected && actual) changes.add("impulse added");
  if (!expected || !actual) return;
  changes.relative("impulse ", expected->normal, actual->normal, largest);
  changes.relative("friction impulse ", expected->friction, actual->friction, largest);
  changes.relative("warm start ", expected->warm_start, actual->warm_start, largest);
}

void compare_relative_velocities(const std::optional<trace::RelativeVelocity>& expected,
                                 const std::optional<trace::RelativeVelocity>& actual,
                                 double fastest, Changes& changes) {
  if (expected && !actual) changes.add("relative velocity gone");
  if (!expected && actual) changes.add("relative velocity added");
  if (!expected || !actual) return;
  changes.relative("relative velocity ", expected->before, actual->before, fastest);
  changes.relative("relative velocity after the step ", expected->after, actual->after, fastest);
}

/// `noun` is "point", or "reduction: point".
void compare_points(const std::string& noun, const std::vector<trace::Point>& expected,
                    const std::vector<trace::Point>& actual, const Tolerance& tolerance,
                    Parts& parts) {
  Match match = match_keys(ids(expected), ids(actual));
  if (match.reordered()) parts.push_back(noun + "s in another order");
  match_rest_by_index(match);
  const auto name = [&](std::size_t index, const trace::Point& point) {
    return noun + " " + std::to_string(index) + " (" + point.id + ")";
  };
  for (const std::size_t i : match.gone) parts.push_back(name(i, expected[i]) + " gone");
  for (const std::size_t i : match.added) {
    parts.push_back(name(i, actual[i]) + " added at " + spell_vector(actual[i].position));
  }
  double largest = 0;  // newton seconds
  double fastest = 0;  // metres a second
  for (const trace::Point& point : expected) {
    if (point.impulse) largest = std::max(largest, point.impulse->normal);
    if (!point.relative_velocity) continue;
    fastest = std::max(
        {fastest, point.relative_velocity->before.norm(), point.relative_velocity->after.norm()});
  }
  for (const auto& [i, j] : match.both) {
    Changes changes(noun + " " + std::to_string(i) + " ", tolerance);
    changes.position("", expected[i].position, actual[j].position);
    changes.length("separation ", expected[i].separation, actual[j].separation);
    changes.exact("id ", expected[i].id, actual[j].id);
    compare_impulses(expected[i].impulse, actual[j].impulse, largest, changes);
    compare_relative_velocities(expected[i].relative_velocity, actual[j].relative_velocity, fastest,
                                changes);
    changes.tell(parts);
  }
}

void compare_manifolds(const trace::Pair& expected, const trace::Pair& actual,
                       const Tolerance& tolerance, Parts& parts) {
  const auto keys = [](const std::vector<trace::Manifold>& manifolds) {
    std::vector<std::string> triangles;
    for (const trace::Manifold& manifold : manifolds) {
      triangles.push_back(manifold.triangle ? std::to_string(*manifold.triangle) : "");
    }
    return triangles;
  };
  const std::vector<std::string> expected_keys = keys(expected.manifolds);
  const std::vector<std::string> actual_keys = keys(actual.manifolds);
  Match match = match_keys(expected_keys, actual_keys);
  if (match.reordered()) parts.push_back("manifolds in another order");
  match_rest_by_index(match);
  const auto name = [](const std::string& triangle, std::size_t index) {
    if (!triangle.empty()) return "manifold of triangle " + triangle;
    return index == 0 ? std::string("manifold") : "manifold " + std::to_string(index);
  };
  for (const std::size_t i : match.gone) parts.push_back(name(expected_keys[i], i) + " gone");
  for (const std::size_t i : match.added) parts.push_back(name(actual_keys[i], i) + " added");
  const bool several = std::max(expected.manifolds.size(), actual.manifolds.size()) > 1;
  for (const auto& [i, j] : match.both) {
    const trace::Manifold& before = expected.manifolds[i];
    const trace::Manifold& after = actual.manifolds[j];
    const std::string which = several ? name(expected_keys[i], i) + ": " : "";
    Changes changes(which, tolerance);
    changes.direction("normal ", before.normal, after.normal);
    changes.exact("axis ", before.axis, after.axis);
    changes.exact("type ", before.type, after.type);
    changes.exact("triangle ", expected_keys[i], actual_keys[j]);
    changes.tell(parts);
    compare_points(which + "point", before.points, after.points, tolerance, parts);
  }
}

void compare_face_axis(const std::string& name, const std::optional<trace::FaceAxis>& expected,
                       const std::optional<trace::FaceAxis>& actual, const Tolerance& tolerance,
                       Parts& parts) {
  if (!both_there(name, expected, actual, parts)) return;
  Changes changes(name + ": ", tolerance);
  changes.exact("face ", expected->face, actual->face);
  changes.length("separation ", expected->separation, actual->separation);
  changes.direction("normal ", expected->normal, actual->normal);
  changes.position("support point ", expected->support, actual->support);
  changes.tell(parts);
}

void compare_sat(const trace::Sat& expected, const trace::Sat& actual, const Tolerance& tolerance,
                 Parts& parts) {
  Changes choice("sat: ", tolerance);
  choice.exact("chosen ", expected.chosen, actual.chosen);
  choice.exact("preference ", expected.preference, actual.preference);
  choice.tell(parts);
  compare_face_axis("sat face_a", expected.face_a, actual.face_a, tolerance, parts);
  compare_face_axis("sat face_b", expected.face_b, actual.face_b, tolerance, parts);
  compare_edge_pairs(expected.edge_pairs, actual.edge_pairs, tolerance, parts);
  if (!both_there("sat edge", expected.edge, actual.edge, parts)) return;
  Changes edge("sat edge: ", tolerance);
  edge.exact("edge of a ", expected.edge->a, actual.edge->a);
  edge.exact("edge of b ", expected.edge->b, actual.edge->b);
  edge.length("separation ", expected.edge->separation, actual.edge->separation);
  edge.direction("normal ", expected.edge->normal, actual.edge->normal);
  edge.position("point on a ", expected.edge->point_a, actual.edge->point_a);
  edge.position("point on b ", expected.edge->point_b, actual.edge->point_b);
  edge.tell(parts);
}

void compare_clip_face(const std::string& name, const trace::ClipFace& expected,
                       const trace::ClipFace& actual, const Tolerance& tolerance, Parts& parts) {
  Changes changes(name + ": ", tolerance);
  changes.exact("shape ", expected.shape, actual.shape);
  changes.exact("face ", expected.face, actual.face);
  changes.direction("normal ", expected.normal, actual.normal);
  changes.vertices(expected.polygon, actual.polygon);
  changes.tell(parts);
}

void compare_clip(const trace::Clip& expected, const trace::Clip& actual,
                  const Tolerance& tolerance, Parts& parts) {
  compare_clip_face("reference face", expected.reference, actual.reference, tolerance, parts);
  compare_clip_face("incident face", expected.incident, actual.incident, tolerance, parts);
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  Changes counts("clip: ", tolerance);
  counts.exact("number of side planes ", count(expected.steps), count(actual.steps));
  counts.exact("number of dropped points ", count(expected.dropped), count(actual.dropped));
  counts.tell(parts);
  for (std::size_t i = 0; i < std::min(expected.steps.size(), actual.steps.size()); ++i) {
    Changes changes("clip step " + std::to_string(i) + ": ", tolerance);
    changes.direction("normal ", expected.steps[i].normal, actual.steps[i].normal);
    changes.length("offset ", expected.steps[i].offset, actual.steps[i].offset);
    changes.vertices(expected.steps[i].polygon, actual.steps[i].polygon);
    changes.tell(parts);
  }
  for (std::size_t i = 0; i < std::min(expected.dropped.size(), actual.dropped.size()); ++i) {
    Changes changes("dropped point " + std::to_string(i) + " ", tolerance);
    changes.position("", expected.dropped[i].position, actual.dropped[i].position);
    changes.exact("reason ", expected.dropped[i].reason, actual.dropped[i].reason);
    changes.tell(parts);
  }
}

void compare_cache(const trace::Cache& expected, const trace::Cache& actual,
                   const Tolerance& tolerance, Parts& parts) {
  const auto spell = [](const trace::Cache& cache) {
    return std::string(cache.hit ? "hit" : "miss") + " of " + cache.kind + ", " + cache.axis;
  };
  Changes changes("cache: ", tolerance);
  changes.exact("", spell(expected), spell(actual));
  if (expected.normal && actual.normal)
    changes.direction("normal ", *expected.normal, *actual.normal);
  if (expected.moved && actual.moved) changes.length("moved ", *expected.moved, *actual.moved);
  changes.tell(parts);
}

void compare_reduction(const trace::Reduction& expected, const trace::Reduction& actual,
                       const Tolerance& tolerance, Parts& parts) {
  Changes changes("reduction: ", tolerance);
  changes.exact("method ", expected.method, actual.method);
  changes.exact("kept ", spell_list(expected.kept), spell_list(actual.kept));
  changes.area("area ", expected.area, actual.area);
  changes.area("best area ", expected.best_area, actual.best_area);
  changes.tell(parts);
  compare_points("reduction point", expected.points, actual.points, tolerance, parts);
}

void compare_gjk(const trace::Gjk& expected, const trace::Gjk& actual, const Tolerance& tolerance,
                 Parts& parts) {
  Changes changes("gjk: ", tolerance);
  changes.exact("status ", expected.status, actual.status);
  changes.exact("iterations ", expected.iterations, actual.iterations);
  changes.length("distance ", expected.distance, actual.distance);
  changes.position("point on a ", expected.point_a, actual.point_a);
  changes.position("point on b ", expected.point_b, actual.point_b);
  for (std::size_t i = 0; i < std::min(expected.steps.size(), actual.steps.size()); ++i) {
    const auto points = [](const trace::Simplex& simplex) {
      std::vector<Vec3d> all;
      for (const trace::SimplexVertex& vertex : simplex)
        all.insert(all.end(), {vertex.a, vertex.b});
      return all;
    };
    changes.vertices(points(expected.steps[i]), points(actual.steps[i]));
  }
  changes.tell(parts);
}

void compare_tree(const trace::Tree& expected, const trace::Tree& actual,
                  const Tolerance& tolerance, Parts& parts) {
  Changes changes("tree: ", tolerance);
  changes.exact("of ", expected.shape, actual.shape);
  changes.position("lower corner of the box ", expected.box.lower, actual.box.lower);
  changes.position("upper corner of the box ", expected.box.upper, actual.box.upper);
  changes.exact("number of boxes ", static_cast<int>(expected.visits.size()),
                static_cast<int>(actual.visits.size()));
  changes.exact("candidates ", spell_list(expected.candidates), spell_list(actual.candidates));
  changes.tell(parts);
}

}  // namespace

std::vector<std::string> compare_pair(const trace::Pair& expected, const trace::Pair& actual,
                                      const Tolerance& tolerance) {
  Parts parts;
  Changes pair("", tolerance);
  pair.exact("", expected.state, actual.state);
  pair.exact("kind ", expected.kind, actual.kind);
  pair.length("separation ", expected.separation, actual.separation);
  // A separation that only repeats what a point's says is told after the points.
  const bool state_changed = expected.state != actual.state || expected.kind != actual.kind;
  if (state_changed) pair.tell(parts);
  compare_manifolds(expected, actual, tolerance, parts);
  if (!state_changed) pair.tell(parts);
  if (both_there("degenerate", expected.degenerate, actual.degenerate, parts)) {
    Changes changes("degenerate: ", tolerance);
    changes.exact("geometry ", expected.degenerate->geometry, actual.degenerate->geometry);
    changes.exact("answer ", expected.degenerate->answer, actual.degenerate->answer);
    changes.tell(parts);
  }
  if (both_there("gjk", expected.gjk, actual.gjk, parts)) {
    compare_gjk(*expected.gjk, *actual.gjk, tolerance, parts);
  }
  if (both_there("tree", expected.tree, actual.tree, parts)) {
    compare_tree(*expected.tree, *actual.tree, tolerance, parts);
  }
  if (both_there("cache", expected.cache, actual.cache, parts)) {
    compare_cache(*expected.cache, *actual.cache, tolerance, parts);
  }
  if (both_there("sat", expected.sat, actual.sat, parts)) {
    compare_sat(*expected.sat, *actual.sat, tolerance, parts);
  }
  if (both_there("clip", expected.clip, actual.clip, parts)) {
    compare_clip(*expected.clip, *actual.clip, tolerance, parts);
  }
  if (both_there("reduction", expected.reduction, actual.reduction, parts)) {
    compare_reduction(*expected.reduction, *actual.reduction, tolerance, parts);
  }
  if (both_there("penetration", expected.penetration, actual.penetration, parts)) {
    compare_penetration(*expected.penetration, *actual.penetration, tolerance, parts);
  }
  if (both_there("minkowski", expected.minkowski, actual.minkowski, parts)) {
    compare_minkowski(*expected.minkowski, *actual.minkowski, tolerance, parts);
  }
  if (both_there("incremental", expected.incremental, actual.incremental, parts)) {
    compare_incremental(*expected.incremental, *actual.incremental, tolerance, parts);
  }
  if (both_there("stability", expected.stability, actual.stability, parts)) {
    compare_stability(*expected.stability, *actual.stability, tolerance, parts);
  }
  return parts;
}

}  // namespace contactscope::snapshot
