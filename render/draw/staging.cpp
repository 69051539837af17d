#include "draw/staging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "draw/illustrate.h"

namespace contactscope::draw {
namespace {

constexpr double kFieldOfView = 30;       // degrees; stronger perspective would bend right angles
constexpr double kElevation = 30;         // degrees above the contact plane
constexpr double kPatchShare = 0.46;      // of the view's smaller side
constexpr double kShapesShare = 0.92;     // of the view, when all shapes are to be seen
constexpr double kLeastContext = 0.45;    // of the smaller shape's radius: a point has no size
constexpr double kLegibleDepth = 6;       // pixels; PICTURES.md, "Composition"
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
  Vec3d center = Vec3d::Zero();
  double radius = 0;
  Vec3d normal = Vec3d::Zero();  // zero when there is no contact
};

Subject bounding(const std::vector<Vec3d>& points) {
  Subject subject;
  if (points.empty()) return subject;
  Vec3d low = points.front(), high = points.front();
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  subject.center = 0.5 * (low + high);
  for (const Vec3d& p : points) {
    subject.radius = std::max(subject.radius, (p - subject.center).norm());
  }
  return subject;
}

Subject contact_patches(const std::vector<trace::Frame>& frames,
                        const std::vector<ShapeMesh>& meshes) {
  std::vector<Vec3d> points;
  Vec3d normal = Vec3d::Zero();
  double smallest = std::numeric_limits<double>::max();
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        if (normal.isZero()) normal = manifold.normal;
        for (const trace::Point& point : manifold.points) points.push_back(point.position);
      }
      if (pair.reduction) {
        for (const trace::Point& point : pair.reduction->points) points.push_back(point.position);
      }
      if (pair.clip) {
        for (const Vec3d& p : pair.clip->incident.polygon) points.push_back(p);
      }
    }
  }
  for (const ShapeMesh& mesh : meshes) smallest = std::min(smallest, mesh.radius);
  Subject subject = bounding(points);
  if (points.empty()) return subject;
  subject.normal = normal;
  subject.radius = std::max(subject.radius, kLeastContext * smallest);
  return subject;
}

Subject all_shapes(const std::vector<trace::Frame>& frames, const std::vector<ShapeMesh>& meshes) {
  std::vector<Vec3d> points;
  for (const trace::Frame& frame : frames) {
    for (const PlacedShape& shape : place_shapes(meshes, frame)) {
      points.insert(points.end(), shape.vertices.begin(), shape.vertices.end());
    }
  }
  return bounding(points);
}

Vec3d viewing_direction(const trace::Header& header, const Subject& subject) {
  const Vec3d usual = default_direction(header);
  if (subject.normal.isZero()) return usual;
  const Vec3d normal = subject.normal.dot(usual) < 0 ? Vec3d(-subject.normal) : subject.normal;
  Vec3d along = usual - usual.dot(normal) * normal;
  along = along.norm() > 1e-3 ? Vec3d(along.normalized()) : any_perpendicular(normal);
  return std::cos(radians(kElevation)) * along + std::sin(radians(kElevation)) * normal;
}

Camera fit_camera(const trace::Header& header, const std::vector<trace::Frame>& frames,
                  const std::vector<ShapeMesh>& meshes, const View& view, const Rect& viewport) {
  const Subject everything = all_shapes(frames, meshes);
  Subject subject = contact_patches(frames, meshes);
  double share = kPatchShare;
  if (view.focus == Focus::Shapes || subject.radius <= 0) {
    const Vec3d normal = subject.normal;
    subject = everything;
    subject.normal = normal;
    share = kShapesShare;
  }
  const Vec3d target = view.target.value_or(subject.center);
  const Vec3d direction =
      view.eye ? Vec3d((*view.eye - target).normalized()) : viewing_direction(header, subject);
  const double smaller = std::min(viewport.width, viewport.height);
  // Height of the picture in metres at the target.
  const double height = 2 * subject.radius / share * viewport.height / smaller;

  if (view.orthographic_height) {
    const double away = view.eye ? (*view.eye - target).norm() : 4 * everything.radius;
    return Camera::orthographic(target + away * direction, target, up_axis(header),
                                *view.orthographic_height, viewport);
  }
  const double fov = radians(view.fov_degrees.value_or(kFieldOfView));
  const double away = view.eye ? (*view.eye - target).norm() : 0.5 * height / std::tan(0.5 * fov);
  return Camera::perspective(target + away * direction, target, up_axis(header), fov, viewport);
}

// 1, 2, 5, 10, 20, 50, ...: the least round factor that makes the deepest overlap legible.
double fit_depth_factor(const std::vector<trace::Frame>& frames, const Camera& camera,
                        double scale) {
  double deepest = 0;  // pixels
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
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
              const View& view, int width, int height) {
  std::vector<ShapeMesh> meshes;
  for (const trace::Shape& shape : header.shapes) meshes.push_back(make_mesh(shape));

  // The camera needs the view's rectangle, that needs the rows of the legend, and these follow from
  // what each frame shows: sketch all frames with a camera that only has to exist.
  const Layout without_legend = make_layout(width, height, !view.panels.empty(), {});
  Staging staging{&header,
                  view,
                  meshes,
                  without_legend,
                  fit_camera(header, frames, meshes, view, without_legend.view),
                  1};
  staging.depth_factor = fit_depth_factor(frames, staging.camera, staging.layout.scale);
  std::vector<std::vector<float>> widths;
  for (const trace::Frame& frame : frames) {
    std::vector<float> entries;
    for (const LegendEntry& entry : sketch_frame(staging, frame).legend) {
      entries.push_back(legend_entry_width(entry, staging.layout.scale));
    }
    if (widths.empty() || widths.back() != entries) widths.push_back(std::move(entries));
  }
  staging.layout = make_layout(width, height, !view.panels.empty(), widths);
  staging.camera = fit_camera(header, frames, meshes, view, staging.layout.view);
  staging.depth_factor = fit_depth_factor(frames, staging.camera, staging.layout.scale);
  return staging;
}

}  // namespace contactscope::draw
