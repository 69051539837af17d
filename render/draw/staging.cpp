#include "draw/staging.h"

#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr double kFieldOfView = 30;    // degrees; stronger perspective would distort right angles
constexpr double kParallelField = 2;   // degrees; a narrow lens in place of a parallel projection
constexpr double kElevation = 30;      // degrees above the contact plane
constexpr double kPatchShare = 0.46;   // share of the view's smaller side
constexpr double kMinPatch = 0.345;    // smallest share with all shapes visible
constexpr double kShapesShare = 0.92;  // share of the view if all shapes should be visible
constexpr double kMinShapes = 0.72;    // share of the distance from which all shapes are visible
constexpr double kLargeShape = 2.2;    // radii of the smallest: a floor, may be cropped
constexpr double kMinContext = 0.45;   // of the smaller shape's radius: a point has no size
constexpr double kSubjectShare = 0.5;  // share of the view of shapes that the view focuses on

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// From the front right and a little above.
Vec3d default_direction(const trace::Header& header) {
  return header.up == "z" ? Vec3d(0.62, -1.0, 0.5).normalized()
                          : Vec3d(0.62, 0.5, 1.0).normalized();
}

/// Points of a sequence for fitting the view, without those that repeat the previous frame's.
struct Cloud {
  std::vector<Vec3d> points, last;

  void add(std::vector<Vec3d> frame) {
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (i >= last.size() || frame[i] != last[i]) points.push_back(frame[i]);
    last = std::move(frame);
  }
};

/// Shapes that a camera should show.
struct Cast {
  std::optional<HomeRegion> home;      // of all shapes; nothing: none is left out
  std::optional<HomeRegion> own_home;  // of the subject
  std::vector<bool> subject;           // for each shape of the header; empty: all shapes
  bool heap = false;                   // the contacts have no common normal

  bool has(const ShapeMeshes& meshes, const std::string& name) const {
    const auto place = meshes.find(name);
    return subject.empty() || (place && subject[*place]);
  }
};

/// Input for fitting a camera, gathered in one pass over the frames.
struct Extent {
  std::vector<Vec3d> shapes;     // all of them
  std::vector<Vec3d> subject;    // points of shapes that a picture of the contact must show
  bool croppable = true;         // whether to crop the subject if the contact would be too small
  std::vector<Vec3d> contact;    // its patches
  Vec3d normal = Vec3d::Zero();  // of the contact, towards the viewer; zero without contact
  Vec3d across = Vec3d::Zero();  // towards the eye, of two normals that are compared; may be zero
};

// The contact's normal towards the viewer: any side, unless a half-space would hide everything.
Vec3d seen_side(const std::vector<PlacedShape>& placed, const trace::Pair& pair,
                const Vec3d& usual) {
  for (const PlacedShape& shape : placed) {
    const trace::Shape& plane = shape.traced();
    if (plane.half_space && (plane.name == pair.a || plane.name == pair.b))
      return shape.pose.rotate(plane.half_space->normal);
  }
  const Vec3d& normal = pair.manifolds.front().normal;
  return normal.dot(usual) < 0 ? Vec3d(-normal) : normal;
}

/// Positions at the end of the step.
std::vector<Vec3d> swept_points(const std::vector<PlacedShape>& placed, const trace::Frame& frame) {
  std::vector<Vec3d> points;
  for (const trace::Pair& pair : frame.pairs) {
    if (!pair.impact) continue;
    for (const auto& [name, travel] :
         {std::pair(pair.a, pair.impact->travel_a), std::pair(pair.b, pair.impact->travel_b)}) {
      for (const PlacedShape& shape : placed)
        if (shape.traced().name == name && !shape.traced().half_space)
          append(points,
                 extent_points(moved(shape, travel.pivot, travel.displacement, travel.turn)));
    }
  }
  return points;
}

