#include "draw/viewports.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/answers.h"
#include "draw/scene/pairs.h"
#include "draw/scene/palette.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kViewportHeading = 17;
constexpr double kViewportHeadingRow = 28;
constexpr double kViewportGap = 12;
constexpr double kWantedAspect = 1.25;

}  // namespace

bool shows_pair(const PairViewport& viewport, const trace::Pair& pair) {
  return pair.a == viewport.a && pair.b == viewport.b && pair.label == viewport.label;
}

std::vector<PairViewport> split_view(const std::vector<trace::Frame>& frames,
                                     const Layout& layout) {
  std::vector<const trace::Pair*> pairs =
      distinct_pairs(frames, [](const trace::Pair&) { return true; });
  // An unlabelled pair next to labelled ones is not part of the comparison.
  const auto has_no_label = [](const trace::Pair* pair) { return pair->label.empty(); };
  if (!std::ranges::all_of(pairs, has_no_label)) std::erase_if(pairs, has_no_label);
  const std::size_t count = pairs.size();
  if (count < 2 || count > kMaxViewports) return {};
  const double gap = layout.px(kViewportGap);
  std::size_t columns = count;
  double best = 1e300;
  for (std::size_t wide = 1; wide <= count; ++wide) {
    const std::size_t high = (count + wide - 1) / wide;
    const double width = layout.view.width / static_cast<double>(wide);
    const double height = layout.view.height / static_cast<double>(high);
    const double off = std::abs(std::log(width / height / kWantedAspect)) +
                       0.3 * static_cast<double>(wide * high - count);
    if (off >= best) continue;
    best = off;
    columns = wide;
  }
  const std::size_t rows = (count + columns - 1) / columns;
  std::vector<PairViewport> viewports;
  for (std::size_t i = 0; i < count; ++i)
    viewports.push_back({pairs[i]->a, pairs[i]->b, pairs[i]->label,
                         layout.view.cell(i, columns, rows, gap, gap), pair_name(*pairs[i])});
  return viewports;
}

Rect inside_of(const PairViewport& viewport, const Layout& layout) {
  const double row = layout.px(kViewportHeadingRow);
  const Rect& frame = viewport.frame;
  return {frame.x + 1, frame.y + row, frame.width - 2, frame.height - row - 1};
}

trace::Frame part_of(const trace::Frame& frame, const PairViewport& viewport) {
  const auto has = [&](const std::string& name) {
    return name == viewport.a || name == viewport.b;
  };
  trace::Frame part;
  part.frame = frame.frame;
  part.time = frame.time;
  for (const trace::Placement& pose : frame.poses)
    if (has(pose.first)) part.poses.push_back(pose);
  for (const trace::Pair& pair : frame.pairs) {
    if (!shows_pair(viewport, pair)) continue;
    part.pairs.push_back(pair);
    part.pairs.back().label.clear();  // the viewport's heading contains it
  }
  for (const trace::Deformed& deformed : frame.deformed)
    if (has(deformed.name)) part.deformed.push_back(deformed);
  for (const trace::FieldSlice& slice : frame.field_slices)
    if (has(slice.name)) part.field_slices.push_back(slice);
  if (frame.solver) {
    part.solver = frame.solver;
    std::erase_if(part.solver->bodies, [&](const trace::Body& body) { return !has(body.name); });
  }
  return part;
}

void draw_viewport_frame(const PairViewport& viewport, const trace::Frame& frame,
                         const Layout& layout, Drawing& drawing) {
  const auto pair = std::ranges::find_if(
      frame.pairs, [&](const trace::Pair& each) { return shows_pair(viewport, each); });
  const bool answers = pair != frame.pairs.end() && !pair->label.empty() && pair->query &&
                       !pair->query->bounds.empty();
  const Pen pen(drawing, layout.scale, kViewportHeading);
  pen.frame(viewport.frame, 1, with_alpha(kQuietText, 0.5f));
  const float padding = pen.px(8), size = pen.px(kViewportHeading);
  const Said heading =
      pen.fitted(answers ? label_with_answer(*pair) : viewport.heading, Weight::Bold,
                 static_cast<float>(viewport.frame.width) - 2 * padding, kViewportHeading);
  pen.text(heading,
           pixel(viewport.frame.x + padding, viewport.frame.y + 0.5 * padding + 0.9 * size),
           Align::Left, kText, Weight::Bold);
}

}  // namespace contactscope::draw
