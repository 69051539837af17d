#include "snapshot/compare_trace.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "snapshot/compare_pair.h"
#include "snapshot/compare_stages.h"
#include "snapshot/match.h"

namespace contactscope::snapshot {
namespace {

using trace::Trace;
using Parts = std::vector<std::string>;

// The C library's sine and cosine differ in the last place between processors. Such a pose moves by
// up to one unit of its coordinates; two of them and the way back to world space make four.
constexpr double kPlaceUlps = 4;
// The same unit in a quaternion turns a shape by up to two units of its extent, and each stage
// after that (query, clip, area) rounds anew. Twice the largest sum of those we could count.
constexpr double kExtentUlps = 16;
// A polygon within the extent has a perimeter of at most eight, and so many lengths' worth of area.
constexpr double kPerimeter = 8;

double largest_coordinate(const std::vector<Vec3d>& points) {
  double largest = 0;
  for (const Vec3d& point : points) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Largest local coordinate of a shape. A plane reaches everywhere; what rounds there is its offset.
double extent(const trace::Shape& shape) {
  if (shape.half_space) return std::abs(shape.half_space->offset);
  return largest_coordinate(shape.vertices) + shape.radius;
}

/// What tolerances are derived from: the expected trace alone, so that nothing wild in the actual
/// one can excuse itself.
class Scale {
 public:
  explicit Scale(const trace::Header& header)
      : ulp_(std::ldexp(1.0, header.scalar == "double" ? -52 : -23)) {
    for (const trace::Shape& shape : header.shapes) {
      extents_[shape.name] = extent(shape);
    }
  }

  /// For one shape, or the larger of two, in a frame.
  Tolerance tolerance(const trace::Frame& frame, const std::string& a, const std::string& b) const {
    const double extent = std::max(extent_of(a), extent_of(b));
    double place = 0;
    for (const auto& [name, pose] : frame.poses) {
      if (name != a && name != b) continue;
      place = std::max(place, pose.position.lpNorm<Eigen::Infinity>());
    }
    return make(place, extent);
  }
  /// For a shape in its own frame.
  Tolerance tolerance(const std::string& shape) const { return make(0, extent_of(shape)); }

 private:
  double extent_of(const std::string& shape) const {
    const auto found = extents_.find(shape);
    return found == extents_.end() ? 0 : found->second;
  }
  Tolerance make(double place, double extent) const {
    const double local = kExtentUlps * extent * ulp_;
    return {kPlaceUlps * place * ulp_ + local, kExtentUlps * ulp_, kPerimeter * extent * local};
  }

  double ulp_;
  std::map<std::string, double> extents_;  // metres, largest local coordinate
};

/// The sentences of one frame.
class Sentences {
 public:
  explicit Sentences(std::string place) : place_(std::move(place)) {}

  void add(const std::string& subject, const std::string& what) {
    ++count_;
    if (count_ > kMostSentences) return;
    texts_.push_back(place_ + (subject.empty() ? "" : ", " + subject) + ": " + what);
  }
  void add(const std::string& subject, const Parts& parts) {
    for (const std::string& part : parts) add(subject, part);
  }
  void append_to(std::vector<std::string>& all) const {
    all.insert(all.end(), texts_.begin(), texts_.end());
    if (count_ > kMostSentences) {
      all.push_back(place_ + ": and " + std::to_string(count_ - kMostSentences) + " more");
    }
  }

 private:
  std::string place_;
  int count_ = 0;
  Parts texts_;
};

/// Matches the entries of two lists by key, and says what is gone, added or in another order.
template <class List, class Key>
Match match_entries(const List& expected, const List& actual, const std::string& plural, Key key,
                    Sentences& sentences) {
  Parts expected_keys, actual_keys;
  for (const auto& entry : expected) expected_keys.push_back(key(entry));
  for (const auto& entry : actual) actual_keys.push_back(key(entry));
  const Match match = match_keys(expected_keys, actual_keys);
  for (const std::size_t i : match.gone) sentences.add(expected_keys[i], "gone");
  for (const std::size_t i : match.added) sentences.add(actual_keys[i], "added");
  if (match.reordered()) sentences.add("", plural + " in another order");
  return match;
}

template <class Lists>
std::string first_difference(const std::string& noun, const Lists& expected, const Lists& actual) {
  if (expected.size() != actual.size()) {
    return std::to_string(expected.size()) + " -> " + std::to_string(actual.size()) + " " + noun +
           "s";
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == actual[i]) continue;
    return noun + " " + std::to_string(i) + " " +
           spell_change(spell_list(expected[i]), spell_list(actual[i]));
  }
  return {};
}

Parts compare_shape(const trace::Shape& expected, const trace::Shape& actual,
                    const Tolerance& tolerance) {
  Parts parts;
  Changes changes("", tolerance);
  changes.exact("type ", expected.type, actual.type);
  changes.vertices(expected.vertices, actual.vertices);
  changes.position("centre of mass ", expected.center_of_mass, actual.center_of_mass);
  changes.length("radius ", expected.radius, actual.radius);
  const trace::HalfSpace none{Vec3d::Zero(), 0};
  const trace::HalfSpace before = expected.half_space.value_or(none);
  const trace::HalfSpace after = actual.half_space.value_or(none);
  changes.direction("normal ", before.normal, after.normal);
  changes.length("offset ", before.offset, after.offset);
  for (const std::string& difference : {first_difference("face", expected.faces, actual.faces),
                                        first_difference("edge", expected.edges, actual.edges)}) {
    if (!difference.empty()) changes.add(difference);
  }
  changes.tell(parts);
  return parts;
}

void compare_headers(const trace::Header& expected, const trace::Header& actual, const Scale& scale,
                     Sentences& sentences) {
  Changes changes("", Tolerance{});
  changes.exact("scenario ", expected.scenario, actual.scenario);
  changes.exact("title ", expected.title, actual.title);
  changes.exact("source ", expected.source, actual.source);
  changes.exact("scalar ", expected.scalar, actual.scalar);
  changes.exact("up ", expected.up, actual.up);
  changes.exact("frames ", expected.frames, actual.frames);
  Parts parts;
  changes.tell(parts);
  sentences.add("", parts);
  const Match match = match_entries(
      expected.shapes, actual.shapes, "shapes",
      [](const trace::Shape& shape) { return shape.name; }, sentences);
  for (const auto& [i, j] : match.both) {
    const trace::Shape& shape = expected.shapes[i];
    sentences.add(shape.name, compare_shape(shape, actual.shapes[j], scale.tolerance(shape.name)));
  }
}

Parts compare_pose(const Pose<double>& expected, const Pose<double>& actual,
                   const Tolerance& tolerance) {
  Parts parts;
  Changes changes("", tolerance);
  changes.position("", expected.position, actual.position);
  // q and -q are the same rotation.
  const double sign = expected.rotation.dot(actual.rotation) < 0 ? -1 : 1;
  const Eigen::Vector4d turned = sign * actual.rotation.coeffs();
  for (int i = 0; i < 4; ++i) {
    if (same(expected.rotation.coeffs()[i], turned[i], tolerance.direction)) continue;
    const Quatd turn = actual.rotation * expected.rotation.conjugate();
    changes.add("turned by " + spell_angle(2 * std::atan2(turn.vec().norm(), std::abs(turn.w()))));
    break;
  }
  changes.tell(parts);
  return parts;
}

std::string pair_name(const trace::Pair& pair) {
  return pair.a + "-" + pair.b + (pair.label.empty() ? "" : " (" + pair.label + ")");
}

void compare_solvers(const trace::Frame& expected, const trace::Frame& actual, const Scale& scale,
                     Sentences& sentences) {
  if (expected.solver && !actual.solver) sentences.add("", "solver gone");
  if (!expected.solver && actual.solver) sentences.add("", "solver added");
  if (!expected.solver || !actual.solver) return;
  Parts settings;
  compare_solver(*expected.solver, *actual.solver, settings);
  sentences.add("", settings);
  const std::vector<trace::Body>& bodies = expected.solver->bodies;
  const Match match = match_entries(
      bodies, actual.solver->bodies, "bodies", [](const trace::Body& body) { return body.name; },
      sentences);
  const BodyScale most = largest(bodies);
  for (const auto& [i, j] : match.both) {
    const std::string& name = bodies[i].name;
    sentences.add(name, compare_body(bodies[i], actual.solver->bodies[j], most,
                                     scale.tolerance(expected, name, name)));
  }
}

void compare_frames(const trace::Frame& expected, const trace::Frame& actual, const Scale& scale,
                    Sentences& sentences) {
  // The time is a product of two numbers of the file, which every processor rounds alike.
  if (expected.time != actual.time) {
    sentences.add("", "time " + spell_change(expected.time, actual.time));
  }
  const Match poses = match_entries(
      expected.poses, actual.poses, "poses", [](const auto& entry) { return entry.first; },
      sentences);
  for (const auto& [i, j] : poses.both) {
    const auto& [name, pose] = expected.poses[i];
    sentences.add(
        name, compare_pose(pose, actual.poses[j].second, scale.tolerance(expected, name, name)));
  }
  const Match pairs = match_entries(expected.pairs, actual.pairs, "pairs", pair_name, sentences);
  for (const auto& [i, j] : pairs.both) {
    const trace::Pair& pair = expected.pairs[i];
    sentences.add(pair_name(pair),
                  compare_pair(pair, actual.pairs[j], scale.tolerance(expected, pair.a, pair.b)));
  }
  compare_solvers(expected, actual, scale, sentences);
  // Their values follow from what is compared above.
  if (expected.totals && !actual.totals) sentences.add("", "totals gone");
  if (!expected.totals && actual.totals) sentences.add("", "totals added");
}

}  // namespace

std::vector<std::string> compare_traces(const Trace& expected, const Trace& actual) {
  std::vector<std::string> all;
  const std::string name = actual.header.scenario;
  const Scale scale(expected.header);
  Sentences header(name);
  compare_headers(expected.header, actual.header, scale, header);
  const auto number = [](const trace::Frame& frame) {
    return "frame " + std::to_string(frame.frame);
  };
  const Match match = match_entries(expected.frames, actual.frames, "frames", number, header);
  header.append_to(all);
  for (const auto& [i, j] : match.both) {
    Sentences frame(name + " " + number(expected.frames[i]));
    compare_frames(expected.frames[i], actual.frames[j], scale, frame);
    frame.append_to(all);
  }
  return all;
}

}  // namespace contactscope::snapshot
