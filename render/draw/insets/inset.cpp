#include "draw/insets/inset.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/compose.h"
#include "draw/scene/palette.h"
#include "draw/scene/view_fit.h"
#include "draw/staging.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kInsetFieldOfView = 30 * 3.14159265358979323846 / 180;
constexpr double kInsetShare = 0.82;  // of the viewport: labels stand around what it shows
constexpr double kSphereShare = 0.9;
constexpr double kInsetHeading = 17;  // pixels at 720 lines
constexpr double kInsetHeadingRow = 26;
constexpr double kInsetPadding = 10;

bool is_inset(Panel panel) {
  return panel == Panel::Minkowski || panel == Panel::GaussMap;
}

Rect viewport_of(const Rect& frame, const Layout& layout) {
  const double padding = layout.px(kInsetPadding);
  const double top = padding + layout.px(kInsetHeadingRow);
  return {frame.x + padding, frame.y + top, frame.width - 2 * padding,
          frame.height - top - padding};
}

}  // namespace

std::vector<Panel> take_insets(View& view) {
  std::vector<Panel> insets;
  for (const Panel panel : view.panels) {
    if (is_inset(panel)) insets.push_back(panel);
  }
  std::erase_if(view.panels, is_inset);
  return insets;
}

std::vector<Inset> stage_insets(const std::vector<Panel>& panels, const Staging& staging,
                                const std::vector<trace::Frame>& frames) {
  const Vec3d world_up = staging.header->up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  std::vector<Inset> insets;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool sphere = panels[i] == Panel::GaussMap;
    const Rect viewport = viewport_of(staging.layout.insets[i], staging.layout);
    Vec3d direction = staging.camera.right().cross(staging.camera.up());
    if (sphere) direction = gauss_map_direction(frames, direction);
    const double half_height = std::tan(0.5 * kInsetFieldOfView);
    const double aspect = viewport.width / viewport.height;
    // From so far the rays that touch the unit sphere make the wanted angle.
    ViewFit fit{Vec3d::Zero(),
                1 / std::sin(std::atan(kSphereShare * half_height * std::min(1.0, aspect)))};
    if (!sphere) {
      fit = fit_view(minkowski_extent(frames), ViewAxes(direction, world_up), std::nullopt,
                     half_height, aspect, kInsetShare);
      if (!(fit.distance > 0)) fit.distance = 1;  // nothing but the origin
    }
    insets.push_back({panels[i], staging.layout.insets[i],
                      Camera::perspective(fit.target + fit.distance * direction, fit.target,
                                          world_up, kInsetFieldOfView, viewport),
                      staging.layout.scale});
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
  compose(picture.sketch, inset.camera, inner, drawing);

  const auto x0 = static_cast<float>(inset.frame.x), y0 = static_cast<float>(inset.frame.y);
  const auto x1 = static_cast<float>(inset.frame.x + inset.frame.width);
  const auto y1 = static_cast<float>(inset.frame.y + inset.frame.height);
  const Point2 corners[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (int i = 0; i < 4; ++i) {
    drawing.primitives.push_back(Stroke{corners[i], corners[(i + 1) % 4], layout.px(1),
                                        with_alpha(kQuietText, 0.5f), Cap::Butt});
  }
  const float padding = layout.px(kInsetPadding);
  const float baseline = y0 + padding + 0.8f * layout.px(kInsetHeading);
  Text heading;
  heading.size = layout.px(kInsetHeading);
  heading.weight = Weight::Bold;
  heading.color = kText;
  heading.at = {x0 + padding, baseline};
  const float room = x1 - x0 - 2 * padding;
  heading.text = fitted(picture.heading, heading.size, FontWeight::Bold, room);
  const float used = text_width(heading.text, heading.size, FontWeight::Bold);
  drawing.primitives.push_back(heading);
  Text note;
  note.size = layout.px(15);
  note.color = kQuietText;
  note.align = Align::Right;
  note.at = {x1 - padding, baseline};
  note.text = fitted(picture.note, note.size, FontWeight::Regular, room - used - 2 * padding);
  // A word that lost its end tells nothing.
  if (note.text == picture.note) drawing.primitives.push_back(note);
}

}  // namespace contactscope::draw
