#include "snapshot/compare_runs.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>

#include "snapshot/compare_frames.h"
#include "snapshot/first_cause.h"
#include "trace/find.h"

namespace contactscope::snapshot {
namespace {

using trace::Frame;
using trace::FrameText;
using trace::TraceReader;

constexpr std::size_t kBatch = 2 << 20;  // bytes of text of each run that are parsed at once
/// Bytes of text in which consequences of the parting are looked for.
constexpr std::size_t kConsequences = 4 << 20;

/// Number and time of a frame.
struct Stamp {
  int frame = 0;
  double time = 0;
};

/// Reads `key` and a number at the start of `text`, with blanks as some writers have them.
template <class Number>
bool take_number(std::string_view& text, std::string_view key, Number& number) {
  if (!text.starts_with(key)) return false;
  text.remove_prefix(key.size());
  if (text.starts_with(' ')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return text.starts_with(',');
}

/// The frames of a run, one text at a time.
class Run {
 public:
  Run(TraceReader& reader, Workers& workers) : reader_(reader), workers_(workers) { advance(); }

  bool is_at_end() const { return !has_; }
  const Stamp& stamp() const { return stamp_; }
  FrameText& text() { return text_; }
  /// Frames that bring shapes are read, so that the shapes are known.
  bool has_shapes() const { return text_.text.find("\"shapes\"") != std::string::npos; }

  void advance() {
    has_ = reader_.take(text_);
    if (!has_) return;
    // All writers that we know begin a frame with these two.
    std::string_view begin = text_.text;
    bool is_read = take_number(begin, "{\"frame\":", stamp_.frame);
    if (is_read && begin.starts_with(", ")) begin.remove_prefix(1);
    if (is_read) begin.remove_prefix(1);
    if (is_read && take_number(begin, "\"time\":", stamp_.time)) return;
    std::vector<FrameText> alone = {text_};
    const std::vector<Frame> frames =
        read(alone, {.poses = false, .pairs = false, .stages = false});
    has_ = !frames.empty();
    if (has_) stamp_ = {frames.front().frame, frames.front().time};
  }

  std::vector<Frame> read(std::vector<FrameText>& texts, const trace::Parts& parts) {
    return reader_.read(texts, parts, workers_);
  }

 private:
  TraceReader& reader_;
  Workers& workers_;
  FrameText text_;
  Stamp stamp_;
  bool has_ = false;
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
  if (!std::ranges::equal(model.pairs, frame.pairs, {}, name, name)) {
    std::map<std::string, bool> names;
    for (const trace::Pair& pair : model.pairs) names.emplace(key_of(pair), true);
    for (trace::Pair& pair : frame.pairs) {
      if (names.contains(key_of(pair))) continue;
      trace::Pair mirrored = pair;
      trace::mirror(mirrored);
      if (names.contains(key_of(mirrored))) pair = std::move(mirrored);
    }
  }
  order_like(model.pairs, frame.pairs, name);
  order_like(model.poses, frame.poses, [](const trace::Placement& one) { return one.first; });
}

/// Corners of the boxes around shapes, in their local frames.
class Corners {
 public:
  void know(const std::vector<trace::Shape>& shapes) {
    for (const trace::Shape& shape : shapes) {
      std::vector<Vec3d>& corners = corners_[shape.name];
      if (shape.vertices.empty()) continue;
      Vec3d lower = shape.vertices.front(), upper = lower;
      for (const Vec3d& vertex : shape.vertices) {
        lower = lower.cwiseMin(vertex);
        upper = upper.cwiseMax(vertex);
      }
      for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? upper : lower).x(), (k & 2 ? upper : lower).y(),
                             (k & 4 ? upper : lower).z());
    }
  }

  /// The largest displacement of a corner between two frames, and its shape.
  void measure(const Frame& a, const Frame& b, RunDistance& distance) const {
    for (std::size_t i = 0; i < a.poses.size(); ++i) {
      const auto& [name, from] = a.poses[i];
      const bool is_there = i < b.poses.size() && b.poses[i].first == name;
      const Pose<double>* const to = is_there ? &b.poses[i].second : trace::find_pose(b, name);
      const auto known = corners_.find(name);
      if (to == nullptr || known == corners_.end()) continue;
      double most = (to->position - from.position).norm();
      for (const Vec3d& corner : known->second)
        most = std::max(most, (to->transform(corner) - from.transform(corner)).norm());
      if (!(most > distance.metres)) continue;
      distance.metres = most;
      distance.shape = name;
    }
  }

 private:
  std::map<std::string, std::vector<Vec3d>> corners_;
};

/// Takes words that two runs may differ by out of the comparison of their headers.
void settle_words(const trace::Header& expected, trace::Header& actual,
                  std::vector<std::string>& notes) {
  const auto settle = [&](const char* name, std::string trace::Header::*member) {
    if (expected.*member == actual.*member) return;
    notes.push_back(name + spell_change(expected.*member, actual.*member));
    actual.*member = expected.*member;
  };
  settle("scenario ", &trace::Header::scenario);
  settle("title ", &trace::Header::title);
  settle("source ", &trace::Header::source);
  settle("scalar ", &trace::Header::scalar);
  settle("engine ", &trace::Header::engine);
  settle("version ", &trace::Header::version);
  actual.frames = expected.frames;
}

/// Frames that differ, until the consequences of the first difference are known.
class Differing {
 public:
  explicit Differing(RunComparison& record) : record_(record) {}

