#include "snapshot/compare_trace.h"

#include <deque>

#include "snapshot/store.h"

namespace contactscope::snapshot {
namespace {

using trace::Trace;

// Sine and cosine of C libraries differ by one ulp between processors. Such a pose moves by up to
// one ulp of its coordinates; two poses and the transform back to world space make four.
constexpr double kPlaceUlps = 4;
// One ulp in a quaternion moves a shape by up to two ulps of its extent; each later stage (query,
// clip, area) rounds again. Twice the largest sum of those that we could count.
constexpr double kExtentUlps = 16;
// A polygon within the extent has a perimeter of at most 8 extents, which scales area errors.
constexpr double kPerimeter = 8;

double largest_coordinate(const std::vector<Vec3d>& points) {
  double largest = 0;
  for (const Vec3d& point : points) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Largest local coordinate of a shape. A plane is unbounded; its offset is what rounds.
double extent(const trace::Shape& shape) {
  if (shape.half_space) return std::abs(shape.half_space->offset);
  return largest_coordinate(shape.vertices) + shape.radius;
}

/// Scale of the tolerances, from the expected trace alone, so that wild values in the actual one do
/// not widen them.
class Scale {
 public:
  explicit Scale(const trace::Header& header)
      : ulp_(std::ldexp(1.0, header.scalar == "double" ? -52 : -23)) {
    for (const trace::Shape& shape : header.shapes) extents_[shape.name] = extent(shape);
  }

  /// For one shape or a pair in a frame.
  Tolerance of(const trace::Frame& frame, const std::string& a, const std::string& b) const {
    const double extent = std::max(extent_of(a), extent_of(b));
    double place = 0;
    for (const auto& [name, pose] : frame.poses) {
      if (name != a && name != b) continue;
      place = std::max(place, pose.position.lpNorm<Eigen::Infinity>());
    }
    return make(place, extent);
  }
  /// For a shape in its local frame.
  Tolerance of(const std::string& shape) const { return make(0, extent_of(shape)); }
  /// For sums over a frame: lengths as for the largest pair, impulses and energies as for all pairs
  /// together.
  Tolerance of(const trace::Frame& frame) const {
    Tolerance tolerance = make(0, 0);
    for (const trace::Pair& pair : frame.pairs)
      tolerance.length = std::max(tolerance.length, of(frame, pair.a, pair.b).length);
    const auto add = [&](trace::Kind kind, double value) { tolerance.magnitude(kind) += value; };
    each_magnitude(frame.pairs, add);
    each_magnitude(frame.solver, add);
    return tolerance;
  }

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

/// Largest coordinate of a pair's shapes and positions, metres.
double extent_of(const trace::Header& header, const trace::Frame& frame, const trace::Pair& pair) {
  double extent = 0;
  for (const trace::Shape& shape : header.shapes)
    if (shape.name == pair.a || shape.name == pair.b)
      extent = std::max({extent, largest_coordinate(shape.vertices), shape.radius});
  for (const auto& [name, pose] : frame.poses)
    if (name == pair.a || name == pair.b)
      extent = std::max(extent, pose.position.lpNorm<Eigen::Infinity>());
  return extent;
}

/// Adds the sentences of the header or of one frame.
void report(const std::string& place, const std::vector<Difference>& differences,
            std::vector<std::string>& sentences) {
  for (std::size_t i = 0; i < differences.size() && i < kMaxSentences; ++i) {
    const auto& [subject, text, stage, what] = differences[i];
    sentences.push_back(place + (subject.empty() ? "" : ", " + subject) + ": " + text);
  }
  if (differences.size() > kMaxSentences) {
    sentences.push_back(place + ": and " + std::to_string(differences.size() - kMaxSentences) +
                        " more");
  }
}

/// Characters around a position of a line.
std::string about(const std::string& line, std::size_t at) {
  constexpr std::size_t kBefore = 24, kLength = 48;
  return at < line.size() ? line.substr(at - std::min(at, kBefore), kLength) : "(the end)";
}

}  // namespace

TraceDifferences compare_and_settle(const Trace& expected, Trace& actual, const Margins& margins) {
  TraceDifferences record;
  std::vector<FrameDifferences> all;
  const std::string name = actual.header.scenario;
  const Scale scale(expected.header);
  std::vector<Difference> header;
  Comparison([&](const std::string& shape, const std::string&) {
    return scale.of(shape);
  }).compare(expected.header, actual.header, {}, "", header);

  const auto number = [](const trace::Frame& frame) {
    return "frame " + std::to_string(frame.frame);
  };
  const Match match = match_keys(mapped(expected.frames, number), mapped(actual.frames, number));
  for (const std::size_t i : match.gone)
    header.push_back({number(expected.frames[i]), "gone", Stage::Frames});
  for (const std::size_t i : match.added)
    header.push_back({number(actual.frames[i]), "added", Stage::Frames});
  if (match.reordered()) header.push_back({"", "frames in another order", Stage::Frames});
  report(name, header, record.sentences);
  for (const Difference& difference : header) {
    record.is_words = record.is_words || difference.stage == Stage::Words;
    record.is_setup = record.is_setup || difference.stage == Stage::Setup;
  }
  if (!header.empty()) all.push_back({-1, nullptr, nullptr, std::move(header)});

  for (const auto& [i, j] : match.both) {
    const trace::Frame& frame = expected.frames[i];
    std::vector<Difference> differences;
    Comparison([&](const std::string& a, const std::string& b) {
      return scale.of(frame, a, b);
    }).compare(frame, actual.frames[j], {"", "", scale.of(frame)}, "", differences);
    report(name + " " + number(frame), differences, record.sentences);
    if (differences.empty()) continue;
    record.frames.push_back(frame.frame);
    all.push_back({frame.frame, &frame, &actual.frames[j], std::move(differences)});
  }
  if (!all.empty()) {
    FirstCause cause = first_cause(name, all, margins);
    record.first = {cause.frame, cause.first->subject, cause.first->stage, cause.first->text,
                    std::move(cause.chain)};
    record.cause = std::move(cause.sentence);
    record.signature = std::move(cause.signature);
    record.is_input = cause.is_input;
  }
  return record;
}

TraceDifferences compare_with_stored(const std::string& text, const std::string& path,
                                     const Trace& actual, const Margins& margins) {
  std::istringstream stored(text);
  Trace settled = actual;
  const Trace expected = trace::read_trace(stored, path);
  TraceDifferences record = compare_and_settle(expected, settled, margins);
  if (!record.sentences.empty()) return record;
  const std::string written = to_json_lines(settled);
  const auto [at, other] = std::ranges::mismatch(text, written);
  if (at == text.end() && other == written.end()) return {};
  const auto line_of = [](const std::string& all, std::size_t begin) {
    return all.substr(begin, all.find('\n', begin) - begin);
  };
  const auto place = static_cast<std::size_t>(at - text.begin());
  const std::size_t begin = place == 0 ? 0 : text.rfind('\n', place - 1) + 1;
  const auto line = std::count(text.begin(), at, '\n');
  record.cause = actual.header.scenario + ": line " + std::to_string(line + 1) + " of " + path +
                 " is written differently, though no fact in it differs: it has '" +
                 about(line_of(text, begin), place - begin) + "' instead of '" +
                 about(line_of(written, begin), place - begin) + "'";
  record.sentences = {record.cause};
  record.signature = "bytes";
  return record;
}

bool Match::reordered() const {
  return !std::ranges::is_sorted(both, {}, [](const auto& places) { return places.second; });
}

Match match_keys(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  std::unordered_map<std::string, std::deque<std::size_t>> open;
  for (std::size_t i = 0; i < actual.size(); ++i) open[actual[i]].push_back(i);
  Match match;
  std::vector<bool> used(actual.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto found = open.find(expected[i]);
    if (found == open.end() || found->second.empty()) {
      match.gone.push_back(i);
      continue;
    }
    match.both.emplace_back(i, found->second.front());
    used[found->second.front()] = true;
    found->second.pop_front();
  }
  for (std::size_t i = 0; i < actual.size(); ++i)
    if (!used[i]) match.added.push_back(i);
  return match;
}

void match_rest_by_index(Match& match) {
  std::vector<std::size_t> common;
  std::ranges::set_intersection(match.gone, match.added, std::back_inserter(common));
  const auto is_common = [&](std::size_t i) { return std::ranges::binary_search(common, i); };
  std::erase_if(match.gone, is_common);
  std::erase_if(match.added, is_common);
  for (const std::size_t i : common) match.both.emplace_back(i, i);
  std::ranges::sort(match.both);
}

std::vector<std::string> brittle_decisions(const trace::Header& header, const trace::Frame& frame) {
  const double ulp = std::ldexp(1.0, header.scalar == "double" ? -52 : -23);
  std::vector<std::string> sentences;
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.decisions.empty()) continue;
    const double extent = extent_of(header, frame, pair);
    const double least = kExtentUlps * ulp;
    const auto axis = std::ranges::find(pair.decisions, "axis", &trace::Decision::stage);
    for (const trace::Decision& decision : pair.decisions) {
      // The best face of a hull does not matter if another axis made the contact.
      if (decision.stage.starts_with("face_") &&
          (axis == pair.decisions.end() || axis->took != decision.stage))
        continue;
      std::string by;
      if (decision.margin && *decision.margin <= least * extent)
        by = spell_length(std::max(*decision.margin, 0.0));
      else if (decision.margin_area && *decision.margin_area <= least * extent * extent)
        by = "no area";
      else if (decision.margin_cosine && *decision.margin_cosine <= least)
        by = "no angle";
      if (by.empty()) continue;
      sentences.push_back("frame " + std::to_string(frame.frame) + ", " + key_of(pair) + ": " +
                          decision.stage + ": " + decision.took + " over " + decision.over +
                          " by " + by +
                          ", which is within rounding: another machine may choose differently");
    }
  }
  return sentences;
}

TakenDecisions take_decisions(const std::vector<int>& stored, const std::vector<View>& views,
                              const trace::Header& header, std::vector<trace::Frame>& frames) {
  const bool requested = std::ranges::any_of(views, [](const View& view) {
    return view.shows(Layer::FlipDistance) || view.shows(Panel::Code);
  });
  TakenDecisions taken;
  for (trace::Frame& frame : frames) {
    if (std::ranges::count(stored, frame.frame) > 0) {
      std::ranges::copy(brittle_decisions(header, frame), std::back_inserter(taken.brittle));
      for (const trace::Pair& pair : frame.pairs)
        if (!pair.decisions.empty()) taken.margins[{frame.frame, key_of(pair)}] = pair.decisions;
    }
    if (requested) continue;
    for (trace::Pair& pair : frame.pairs) {
      pair.decisions.clear();
      if (pair.sat) pair.sat->tolerance.reset();
    }
  }
  return taken;
}

}  // namespace contactscope::snapshot
