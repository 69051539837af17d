#include "draw/insets/contact_plane.h"

#include "draw/scene/labels.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kOrderDigit = 14;

PlaneAxes axes_about(const Vec3d& normal, const Vec3d& right, double least) {
  const Vec3d along = right - right.dot(normal) * normal;
  const Vec3d u = along.norm() > least ? Vec3d(along.normalized()) : any_perpendicular(normal);
  return {u, normal.cross(u)};
}

constexpr double kShortMargin = 0.06;  // share of the support's size: too short to draw

constexpr Swatch kMarginSwatch{LegendGroup::Masses, 2, [](auto& pen) {
                                 pen.level_line(0, 16, 2.2, kAxis);
                                 pen.head(22, 8, kAxis);
                               }};

}  // namespace

PlaneAxes axes_as_seen(const Camera& camera, const Vec3d& normal) {
  PlaneAxes axes = axes_about(normal, camera.right(), 1e-3);
  if (axes.v.dot(camera.up()) < 0) axes.v = -axes.v;
  return axes;
}

PlaneAxes axes_from_above(const Vec3d& normal, const Vec3d& above) {
  return axes_about(normal.dot(above) < 0 ? Vec3d(-normal) : normal, Vec3d::UnitX(), 0.1);
}

Point2 ContactPlane::at(const Vec3d& point) const {
  const Vec2d offset = pixels_per_metre * (axes.along(point) - center);
  return pixel(map.x + 0.5 * map.width + offset.x(), map.y + 0.5 * map.height - offset.y());
}

std::vector<Point2> ContactPlane::at(const std::vector<Vec3d>& points) const {
  return mapped(points, [&](const Vec3d& point) { return at(point); });
}

std::vector<Point2> ContactPlane::at(const std::vector<trace::Point>& points) const {
  return at(mapped(points, &trace::Point::position));
}

void ContactPlane::area(const std::vector<Point2>& polygon, const Color& color) const {
  fill(clip_polygon(map, polygon), color);
}

void ContactPlane::border(const std::vector<Point2>& polygon, double width, const Color& color,
                          double dash) const {
  std::vector<Point2> run;
  const auto finish = [&] {
    path(run, width, color, dash);
    run.clear();
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2& to = polygon[(i + 1) % polygon.size()];
    const std::optional<Segment2> seen = clip_segment(map, polygon[i], to);
    if (!seen) continue;
    if (!run.empty() && run.back() != seen->from) finish();
    if (run.empty()) run.push_back(seen->from);
    run.push_back(seen->to);
  }
  finish();
}

void ContactPlane::line_through(const Vec3d& a, const Vec3d& b, double width, const Color& color,
                                double dash) const {
  const Point2 from = at(a), to = at(b);
  const Point2 offset = to - from;
  if (!(length(offset) > 0)) return;
  const float reach = static_cast<float>(map.width + map.height) / length(offset);
  const std::optional<Segment2> seen =
      clip_segment(map, from - reach * offset, to + reach * offset);
  if (seen) line(seen->from, seen->to, width, color, dash);
}

void ContactPlane::number_kept(const std::vector<Point2>& places, const std::vector<int>& kept,
                               double size, const std::vector<int>& deepest) const {
  const Vec2d middle = middle_of(places);
  LabelPlacer placer(map);
  for (const Point2& place : places) placer.block(place, px(kKeptReach * size));
  for (const int i : deepest) placer.block(contactscope::at(places, i), px(kDeepestReach * size));
  const float height = px(kOrderDigit);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Point2& place = contactscope::at(places, kept[k]);
    const std::string digit = std::to_string(k + 1);
    const float width = text_width(digit, height, FontWeight::Bold);
    const float up = 0.76f * ascent(height, FontWeight::Bold), room = kBadgeRoom * up;
    const bool is_deepest = std::ranges::find(deepest, kept[k]) != deepest.end();
    const float reach = px((is_deepest ? kDeepestReach : kKeptReach) * size);
    auto found = placer.place(place, width + 2 * room, up + room, room,
                              {reach + px(2), pixel(outward(middle, flat(place)))});
    if (!found) continue;
    found->left_baseline.x += room;
    if (found->needs_leader) line(place, found->leader_end, 1, kContact);
    draw_badge(Badge::Choice, found->left_baseline + Point2{0.5f * width, -0.5f * up}, width, up,
               kContact, *this);
    text(digit, found->left_baseline, Align::Left, kContact, Weight::Bold, kOrderDigit);
  }
}

