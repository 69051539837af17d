#include "draw/insets/contact_plane.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "draw/scene/labels.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/sequence_scales.h"

namespace contactscope::draw {
namespace {

constexpr double kOrderDigit = 14;

/// Right-handed about the normal.
PlaneAxes axes_about(const Vec3d& normal, const Vec3d& right, double least) {
  const Vec3d along = right - right.dot(normal) * normal;
  const Vec3d u = along.norm() > least ? Vec3d(along.normalized()) : any_perpendicular(normal);
  return {u, normal.cross(u)};
}

}  // namespace

PlaneAxes axes_as_seen(const Camera& camera, const Vec3d& normal) {
  PlaneAxes axes = axes_about(normal, camera.right(), 1e-3);
  if (axes.v.dot(camera.up()) < 0) axes.v = -axes.v;
  return axes;
}

PlaneAxes axes_from_above(const Vec3d& normal, const Vec3d& above) {
  return axes_about(normal.dot(above) < 0 ? Vec3d(-normal) : normal, Vec3d::UnitX(), 0.1);
}

void PlaneExtent::include(const PlaneAxes& axes, const Vec3d& point) {
  const std::array<double, 2> at{axes.u.dot(point), axes.v.dot(point)};
  for (std::size_t k = 0; k < 2; ++k) {
    low[k] = std::min(low[k], at[k]);
    high[k] = std::max(high[k], at[k]);
  }
}

Point2 ContactPlane::at(const Vec3d& point) const {
  const double right = pixels_per_metre_ * (axes_.u.dot(point) - center_[0]);
  const double up = pixels_per_metre_ * (axes_.v.dot(point) - center_[1]);
  return {static_cast<float>(map_.x + 0.5 * map_.width + right),
          static_cast<float>(map_.y + 0.5 * map_.height - up)};
}

std::vector<Point2> ContactPlane::at(const std::vector<Vec3d>& points) const {
  std::vector<Point2> places;
  for (const Vec3d& point : points) places.push_back(at(point));
  return places;
}

void ContactPlane::area(const std::vector<Point2>& polygon, const Color& color) const {
  pen_.fill(clip_polygon(map_, polygon), color);
}

void ContactPlane::border(const std::vector<Point2>& polygon, double width, const Color& color,
                          double dash) const {
  std::vector<Point2> run;
  const auto finish = [&] {
    pen_.path(run, width, color, dash);
    run.clear();
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2& to = polygon[(i + 1) % polygon.size()];
    const std::optional<Segment2> seen = clip_segment(map_, polygon[i], to);
    if (!seen) continue;
    if (!run.empty() && (run.back().x != seen->from.x || run.back().y != seen->from.y)) finish();
    if (run.empty()) run.push_back(seen->from);
    run.push_back(seen->to);
  }
  finish();
}

void ContactPlane::line_through(const Vec3d& a, const Vec3d& b, double width, const Color& color,
                                double dash) const {
  const Point2 from = at(a), to = at(b);
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float length = std::hypot(dx, dy);
  if (!(length > 0)) return;
  const float reach = static_cast<float>(map_.width + map_.height) / length;
  const std::optional<Segment2> seen = clip_segment(
      map_, {from.x - reach * dx, from.y - reach * dy}, {to.x + reach * dx, to.y + reach * dy});
  if (seen) pen_.line(seen->from, seen->to, width, color, dash);
}

void ContactPlane::number_kept(const std::vector<Point2>& places, const std::vector<int>& kept,
                               double size, const std::optional<std::size_t>& deepest) const {
  Vec2d middle = Vec2d::Zero();
  for (const Point2& place : places) middle += flat(place) / static_cast<double>(places.size());
  LabelPlacer placer(map_);
  for (const Point2& place : places) placer.block(place, pen_.px(kKeptReach * size));
  if (deepest) placer.block(places[*deepest], pen_.px(12 * size));
  const float height = pen_.px(kOrderDigit);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Point2& place = places[static_cast<std::size_t>(kept[k])];
    Vec2d away = flat(place) - middle;
    away = away.norm() > 1 ? Vec2d(away.normalized()) : Vec2d(0, -1);
    const std::string digit = std::to_string(k + 1);
    const auto found = placer.place(place, text_width(digit, height, FontWeight::Bold),
                                    0.76f * ascent(height, FontWeight::Bold), 0,
                                    pen_.px(kKeptReach * size + 2), pixel(away));
    if (!found) continue;
    if (found->needs_leader) pen_.line(place, found->leader_end, 1, kContact);
    pen_.text(digit, found->left_baseline, Align::Left, kContact, Weight::Bold, kOrderDigit, 2);
  }
}

void ContactPlane::scale_bar(double share, double middle) const {
  const double length = round_down(share * map_.width / pixels_per_metre_);
  const auto right = static_cast<float>(map_.x + map_.width);
  const auto left = right - static_cast<float>(length * pixels_per_metre_);
  const auto y = static_cast<float>(middle);
  const float end = pen_.px(3);
  pen_.line({left, y}, {right, y}, 1.5, kQuietText);
  for (const float x : {left, right}) pen_.line({x, y - end}, {x, y + end}, 1.5, kQuietText);
  pen_.text(spell_quantity(length, "m", 1), {left - pen_.px(8), y + pen_.px(4.5)}, Align::Right,
            kQuietText);
}

void draw_kept_point(const Point2& at, const Pen& pen, double size) {
  pen.disc(at, 5.6 * size, kWhite);
  pen.disc(at, 4.2 * size, kContact);
  pen.ring(at, 6.4 * size, kKeptReach * size, kContact);
}

void draw_plain_point(const Point2& at, const Pen& pen) {
  pen.disc(at, 6.6, kWhite);
  pen.disc(at, 5, kContact);
}

void draw_apart_point(const Point2& at, const Pen& pen) {
  pen.disc(at, 6.6, kWhite);
  pen.disc(at, 5, with_alpha(kContact, 0.3f));
  pen.ring(at, 4, 5.2, kContact);
}

void draw_dropped_point(const Point2& at, const Pen& pen, double size) {
  pen.cross(at, 3.6 * size, 4.5 * size, with_alpha(kWhite, 0.9f), Cap::Round);
  pen.cross(at, 3.6 * size, 2 * size, kDropped, Cap::Round);
}

void draw_deepest_mark(const Point2& at, const Layout& layout, double size, const Color& color,
                       Drawing& drawing) {
  const double h = layout.px(10.4 * size);
  const std::vector<Point2> corners = corners_of({at.x - h, at.y - h, 2 * h, 2 * h});
  const Pen pen(drawing, layout.scale, kOrderDigit);
  pen.outline(corners, 3.6 * size, with_alpha(kWhite, 0.8f));
  pen.outline(corners, 1.6 * size, color);
}

}  // namespace contactscope::draw
