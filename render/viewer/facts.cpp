#include "viewer/facts.h"

#include "core/spell.h"
#include "trace/find.h"
#include "trace/json.h"

namespace contactscope::viewer {
namespace {

using nlohmann::ordered_json;

constexpr double kUnits = 16384;  // steps of a component of a quaternion
constexpr double kCoarser = 4;    // quanta of a point's position, and the same for normals
constexpr double kFiner = 256;    // steps of a separation in one of a position

// Keys of vectors that are no positions: unit ones, and those in newton seconds, metres per second or
// radians.
constexpr std::array kUnitVectors = {"normal", "direction", "axis"};
constexpr std::array kRates = {"friction", "before", "after", "turn"};
constexpr auto is_one_of = [](const std::string& key, const auto& keys) {
  return std::ranges::find(keys, key) != keys.end();
};

/// Diameter of the smallest shape, metres; 1 if no shape is finite.
double smallest_of(const trace::Header& header) {
  double smallest = std::numeric_limits<double>::max();
  for (const trace::Shape& shape : header.shapes) {
    Eigen::AlignedBox3d box;
    for (const Vec3d& vertex : shape.vertices) box.extend(vertex);
    if (box.isEmpty()) continue;
    const double size = box.diagonal().norm() + 2 * (shape.radius + shape.margin);
    if (size > 0) smallest = std::min(smallest, size);
  }
  return smallest == std::numeric_limits<double>::max() ? 1 : smallest;
}

/// The nearest multiple of a step, or one next to it that has the same thousandths, which the page shows.
std::int32_t steps(double value, double step) {
  constexpr double kMax = std::numeric_limits<std::int32_t>::max(), kDigit = 1e-3;
  const double nearest = std::clamp(std::round(value / step), -kMax, kMax);
  if (step < kDigit && std::abs(nearest) < kMax)
    for (const double near : {nearest, nearest + 1, nearest - 1})
      if (std::round(near * step / kDigit) == std::round(value / kDigit))
        return static_cast<std::int32_t>(near);
  return static_cast<std::int32_t>(nearest);
}

/// A float's bits with `kept` of its mantissa's, rounded.
std::int32_t upper_bits(double value, int kept) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(std::min(value, 1e38)));
  return static_cast<std::int32_t>((bits + (1u << (22 - kept))) >> (23 - kept));
}

/// `code` of a positive number, or the one next to it that has the same digits on the page: three, or
/// fewer where `step` is larger than these.
template <class Decoded>
std::int32_t same_digits(double value, double step, std::int32_t code, Decoded decoded) {
  if (!(value > 0) || !std::isfinite(value)) return code;
  const double cell =
      std::pow(10, std::max(std::floor(std::log10(value)) - 2, std::ceil(std::log10(step))));
  for (const std::int32_t near : {code, code + 1, code - 1})
    if (std::round(decoded(near) / cell) == std::round(value / cell)) return near;
  return code;
}

/// Takes a positive number; 0 means that it is not recorded.
std::int32_t float_steps(double value) {
  const auto decoded = [](std::int32_t code) {
    return std::bit_cast<float>(std::uint32_t(code) << 13);
  };
  return same_digits(value, 0, upper_bits(std::max(0.0, value), 10), decoded) + 1;
}

/// Multiples of `step` up to 2048 of them; above, 11 bits after the first one.
std::int32_t fine_steps(double value, double step) {
  const double size = std::abs(value) / step;
  const std::int32_t nearest = size < 2048 ? steps(size, 1) : upper_bits(size, 11) - (137 << 11);
  const std::int32_t code = same_digits(std::abs(value), step, nearest, [&](std::int32_t near) {
    return step *
           (near < 2048 ? near : std::bit_cast<float>(std::uint32_t(near + (137 << 11)) << 12));
  });
  return value < 0 ? -code : code;
}

/// Keeps seven digits of each number, so that floats become short texts.
void shorten(ordered_json& json) {
  if (json.is_number_float()) {
    json = std::strtod(printed("%.7g", json.get<double>()).c_str(), nullptr);
  } else if (json.is_structured()) {
    for (ordered_json& inner : json) shorten(inner);
  }
}

}  // namespace

PackedFacts::PackedFacts(const trace::Header& header)
    : quantum_(std::exp2(std::floor(std::log2(smallest_of(header) / 16384)))),
      fine_(std::min(quantum_, 1 / kUnits) / kFiner) {
  json_ = {{"quantum", quantum_},       {"place", kCoarser * quantum_},
           {"unit", kCoarser / kUnits}, {"fine", fine_},
           {"units", kUnits},           {"header", ordered_json::parse(to_json_line(header))}};
  shorten(json_["header"]);
#define CONTACTSCOPE_NAMED(page, name, count) {#page, k##name},
  json_["fields"] = {CONTACTSCOPE_VIEWER_FIELDS(CONTACTSCOPE_NAMED){"FIELDS", kFields}};
#undef CONTACTSCOPE_NAMED
  for (const char* list : {"frames", "times", "impulses", "pairs", "texts", "forms"})
    json_[list] = ordered_json::array();
  for (const char* object : {"masses", "deformed"}) json_[object] = ordered_json::object();
  for (const char* list : {"poses", "records", "manifolds", "points", "values"}) counts_[list] = 0;
  for (const trace::Shape& shape : header.shapes) bodies_.emplace(shape.name, count_of(bodies_));
  poses_.resize(bodies_.size());
}