  bool is_complete() const { return bytes_ >= kConsequences; }

  void add(std::vector<Difference> differences, Frame a, Frame b, std::size_t bytes) {
    std::array<Frame, 2>& both = frames_.emplace_back(std::array{std::move(a), std::move(b)});
    all_.push_back({both[0].frame, &both[0], &both[1], std::move(differences)});
    bytes_ += bytes;
  }
  void add_header(std::vector<Difference> differences) {
    if (!differences.empty()) all_.push_back({-1, nullptr, nullptr, std::move(differences)});
  }

  void conclude() {
    if (all_.empty()) return;
    const FirstCause cause = first_cause("", all_);
    Parting& parting = record_.parting.emplace();
    parting.frame = cause.frame;
    parting.subject = cause.first->subject;
    parting.stage = cause.first->stage;
    parting.what = cause.first->text;
    parting.chain = cause.chain;
    for (std::array<Frame, 2>& both : frames_) {
      if (both[0].frame != cause.frame) continue;
      parting.frames = std::move(both);
      for (const Frame& frame : parting.frames)
        for (const trace::Pair& pair : frame.pairs)
          if (key_of(pair) == parting.subject) parting.a = pair.a, parting.b = pair.b;
    }
  }

 private:
  RunComparison& record_;
  std::deque<std::array<Frame, 2>> frames_;
  std::vector<FrameDifferences> all_;
  std::size_t bytes_ = 0;
};

}  // namespace

RunComparison compare_runs(TraceReader& a, TraceReader& b, Workers& workers) {
  RunComparison record;
  record.headers = {a.header(), b.header()};
  Differing differing(record);
  Corners corners;
  corners.know(a.header().shapes);
  trace::Header coarser = a.header(), actual = b.header();
  if (actual.scalar == "float") coarser.scalar = actual.scalar;
  FrameComparison comparison(coarser);
  settle_words(a.header(), actual, record.notes);
  differing.add_header(comparison.header(a.header(), actual));

  Run one(a, workers), other(b, workers);
  while (!one.is_at_end() || !other.is_at_end()) {
    // The frames whose text differs, and where their distances go.
    std::array<std::vector<FrameText>, 2> texts;
    std::vector<std::size_t> places;
    for (std::size_t bytes = 0; bytes < kBatch && !(one.is_at_end() && other.is_at_end());) {
      const bool only_one =
          other.is_at_end() || (!one.is_at_end() && one.stamp().frame < other.stamp().frame);
      const bool only_other =
          one.is_at_end() || (!other.is_at_end() && other.stamp().frame < one.stamp().frame);
      if (only_one || only_other) {
        ++record.alone[only_one ? 0 : 1];
        (only_one ? one : other).advance();
        continue;
      }
      record.distances.push_back({one.stamp().frame, one.stamp().time, 0, {}});
      const bool is_equal = one.text().text == other.text().text;
      record.equal += is_equal;
      if (!is_equal || one.has_shapes()) {
        bytes += std::max(one.text().text.size(), other.text().text.size());
        places.push_back(record.distances.size() - 1);
        texts[0].push_back(std::move(one.text()));
        texts[1].push_back(std::move(other.text()));
      }
      one.advance();
      other.advance();
    }
    const bool is_open = !differing.is_complete();
    const trace::Parts parts{.poses = true, .pairs = is_open, .stages = is_open};
    std::vector<Frame> before = one.read(texts[0], parts), now = other.read(texts[1], parts);
    const std::size_t count = std::min(before.size(), now.size());
    if (count < places.size()) record.distances.resize(places[count]);  // the last line is torn
    for (std::size_t i = 0; i < count; ++i) {
      corners.know(before[i].shapes);
      comparison.know(before[i].shapes);
      for (std::size_t run : {0u, 1u}) {
        std::vector<trace::Shape>& shapes = record.headers[run].shapes;
        const std::vector<trace::Shape>& added = (run == 0 ? before : now)[i].shapes;
        shapes.insert(shapes.end(), added.begin(), added.end());
      }
    }
    std::vector<std::vector<Difference>> differences(count);
    workers.for_each(static_cast<int>(count), [&](int index, int) {
      const auto i = static_cast<std::size_t>(index);
      corners.measure(before[i], now[i], record.distances[places[i]]);
      if (!is_open) return;
      arrange_like(before[i], now[i]);
      differences[i] = comparison.frame(before[i], now[i]);
    });
    for (std::size_t i = 0; i < count && is_open; ++i) {
      if (differences[i].empty()) {
        if (!record.rounding && texts[0][i].text != texts[1][i].text)
          record.rounding = before[i].frame;
      } else if (!differing.is_complete()) {
        differing.add(std::move(differences[i]), std::move(before[i]), std::move(now[i]),
                      texts[0][i].text.size());
      }
    }
  }
  differing.conclude();
  return record;
}

}  // namespace contactscope::snapshot