// Also gives every plane of `meshes` its patch. Round shapes, known by their outline alone, must
// not be cropped, nor the ground with everything on it. Otherwise the subject is all shapes except
// floors.
Extent gather(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& view, ShapeMeshes& meshes, bool with_sweeps = false,
              const Cast& cast = {}) {
  const Vec3d usual = default_direction(header);
  const double least = meshes.smallest_radius();
  const double smallest = std::isfinite(least) ? least : 0;  // zero without shapes
  const auto is_round = [](const ShapeMesh& mesh) { return mesh.shape->radius > 0; };
  const bool any_round = std::ranges::any_of(meshes, is_round);
  std::map<std::size_t, PatchFit> planes;
  Extent extent;
  Cloud shapes, subject;
  for (const trace::Frame& frame : frames) {
    std::vector<PlacedShape> placed = place_shapes(meshes, frame);
    std::vector<PlacedShape> own;  // of the subject
    if (!cast.subject.empty()) {
      std::ranges::copy_if(placed, std::back_inserter(own),
                           [&](const PlacedShape& shape) { return cast.subject[shape.place]; });
      if (cast.own_home) keep_home(*cast.own_home, shapes_in_contact(meshes, frame), own);
    }
    if (cast.home) keep_home(*cast.home, shapes_in_contact(meshes, frame), placed);
    std::vector<Vec3d> points = extent_points(placed), chosen;
    for (const PlacedShape& shape : placed) {
      if (const auto& plane = shape.traced().half_space)
        planes.try_emplace(shape.place, *plane, shape.pose, up_axis(header))
            .first->second.add(shape.pose, points);
      if (any_round ? is_round(*shape.mesh) : shape.mesh->radius <= kLargeShape * smallest)
        append(chosen, extent_points(shape));
    }
    for (const trace::Pair& pair : frame.pairs) {
      if (!view.shows(Layer::Volumes) || !pair.query) continue;
      for (const auto& volume : {pair.query->bounds_a, pair.query->bounds_b})
        if (volume) append(points, extent_points(*volume));
    }
    if (with_sweeps && view.shows(Layer::Sweep)) append(points, swept_points(placed, frame));
    shapes.add(cast.subject.empty() ? std::move(points) : extent_points(own));
    subject.add(std::move(chosen));
    for (const trace::Pair& pair : frame.pairs) {
      if (!cast.has(meshes, pair.a) && !cast.has(meshes, pair.b)) continue;
      if (extent.normal.isZero() && !pair.manifolds.empty())
        extent.normal = seen_side(placed, pair, usual);
      append(extent.contact, positions_of(pair));
      if (pair.reduction)
        append(extent.contact, mapped(pair.reduction->points, &trace::Point::position));
      if (pair.clip) append(extent.contact, pair.clip->incident.polygon);
    }
  }
  extent.shapes = std::move(shapes.points);
  for (const auto& [i, plane] : planes) {
    meshes[i].patch = plane.patch();
    Cloud corners;
    for (const Pose<double>& pose : plane.poses) corners.add(patch_corners(*meshes[i].patch, pose));
    if (cast.subject.empty()) append(extent.shapes, corners.points);
  }
  if (!cast.subject.empty()) {
    extent.contact.clear();
    subject.points.clear();
  }
  if (cast.heap) extent.normal = up_axis(header);
  extent.subject = planes.empty() ? subject.points : extent.shapes;
  extent.croppable = planes.empty() && !any_round;
  if (extent.contact.empty()) return extent;
  // A point contact has no size, so its surroundings count instead.
  const Vec3d center = center_of(extent.contact);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d reach = kMinContext * smallest * Vec3d::Unit(axis);
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
                  const Rect& viewport, bool has_subject) {
  // A fitted parallel projection starts with a distant eye, whose rays are nearly parallel.
  const bool parallel = view.orthographic_height && !(*view.orthographic_height > 0);
  const double fov = radians(parallel ? kParallelField : view.fov_degrees.value_or(kFieldOfView));
  const double half_height = std::tan(0.5 * fov);
  const double aspect = viewport.width / viewport.height;

  // Without a target, the view's eye looks at the middle of all shapes.
  Vec3d direction =
      extent.across.isZero() ? viewing_direction(header, extent.normal) : extent.across;
  if (view.eye)
    direction = (*view.eye - view.target.value_or(center_of(extent.shapes))).normalized();
  const Vec3d up = up_axis(header);
  const auto fit = [&](std::vector<Vec3d> points, double share,
                       const std::vector<Vec3d>& more = {}) {
    append(points, more);
    return fit_view(points, direction, up, view.target, half_height, aspect, share);
  };
  ViewFit best = fit(extent.shapes, has_subject ? kSubjectShare : kShapesShare);
  if (view.focus == Focus::Contact && !extent.contact.empty()) {
    ViewFit close = fit(extent.contact, kPatchShare);
    const ViewFit around = fit(extent.subject, kShapesShare, extent.contact);
    // Crop the subject if the patch would be smaller than a third of the view.
    if (!extent.croppable || around.distance <= fit(extent.contact, kMinPatch).distance)
      close = {around.target, std::max(around.distance, close.distance)};
    // Not so near that the shapes are no longer visible.
    if (close.distance < best.distance)
      best = {close.target, std::max(close.distance, kMinShapes * best.distance)};
  }
  const double parallel_height = 2 * half_height * best.distance;
  if (view.eye) best.distance = (*view.eye - best.target).norm();
  const Vec3d eye = view.eye.value_or(best.target + best.distance * direction);
  if (parallel) return Camera::orthographic(eye, best.target, up, parallel_height, viewport);
  return view.orthographic_height
             ? Camera::orthographic(eye, best.target, up, *view.orthographic_height, viewport)
             : Camera::perspective(eye, best.target, up, fov, viewport);
}

