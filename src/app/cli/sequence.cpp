#include "app/cli/sequence.h"

#include "draw/scene/pairs.h"

namespace contactscope::app {
namespace {

/// Deepest penetration of a frame, metres.
double penetration(const trace::Frame& frame) {
  double deepest = 0;
  for (const trace::Pair& pair : frame.pairs) deepest = std::max(deepest, trace::overlap_of(pair));
  return deepest;
}

/// Keeps an evenly spaced sample of the frames seen so far; the spacing grows with their number.
class Sampler {
 public:
  explicit Sampler(std::size_t budget) : budget_(budget) {}

  /// `bytes` is the length of its text.
  void add(trace::Frame frame, std::size_t bytes) {
    const std::size_t place = seen_++ / every_;
    Held held{std::move(frame), bytes, 0};
    held.depth = penetration(held.frame);
    last_.reset();
    if (place == held_.size()) {
      bytes_ += bytes;
      held_.push_back(std::move(held));
    } else if (place > 0 && held.depth > held_.back().depth) {
      bytes_ += bytes - held_.back().bytes;
      held_.back() = std::move(held);
    } else {
      last_ = std::move(held.frame);
    }
    while (bytes_ > budget_ && held_.size() > 2) halve();
  }

  std::size_t every() const { return every_; }

  /// The sample; the last frame of all replaces the one that represents it.
  std::vector<trace::Frame> frames() {
    if (last_ && held_.size() > 1) held_.back().frame = std::move(*last_);
    std::vector<trace::Frame> frames;
    for (Held& held : held_) frames.push_back(std::move(held.frame));
    return frames;
  }

 private:
  struct Held {
    trace::Frame frame;
    std::size_t bytes = 0;
    double depth = 0;
  };

  void halve() {
    std::vector<Held> left;
    bytes_ = 0;
    for (std::size_t i = 0; i < held_.size(); i += 2) {
      const bool second = i > 0 && i + 1 < held_.size() && held_[i + 1].depth > held_[i].depth;
      left.push_back(std::move(held_[second ? i + 1 : i]));
      bytes_ += left.back().bytes;
    }
    held_ = std::move(left);
    every_ *= 2;
  }

  std::size_t budget_, bytes_ = 0;
  std::size_t every_ = 1, seen_ = 0;
  std::vector<Held> held_;
  std::optional<trace::Frame> last_;  // if another frame represents it
};

}  // namespace

void Sequence::each(const std::vector<int>& wanted, const std::function<void(std::size_t)>& show,
                    bool with_before) {
  if (!file) {
    for (std::size_t i = 0; i < frames.size(); ++i)
      if (std::ranges::binary_search(wanted, frames[i].frame)) show(i);
    return;
  }
  file->rewind();
  const auto is_wanted = [&](std::size_t i) {
    return i < numbers.size() && std::ranges::binary_search(wanted, numbers[i]);
  };
  last.reset(), before.reset();
  for (std::size_t i = 0; i < numbers.size() && numbers[i] <= wanted.back(); ++i) {
    if (!is_wanted(i) && !(with_before && is_wanted(i + 1))) {
      file->skip();
      continue;
    }
    std::optional<trace::Frame> frame = file->next();
    if (!frame) return;  // the file was truncated meanwhile
    frame->shapes.clear();
    trace::name_points(header.shapes, *frame);
    if (trim) trim(*frame);
    if (!is_wanted(i)) {
      before = std::move(frame);
      continue;
    }
    std::swap(frames[i / every], *frame);
    show(i / every);
    std::swap(frames[i / every], *frame);
    last = std::move(*frame);
    before.reset();
  }
}

PairHistory Sequence::history(const std::string& a, const std::string& b) const {
  PairHistory all;
  if (!file) return all;
  file->rewind();
  Workers workers(hardware_threads());
  for (;;) {
    const std::vector<trace::Frame> some = file->next({.poses = false, .stages = false}, workers);
    if (some.empty()) return all;
    for (const trace::Frame& frame : some) draw::add_frame(frame, a, b, all);
  }
}

const trace::Frame* Sequence::recent(int number) const {
  for (const std::optional<trace::Frame>* one : {&before, &last})
    if (*one && (*one)->frame == number) return &**one;
  return nullptr;
}

Sequence read_sequence(const std::string& path, Hold hold, std::size_t budget) {
  auto file = std::make_shared<TraceFile>(
      path, hold == Hold::Sample ? TraceFile::Passes::Several : TraceFile::Passes::One);
  Sequence sequence;
  Sampler sampler(hold == Hold::Sample ? budget : SIZE_MAX);
  while (std::optional<trace::Frame> frame = file->next()) {
    frame->shapes.clear();  // they are in the header now
    sequence.numbers.push_back(frame->frame);
    sampler.add(std::move(*frame), file->bytes());
  }
  file->report_torn();
  sequence.path = path;
  sequence.every = sampler.every();
  sequence.frames = sampler.frames();
  sequence.header = file->header();
  for (trace::Frame& frame : sequence.frames)  // not those that the sample leaves out
    if (trace::name_points(sequence.header.shapes, frame)) sequence.ids_are_made = true;
  if (sequence.every > 1) sequence.file = std::move(file);
  return sequence;
}

}  // namespace contactscope::app
