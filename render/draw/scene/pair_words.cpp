#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kMarginal = 0.05;  // share of the size of the support

constexpr std::size_t kManyManifolds = 30;
constexpr std::size_t kManyPairs = 12;  // fewer, as with a mesh, are not a heap

using PairKey = std::tuple<std::string_view, std::string_view, std::string_view>;

PairKey key_of(const trace::Pair& pair) { return {pair.a, pair.b, pair.label}; }

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

PairState state_of(const trace::Pair& pair, double touching) {
  const auto has_points = [](const trace::Manifold& manifold) { return !manifold.points.empty(); };
  // A pair with points is not separated, whatever an engine's trace says: titles count its points.
  if (pair.state == "separated" && std::ranges::none_of(pair.manifolds, has_points))
    return pair.separation < 0 ? PairState::Skipped : PairState::Separation;
  return pair.separation > touching ? PairState::WithinMargin : PairState::Touching;
}

std::string spell_state(PairState state) {
  switch (state) {
    case PairState::Separation:
      return "apart";
    case PairState::WithinMargin:
      return "within the margin";
    case PairState::Touching:
      return "touching";
    case PairState::Skipped:
      break;
  }
  return "overlap, contact skipped";
}

const char* gap_or_overlap(double separation) { return separation > 0 ? "gap" : "overlap"; }

std::string spell_separation(double separation, double noise, const LengthUnit& unit) {
  return std::string(gap_or_overlap(separation)) + " " +
         spell_length(std::abs(separation), noise, unit);
}

std::string spell_axis(const std::string& axis) {
  if (axis == "face_a") return "face of A";
  if (axis == "face_b") return "face of B";
  if (axis == "edge_edge") return "edges of A and B";
  if (axis == "closest_points") return "closest points";
  return axis;
}

std::string spell_features(const std::string& type) {
  const std::size_t dash = type.find('-');
  if (dash == std::string::npos) return type;
  return type.substr(0, dash) + " on " + type.substr(dash + 1);
}

std::string in_words(std::string_view code) {
  // Phrases where the code alone is not clear enough.
  constexpr std::pair<std::string_view, std::string_view> kPhrases[] = {
      {"optimal", "best area"},
      {"optimal_deepest", "best area with the deepest"},
      {"area_deepest", "area, the deepest first"}};
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"gjk", "GJK"},     {"epa", "EPA"},       {"mpr", "MPR"},     {"sat", "SAT"},
      {"aabb", "AABB"},   {"obb", "OBB"},       {"bvh", "BVH"},     {"sdf", "SDF"},
      {"ode", "ODE"},     {"mjx", "MJX"},       {"jolt", "Jolt"},   {"bullet", "Bullet"},
      {"physx", "PhysX"}, {"newton", "Newton"}, {"dart", "DART"},   {"mujoco", "MuJoCo"},
      {"box3d", "Box3D"}, {"rapier", "Rapier"}, {"parry", "Parry"}, {"fcl", "FCL"}};
  for (const auto& [phrase, words] : kPhrases)
    if (code == phrase) return std::string(words);
  std::string text;
  while (!code.empty()) {
    const std::size_t end = std::min(code.find_first_of("_ "), code.size());
    std::string_view word = code.substr(0, end);
    for (const auto& [known, name] : kNames)
      if (word == known) word = name;
    text += word;
    if (end < code.size()) text += ' ';
    code.remove_prefix(std::min(end + 1, code.size()));
  }
  return text;
}

Balance balance_of(const trace::Stability& stability) {
  if (stability.verdict == "no contact") return Balance::NoContact;
  if (stability.verdict != "stable") return Balance::Unstable;
  double reach = 0;
  for (const Vec3d& corner : stability.support)
    reach = std::max(reach, (corner - stability.support.front()).norm());
  return stability.margin < kMarginal * reach ? Balance::Marginal : Balance::Stable;
}

std::string spell_balance(Balance balance) {
  switch (balance) {
    case Balance::Stable:
      return "stable";
    case Balance::Marginal:
      return "marginal";
    case Balance::Unstable:
      return "unstable";
    case Balance::NoContact:
      break;
  }
  return "no contact";
}

double smaller_radius(const trace::Pair& pair, const ShapeMeshes& meshes) {
  double smaller = std::numeric_limits<double>::infinity();
  for (const std::string* name : {&pair.a, &pair.b})
    if (const auto place = meshes.find(*name); place && meshes[*place].radius > 0)
      smaller = std::min(smaller, meshes[*place].radius);
  return smaller;
}

std::optional<double> separation_of(const trace::Pair& pair) {
  if (pair.query) return pair.query->gap;
  if (pair.separation != 0) return pair.separation;
  const trace::Point* const deepest = trace::deepest_point(pair);
  return deepest != nullptr ? std::optional(deepest->separation) : std::nullopt;
}

std::optional<PairPoint> deepest_contact(const trace::Pair& pair) {
  std::optional<PairPoint> deepest;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points)
      if (!deepest || point.separation < deepest->point->separation)
        deepest = PairPoint{&manifold, &point};
  return deepest;
}

ContactCounts count_contacts(const trace::Frame& frame) {
  ContactCounts counts;
  for (const trace::Pair& pair : frame.pairs) {
    const std::size_t before = counts.points;
    for (const trace::Manifold& manifold : pair.manifolds) {
      counts.manifolds += !manifold.points.empty();
      counts.points += manifold.points.size();
    }
    counts.pairs += counts.points > before;
  }
  return counts;
}

bool is_heap(const trace::Frame& frame) {
  const ContactCounts counts = count_contacts(frame);
  return counts.manifolds > kManyManifolds && counts.pairs > kManyPairs;
}

std::vector<RankedPair> ranked_pairs(const trace::Frame& frame, Rank by, std::size_t most,
                                     const ShapeMeshes& meshes, const trace::Frame* before) {
  std::map<PairKey, double> last;
  if (by == Rank::Change) {
    if (before == nullptr) return {};
    for (const trace::Pair& pair : before->pairs) last.emplace(key_of(pair), overlap_of(pair));
  }
  std::vector<RankedPair> ranked;
  for (const trace::Pair& pair : frame.pairs) {
    double value = by == Rank::Impulse ? impulse_of(pair) : overlap_of(pair);
    if (by == Rank::Worst) value /= smaller_radius(pair, meshes);
    if (by == Rank::Change) {
      const auto known = last.find(key_of(pair));
      value = std::abs(value - (known == last.end() ? 0 : known->second));
    }
    if (value > 0) ranked.push_back({&pair, value});
  }
  most = std::min(most, ranked.size());
  // Stable: equal values keep the order of the file.
  std::ranges::stable_sort(ranked, std::ranges::greater(), &RankedPair::value);
  ranked.resize(most);
  return ranked;
}

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
