#pragma once

#include "draw/scene/scene.h"

/// Comparisons: each pair in its own viewport, side by side, with the same parallel projection and
/// direction, so that only real differences are visible.
///
/// Magnifier for a subject that is smaller than its dots. It repeats a part of the picture enlarged
/// in a corner, and frames the source.
namespace contactscope::draw {

inline constexpr std::size_t kMaxViewports = 12;

struct PairViewport {
  std::string a, b, label;  // the pair
  Rect frame;               // on the canvas, including the heading
  std::string heading;
  std::optional<Camera> camera{};  // after fitting
  std::optional<View> view{};      // of a stage, which has no pair: the shapes and its layer
};

/// Divides the view among the pairs of a sequence; empty for fewer than two or for too many pairs.
std::vector<PairViewport> split_view(const std::vector<trace::Frame>& frames, const Layout& layout);

/// Divides the view among its layers but the shapes; empty for fewer than two.
std::vector<PairViewport> split_stages(const View& view, const Layout& layout);

/// The area below the heading.
Rect inside_of(const PairViewport& viewport, const Layout& layout);

/// Whether the viewport belongs to this pair.
bool shows_pair(const PairViewport& viewport, const trace::Pair& pair);

/// The part of a frame that a viewport shows: two shapes and their pair, without its label; of a
/// stage all.
trace::Frame part_of(const trace::Frame& frame, const PairViewport& viewport);

/// Draws border and heading; queries of bounds add their answer in this frame, a simplex the steps of
/// GJK, and stages what they pass on.
void draw_viewport_frame(const PairViewport& viewport, const View& view, const trace::Frame& frame,
                         const Layout& layout, Drawing& drawing);

struct Magnifier {
  Rect frame;         // of the canvas
  double factor = 1;  // magnification: 2, 5, 10, ...
};

/// Places a magnifier if the view's subject is smaller than 20 pixels in all frames, but not zero.
/// The subject is the points of a pair, or the two ends of its axis or distance. `shapes`: points
/// of the shapes in view; the magnifier covers as few as possible.
std::optional<Magnifier> stage_magnifier(const View& view, const Camera& camera,
                                         const Layout& layout,
                                         const std::vector<trace::Frame>& frames,
                                         const std::vector<Vec3d>& shapes);

/// Middle of this frame's subject, world; nothing without a subject.
std::optional<Vec3d> magnified_middle(const View& view, const trace::Frame& frame);

/// Scales for the magnifier with which overlaps and gaps are about as long in it as in the view.
SequenceScales scales_within(const Magnifier& magnifier, const SequenceScales& scales);

/// Draws the sketch again, with its labels; `note` follows the factor.
void draw_magnified(const Magnifier& magnifier, const Vec3d& middle, Sketch sketch,
                    const std::string& note, const Camera& camera, const Layout& layout,
                    Drawing& drawing);

}  // namespace contactscope::draw