/// Where a fault's pair has another normal than its shapes: a direction from which both are seen at
/// full length, nearly, from the usual side. Else zero.
Vec3d across_normals(const trace::Header& header, const std::vector<trace::Frame>& frames,
                     const Fault::Place& place) {
  for (const trace::Frame& frame : frames) {
    if (!place.normal || frame.frame != place.frame) continue;
    for (const trace::Pair& pair : frame.pairs) {
      if (std::minmax(pair.a, pair.b) != std::minmax(place.a, place.b)) continue;
      for (const trace::Manifold& manifold : pair.manifolds) {
        const Vec3d across = manifold.normal.cross(*place.normal);
        constexpr double kDiffer = 0.1, kRaised = 0.35;
        if (across.norm() < kDiffer) continue;
        const double side = across.dot(default_direction(header)) < 0 ? -1 : 1;
        return (side * across.normalized() + kRaised * up_axis(header)).normalized();
      }
    }
  }
  return Vec3d::Zero();
}

/// Position of the first shape of a viewport's pair at the start of the sequence.
Vec3d first_place(const std::vector<trace::Frame>& frames, const PairViewport& viewport) {
  for (const trace::Placement& pose : frames.front().poses)
    if (pose.first == viewport.a) return pose.second.position;
  return Vec3d::Zero();
}

// All viewports have the same scale and direction; the one that needs the most room decides. Their
// contents are centred in all frames. A target of the view applies to all pairs, relative to each.
void fit_viewports(const trace::Header& header, const std::vector<trace::Frame>& frames,
                   const Extent& all, Staging& staging) {
  const View& view = staging.view;
  Vec3d direction = viewing_direction(header, all.normal);
  if (view.eye) direction = (*view.eye - view.target.value_or(center_of(all.shapes))).normalized();
  const Vec3d up = up_axis(header);
  const Camera any = Camera::orthographic(direction, Vec3d::Zero(), up, 1, staging.layout.view);
  const auto flat = [&](const Vec3d& p) { return Vec2d(any.right().dot(p), any.up().dot(p)); };
  std::vector<Vec3d> middles;
  double height = 0, reach = 0;
  for (const PairViewport& viewport : staging.viewports) {
    const Rect inside = inside_of(viewport, staging.layout);
    ShapeMeshes meshes = staging.meshes;
    const Extent own = gather(
        header, mapped(frames, [&](const trace::Frame& frame) { return part_of(frame, viewport); }),
        view, meshes, true);
    const auto high = [&](const std::vector<Vec3d>& points, double share) {
      Eigen::AlignedBox2d box;
      for (const Vec3d& p : points) box.extend(flat(p));
      const Vec2d size = box.sizes();
      return std::max(size.y(), size.x() * inside.height / inside.width) / share;
    };
    const bool close = view.focus == Focus::Contact && !own.contact.empty();
    middles.push_back(view.target ? Vec3d(*view.target + first_place(frames, viewport) -
                                          first_place(frames, staging.viewports.front()))
                      : close     ? center_of(own.contact)
                                  : center_of(own.shapes));
    const double whole = high(own.shapes, kShapesShare);
    height = std::max(height, close ? std::clamp(high(own.contact, kPatchShare),
                                                 kMinShapes * kMinShapes * whole, whole)
                                    : whole);
    reach = std::max(reach, box_around(own.shapes).diagonal().norm());
  }
  if (view.orthographic_height.value_or(0) > 0) height = *view.orthographic_height;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    PairViewport& viewport = staging.viewports[i];
    viewport.camera =
        Camera::orthographic(middles[i] + 2 * (reach + height) * direction, middles[i], up, height,
                             inside_of(viewport, staging.layout));
  }
}

