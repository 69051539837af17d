#include "snapshot/compare_runs.h"

#include "trace/find.h"

namespace contactscope::snapshot {
namespace {

using trace::Frame;
using trace::FrameText;
using trace::TraceReader;

constexpr std::size_t kBatch = 1 << 20;  // bytes of text of each run that are parsed at once
/// Bytes of text in which consequences of the parting are looked for.
constexpr std::size_t kConsequences = 2 << 20;

/// The frames of a run, one text at a time.
struct Run {
  Run(TraceReader& of, Workers& with) : reader(of), workers(with) { advance(); }

  void advance() {
    is_at_end = !reader.take(text);
    // All writers that we know begin a frame with these two.
    constexpr const char* kBegin = " { \"frame\" : %d , \"time\" : %lf";
    if (is_at_end || std::sscanf(text.text.c_str(), kBegin, &frame, &time) == 2) return;
    std::vector<FrameText> alone = {text};
    const auto read =
        reader.read(alone, {.poses = false, .pairs = false, .stages = false}, workers);
    is_at_end = read.empty();
    if (is_at_end) return;
    frame = read.front().frame;
    time = read.front().time;
  }

  TraceReader& reader;
  Workers& workers;
  FrameText text{};
  bool is_at_end = false;
  int frame = 0;
  double time = 0;
};

/// Puts the entries of a list into the order of another one, by name; others go last.
template <class Entry, class Name>
void order_like(const std::vector<Entry>& model, std::vector<Entry>& list, const Name& name_of) {
  if (std::ranges::equal(model, list, {}, name_of, name_of)) return;
  std::map<std::string, std::size_t> places;
  for (const Entry& entry : model) places.emplace(name_of(entry), places.size());
  std::ranges::stable_sort(list, {}, [&](const Entry& entry) {
    const auto found = places.find(name_of(entry));
    return found == places.end() ? places.size() : found->second;
  });
}

/// Mirrors pairs that the other run has with a and b swapped, and gives shapes and pairs its order.
void arrange_like(const Frame& model, Frame& frame) {
  const auto name = [](const trace::Pair& pair) { return key_of(pair); };
  std::set<std::string> names;
  for (const trace::Pair& pair : model.pairs) names.insert(name(pair));
  for (trace::Pair& pair : frame.pairs) {
    if (names.contains(name(pair))) continue;
    trace::mirror(pair);
    if (!names.contains(name(pair))) trace::mirror(pair);
  }
  order_like(model.pairs, frame.pairs, name);
  order_like(model.poses, frame.poses, [](const trace::Placement& one) { return one.first; });
}

void measure(const Frame& a, const Frame& b, RunDistance& distance) {
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const auto& [name, from] = a.poses[i];
    const bool is_there = i < b.poses.size() && b.poses[i].first == name;
    const Pose<double>* const to = is_there ? &b.poses[i].second : trace::find_pose(b, name);
    const double moved = to == nullptr ? 0 : (to->position - from.position).norm();
    if (!(moved > distance.metres)) continue;
    distance.metres = moved;
    distance.shape = name;
  }
}

/// Takes words by which two runs may differ out of the comparison of their headers.
void settle_words(const trace::Header& expected, trace::Header& actual,
                  std::vector<std::string>& notes) {
  using H = trace::Header;
  for (const auto& [name, member] : {std::pair{"scenario ", &H::scenario},
                                     {"title ", &H::title},
                                     {"source ", &H::source},
                                     {"scalar ", &H::scalar},
                                     {"engine ", &H::engine},
                                     {"version ", &H::version}}) {
    if (expected.*member == actual.*member) continue;
    notes.push_back(name + spell_change(expected.*member, actual.*member));
    actual.*member = expected.*member;
  }
  actual.frames = expected.frames;
}

/// The largest change of a point: of its impulse in newton seconds, or of its place in metres.
double change_of(const trace::Pair& before, const trace::Pair& now, bool is_of_solver) {
  std::array<std::vector<Vec3d>, 2> values;
  for (const trace::Pair* const pair : {&before, &now})
    for (const trace::Manifold& manifold : pair->manifolds)
      for (const trace::Point& point : manifold.points) {
        const trace::Impulse impulse = point.impulse.value_or(trace::Impulse{});
        const Vec3d acts = impulse.normal * manifold.normal + impulse.friction;
        const Vec3d place = point.position + point.separation * manifold.normal;
        values[pair == &now ? 1 : 0].push_back(is_of_solver ? acts : place);
      }
  double most = 0;
  for (std::size_t i = 0; i < std::min(values[0].size(), values[1].size()); ++i)
    most = std::max(most, (values[1][i] - values[0][i]).norm());
  return most;
}

/// Without the blanks that writers of JSON put between values.
std::string spaced_alike(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return text;
}

/// The pair, or the shape with another pose, that differs most of those that differ in the stage
/// of the parting. Their values have one unit, so that the size of the quantity does not matter.
/// Counts the pairs that differ.
std::string most_different(RunComparison& runs) {
  std::vector<Difference> all;
  trace::Frame settled = runs.frames[1];
  Comparison([](const auto&, const auto&) {
    return Tolerance{};  // numbers within rounding are equal there
  }).compare(runs.frames[0], settled, {}, "", all);
  std::map<std::string, std::array<trace::Pair, 2>> pairs;
  for (std::size_t i = 0; i < runs.frames.size(); ++i)
    for (const trace::Pair& pair : runs.frames[i].pairs) pairs[key_of(pair)][i] = pair;
  const bool is_of_pair = pairs.contains(runs.parting->subject);
  std::set<std::string> differing;
  std::string most = runs.parting->subject;
  double largest = 0;
  for (const Difference& one : all) {
    const auto pair = pairs.find(one.subject);
    const bool is_pair = pair != pairs.end();
    if (is_pair) differing.insert(one.subject);
    if (one.stage != runs.parting->stage || is_pair != is_of_pair) continue;
    const auto* const from = trace::find_pose(runs.frames[0], one.subject);
    const auto* const to = trace::find_pose(settled, one.subject);
    double change = from && to ? (to->position - from->position).norm() : 0;
    if (is_pair) change = change_of(pair->second[0], pair->second[1], one.stage == Stage::Solver);
    if (change > largest) largest = change, most = one.subject;
  }
  runs.more_pairs = differing.size() - std::size_t(is_of_pair ? 1 : 0);
  return most;
}

/// Gives frames the solver's settings of other frames.
void settle_settings(const std::vector<Frame>& model, std::vector<Frame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!model[i].solver || !frames[i].solver) continue;
    trace::Solver settled = *model[i].solver;
    settled.bodies = std::move(frames[i].solver->bodies);
    settled.stops = std::move(frames[i].solver->stops);
    frames[i].solver = std::move(settled);
  }
}

}  // namespace

