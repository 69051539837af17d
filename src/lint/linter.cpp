#include "lint/linter.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/at.h"
#include "lint/watch.h"

namespace contactscope::lint {

std::string metres(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", length);
  return text.data();
}

std::string spelled(const Vec3d& vector) {
  return "[" + metres(vector.x()) + ", " + metres(vector.y()) + ", " + metres(vector.z()) + "]";
}

struct Linter::State {
  State(const trace::Header& header, const LintOptions& options) {
    for (const trace::Shape& shape : header.shapes) solids.add(shape);
    watches.push_back(watch_claims(header, options));
    watches.push_back(watch_overlaps());
    watches.push_back(watch_ids());
    watches.push_back(watch_records());
    watches.push_back(watch_friction());
    if (options.shapes_are_given) return;
    watches.push_back(watch_windings());
    watches.push_back(watch_rotations());
    watches.push_back(watch_velocities());
    watches.push_back(watch_motion(header));
  }

  /// Takes the next frame, null after the last one, and checks the one before it.
  void see(const trace::Frame* next) {
    after = next;
    if (now != nullptr) look();
    before = now;
    now = after;
  }

  void look() {
    solids.deform(now->deformed);
    const auto neighbour = [&](const trace::Frame* frame, int offset) {
      return frame != nullptr && frame->frame == now->frame + offset ? frame : nullptr;
    };
    const Moments moments{neighbour(before, -1), now, neighbour(after, 1)};
    for (const std::unique_ptr<Watch>& watch : watches) watch->see(solids, moments);
  }

  Solids solids;
  std::vector<std::unique_ptr<Watch>> watches;
  const trace::Frame *before = nullptr, *now = nullptr, *after = nullptr;
  // These frames, unless the whole trace is in memory.
  std::array<trace::Frame, 3> window;
  std::size_t seen = 0;
};

Linter::Linter(const trace::Header& header, const LintOptions& options)
    : state_(std::make_unique<State>(header, options)) {}
Linter::~Linter() = default;

void Linter::frame(trace::Frame frame) {
  trace::Frame& kept = state_->window[state_->seen++ % state_->window.size()];
  kept = std::move(frame);
  look_at(kept);
}

void Linter::shapes(const std::vector<trace::Shape>& added) {
  for (const trace::Shape& shape : added) state_->solids.add(shape);
}

void Linter::look_at(const trace::Frame& frame) {
  shapes(frame.shapes);
  state_->see(&frame);
}

std::vector<Finding> Linter::findings() {
  state_->see(nullptr);
  std::vector<Finding> all;
  for (const std::unique_ptr<Watch>& watch : state_->watches) watch->report(all);
  for (const auto& [name, why] : state_->solids.refused)
    all.push_back({"shape", "shape '" + name + "' bounds nothing, so its contacts cannot be judged",
                   why, 1, 0, 1, 0, name, "", "", ""});
  return all;
}

std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options) {
  Linter linter(trace.header, options);
  for (const trace::Frame& frame : trace.frames) linter.look_at(frame);
  return linter.findings();
}

}  // namespace contactscope::lint