// Widths of the legend's entries for each frame.
std::vector<std::vector<float>> legend_widths(const Staging& staging,
                                              const std::vector<trace::Frame>& frames) {
  std::vector<std::vector<float>> widths;
  for (const trace::Frame& frame : frames) {
    std::vector<float> entries =
        mapped(legend_of(staging, frame).listed, [&](const LegendEntry& entry) {
          return legend_entry_width(entry, staging.layout.scale, staging.layout.words);
        });
    if (widths.empty() || widths.back() != entries) widths.push_back(std::move(entries));
  }
  return widths;
}

/// Next to a much smaller shape, a large one in focus is only context.
Cast cast_of(const std::vector<trace::Frame>& frames, const View& view, const ShapeMeshes& meshes,
             bool is_trace) {
  Cast cast;
  if (std::optional<HomeRegion> home = home_region(meshes, frames);
      home && (is_trace ? home->cuts_off : home->fly_off))
    cast.home = std::move(home);
  cast.heap = is_trace && std::ranges::any_of(frames, is_heap);
  if (view.focus_on.empty()) return cast;
  cast.subject.assign(meshes.size(), false);
  for (const std::string& name : view.focus_on)
    if (const auto place = meshes.find(name)) cast.subject[*place] = true;
  cast.own_home = home_region(meshes, frames, cast.subject);
  if (!cast.own_home) return cast;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (cast.own_home->is_large[i]) cast.subject[i] = false;
  cast.heap = false;
  return cast;
}

/// The steps of all bodies that fly off in a frame.
std::vector<const Fault::Place*> paths_of(const View& view, int frame) {
  std::vector<const Fault::Place*> paths;
  for (const Fault& fault : view.faults)
    for (const Fault::Place& one : fault.places)
      if (one.path && one.frame == frame) paths.push_back(&one);
  return paths;
}

}  // namespace