RunComparison compare_runs(TraceReader& a, TraceReader& b, Workers& workers) {
  RunComparison record;
  // The frames that differ, until the consequences of the first difference are known.
  trace::Trace expected{a.header(), {}}, actual{b.header(), {}};
  const std::string coarser = b.header().scalar == "float" ? "float" : a.header().scalar;
  settle_words(expected.header, actual.header, record.notes);
  expected.header.scalar = actual.header.scalar = coarser;
  trace::Trace header = actual;
  record.header = compare_and_settle(expected, header).first;
  actual.header = expected.header;  // so that the frames are compared alone
  std::size_t held = 0;             // bytes
  // Each thread compares frames in traces of its own.
  std::vector<std::array<trace::Trace, 2>> single(static_cast<std::size_t>(workers.count()),
                                                  {expected, expected});

  Run one(a, workers), other(b, workers);
  while (!one.is_at_end || !other.is_at_end) {
    // The frames whose text differs, and where their distances go.
    std::array<std::vector<FrameText>, 2> texts;
    std::vector<std::size_t> places;
    for (std::size_t bytes = 0; bytes < kBatch && !(one.is_at_end && other.is_at_end);) {
      const bool is_lone = one.is_at_end || other.is_at_end || one.frame != other.frame;
      if (is_lone) {
        const bool first = other.is_at_end || (!one.is_at_end && one.frame < other.frame);
        ++record.alone[first ? 0 : 1];
        (first ? one : other).advance();
        continue;
      }
      record.distances.push_back({one.frame, one.time, 0, {}});
      if (one.text.text == other.text.text) {
        ++record.equal;
      } else {
        bytes += std::max(one.text.text.size(), other.text.text.size());
        places.push_back(record.distances.size() - 1);
        texts[0].push_back(std::move(one.text));
        texts[1].push_back(std::move(other.text));
      }
      one.advance();
      other.advance();
    }
    const bool is_open = held < kConsequences;
    const trace::Parts parts{.poses = true, .pairs = is_open, .stages = is_open};
    std::vector<Frame> before = a.read(texts[0], parts, workers);
    std::vector<Frame> now = b.read(texts[1], parts, workers);
    const std::size_t count = std::min(before.size(), now.size());
    if (count < places.size()) record.distances.resize(places[count]);  // the last line is torn
    std::vector<char> differs(count);
    workers.for_each(static_cast<int>(count), [&](int index, int worker) {
      const auto i = static_cast<std::size_t>(index);
      measure(before[i], now[i], record.distances[places[i]]);
      if (!is_open) return;
      arrange_like(before[i], now[i]);
      auto& [left, right] = single[static_cast<std::size_t>(worker)];
      left.frames = {std::move(before[i])};
      right.frames = {std::move(now[i])};
      differs[i] = compare_and_settle(left, right).first.has_value();
      before[i] = std::move(left.frames.front());
      now[i] = std::move(right.frames.front());
    });
    for (std::size_t i = 0; i < count && held < kConsequences; ++i) {
      if (differs[i] != 0) {
        held += texts[0][i].text.size();
        expected.frames.push_back(std::move(before[i]));
        actual.frames.push_back(std::move(now[i]));
      } else if (!record.rounding &&
                 spaced_alike(texts[0][i].text) != spaced_alike(texts[1][i].text)) {
        record.rounding = before[i].frame;
      }
    }
  }
  if (expected.frames.empty()) return record;
  const auto part = [&] { return compare_and_settle(expected, actual).first; };
  record.parting = part();
  if (record.parting && record.parting->stage == Stage::Solver && record.parting->subject.empty()) {
    settle_settings(expected.frames, actual.frames);
    record.setting = std::exchange(record.parting, part());
    record.setting->chain = record.setting->what;
  }
  if (!record.parting) return record;
  const auto is_first = [&](const Frame& frame) { return frame.frame == record.parting->frame; };
  Frame& before = *std::ranges::find_if(expected.frames, is_first);
  Frame& now = *std::ranges::find_if(actual.frames, is_first);
  record.frames = {before, now};
  if (const std::string most = most_different(record); most != record.parting->subject) {
    for (Frame* frame : {&before, &now}) {
      std::stable_partition(frame->poses.begin(), frame->poses.end(),
                            [&](auto& entry) { return entry.first == most; });
      std::stable_partition(frame->pairs.begin(), frame->pairs.end(),
                            [&](auto& entry) { return key_of(entry) == most; });
    }
    record.parting = part();
  }
  for (const Frame& frame : record.frames)
    for (const trace::Pair& pair : frame.pairs)
      if (key_of(pair) == record.parting->subject) record.a = pair.a, record.b = pair.b;
  return record;
}

}  // namespace contactscope::snapshot
