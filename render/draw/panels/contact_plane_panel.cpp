#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr double kMapFree = 0.09;  // share of the map's size, free on each side
constexpr float kMinMapLines = 5;  // height of the map with its scale, lines of text
constexpr float kCaptionLines = 2.8f;
constexpr double kResult = 17;  // text size of the result, pixels at 720 lines
constexpr double kFlattest = 0.3;
constexpr int kRoundSteps = 96;
constexpr double kProjectionRadius = 7.5;  // pixels at 720 lines
constexpr double kUnderPoint = 1.9;        // factor of it, so that a point on it leaves it visible

/// Round shapes of the pair. Their outline along the normal is context for one or two points, which
/// have no extent. Their vertices are the centre of a sphere or the ends of a capsule's core.
std::vector<PlacedShape> round_shapes(const ShapeMeshes& meshes, const trace::Frame& frame,
                                      const trace::Pair& pair) {
  const auto is_round = [&](const std::string& name) {
    const std::optional<std::size_t> place = meshes.find(name);
    return place && meshes[*place].shape->radius > 0;
  };
  if (!is_round(pair.a) && !is_round(pair.b)) return {};
  std::vector<PlacedShape> shapes = place_shapes(meshes, frame);
  std::erase_if(shapes, [&](const PlacedShape& shape) {
    const trace::Shape& solid = *shape.mesh->shape;
    return solid.radius == 0 || shape.vertices.empty() ||
           (solid.name != pair.a && solid.name != pair.b);
  });
  return shapes;
}

/// Outline of a sphere or capsule along the normal.
std::vector<Point2> outline_of(const std::vector<Point2>& core, float radius) {
  const Point2 &first = core.front(), &last = core.back();
  std::vector<Point2> points;
  for (const Vec2d& at : circle(kRoundSteps)) {
    const Point2 out = pixel(at.x(), at.y());
    points.push_back((dot(out, first - last) > 0 ? first : last) + radius * out);
  }
  return points;
}

/// Blended half with white. Opaque, because overlapping ends of strokes would show.
constexpr Color pale(const Color& color) {
  return {0.5f + 0.5f * color.r, 0.5f + 0.5f * color.g, 0.5f + 0.5f * color.b, 1};
}

