#include "draw/insets/inset.h"

namespace contactscope::draw {
namespace {

constexpr double kInsetFieldOfView = 30 * std::numbers::pi / 180;
constexpr double kInsetShare = 0.82;  // of the viewport: labels need room around the contents
constexpr double kSphereShare = 0.9;
constexpr double kInsetHeading = 17;  // pixels at 720 lines
constexpr double kInsetNote = 15, kInsetHeadingRow = 26, kInsetPadding = 10;

bool is_inset(Panel panel) { return panel == Panel::Minkowski || panel == Panel::GaussMap; }

/// Orthographic camera, with the scale of `camera` if all points fit. A gap between the shapes then
/// has the same length as the distance from the origin to the difference.
Camera parallel_camera(const Camera& camera, const std::vector<Vec3d>& points,
                       const Vec3d& direction, const Vec3d& world_up, const Rect& viewport) {
  Eigen::AlignedBox3d seen;  // right, up and towards the eye
  for (const Vec3d& p : points)
    seen.extend(Vec3d(p.dot(camera.right()), p.dot(camera.up()), p.dot(direction)));
  const Vec3d middle = seen.center(), size = seen.sizes();
  const double aspect = viewport.width / viewport.height;
  const double fitted = std::max(size.y(), size.x() / aspect) / kInsetShare;
  const Vec3d target =
      middle.x() * camera.right() + middle.y() * camera.up() + middle.z() * direction;
  const double alike = viewport.height / camera.pixels_per_metre(camera.eye() - direction);
  const double height = std::max(fitted, alike);
  return Camera::orthographic(target + (size.norm() + height) * direction, target, world_up,
                              height > 0 ? height : 1, viewport);
}

}  // namespace

std::vector<Panel> take_insets(View& view) {
  std::vector<Panel> insets;
  std::ranges::copy_if(view.panels, std::back_inserter(insets), is_inset);
  std::erase_if(view.panels, is_inset);
  return insets;
}

std::vector<Inset> stage_insets(const std::vector<Panel>& panels, const Vec3d& world_up,
                                const Camera& camera, const Layout& layout,
                                const std::vector<trace::Frame>& frames) {
  std::vector<Inset> insets;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool sphere = panels[i] == Panel::GaussMap;
    const Rect& frame = layout.insets[i];
    const double padding = layout.px(kInsetPadding);
    const double top = padding + layout.px(kInsetHeadingRow);
    const Rect viewport{frame.x + padding, frame.y + top, frame.width - 2 * padding,
                        frame.height - top - padding};
    Vec3d direction = camera.right().cross(camera.up());
    if (sphere) direction = gauss_map_direction(frames, direction);
    const double half_height = std::tan(0.5 * kInsetFieldOfView);
    const double aspect = viewport.width / viewport.height;
    // At this distance the rays that touch the unit sphere make the desired angle.
    ViewFit fit{Vec3d::Zero(),
                1 / std::sin(std::atan(kSphereShare * half_height * std::min(1.0, aspect)))};
    if (!sphere && !camera.is_perspective()) {
      insets.push_back(
          {panels[i], frame,
           parallel_camera(camera, minkowski_extent(frames), direction, world_up, viewport),
           i > 0 && panels[i - 1] == panels[i]});
      continue;
    }
    if (!sphere) {
      fit = fit_view(minkowski_extent(frames), direction, world_up, std::nullopt, half_height,
                     aspect, kInsetShare);
      if (!(fit.distance > 0)) fit.distance = 1;  // only the origin
    }
    insets.push_back({panels[i], frame,
                      Camera::perspective(fit.target + fit.distance * direction, fit.target,
                                          world_up, kInsetFieldOfView, viewport)});
  }
  return insets;
}

InsetPicture sketch_inset(const Inset& inset, const Scene& scene) {
  return inset.panel == Panel::GaussMap ? sketch_gauss_map(inset, scene)
                                        : sketch_minkowski(inset, scene);
}

void draw_inset(const Inset& inset, const InsetPicture& picture, const Layout& layout,
                Drawing& drawing) {
  Layout inner = layout;
  inner.view = inset.camera.viewport();
  inner.framed = true;
  inner.insets.clear();  // labels avoid other insets, but not their own
  drawing.begin(kInsetPart, {}, name_of(inset.panel));
  compose(picture.sketch, inset.camera, inner, drawing);

  const Pen pen(drawing, layout.scale, kInsetNote);
  pen.frame(inset.frame, 1, with_alpha(kQuietText, 0.5f));
  const float padding = pen.px(kInsetPadding), size = pen.px(kInsetHeading);
  const float left = static_cast<float>(inset.frame.x) + padding;
  const float right = static_cast<float>(inset.frame.right()) - padding;
  const float baseline = static_cast<float>(inset.frame.y) + padding + 0.8f * size;
  const Said heading = pen.fitted(picture.heading, Weight::Bold, right - left, kInsetHeading);
  pen.text(heading, {left, baseline}, Align::Left, kText, Weight::Bold, kInsetHeading);
  // A shortened note would have no meaning.
  const float used = text_width(heading.text, size, Weight::Bold) + 2 * padding;
  if (pen.width_of(picture.note) <= right - left - used)
    pen.text(picture.note, {right, baseline}, Align::Right, kQuietText);
}

}  // namespace contactscope::draw
