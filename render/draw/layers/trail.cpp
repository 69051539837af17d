#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/ghost.h"

/// Onion skins: outlines of moving shapes in earlier frames. A jump leaves no outlines in between.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMaxSkins = 12;  // per shape

constexpr LineStyle kPast{1.2f, kDropped};
constexpr LineStyle kTrailPath{1.5f, kDropped, true};
// If dashes mark future positions.
constexpr LineStyle kSolidPath{1.2f, with_alpha(kDropped, 0.7f)};

constexpr double kMinOfBox = 30;    // pixels: shorter displacements are drawn for balls only
constexpr double kMinStep = 4;      // pixels: closer outlines would merge into bars
constexpr double kMinTurn = 0.005;  // sine of half the rotation
constexpr double kSpread = 1.1;     // radii of the shape between the outlines of a long path

constexpr Swatch kPastSwatch{LegendGroup::Motion, 4,
                             [](auto& pen) { pen.level_line(0, 23, 1.2, kDropped); }};

// Thins poses, from the present one (last) back to the oldest, so that outlines are
// distinguishable.
std::vector<Pose<double>> spread(const std::vector<Pose<double>>& past, const PlacedShape& shape) {
  const Vec3d& middle = shape.traced().center_of_mass;
  const double radius = shape.mesh->radius;
  std::vector<Pose<double>> kept = {past.back()};
  for (auto pose = past.rbegin() + 1; pose != past.rend(); ++pose) {
    const Pose<double>& after = kept.back();
    const double offset = (pose->transform(middle) - after.transform(middle)).norm();
    const double turn = 2 * (pose->rotation * after.rotation.conjugate()).vec().norm();
    if (offset + radius * turn >= kSpread * radius) kept.push_back(*pose);
  }
  std::ranges::reverse(kept);
  return kept;
}

void draw_trail(const Scene& scene, Sketch& sketch) {
  if (scene.sequence == nullptr) return;
  const bool shows_future = scene.shows(Layer::Sweep) || scene.shows(Layer::Ahead);
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
    const bool is_long = past.size() > kMaxSkins;
    past.push_back(shape.pose);
    const std::size_t before = past.size() < 2 ? 0 : past.size() - 2;
    const auto last_path =
        seen_distance(scene.camera, past[before].transform(middle), shape.pose.transform(middle));
    const bool rests = last_path && *last_path < kMinStep * scene.scales.pixel;
    if (is_long) past = spread(past, shape);
    if (past.size() > kMaxSkins + 1) past.erase(past.begin(), past.end() - kMaxSkins - 1);
    const Vec3d now = shape.pose.transform(middle);
    const double pixels_per_metre = scene.camera.pixels_per_metre(now) / scene.scales.pixel;
    std::optional<Vec3d> last;  // position of the newest drawn outline
    for (std::size_t k = 0; k + 1 < past.size(); ++k) {
      const Pose<double>&then = past[k], &next = past[k + 1];
      const Vec3d place = then.transform(middle), offset = next.transform(middle) - place;
      const Quatd turn = then.rotation * shape.pose.rotation.conjugate();
      if (offset.isZero(0) && then.rotation.coeffs() == next.rotation.coeffs()) continue;
      // Inside a box, a displacement too short for an arrow head has no meaning. If the shape rests
      // now, arrows would suggest that it still moves.
      const auto seen = seen_distance(scene.camera, place, Vec3d(place + offset));
      const bool has_head = seen && *seen >= kMinOfBox * scene.scales.pixel;
      if (border_of_ball(shape) > 0 || (has_head && !rests))
        draw_path(scene, place, place + offset, border_of_ball(shape),
                  shows_future ? kSolidPath : kTrailPath, sketch);
      const auto merges = [&](const Vec3d& other) {
        return (place - other).norm() * pixels_per_metre < kMinStep;
      };
      if (turn.vec().norm() < kMinTurn && (merges(now) || (last && merges(*last)))) continue;
      last = place;
      const Eigen::AngleAxisd back(turn);
      draw_ghost(scene.camera, moved(shape, now, place - now, Vec3d(back.angle() * back.axis())),
                 kPast, sketch);
      sketch.explain(kPastSwatch, "in the frames before", place);
    }
  }
}

}  // namespace

const LayerDrawing kTrailLayer{.beneath = draw_trail};

}  // namespace contactscope::draw
