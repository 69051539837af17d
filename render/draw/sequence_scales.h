#pragma once

#include <string>
#include <vector>

namespace contactscope::trace {
struct Frame;
}

namespace contactscope::draw {

class Camera;
struct Layout;
struct ShapeMesh;

/// How long a whole sequence draws what is no length. All are 1, 2 or 5 times a power of ten, so
/// that a legend can state them.
struct SequenceScales {
  double impulse = 0;          // metres for one newton second; 0 where there are no impulses
  double longest_impulse = 0;  // metres; longer arrows are cut there, and marked as such
  double velocity = 0;         // seconds: an arrow is the way in this time; 0 where nothing moves
  double spin = 0;             // seconds: a curved arrow is the turn in this time
  double drift = 1;            // how far anchors are apart is drawn this many times as long
};

SequenceScales fit_scales(const std::vector<ShapeMesh>& meshes,
                          const std::vector<trace::Frame>& frames, const Camera& camera,
                          const Layout& layout);

/// The largest 1, 2 or 5 times a power of ten that is at most `value` > 0.
double round_down(double value);

/// "1 N s = 0.2 m", or of small impulses "10 mN s = 50 mm".
std::string spell_impulse_scale(double metres_per_newton_second);

}  // namespace contactscope::draw
