#include "draw/scene/answers.h"

#include <algorithm>

#include "draw/scene/pair_words.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

std::string things_of(const trace::Query& query) {
  if (query.bounds == "aabb") return "the axis-aligned boxes";
  if (query.bounds == "obb") return "the oriented boxes";
  if (query.bounds == "sphere") return "the bounding spheres";
  return "the shapes";
}

/// "gap 120 mm", "overlap 3.00 mm".
std::string spell_gap(double gap, const LengthUnit& unit) {
  if (gap == 0) return "they touch";
  return spell_separation(gap, 0, unit);
}

/// Containment of two meshes whose surfaces do not cross.
std::string spell_containment(const trace::Pair& pair, const trace::Containment& containment) {
  if (containment.a == "open" || containment.b == "open") {
    const std::string open = containment.a == "open" ? pair.a : pair.b;
    return ": no triangles cross, and " + open + " has holes, so that nothing is inside it";
  }
  if (containment.a == "inside") return ": " + pair.a + " is inside " + pair.b;
  if (containment.b == "inside") return ": " + pair.b + " is inside " + pair.a;
  return ": no triangles cross, and neither is inside the other";
}

/// Number of intersecting triangle pairs; without an overlap the meshes only touch.
std::string spell_intersections(const trace::Pair& pair) {
  const std::size_t count = pair.intersections.size();
  const std::string text = ": " + counted(count, "pair of triangles ", "pairs of triangles ");
  if (!pair.overlap.value_or(false))
    return text + (count == 1 ? "touches" : "touch") + ", none cross";
  return text + (count == 1 ? "meets" : "meet");
}

std::string reason_of(const trace::Pair& pair, const LengthUnit& unit) {
  const trace::Query& query = *pair.query;
  if (answer_kind(pair) == AnswerKind::FalsePositive) {
    const auto& gap = query.shapes->gap;
    return ", though the shapes are " + (gap ? spell_length(*gap, 0, unit) + " " : std::string()) +
           "apart: a false positive";
  }
  if (answer_kind(pair) == AnswerKind::Missed) return ", though the shapes overlap: a miss";
  if (query.containment) return spell_containment(pair, *query.containment);
  if (!pair.intersections.empty()) return spell_intersections(pair);
  return query.gap ? ", " + spell_gap(*query.gap, unit) : "";
}

}  // namespace

AnswerKind answer_kind(const trace::Pair& pair) {
  const trace::Query& query = *pair.query;
  const bool overlap = pair.overlap.value_or(false);
  if (!overlap && query.shapes && query.shapes->overlap) return AnswerKind::Missed;
  if (!query.touching.value_or(overlap)) return AnswerKind::No;
  return query.shapes && !query.shapes->overlap ? AnswerKind::FalsePositive : AnswerKind::Yes;
}

Color answer_color(AnswerKind kind) {
  return is_wrong(kind) ? kText : kind == AnswerKind::Yes ? kBox : kDropped;
}

std::string spell_question(const trace::Query& query) {
  const std::string things = things_of(query);
  if (query.requested == "distance") return "how far apart are " + things + "?";
  if (query.requested == "penetration") return "how deep are " + things + " in each other?";
  const std::string verb = query.requested == "touching" ? " touch" : " overlap";
  const std::string compared = query.tolerance > 0 ? ", within " + spell_length(query.tolerance)
                               : query.requested == "touching"   ? ""
                               : query.comparison == "exclusive" ? ", touching left out"
                               : query.comparison == "proper"    ? ", properly"
                                                                 : ", touching included";
  return "do " + things + verb + compared + "?";
}

std::string spell_answer(const trace::Pair& pair, const LengthUnit& unit) {
  const trace::Query& query = *pair.query;
  const bool overlap = pair.overlap.value_or(false);
  if (query.requested == "distance" || query.requested == "penetration") {
    const std::string none = spell_length(0, 0, unit);
    if (!query.gap) return overlap ? none + ": they overlap" : "not known";
    if (*query.gap == 0) return none + ": they touch";
    if (query.requested == "distance" && *query.gap < 0) return none + ": they overlap";
    return spell_gap(*query.gap, unit);
  }
  return (query.touching.value_or(overlap) ? "yes" : "no") + reason_of(pair, unit);
}

std::string spell_answer_kind(AnswerKind kind) {
  const bool yes = kind == AnswerKind::Yes || kind == AnswerKind::FalsePositive;
  return std::string(yes ? "yes" : "no") + (is_wrong(kind) ? ", falsely" : "");
}

std::string label_with_answer(const trace::Pair& pair) {
  return pair.label + ": " + spell_answer_kind(answer_kind(pair));
}

std::string spell_axis(const trace::Query& query, const trace::TestedAxis& axis) {
  const auto named = [](int k) { return std::string(1, "xyz"[std::clamp(k, 0, 2)]); };
  if (query.bounds == "aabb") return named(axis.a);
  const std::string of_a = "A's " + named(axis.a), of_b = "B's " + named(axis.b);
  if (axis.kind == "face_a") return of_a;
  if (axis.kind == "face_b") return of_b;
  if (axis.kind == "edges") return of_a + " × " + of_b;
  return "middle to middle";
}

std::vector<Vec3d> extent_points(const trace::Volume& volume) {
  std::vector<Vec3d> points;
  if (volume.half_extents) {
    const Quatd turn = volume.rotation.value_or(Quatd::Identity());
    for (int bits = 0; bits < 8; ++bits) {
      const Vec3d signs(bits & 1 ? 1 : -1, bits & 2 ? 1 : -1, bits & 4 ? 1 : -1);
      points.push_back(volume.center + turn * Vec3d(signs.cwiseProduct(*volume.half_extents)));
    }
  }
  for (int k = 0; volume.radius && k < 3; ++k)
    for (const double side : {-1.0, 1.0})
      points.push_back(volume.center + side * *volume.radius * Vec3d::Unit(k));
  return points;
}

}  // namespace contactscope::draw