void PackedFacts::put(int field, int value, int predicted) {
  at(last_, field).value = predicted;
  coder_.put(field, value, at(last_, field));
}

template <std::size_t N>
void PackedFacts::put_row(int field, const std::array<std::int32_t, N>& now,
                          std::vector<Row<N>>& rows, int place) {
  if (place == count_of(rows)) rows.push_back(place > 0 ? rows.back() : Row<N>{});
  for (int i = 0; i < count_of(now); ++i) coder_.put(field + i, at(now, i), at(at(rows, place), i));
}

int PackedFacts::number_of(const char* list, const std::string& text) {
  const auto [known, is_new] = numbers_.try_emplace({list, text}, count_of(json_[list]));
  if (is_new) json_[list].push_back(text);
  return known->second;
}

PackedFacts::Value PackedFacts::places(const Vec3d& v, double step) const {
  return {steps(v.x(), step), steps(v.y(), step), steps(v.z(), step)};
}

void PackedFacts::add_poses(const trace::Frame& frame) {
  put(kPoses, count_of(frame.poses));
  int next = 0;
  for (const auto& [name, pose] : frame.poses) {
    const int body = bodies_.at(name);
    put(kPoseBody, body, next);
    next = body + 1;
    const Row<7>& last = at(poses_, body);
    const Value position = places(pose.position, quantum_);
    // q and -q are the same rotation.
    const Quatd& q = pose.rotation;
    const Quatd before(last[3].value, last[4].value, last[5].value, last[6].value);
    const double unit = (q.dot(before) < 0 ? -1 : 1) / kUnits;
    const Value axis = places(q.vec(), unit);
    put_row<7>(
        kPose,
        {position[0], position[1], position[2], steps(q.w(), unit), axis[0], axis[1], axis[2]},
        poses_, body);
  }
}

/// Collects the values within stages; what is left is their form, with a field for each.
void PackedFacts::take_leaves(ordered_json& node, const std::string& key,
                              std::vector<Leaf>& leaves) {
  const auto is_number = [](const ordered_json& one) { return one.is_number(); };
  const auto is_float = [](const ordered_json& one) { return one.is_number_float(); };
  if (node.is_array() && node.size() == 3 && std::ranges::all_of(node, is_number) &&
      std::ranges::any_of(node, is_float) && !is_one_of(key, kRates)) {
    const bool is_unit = is_one_of(key, kUnitVectors);
    const Vec3d v(node[0].get<double>(), node[1].get<double>(), node[2].get<double>());
    leaves.push_back(
        {is_unit ? kUnit : kPlace, places(v, kCoarser * (is_unit ? 1 / kUnits : quantum_))});
  } else if (node.is_object()) {
    for (const auto& [name, inner] : node.items()) take_leaves(inner, name, leaves);
    return;
  } else if (node.is_array()) {
    for (ordered_json& inner : node) take_leaves(inner, "", leaves);
    return;
  } else if (node.is_string()) {
    leaves.push_back({kText, {number_of("texts", node)}});
  } else if (node.is_number_integer() && std::abs(node.get<double>()) < 1e9) {
    leaves.push_back({kInteger, {node.get<std::int32_t>()}});
  } else if (node.is_number()) {
    leaves.push_back({kScalar, {fine_steps(node.get<double>(), fine_)}});
  } else {
    return;  // true, false, null
  }
  node = leaves.back().field;
}