/// Contact plane of the first touching pair in one frame.
class ContactPlanePanel : public PanelContent {
 public:
  ContactPlanePanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    // The patch and the incident face must fit into the map. The reference face may be a whole
    // floor, and is cut at the map's border; of two round shapes the smaller one counts.
    for (const trace::Frame& frame : frames) {
      const trace::Pair* pair = pair_of_contact_plane(frame);
      if (pair == nullptr) continue;
      append(points_, positions_of(*pair));
      if (pair->stability && staging.view.shows(Layer::CenterOfMass))
        points_.push_back(pair->stability->projection);
      if (const auto* clip = own_clip(*pair)) append(points_, clip->incident.polygon);
      const std::vector<PlacedShape> round = round_shapes(staging.meshes, frame, *pair);
      const auto smallest = std::ranges::min_element(
          round, {}, [](const PlacedShape& shape) { return shape.mesh->radius; });
      if (smallest == round.end()) continue;
      for (const Vec3d& center : smallest->vertices)
        balls_.emplace_back(center, smallest->mesh->shape->radius);
    }
  }

  PanelNeed need(const PanelMoment&) const override {
    const float lines = (kMinMapLines + kCaptionLines) * Sheet::line_height(scale_);
    const float least = Sheet::heading_height(scale_) + lines;
    return {least, least, 0, 2};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("contact plane, seen along the normal");
    const trace::Frame& frame = frames_[moment.frame];
    const trace::Pair* pair = pair_of_contact_plane(frame);
    if (pair == nullptr) {
      sheet.line("no contact in this frame", kQuietText);
      return {};
    }
    const Rect rest = sheet.rest();
    const double line = sheet.line_height();
    // The map is no higher than its contents; the text follows below.
    const double room = rest.height - (kCaptionLines + 1) * line;
    const Vec2d sizes = sizes_along(axes_as_seen(staging_.camera, pair->manifolds.front().normal));
    const double wanted = rest.width * sizes.y() / sizes.x();
    const Rect map{rest.x, rest.y, rest.width, std::min(room, wanted)};
    const double caption = map.bottom() + line;
    const ContactPlane plane = plane_of(*pair, map, sheet.pen());
    draw_round_shapes(*pair, frame, plane);
    if (own_clip(*pair) != nullptr) draw_clip(*pair, plane);
    const bool has_center = staging_.view.shows(Layer::CenterOfMass);
    const bool is_under = has_center && covers_point(*pair, plane);
    if (is_under) draw_projection(*pair, plane, kUnderPoint);
    const std::vector<std::string> words = draw_points(*pair, plane);
    if (has_center && !is_under) draw_projection(*pair, plane, 1);
    plane.scale_bar(0.3, caption - 0.2 * line);
    const Pen& pen = sheet.pen();
    double baseline = caption + 1.1 * line;
    for (const std::string& each : words) {
      pen.text(pen.fitted(each, Weight::Bold, static_cast<float>(rest.width), kResult),
               pixel(rest.x, baseline), Align::Left, kText, Weight::Bold, kResult);
      baseline += 1.15 * pen.px(kResult);
    }
    sheet.skip_to(baseline);
    return {};
  }

 private:
  /// Extent of everything that must fit in any frame.
  PlaneExtent extent_along(const PlaneAxes& axes) const {
    PlaneExtent extent;
    for (const Vec3d& point : points_) extent.extend(axes.along(point));
    for (const auto& [center, radius] : balls_) {
      for (const Vec3d& side : {axes.u, axes.v}) {
        for (const double offset : {radius, -radius})
          extent.extend(axes.along(center + offset * side));
      }
    }
    return extent;
  }
  /// Minimum height of the map, so that its marks have room.
  Vec2d sizes_along(const PlaneAxes& axes) const {
    const Vec2d sizes = extent_along(axes).sizes().cwiseMax(Vec2d::Constant(1e-12));
    return {sizes.x(), std::max(sizes.y(), kFlattest * sizes.x())};
  }

  /// One scale for the whole sequence: the largest frame fits.
  ContactPlane plane_of(const trace::Pair& pair, const Rect& map, const Pen& pen) const {
    const PlaneAxes axes = axes_as_seen(staging_.camera, pair.manifolds.front().normal);
    const PlaneExtent extent = extent_along(axes);
    const Vec2d sizes = sizes_along(axes);
    const double share = 1 - 2 * kMapFree;
    const double scale = std::min(map.width * share / sizes.x(), map.height * share / sizes.y());
    return {axes, extent.center(), scale, map, pen};
  }

  void draw_round_shapes(const trace::Pair& pair, const trace::Frame& frame,
                         const ContactPlane& plane) const {
    for (const PlacedShape& shape : round_shapes(staging_.meshes, frame, pair)) {
      const std::vector<Point2> core = plane.at(shape.vertices);
      const auto radius = static_cast<float>(shape.mesh->shape->radius * plane.pixels_per_metre);
      const std::vector<Point2> outline = outline_of(core, radius);
      plane.area(outline, with_alpha(shape.is_a ? kShapeA : kShapeB, 0.55f));
      plane.border(outline, 1.5, pale(kShapeEdge));
      if (core.size() == 2) plane.line(core[0], core[1], 1, pale(kShapeEdge), 8, 5);
    }
  }

  static void draw_clip(const trace::Pair& pair, const ContactPlane& plane) {
    const trace::Clip& clip = *pair.clip;
    const auto polygon = [&](const trace::Polygon& corners, const Color& color, float fill,
                             double dash) {
      if (corners.size() < 2) return;
      const std::vector<Point2> places = plane.at(corners);
      plane.area(places, with_alpha(color, fill));
      plane.border(places, 2.5, color, dash);
    };
    polygon(clip.reference.polygon, kReferenceFace, 0.18f, 0);
    if (!clip.steps.empty()) polygon(clip.steps.back().polygon, kClipPolygon, 0.25f, 0);
    // Dashed, so that an equal clip polygon stays visible.
    polygon(clip.incident.polygon, kIncidentFace, 0.18f, 8);
    for (const trace::DroppedPoint& dropped : clip.dropped)
      if (!is_kept(pair, dropped)) draw_dropped_point(plane.at(dropped.position), plane, 1);
  }

  /// Projection of the centre of mass along the normal: inside the support or outside.
  static void draw_projection(const trace::Pair& pair, const ContactPlane& plane, double size) {
    if (!pair.stability || pair.stability->verdict == "no contact") return;
    const Point2 at = plane.at(pair.stability->projection);
    if (plane.map.contains(at))
      draw_quartered_disc(at, plane.px(size * kProjectionRadius), plane.px(1.4), plane.drawing());
  }

  /// Whether the projection would hide a contact point.
  static bool covers_point(const trace::Pair& pair, const ContactPlane& plane) {
    if (!pair.stability) return false;
    const Point2 at = plane.at(pair.stability->projection);
    return std::ranges::any_of(positions_of(pair), [&](const Vec3d& point) {
      return distance(plane.at(point), at) < plane.px(2 * kProjectionRadius);
    });
  }

  /// Returns the result as text.
  std::vector<std::string> draw_points(const trace::Pair& pair, const ContactPlane& plane) const {
    if (reduction_in_contact_plane(pair))
      return draw_reduction(*pair.reduction, pair.manifolds.front().normal, plane);
    const std::vector<PairPoint> points = all_points(pair);
    for (const PairPoint& any : points) draw_point(*any.point, plane);
    const std::string text = std::to_string(points.size());
    if (pair.manifolds.size() > 1) {
      // Each was reduced separately, and the record contains only one of these reductions.
      return {text + " points in " + std::to_string(pair.manifolds.size()) + " manifolds"};
    }
    if (points.size() < 3)
      return {words_without_area(mapped(points, [](const PairPoint& any) { return *any.point; }))};
    return {text + " points"};
  }

  std::string words_without_area(const std::vector<trace::Point>& points) const {
    const LengthUnit& unit = staging_.scales.length;
    if (points.size() != 2) return std::to_string(points.size()) + " point, no area";
    return "2 points, " + spell_length((points[1].position - points[0].position).norm(), 0, unit) +
           " apart";
  }

  std::vector<std::string> draw_reduction(const trace::Reduction& reduction, const Vec3d& normal,
                                          const ContactPlane& plane) const {
    const std::vector<int>& kept = reduction.kept;
    const bool fewer = kept.size() < reduction.points.size();
    const std::vector<Point2> places = plane.at(reduction.points);
    if (const std::vector<Vec3d> corners = kept_polygon(reduction, normal);
        fewer && corners.size() > 2) {
      plane.area(plane.at(corners), with_alpha(kContact, kKeptFill));
      plane.border(plane.at(corners), 2, kContact, 0);
    }
    constexpr std::size_t kCrowd = 40;  // crosses that would cover each other
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (std::ranges::find(kept, static_cast<int>(i)) == kept.end())
        draw_dropped_point(places[i], plane, places.size() > kCrowd ? 0.5 : 1);
      else if (fewer)
        draw_kept_point(places[i], plane, 1);
      else
        draw_point(reduction.points[i], plane);
    }
    if (fewer) plane.number_kept(places, kept, 1);
    if (kept.size() < 3)
      return {words_without_area(
          mapped(kept, [&](int i) { return reduction.points[static_cast<std::size_t>(i)]; }))};
    std::vector<std::string> words = {"area " + spell_area(reduction.area)};
    if (fewer && reduction.best_area > 0)
      words.push_back(printed("%.1f %% of the best %zu of %zu points",
                              100 * reduction.area / reduction.best_area, kept.size(),
                              places.size()));
    return words;
  }

  void draw_point(const trace::Point& point, const ContactPlane& plane) const {
    draw_plain_point(plane.at(point.position), plane, stands_off(point, staging_.scales));
  }

  std::vector<Vec3d> points_;                    // must fit in all frames
  std::vector<std::pair<Vec3d, double>> balls_;  // centre and radius; must fit too
};

}  // namespace

const PanelDrawing kContactPlanePanel{.needs = {&Stages::clip, &Stages::reduction},
                                      .make = make_panel<ContactPlanePanel>};

}  // namespace contactscope::draw
