#include "core/spell.h"
#include "draw/insets/contact_cells.h"
#include "draw/scene/points.h"
#include "draw/scene/sketch.h"

// A unit force, the load, presses a body on contact points, through their middle c. A moment that tilts the
// body towards u moves that force along u, at most to the farthest point: the points resist
// max u . (p - c). For one point that is the circle with the diameter from c to p (Thales), so the
// rose of several points is a union of discs.
namespace contactscope::draw {

Vec2d mean_of(const std::vector<Vec2d>& points) {
  return std::accumulate(points.begin(), points.end(), Vec2d(0, 0)) /
         static_cast<double>(points.size());
}

double longest_arm(const std::vector<Vec2d>& points, const Vec2d& center, const Vec2d& toward) {
  double longest = -std::numeric_limits<double>::infinity();
  for (const Vec2d& point : points) longest = std::max(longest, toward.dot(point - center));
  return longest;
}

// The share is least across an edge of one of the two polygons: between these directions both arms
// are those of one point each, and the ratio of two such arms has no extremes. Points on a line have
// no arm across it, so directions along edges are candidates too.
WeakestTilt weakest_tilt(const std::vector<Vec2d>& all, const std::vector<Vec2d>& kept) {
  constexpr double kNoise = 1e-4;  // of pixels in float, as a share of an edge or an arm
  const Vec2d center = mean_of(all);
  WeakestTilt weakest;
  for (const std::vector<Vec2d>& polygon : {convex_polygon(all), convex_polygon(kept)}) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      for (const Vec2d& side : {Vec2d(edge.y(), -edge.x()), edge}) {
        const Vec2d toward = side.normalized();
        const double arm = longest_arm(all, center, toward);
        if (!(arm > kNoise * edge.norm())) continue;
        const double share = longest_arm(kept, center, toward) / arm;
        if (share < weakest.share - kNoise) weakest = {arm * toward, share};
      }
    }
  }
  return weakest;
}

void draw_rose(const ContactPlane& plane, const ContactCell& cell, double mark, bool explains) {
  const std::vector<Vec2d> all = mapped(plane.at(cell.points), flat);
  const std::vector<Vec2d> kept = mapped(cell.kept, [&](int i) { return at(all, i); });
  const Vec2d center = mean_of(all);
  for (const auto& [points, width, color] :
       {std::tuple{&all, 1.5, kDropped}, {&kept, 2.5, kContact}}) {
    std::vector<Point2> rim;
    for (const Vec2d& toward : circle(360, 361)) {
      rim.push_back(pixel(center + std::max(0.0, longest_arm(*points, center, toward)) * toward));
      if (rim.size() == 1) continue;
      plane.fill({pixel(center), rim[rim.size() - 2], rim.back()}, with_alpha(color, 0.25f));
    }
    plane.path(rim, width, color);
  }
  if (const WeakestTilt tilt = weakest_tilt(all, kept); tilt.share < 1 && !kept.empty()) {
    const Vec2d across = Vec2d(-tilt.arm.y(), tilt.arm.x()).normalized();
    const Vec2d foot = center + tilt.share * tilt.arm;
    std::vector<Vec2d> edge = kept;  // over which it tips; within a pixel
    std::erase_if(edge, [&](const Vec2d& p) { return tilt.arm.dot(foot - p) > tilt.arm.norm(); });
    const double past = plane.px(14);
    plane.line(pixel(foot + (longest_arm(edge, foot, across) + past) * across),
               pixel(foot - (longest_arm(edge, foot, -across) + past) * across), 3, kNormal);
    plane.line(pixel(center), pixel(center + tilt.arm), 2, kNormal, 6);
    // On the longer part of the arm: the kept or the lost one.
    const double share = std::max(tilt.share, 0.0), along = share > 0.5 ? share : 1 + share;
    plane.text(printed("%.0f %% left", 100 * share),
               pixel(center + 0.5 * along * tilt.arm + Vec2d(0, plane.px(6))), Align::Center,
               kNormal, Weight::Bold, 17, 3);
  }
  // The longest radius, which both roses share, in words if they fit.
  const auto reach = [&](const Vec2d& point) { return (point - center).norm(); };
  const char* const words = "radius: moment resisted";
  if (explains && !kept.empty() && plane.width_of(words, Weight::Bold) < 0.6 * plane.map.width) {
    const Vec2d tip = *std::ranges::max_element(kept, {}, reach),
                above = tip - Vec2d(0, plane.px(74));
    plane.line(pixel(center), pixel(tip), 2, kContact);
    plane.line(pixel(tip), pixel(above), 1, kContact);
    plane.text(words, pixel(plane.map.right(), above.y() - plane.px(6)), Align::Right, kContact,
               Weight::Bold, 15, 3);
  }
  draw_quartered_disc(pixel(center), plane.px(9 * mark), plane.px(1.5), plane.drawing());
  plane.text("load", pixel(center + Vec2d(-plane.px(9 * mark + 5), plane.px(5))), Align::Right,
             kText, Weight::Bold, 15, 3);
  for (int i = 0; i < count_of(all); ++i)
    if (std::ranges::find(cell.kept, i) == cell.kept.end())
      draw_dropped_point(pixel(at(all, i)), plane, mark);
  for (const Vec2d& place : kept) draw_kept_point(pixel(place), plane, mark);
}

}  // namespace contactscope::draw
