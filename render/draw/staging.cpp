#include "draw/staging.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/at.h"
#include "draw/illustrate.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/plane_patch.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr double kFieldOfView = 30;       // degrees; stronger perspective would bend right angles
constexpr double kElevation = 30;         // degrees above the contact plane
constexpr double kPatchShare = 0.46;      // of the view's smaller side
constexpr double kLeastPatch = 0.345;     // of it, where all shapes can be seen
constexpr double kShapesShare = 0.92;     // of the view, when all shapes are to be seen
constexpr double kLeastShapes = 0.72;     // of the distance from which all shapes are seen
constexpr double kLargeShape = 2.2;       // radii of the smallest: a floor, which may be cropped
constexpr double kLeastContext = 0.45;    // of the smaller shape's radius: a point has no size
constexpr double kLegibleDepth = 13;      // pixels: six beyond the border of the dot
constexpr double kExaggeratedDepth = 24;  // pixels that the deepest overlap of the sequence gets

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

// From the front right and a little above.
Vec3d default_direction(const trace::Header& header) {
  return header.up == "z" ? Vec3d(0.62, -1.0, 0.5).normalized()
                          : Vec3d(0.62, 0.5, 1.0).normalized();
}

/// Points of a sequence that a picture must hold. One that has not moved since the frame before
/// stands there already.
struct Cloud {
  std::vector<Vec3d> points, last;

  void add(std::vector<Vec3d> frame) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (i >= last.size() || frame[i] != last[i]) points.push_back(frame[i]);
    }
    last = std::move(frame);
  }
};

/// What a sequence asks of a camera, gathered in one pass over its frames.
struct Extent {
  std::vector<Vec3d> shapes;     // all of them
  std::vector<Vec3d> uncropped;  // what a picture cannot crop as it may a box; see below
  std::vector<Vec3d> bodies;     // all but floors; only where there is nothing of `uncropped`
  std::vector<Vec3d> contact;    // its patches
  Vec3d normal = Vec3d::Zero();  // of the contact, to the viewer's side; zero when there is none
};

// The contact's normal, to the side from which it is looked at; either one, unless a half-space
// would then hide everything.
Vec3d seen_side(const ShapeMeshes& meshes, const std::vector<PlacedShape>& placed,
                const trace::Pair& pair, const Vec3d& normal, const Vec3d& usual) {
  for (const std::string* name : {&pair.a, &pair.b}) {
    const std::optional<std::size_t> place = meshes.find(*name);
    if (!place || !meshes[*place].shape->half_space) continue;
    return placed[*place].pose.rotate(meshes[*place].shape->half_space->normal);
  }
  return normal.dot(usual) < 0 ? Vec3d(-normal) : normal;
}

void add_contact(const trace::Pair& pair, std::vector<Vec3d>& points) {
  for (const PairPoint& any : all_points(pair)) points.push_back(any.point->position);
  if (pair.reduction) {
    for (const trace::Point& point : pair.reduction->points) points.push_back(point.position);
  }
  if (pair.clip) append(points, pair.clip->incident.polygon);
}

/// A plane of a sequence, and where it stands in each frame.
struct SequencePlane {
  PatchFit fit;
  std::vector<Pose<double>> poses;
};

// Also gives every plane of `meshes` its patch. Not to be cropped are round shapes, which are known by
// their outline alone, and the ground with all that is on it.
Extent gather(const trace::Header& header, const std::vector<trace::Frame>& frames,
              ShapeMeshes& meshes) {
  const Vec3d usual = default_direction(header);
  const double smallest = meshes.smallest_radius();
  const auto is_round = [](const ShapeMesh& mesh) { return mesh.shape->radius > 0; };
  const bool any_round = std::ranges::any_of(meshes, is_round);
  std::map<std::size_t, SequencePlane> planes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (const auto& plane = meshes[i].shape->half_space)
      planes.try_emplace(i, SequencePlane{{*plane, up_axis(header)}, {}});
  }
  Extent extent;
  Cloud shapes, round, bodies;
  for (const trace::Frame& frame : frames) {
    const std::vector<PlacedShape> placed = place_shapes(meshes, frame);
    std::vector<Vec3d> points = extent_points(placed), chosen;
    for (auto& [i, plane] : planes) {
      plane.fit.add(placed[i].pose, points);
      plane.poses.push_back(placed[i].pose);
    }
    shapes.add(std::move(points));
    for (const PlacedShape& shape : placed) {
      if (any_round ? is_round(*shape.mesh) : shape.mesh->radius <= kLargeShape * smallest)
        append(chosen, extent_points(shape));
    }
    (any_round ? round : bodies).add(std::move(chosen));
    for (const trace::Pair& pair : frame.pairs) {
      if (extent.normal.isZero() && !pair.manifolds.empty())
        extent.normal = seen_side(meshes, placed, pair, pair.manifolds.front().normal, usual);
      add_contact(pair, extent.contact);
    }
  }
  extent.shapes = std::move(shapes.points);
  for (const auto& [i, plane] : planes) {
    meshes[i].patch = plane.fit.patch();
    Cloud corners;
    for (const Pose<double>& pose : plane.poses) corners.add(patch_corners(*meshes[i].patch, pose));
    append(extent.shapes, corners.points);
  }
  extent.uncropped = planes.empty() ? round.points : extent.shapes;
  extent.bodies = std::move(bodies.points);
  if (extent.contact.empty()) return extent;
  // A point contact has no size: what lies around it counts instead.
  const Vec3d center = center_of(extent.contact);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d reach = kLeastContext * smallest * Vec3d::Unit(axis);
    append(extent.contact, std::array<Vec3d, 2>{center + reach, center - reach});
  }
  return extent;
}

