#pragma once

#include <string>
#include <vector>

namespace contactscope {
struct View;
}
namespace contactscope::trace {
struct Frame;
}

namespace contactscope::draw {

class Camera;
struct Layout;
class ShapeMeshes;

/// How long a whole sequence draws what is no length. All are 1, 2 or 5 times a power of ten, so
/// that a legend can state them.
struct SequenceScales {
  double impulse = 0;          // metres for one newton second; 0 where there are no impulses
  double longest_impulse = 0;  // metres; longer arrows are cut there, and marked as such
  double friction = 0;         // metres for one newton second of friction
  double velocity = 0;         // seconds: an arrow is the way in this time; 0 where nothing moves
  double spin = 0;             // seconds: a curved arrow is the turn in this time
  double drift = 1;            // how far anchors are apart is drawn this many times as long
  double closing = 0;          // metres a second: largest relative velocity along a normal
  double step = 0;             // seconds from a frame to the next; 0 of one frame alone
  double pixel = 1;            // pixels for one at 720 lines
  double touching = 0;         // metres: a contact point whose separation is larger does not touch
};

SequenceScales fit_scales(const ShapeMeshes& meshes, const std::vector<trace::Frame>& frames,
                          const Camera& camera, const Layout& layout, const View& view);

/// The largest 1, 2 or 5 times a power of ten that is at most `value` > 0.
double round_down(double value);

/// "1 N s = 0.2 m", or of small impulses "10 mN s = 50 mm"; of another unit than newton seconds
/// likewise.
std::string spell_impulse_scale(double metres_per_unit, const std::string& unit = "N s");

}  // namespace contactscope::draw
