#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/layout.h"
#include "trace/trace.h"

/// Comparisons: each pair in its own viewport, side by side, with the same parallel projection and
/// direction, so that only real differences are visible.
namespace contactscope::draw {

inline constexpr std::size_t kMaxViewports = 12;

struct PairViewport {
  std::string a, b, label;  // the pair
  Rect frame;               // on the canvas, including the heading
  std::string heading;
  std::optional<Camera> camera{};  // after fitting
};

/// Divides the view among the pairs of a sequence; empty for fewer than two or for too many pairs.
std::vector<PairViewport> split_view(const std::vector<trace::Frame>& frames, const Layout& layout);

/// The area below the heading.
Rect inside_of(const PairViewport& viewport, const Layout& layout);

/// Whether the viewport belongs to this pair.
bool shows_pair(const PairViewport& viewport, const trace::Pair& pair);

/// The part of a frame that a viewport shows: two shapes and their pair, without its label.
trace::Frame part_of(const trace::Frame& frame, const PairViewport& viewport);

/// Draws border and heading; queries of bounds add their answer in this frame.
void draw_viewport_frame(const PairViewport& viewport, const trace::Frame& frame,
                         const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