// Above the contact plane on the side of `normal`.
Vec3d viewing_direction(const trace::Header& header, const Vec3d& normal) {
  const Vec3d usual = default_direction(header);
  if (normal.isZero()) return usual;
  Vec3d along = usual - usual.dot(normal) * normal;
  along = along.norm() > 1e-3 ? Vec3d(along.normalized()) : any_perpendicular(normal);
  return std::cos(radians(kElevation)) * along + std::sin(radians(kElevation)) * normal;
}

Camera fit_camera(const trace::Header& header, const Extent& extent, const View& view,
                  const Rect& viewport) {
  const double fov = radians(view.fov_degrees.value_or(kFieldOfView));
  const double half_height = std::tan(0.5 * fov);
  const double aspect = viewport.width / viewport.height;

  // Without a target of the view's own, the direction of its eye is from the middle of all.
  Vec3d direction = viewing_direction(header, extent.normal);
  if (view.eye) {
    direction = (*view.eye - view.target.value_or(center_of(extent.shapes))).normalized();
  }
  const ViewAxes axes(direction, up_axis(header));
  const auto fit = [&](std::vector<Vec3d> points, double share,
                       const std::vector<Vec3d>& more = {}) {
    append(points, more);
    return fit_view(points, axes, view.target, half_height, aspect, share);
  };
  ViewFit best = fit(extent.shapes, kShapesShare);
  if (view.focus == Focus::Contact && !extent.contact.empty()) {
    ViewFit close = fit(extent.contact, kPatchShare);
    if (!extent.uncropped.empty()) {
      const ViewFit around = fit(extent.uncropped, kShapesShare, extent.contact);
      close = {around.target, std::max(around.distance, close.distance)};
    } else {  // whole bodies, as long as the patch stays a third of the view
      const ViewFit seen = fit(extent.bodies, kShapesShare, extent.contact);
      if (seen.distance <= fit(extent.contact, kLeastPatch).distance)
        close = {seen.target, std::max(seen.distance, close.distance)};
    }
    // Not so near that the shapes are lost.
    if (close.distance < best.distance)
      best = {close.target, std::max(close.distance, kLeastShapes * best.distance)};
  }
  if (view.eye) best.distance = (*view.eye - best.target).norm();
  const Vec3d eye = view.eye.value_or(best.target + best.distance * direction);
  if (view.orthographic_height) {
    return Camera::orthographic(eye, best.target, up_axis(header), *view.orthographic_height,
                                viewport);
  }
  return Camera::perspective(eye, best.target, up_axis(header), fov, viewport);
}

// 1, 2, 5, 10, 20, 50, ...: the least round factor that makes the deepest overlap legible.
double fit_depth_factor(const std::vector<trace::Frame>& frames, const View& view,
                        const Camera& camera, double scale) {
  // These have no whiskers there.
  const bool by_age = view.shows(Layer::Persistent);
  double deepest = 0;  // pixels
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (by_age && pair.incremental) continue;
      for (const auto& [manifold, point] : all_points(pair)) {
        const Vec3d& at = point->position;
        if (camera.sees(at))
          deepest = std::max(deepest, -point->separation * camera.pixels_per_metre(at));
      }
    }
  }
  if (deepest <= 0 || deepest >= kLegibleDepth * scale) return 1;
  const double wanted = kExaggeratedDepth * scale / deepest;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= 0.75 * wanted) return step * decade;
  }
  return 10 * decade;
}

// For the legend of each frame the widths of its entries.
std::vector<std::vector<float>> legend_widths(const Staging& staging,
                                              const std::vector<trace::Frame>& frames) {
  std::vector<std::vector<float>> widths;
  for (const trace::Frame& frame : frames) {
    std::vector<float> entries;
    for (const LegendEntry& entry : legend_of(staging, frame))
      entries.push_back(legend_entry_width(entry, staging.layout.scale));
    if (widths.empty() || widths.back() != entries) widths.push_back(std::move(entries));
  }
  return widths;
}

}  // namespace

Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& asked, int width, int height, const LayerTable& layers) {
  View view = asked;
  const std::vector<Panel> insets = take_insets(view);
  ShapeMeshes meshes(header.shapes);
  const Extent extent = gather(header, frames, meshes);
  const auto layout = [&](const std::vector<std::vector<float>>& widths) {
    return make_layout(width, height, !view.panels.empty(), widths, count_of(insets));
  };
  // The camera needs the view's rectangle, that needs the rows of the legend, and these follow from
  // what each frame shows: explain all frames with a camera that only has to exist.
  Staging staging{&header,           view,       &layers,
                  std::move(meshes), layout({}), fit_camera(header, extent, view, layout({}).view)};
  if (view.kind == ViewKind::ContactPlane) {
    staging.cells = std::make_shared<ContactCells>(header.title, header.source, header.up,
                                                   reduced(frames), view.choices, width, height);
    return staging;
  }
  const auto fit = [&] {
    staging.depth_factor = fit_depth_factor(frames, view, staging.camera, staging.layout.scale);
    staging.scales = fit_scales(staging.meshes, frames, staging.camera, staging.layout, view);
    staging.insets = stage_insets(insets, up_axis(header), staging.camera, staging.layout, frames);
  };
  fit();
  staging.layout = layout(legend_widths(staging, frames));
  staging.camera = fit_camera(header, extent, view, staging.layout.view);
  fit();
  return staging;
}

}  // namespace contactscope::draw
