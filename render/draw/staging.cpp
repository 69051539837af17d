#include "draw/staging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "draw/illustrate.h"
#include "draw/scene/plane_patch.h"
#include "draw/scene/view_fit.h"

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

Vec3d up_axis(const trace::Header& header) {
  return header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
}

// From the front right and a little above.
Vec3d default_direction(const trace::Header& header) {
  return header.up == "z" ? Vec3d(0.62, -1.0, 0.5).normalized()
                          : Vec3d(0.62, 0.5, 1.0).normalized();
}

struct Subject {
  std::vector<Vec3d> points;
  Vec3d normal = Vec3d::Zero();  // of the contact, to the viewer's side; zero when there is none
};

// The contact's normal, to the side from which it is looked at; either one, unless a half-space
// would then hide everything.
Vec3d seen_side(const std::vector<ShapeMesh>& meshes, const trace::Frame& frame,
                const trace::Pair& pair, const trace::Manifold& manifold, const Vec3d& usual) {
  for (const PlacedShape& shape : place_shapes(meshes, frame)) {
    const std::string& name = shape.mesh->shape->name;
    if ((name != pair.a && name != pair.b) || !shape.mesh->shape->half_space) continue;
    return shape.pose.rotate(shape.mesh->shape->half_space->normal);
  }
  return manifold.normal.dot(usual) < 0 ? Vec3d(-manifold.normal) : manifold.normal;
}

Subject contact_patches(const std::vector<trace::Frame>& frames,
                        const std::vector<ShapeMesh>& meshes, const Vec3d& usual) {
  Subject subject;
  std::vector<Vec3d>& points = subject.points;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        if (subject.normal.isZero())
          subject.normal = seen_side(meshes, frame, pair, manifold, usual);
        for (const trace::Point& point : manifold.points) points.push_back(point.position);
      }
      if (pair.reduction) {
        for (const trace::Point& point : pair.reduction->points) points.push_back(point.position);
      }
      if (pair.clip) {
        const trace::Polygon& incident = pair.clip->incident.polygon;
        points.insert(points.end(), incident.begin(), incident.end());
      }
    }
  }
  if (points.empty()) return subject;
  // A point contact has no size: what lies around it counts instead.
  double smallest = std::numeric_limits<double>::max();
  for (const ShapeMesh& mesh : meshes) smallest = std::min(smallest, mesh.radius);
  const Vec3d center = center_of(points);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d reach = kLeastContext * smallest * Vec3d::Unit(axis);
    points.push_back(center + reach);
    points.push_back(center - reach);
  }
  return subject;
}

Subject all_shapes(const std::vector<trace::Frame>& frames, const std::vector<ShapeMesh>& meshes) {
  Subject subject;
  for (const trace::Frame& frame : frames) {
    const std::vector<PlacedShape> placed = place_shapes(meshes, frame);
    const auto add = [&](const std::vector<Vec3d>& points) {
      subject.points.insert(subject.points.end(), points.begin(), points.end());
    };
    add(extent_points(placed));
    for (const PlacedShape& shape : placed) {
      if (shape.mesh->patch) add(patch_corners(shape));
    }
  }
  return subject;
}

// What a picture cannot crop as it may a box: round shapes, which are known by their outline alone,
// and the ground with all that is on it.
Subject uncropped(const std::vector<trace::Frame>& frames, const std::vector<ShapeMesh>& meshes) {
  if (std::ranges::any_of(meshes, [](const ShapeMesh& mesh) { return mesh.patch.has_value(); })) {
    return all_shapes(frames, meshes);
  }
  Subject subject;
  for (const trace::Frame& frame : frames) {
    for (const PlacedShape& shape : place_shapes(meshes, frame)) {
      if (shape.mesh->shape->radius == 0) continue;
      const std::vector<Vec3d> points = extent_points(shape);
      subject.points.insert(subject.points.end(), points.begin(), points.end());
    }
  }
  return subject;
}

// All but what is large beside the smallest shape.
Subject without_floors(const std::vector<trace::Frame>& frames,
                       const std::vector<ShapeMesh>& meshes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ShapeMesh& mesh : meshes) smallest = std::min(smallest, mesh.radius);
  Subject subject;
  for (const trace::Frame& frame : frames) {
    for (const PlacedShape& shape : place_shapes(meshes, frame)) {
      if (!(shape.mesh->radius <= kLargeShape * smallest)) continue;
      const std::vector<Vec3d> points = extent_points(shape);
      subject.points.insert(subject.points.end(), points.begin(), points.end());
    }
  }
  return subject;
}

