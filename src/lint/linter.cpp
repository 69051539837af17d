#include "lint/linter.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

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
    if (options.shapes_are_given) return;
    watches.push_back(watch_rotations());
    watches.push_back(watch_motion(header));
  }

  /// Shows the middle one of the three frames.
  void look() {
    if (!now) return;
    solids.deform(now->deformed);
    const auto neighbour = [&](const std::optional<trace::Frame>& frame, int way) {
      return frame && frame->frame == now->frame + way ? &*frame : nullptr;
    };
    const Moments moments{neighbour(before, -1), &*now, neighbour(after, 1)};
    for (const std::unique_ptr<Watch>& watch : watches) watch->see(solids, moments);
  }
  void advance() {
    before = std::move(now);
    now = std::move(after);
    after.reset();
  }

  Solids solids;
  std::vector<std::unique_ptr<Watch>> watches;
  std::optional<trace::Frame> before, now, after;
};

Linter::Linter(const trace::Header& header, const LintOptions& options)
    : state_(std::make_unique<State>(header, options)) {}
Linter::~Linter() = default;

void Linter::frame(trace::Frame frame) {
  for (const trace::Shape& shape : frame.shapes) state_->solids.add(shape);
  state_->after = std::move(frame);
  state_->look();
  state_->advance();
}

std::vector<Finding> Linter::findings() {
  state_->look();
  std::vector<Finding> all;
  for (const std::unique_ptr<Watch>& watch : state_->watches) watch->tell(all);
  for (const auto& [name, why] : state_->solids.refused)
    all.push_back(
        {"shape",
         "shape '" + name + "' bounds nothing, so that nothing can be said of its contacts", why, 1,
         0, 1, 0, name, "", "", ""});
  return all;
}

std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options) {
  Linter linter(trace.header, options);
  for (const trace::Frame& frame : trace.frames) linter.frame(frame);
  return linter.findings();
}

}  // namespace contactscope::lint
