#include "viewer/facts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/at.h"
#include "core/spell.h"
#include "trace/find.h"
#include "trace/json.h"

namespace contactscope::viewer {
namespace {

using nlohmann::ordered_json;

constexpr double kUnits = 16384;  // steps of a component of a unit vector or quaternion
constexpr double kFiner = 256;    // steps of a separation in one of a position
constexpr int kDroppedBits = 11;  // of a float

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

std::int32_t steps(double value, double step) {
  constexpr double kMax = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round(value / step), -kMax, kMax));
}

/// Takes a positive number; 0 means that it is not recorded.
std::int32_t float_steps(double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(std::max(0.0, value)));
  return static_cast<std::int32_t>(bits >> kDroppedBits) + 1;
}

/// Keeps seven digits of each number, so that floats become short texts.
void shorten(ordered_json& json) {
  if (json.is_number_float()) {
    json = std::strtod(printed("%.7g", json.get<double>()).c_str(), nullptr);
  } else if (json.is_structured()) {
    for (ordered_json& inner : json) shorten(inner);
  }
}

ordered_json shortened(const std::string& line) {
  ordered_json json = ordered_json::parse(line);
  shorten(json);
  return json;
}

}  // namespace

PackedFacts::PackedFacts(const trace::Header& header)
    : quantum_(std::exp2(std::floor(std::log2(smallest_of(header) / 16384)))) {
  json_ = {{"quantum", quantum_}, {"units", kUnits}, {"header", shortened(to_json_line(header))}};
  for (const char* list : {"frames", "times", "pairs", "texts", "stages"})
    json_[list] = ordered_json::array();
  for (const char* object : {"masses", "deformed"}) json_[object] = ordered_json::object();
  for (const trace::Shape& shape : header.shapes) bodies_.emplace(shape.name, count_of(bodies_));
  last_poses_.resize(bodies_.size());
}

void PackedFacts::put(int column, std::int32_t value, std::int32_t predicted) {
  auto& [bytes, count] = at(columns_, column);
  // Wraps around on overflow, as in JavaScript.
  const std::uint32_t difference =
      static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(predicted);
  std::uint32_t rest = (difference << 1) ^ (difference >> 31 != 0 ? ~std::uint32_t{0} : 0);
  for (; rest > 0x7f; rest >>= 7) bytes += static_cast<char>(0x80 | (rest & 0x7f));
  bytes += static_cast<char>(rest);
  ++count;
}

template <std::size_t N> void PackedFacts::put_row(int first, const Row<N>& now, Row<N>& last) {
  for (int i = 0; i < count_of(now); ++i) put(first + i, at(now, i), at(last, i));
  last = now;
}

int PackedFacts::number_of(const std::string& text) {
  const auto [known, is_new] = texts_.emplace(text, count_of(texts_));
  if (is_new) json_["texts"].push_back(text);
  return known->second;
}

void PackedFacts::add_poses(const trace::Frame& frame) {
  put(kPoses, count_of(frame.poses));
  int next = 0;
  for (const auto& [name, pose] : frame.poses) {
    const int body = bodies_.at(name);
    put(kPoseBody, body, next);
    next = body + 1;
    Row<7>& last = at(last_poses_, body);
    Row<7> now;
    for (int i = 0; i < 3; ++i) at(now, i) = steps(pose.position[i], quantum_);
    // q and -q are the same rotation.
    const Quatd& q = pose.rotation;
    const Quatd before(last[3], last[4], last[5], last[6]);
    const double unit = (q.dot(before) < 0 ? -1 : 1) / kUnits;
    now[3] = steps(q.w(), unit);
    for (int i = 0; i < 3; ++i) at(now, 4 + i) = steps(q.vec()[i], unit);
    put_row(kPose, now, last);
  }
}

void PackedFacts::add_pair(const trace::Pair& pair, const ordered_json& stages) {
  const std::string key = ordered_json({pair.a, pair.b, pair.label}).dump();
  const auto [known, is_new] = pairs_.emplace(key, count_of(pairs_));
  if (is_new) {
    json_["pairs"].push_back({bodies_.at(pair.a), bodies_.at(pair.b), pair.label, pair.kind});
    last_points_.emplace_back();
    last_normals_.emplace_back();
  }
  put(kPair, known->second);
  put(kPairState, pair.state == "touching");
  if (!stages.empty()) json_["stages"].push_back(stages);
  put(kPairStages, stages.empty() ? 0 : count_of(json_["stages"]));
  put(kManifolds, count_of(pair.manifolds));
  std::vector<Row<7>>& last = at(last_points_, known->second);
  int place = 0;
  for (const trace::Manifold& manifold : pair.manifolds) {
    Row<3> normal;
    for (int i = 0; i < 3; ++i) at(normal, i) = steps(manifold.normal[i], 1 / kUnits);
    put_row(kNormal, normal, at(last_normals_, known->second));
    put(kAxis, number_of(manifold.axis));
    put(kType, number_of(manifold.type));
    put(kTriangle, manifold.triangle.value_or(-1));
    put(kPoints, count_of(manifold.points));
    for (const trace::Point& point : manifold.points) {
      if (place == count_of(last)) last.push_back(place > 0 ? last.back() : Row<7>{});
      Row<7> now{};
      for (int i = 0; i < 3; ++i) at(now, i) = steps(point.position[i], quantum_);
      now[3] = steps(point.separation, quantum_ / kFiner);
      if (point.impulse) now[4] = float_steps(point.impulse->normal);
      if (point.impulse) now[5] = float_steps(point.impulse->friction.norm());
      now[6] = number_of(point.id);
      put_row(kPoint, now, at(last, place++));
    }
  }
  const trace::Point* deepest = deepest_point(pair);
  put(kPairSeparation, steps(pair.separation, quantum_ / kFiner),
      deepest != nullptr ? steps(deepest->separation, quantum_ / kFiner) : 0);
}

void PackedFacts::add(const trace::Frame& frame) {
  json_["frames"].push_back(frame.frame);
  json_["times"].push_back(frame.time);
  add_poses(frame);
  if (frame.solver)
    for (const trace::Body& body : frame.solver->bodies)
      json_["masses"].emplace(body.name, body.mass);
  // All that a pair has next to its manifolds stays JSON.
  trace::Frame other;
  other.pairs = frame.pairs;
  other.deformed = frame.deformed;
  for (trace::Pair& pair : other.pairs) pair.manifolds.clear();
  ordered_json rest = shortened(to_json_line(other));
  if (rest.contains("deformed"))
    json_["deformed"][std::to_string(json_["frames"].size() - 1)] = rest["deformed"];
  put(kPairs, count_of(frame.pairs));
  for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
    ordered_json& stages = rest["pairs"][i];
    for (const char* key : {"a", "b", "label", "kind", "state", "separation", "manifolds"})
      stages.erase(key);
    for (auto entry = stages.begin(); entry != stages.end();)
      entry = entry->is_null() ? stages.erase(entry) : std::next(entry);
    add_pair(frame.pairs[i], stages);
  }
}

std::string PackedFacts::bytes(ordered_json page) const {
  page.update(json_);
  page["columns"] = ordered_json::array();
  std::string data;
  for (const Column& column : columns_) {
    page["columns"].push_back({column.count, column.bytes.size()});
    data += column.bytes;
  }
  const std::string json = page.dump();
  std::string length;
  for (int i = 0; i < 4; ++i) length += static_cast<char>((json.size() >> (8 * i)) & 0xff);
  return length + json + data;
}

}  // namespace contactscope::viewer