void ContactPlane::scale_bar(double share, double middle) const {
  const double metres = round_down(share * map.width / pixels_per_metre);
  const auto right = static_cast<float>(map.right());
  const auto left = right - static_cast<float>(metres * pixels_per_metre);
  const auto y = static_cast<float>(middle);
  const float end = px(3);
  line({left, y}, {right, y}, 1.5, kQuietText);
  for (const float x : {left, right}) line({x, y - end}, {x, y + end}, 1.5, kQuietText);
  text(spell_quantity(metres, "m", 1, length_unit(metres)), {left - px(8), y + px(4.5)},
       Align::Right, kQuietText);
}

Vec2d middle_of(const std::vector<Point2>& places) {
  Vec2d middle = Vec2d::Zero();
  for (const Point2& place : places) middle += flat(place) / static_cast<double>(places.size());
  return middle;
}

Vec2d outward(const Vec2d& middle, const Vec2d& at) {
  const Vec2d out = at - middle;
  return out.norm() > 1 ? Vec2d(out.normalized()) : Vec2d(0, -1);
}

void draw_kept_point(const Point2& at, const Pen& pen, double size) {
  pen.disc(at, 5.6 * size, kWhite);
  pen.disc(at, 4.2 * size, kContact);
  pen.ring(at, 6.4 * size, kKeptReach * size, kContact);
}

void draw_plain_point(const Point2& at, const Pen& pen, bool separated) {
  pen.disc(at, 6.6, kWhite);
  pen.disc(at, 5, with_alpha(kContact, separated ? 0.3f : 1.0f));
  if (separated) pen.ring(at, 4, 5.2, kContact);
}

void draw_dropped_point(const Point2& at, const Pen& pen, double size) {
  pen.cross(at, 3.6 * size, 4.5 * size, with_alpha(kWhite, 0.9f), Cap::Round);
  pen.cross(at, 3.6 * size, 2 * size, kDropped, Cap::Round);
}

void draw_deepest_mark(const Point2& at, const Pen& pen, double size) {
  const double h = pen.px(10.4 * size);
  const std::vector<Point2> corners = corners_of({at.x - h, at.y - h, 2 * h, 2 * h});
  pen.outline(corners, 3.6 * size, with_alpha(kWhite, 0.8f));
  pen.outline(corners, 1.6 * size, kNormal);
}

const trace::Pair* pair_of_contact_plane(const trace::Frame& frame) {
  return first_pair(frame, [](const trace::Pair& pair) { return !pair.manifolds.empty(); });
}

bool reduction_in_contact_plane(const trace::Pair& pair) {
  return pair.manifolds.size() == 1 && pair.reduction &&
         (pair.reduction->points.size() > 2 || pair.kind == "hull-hull");
}

const trace::Stability* stability_of(const trace::Pair& pair) {
  const bool known = pair.stability && pair.stability->verdict != "no contact";
  return known && !pair.manifolds.empty() ? &*pair.stability : nullptr;
}

void explain_panels(const View& view, const trace::Frame& frame, Legend& legend) {
  for (const trace::Pair& pair : frame.pairs) {
    const trace::Stability* stability = stability_of(pair);
    if (stability == nullptr || !view.shows(Panel::Stability)) continue;
    explain_support(*stability, stability->axis && stability->verdict != "stable", legend);
    double reach = 0;
    for (const Vec3d& corner : stability->support)
      reach = std::max(reach, (corner - stability->projection).norm());
    if (std::abs(stability->margin) > kShortMargin * reach)
      legend.explain(kMarginSwatch, "margin: to the border of the support");
  }
  const trace::Pair* pair = pair_of_contact_plane(frame);
  if (pair == nullptr || !view.shows(Panel::ContactPlane)) return;
  if (own_clip(*pair) != nullptr) {
    legend.explain(kReferenceFaceSwatch, "reference face");
    legend.explain(kIncidentFaceSwatch, "incident face");
    if (!pair->clip->steps.empty() && !pair->clip->steps.back().polygon.empty())
      legend.explain(kClipPolygonSwatch, "clip polygon");
    for (const trace::DroppedPoint& dropped : pair->clip->dropped)
      if (!is_kept(*pair, dropped)) legend.explain(kDroppedSwatch, dropped.reason);
  }
  if (!view.shows(Layer::Contacts)) legend.explain(kPlainPointSwatch, "contact point");
  if (reduction_in_contact_plane(*pair) &&
      pair->reduction->kept.size() < pair->reduction->points.size()) {
    legend.explain(kReducedSwatch, "reduced away");
    if (pair->reduction->kept.size() > 2)
      legend.explain(kSpannedSwatch, kSpannedWords);
    else
      legend.explain(kKeptSwatch, "kept, in order of choice");
  }
}

}  // namespace contactscope::draw
