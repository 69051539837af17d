#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/ghost.h"

/// Onion skins: where the moving shapes have been in the frames before that are drawn. What jumps
/// over something leaves no skin in between.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMostSkins = 12;  // of one shape; older ones are left out

constexpr LineStyle kPast{1.2f, kDropped};
constexpr LineStyle kTrailWay{1.2f, kDropped, true};

constexpr Swatch kPastSwatch{LegendGroup::Motion, 4, [](auto& pen) { pen.area(kDropped, 0, 1.2); }};

void draw_trail(const Scene& scene, Sketch& sketch) {
  if (scene.sequence == nullptr) return;
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.is_mesh() || shape.traced().half_space) continue;
    const Vec3d middle = shape.traced().center_of_mass;
    std::vector<Pose<double>> past;
    for (const FramePoses& frame : *scene.sequence) {
      if (frame.frame >= scene.frame.frame) break;
      const auto then = std::ranges::find(frame.poses, shape.traced().name,
                                          &std::pair<std::string, Pose<double>>::first);
      if (then != frame.poses.end()) past.push_back(then->second);
    }
    if (past.size() > kMostSkins) past.erase(past.begin(), past.end() - kMostSkins);
    past.push_back(shape.pose);
    for (std::size_t k = 0; k + 1 < past.size(); ++k) {
      const Pose<double>&then = past[k], &next = past[k + 1];
      const Vec3d way = next.transform(middle) - then.transform(middle);
      if (way.isZero(0) && then.rotation.coeffs() == next.rotation.coeffs()) continue;
      const Eigen::AngleAxisd back(then.rotation * shape.pose.rotation.conjugate());
      const Vec3d now = shape.pose.transform(middle);
      draw_ghost(scene.camera,
                 moved(shape, now, then.transform(middle) - now, Vec3d(back.angle() * back.axis())),
                 kPast, sketch);
      sketch.line(then.transform(middle), then.transform(middle) + way, kTrailWay);
      sketch.explain(kPastSwatch, "in the frames before", then.transform(middle));
    }
  }
}

}  // namespace

const LayerDrawing kTrailLayer{.beneath = draw_trail};

}  // namespace contactscope::draw