// Above the contact plane on the side of `normal`.
Vec3d viewing_direction(const trace::Header& header, const Vec3d& normal) {
  const Vec3d usual = default_direction(header);
  if (normal.isZero()) return usual;
  Vec3d along = usual - usual.dot(normal) * normal;
  along = along.norm() > 1e-3 ? Vec3d(along.normalized()) : any_perpendicular(normal);
  return std::cos(radians(kElevation)) * along + std::sin(radians(kElevation)) * normal;
}

Camera fit_camera(const trace::Header& header, const std::vector<trace::Frame>& frames,
                  const std::vector<ShapeMesh>& meshes, const View& view, const Rect& viewport) {
  const Subject everything = all_shapes(frames, meshes);
  const Subject contact = contact_patches(frames, meshes, default_direction(header));
  const double fov = radians(view.fov_degrees.value_or(kFieldOfView));
  const double half_height = std::tan(0.5 * fov);
  const double aspect = viewport.width / viewport.height;

  // Without a target of the view's own, the direction of its eye is from the middle of all.
  Vec3d direction = viewing_direction(header, contact.normal);
  if (view.eye) {
    direction = (*view.eye - view.target.value_or(center_of(everything.points))).normalized();
  }
  const ViewAxes axes(direction, up_axis(header));
  ViewFit best = fit_view(everything.points, axes, view.target, half_height, aspect, kShapesShare);
  if (view.focus == Focus::Contact && !contact.points.empty()) {
    ViewFit close = fit_view(contact.points, axes, view.target, half_height, aspect, kPatchShare);
    Subject whole = uncropped(frames, meshes);
    if (!whole.points.empty()) {
      whole.points.insert(whole.points.end(), contact.points.begin(), contact.points.end());
      const ViewFit around =
          fit_view(whole.points, axes, view.target, half_height, aspect, kShapesShare);
      close = {around.target, std::max(around.distance, close.distance)};
    } else {  // whole bodies, as long as the patch stays a third of the view
      const ViewFit least =
          fit_view(contact.points, axes, view.target, half_height, aspect, kLeastPatch);
      Subject bodies = without_floors(frames, meshes);
      bodies.points.insert(bodies.points.end(), contact.points.begin(), contact.points.end());
      const ViewFit seen =
          fit_view(bodies.points, axes, view.target, half_height, aspect, kShapesShare);
      if (seen.distance <= least.distance)
        close = {seen.target, std::max(seen.distance, close.distance)};
    }
    // Not so near that the shapes are lost.
    if (close.distance < best.distance) {
      best = {close.target, std::max(close.distance, kLeastShapes * best.distance)};
    }
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
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          const std::optional<Point2> at = camera.project(point.position);
          if (!at || !camera.viewport().contains(*at)) continue;
          deepest = std::max(deepest, -point.separation * camera.pixels_per_metre(point.position));
        }
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

}  // namespace

Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& asked, int width, int height) {
  View view = asked;
  const std::vector<Panel> insets = take_insets(view);
  std::vector<ShapeMesh> meshes;
  for (const trace::Shape& shape : header.shapes) meshes.push_back(make_mesh(shape));
  fit_patches(header, frames, meshes);

  // The camera needs the view's rectangle, that needs the rows of the legend, and these follow from
  // what each frame shows: sketch all frames with a camera that only has to exist.
  const Layout without_legend = make_layout(width, height, !view.panels.empty(), {}, insets.size());
  Staging staging{&header,
                  view,
                  meshes,
                  without_legend,
                  fit_camera(header, frames, meshes, view, without_legend.view),
                  1,
                  nullptr,
                  {},
                  {}};
  if (view.kind == ViewKind::ContactPlane) {
    staging.cells = std::make_shared<ContactCells>(header.title, header.source, header.up,
                                                   reduced(frames), view.choices, width, height);
    return staging;
  }
  staging.depth_factor = fit_depth_factor(frames, view, staging.camera, staging.layout.scale);
  staging.scales = fit_scales(meshes, frames, staging.camera, staging.layout, view);
  staging.insets = stage_insets(insets, staging, frames);
  std::vector<std::vector<float>> widths;
  for (const trace::Frame& frame : frames) {
    std::vector<float> entries;
    for (const LegendEntry& entry : legend_of(staging, frame)) {
      entries.push_back(legend_entry_width(entry, staging.layout.scale));
    }
    if (widths.empty() || widths.back() != entries) widths.push_back(std::move(entries));
  }
  staging.layout = make_layout(width, height, !view.panels.empty(), widths, insets.size());
  staging.camera = fit_camera(header, frames, meshes, view, staging.layout.view);
  staging.depth_factor = fit_depth_factor(frames, view, staging.camera, staging.layout.scale);
  staging.scales = fit_scales(meshes, frames, staging.camera, staging.layout, view);
  staging.insets = stage_insets(insets, staging, frames);
  return staging;
}

}  // namespace contactscope::draw