void PackedFacts::add_pair(const trace::Pair& pair, ordered_json stages) {
  const std::string key = ordered_json({pair.a, pair.b, pair.label}).dump();
  const auto [number, is_new] = pairs_.emplace(key, count_of(pairs_));
  if (is_new) {
    json_["pairs"].push_back({bodies_.at(pair.a), bodies_.at(pair.b), pair.label, pair.kind});
    known_.emplace_back().follower.value = number->second + 1;
  }
  // The follower of the pair before, and this pair's other last values.
  coder_.put(kPair, number->second, at(known_, previous_).follower);
  previous_ = number->second;
  Known& known = at(known_, previous_);
  std::vector<Leaf> leaves;
  int form = 0;
  if (!stages.empty()) {
    take_leaves(stages, "", leaves);
    form = 1 + number_of("forms", stages.dump());
  }
  std::vector<std::int32_t> layout{pair.state == "touching", form, count_of(pair.manifolds)};
  for (const trace::Manifold& manifold : pair.manifolds) {
    layout.insert(layout.end(),
                  {number_of("texts", manifold.axis), number_of("texts", manifold.type),
                   manifold.triangle.value_or(-1), count_of(manifold.points)});
    for (const trace::Point& point : manifold.points)
      layout.push_back(number_of("texts", point.id));
  }
  const bool is_steady = layout == known.layout;
  coder_.put(kSteady, is_steady, known.steady);
  if (!is_steady) put(kLayoutSize, count_of(layout), count_of(known.layout));
  known.layout.resize(layout.size());
  for (int i = 0; !is_steady && i < count_of(layout); ++i)
    put(kLayout, at(layout, i), at(known.layout, i));
  known.layout = std::move(layout);
  std::map<int, std::vector<Value>> seen;
  int place = 0, row = 0;
  std::int32_t deepest = std::numeric_limits<std::int32_t>::max();
  for (const trace::Manifold& manifold : pair.manifolds) {
    const Value normal = places(manifold.normal, kCoarser / kUnits);
    seen[kUnit].push_back(normal);
    put_row(kNormal, normal, known.normals, row++);
    for (const trace::Point& point : manifold.points) {
      const Value at = places(point.position, kCoarser * quantum_);
      const std::int32_t separation = fine_steps(point.separation, fine_);
      seen[kPlace].push_back(at);
      seen[kScalar].push_back({separation});
      deepest = std::min(deepest, separation);
      put_row<6>(
          kPoint,
          {at[0], at[1], at[2], separation, point.impulse ? float_steps(point.impulse->normal) : 0,
           point.impulse ? float_steps(point.impulse->friction.norm()) : 0},
          known.points, place++);
    }
  }
  if (place > 0) known.gap.value = deepest;
  coder_.put(kPairSeparation, fine_steps(pair.separation, fine_), known.gap);
  std::vector<Row<4>>& last = known.leaves[form];
  for (int i = 0; i < count_of(leaves); ++i) {
    const auto& [field, value] = at(leaves, i);
    std::vector<Value>& known_values = seen[field];
    if (i == count_of(last)) last.emplace_back();
    const auto found = std::ranges::find(known_values, value);
    const int same = found == known_values.end() ? 0 : int(found - known_values.begin()) + 1;
    Row<4>& row_of = at(last, i);
    if (field >= kScalar) coder_.put(kSame, same, row_of[3]);
    if (field >= kScalar && same > 0) continue;
    for (int k = 0; k < (field >= kPlace ? 3 : 1); ++k)
      coder_.put(field + k, at(value, k), at(row_of, k));
    known_values.push_back(value);
  }
  ++counts_["records"];
  counts_["manifolds"] += row;
  counts_["points"] += place;
  counts_["values"] += 3 * count_of(leaves);
}

void PackedFacts::add(const trace::Frame& frame) {
  json_["frames"].push_back(frame.frame);
  json_["times"].push_back(frame.time);
  counts_["poses"] += count_of(frame.poses);
  add_poses(frame);
  if (frame.solver)
    for (const trace::Body& body : frame.solver->bodies)
      json_["masses"].emplace(body.name, body.mass);
  // All that a pair has next to its manifolds is read from JSON.
  trace::Frame other;
  other.pairs = frame.pairs;
  other.deformed = frame.deformed;
  for (trace::Pair& pair : other.pairs) pair.manifolds.clear();
  ordered_json rest = ordered_json::parse(to_json_line(other));
  if (rest.contains("deformed")) {
    shorten(rest["deformed"]);
    json_["deformed"][std::to_string(json_["frames"].size() - 1)] = rest["deformed"];
  }
  double impulse = 0;
  for (const trace::Pair& pair : frame.pairs)
    for (const trace::Point& point : joined(pair.manifolds, &trace::Manifold::points))
      if (point.impulse && point.impulse->normal > 0) impulse += point.impulse->normal;
  json_["impulses"].push_back(impulse);
  shorten(json_["impulses"].back());
  put(kPairs, count_of(frame.pairs), at(last_, kPairs).value);
  for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
    ordered_json& stages = rest["pairs"][i];
    for (const char* key : {"a", "b", "label", "kind", "state", "separation", "manifolds"})
      stages.erase(key);
    for (auto entry = stages.begin(); entry != stages.end();)
      entry = entry->is_null() ? stages.erase(entry) : std::next(entry);
    add_pair(frame.pairs[i], std::move(stages));
  }
}

std::string PackedFacts::bytes(ordered_json page) const {
  page.update(json_);
  page["counts"] = counts_;
  const std::string json = page.dump();
  std::string length;
  for (int i = 0; i < 4; ++i) length += static_cast<char>((json.size() >> (8 * i)) & 0xff);
  return length + json + coder_.bytes();
}

}  // namespace contactscope::viewer
