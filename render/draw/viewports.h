#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/layout.h"
#include "trace/trace.h"

/// Comparisons: each pair in a viewport of its own, side by side, all with the same parallel
/// projection from the same side, so that only what differs differs.
namespace contactscope::draw {

inline constexpr std::size_t kMostViewports = 12;

struct PairViewport {
  std::string a, b, label;  // the pair
  Rect frame;               // of the canvas, with its heading
  std::string heading;
  std::optional<Camera> camera{};  // once it is fitted
};

/// Divides the view among the pairs of a sequence; none where these are fewer than two, or too
/// many.
std::vector<PairViewport> split_view(const std::vector<trace::Frame>& frames, const Layout& layout);

/// Below the heading.
Rect inside_of(const PairViewport& viewport, const Layout& layout);

/// Whether it is the viewport of this pair.
bool shows_pair(const PairViewport& viewport, const trace::Pair& pair);

/// Of a frame what a viewport shows: the two shapes and their pair, without its label.
trace::Frame part_of(const trace::Frame& frame, const PairViewport& viewport);

/// Its border and heading, of bounds with what they say in this frame.
void draw_viewport_frame(const PairViewport& viewport, const trace::Frame& frame,
                         const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