Fault::Place place_in_focus(const View& view, const std::vector<trace::Frame>& frames,
                            const ShapeMeshes& meshes) {
  const bool is_worst = view.focus == Focus::Worst;
  if (const Fault::Place* const named = view.first_fault(); is_worst && named) return *named;
  double most = 0;
  Fault::Place place;
  for (const trace::Frame& frame : frames)
    for (const auto& [pair, value] :
         ranked_pairs(frame, is_worst ? Rank::Worst : Rank::Overlap, 1, meshes))
      if (value > most) most = value, place = {frame.frame, pair->a, pair->b};
  return place;
}

Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& requested, int width, int height, const FigureStyle& style,
              const LayerTable& layers, const std::vector<int>& stored,
              const FittedFrames* fitted) {
  View view = requested;
  std::vector<Panel> insets = take_insets(view);
  // Without a picture of the scene, a story of the difference has all the room, for one or two steps.
  const bool is_alone =
      view.layers.empty() && view.story != Story::None && insets == std::vector{Panel::Minkowski};
  if (is_alone && !view.inset) insets.push_back(Panel::Minkowski);
  ShapeMeshes meshes(header.shapes);
  const std::vector<trace::Frame>& to_fit = fitted != nullptr ? fitted->frames : frames;
  if (view.focus == Focus::Deepest || view.focus == Focus::Worst) {
    const Fault::Place place = place_in_focus(view, to_fit, meshes);
    view.focus_on = {place.a, place.b};
    std::erase(view.focus_on, "");
    if (const auto named = view.first_fault(); named && named->path)
      view.focus_on = mapped(paths_of(view, named->frame), [](auto one) { return one->a; });
    // Two that fly off are no pair.
    if (place.path && view.focus_on.size() == 2) view.focus_on.push_back(view.focus_on[0]);
  }
  const Cast cast = cast_of(to_fit, view, meshes, fitted != nullptr);
  Extent extent = gather(header, to_fit, view, meshes, false, cast);
  if (const Fault::Place* const place = view.first_fault(); place && view.focus == Focus::Worst) {
    extent.across = across_normals(header, to_fit, *place);
    for (const Fault::Place* const one : paths_of(view, place->frame))
      append(extent.shapes, *one->path);
  }
  const auto camera_in = [&](const Rect& viewport) {
    return fit_camera(header, extent, view, viewport, !cast.subject.empty());
  };
  const auto layout = [&](const std::vector<std::vector<float>>& widths) {
    Layout made =
        make_layout(width, height, !view.panels.empty(), widths, count_of(insets) - is_alone, style,
                    plain_title(view.title.value_or(header.title)));
    if (is_alone) made.insets.insert(made.insets.begin(), made.view);
    // Without a picture of the scene the panels have all the room.
    if (view.layers.empty() && !view.panels.empty() && !style.follows())
      made.panels = {made.page.x, made.view.y, made.page.width, made.view.height};
    return made;
  };
  // The camera needs the view's rectangle, which needs the legend's rows, which depend on the
  // contents of the frames. Therefore the legend of all frames is made with a provisional camera.
  Staging staging{&header,           view,       &layers,
                  std::move(meshes), layout({}), camera_in(layout({}).view)};
  staging.leaves_out = cast.home && cast.subject.empty() && !view.eye && !view.target;
  staging.style = style;
  staging.layout.words = staging.style.words.get();
  staging.moments = Moments(frames, view.story);
  const std::string title = view.title.value_or(header.title);
  if (view.kind == ViewKind::ContactPlane) {
    staging.title = stage_title(title, frames);
    std::vector<ContactMoment> moments = reduced(frames, staging.moments);
    for (std::size_t i = 0; i < moments.size(); ++i)
      moments[i].title = fill_title(staging, frames[i]);
    staging.cells = std::make_shared<ContactCells>(header.title, header.source, header.up,
                                                   std::move(moments), view.choices, width, height,
                                                   style, view.charts && view.shows(Chart::Margin));
    return staging;
  }
  if (view.shows(Layer::Trail) || view.shows(Layer::Islands) || view.shows(Layer::Velocities)) {
    auto sequence = std::make_shared<SequencePoses>();
    for (const trace::Frame& frame : frames) sequence->push_back({frame.frame, frame.poses});
    staging.sequence = std::move(sequence);
  }
  // The size of pair views follows from the stored frames, not from the frames between.
  std::vector<trace::Frame> shown;
  if (view.layout == ViewLayout::SideBySide)
    std::ranges::copy_if(frames, std::back_inserter(shown), [&](const trace::Frame& frame) {
      return std::ranges::find(stored, frame.frame) != stored.end();
    });
  const auto fit = [&] {
    if (view.layout == ViewLayout::SideBySide) {
      staging.viewports = split_view(frames, staging.layout);
      fit_viewports(header, shown.empty() ? frames : shown, extent, staging);
    } else if (view.layout == ViewLayout::Stages) {
      staging.viewports = split_stages(view, staging.layout);
      for (PairViewport& viewport : staging.viewports)
        viewport.camera = camera_in(inside_of(viewport, staging.layout));
    }
    Layout layout_of_one = staging.layout;
    if (!staging.viewports.empty()) {
      staging.camera = *staging.viewports.front().camera;
      if (view.layout == ViewLayout::Stages) layout_of_one.view = staging.camera.viewport();
    }
    staging.scales = fit_scales(staging.meshes, frames, staging.camera, layout_of_one, view,
                                [&](const trace::Pair& pair) -> const Camera* {
                                  const auto own = std::ranges::find_if(
                                      staging.viewports, [&](const PairViewport& viewport) {
                                        return shows_pair(viewport, pair);
                                      });
                                  return own == staging.viewports.end() ? nullptr : &*own->camera;
                                });
    staging.insets = stage_insets(insets, up_axis(header), staging.camera, staging.layout, frames);
  };
  fit();
  if (style.legend)
    staging.layout =
        layout(legend_widths(staging, fitted != nullptr && fitted->all ? fitted->frames : frames));
  staging.camera = camera_in(staging.layout.view);
  fit();
  staging.title = stage_title(title, frames, staging.scales.length);
  if (staging.viewports.empty())
    staging.magnifier =
        stage_magnifier(staging.view, staging.camera, staging.layout, frames, extent.shapes);
  return staging;
}

}  // namespace contactscope::draw
