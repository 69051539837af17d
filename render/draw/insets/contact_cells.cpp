#include "draw/insets/contact_cells.h"

#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kHatchSpacing = 5;  // pixels between lines
/// Whether all points were chosen as extremes along directions.
bool by_extremes(const ContactCell& cell) {
  return cell.choices.size() > 1 &&
         std::ranges::all_of(cell.choices,
                             [](const trace::Choice& choice) { return choice.rule == "support"; });
}

/// Bounding box of the points, with sides along the first direction.
std::vector<Point2> axes_box(const ContactPlane& plane, const ContactCell& cell) {
  const PlaneAxes axes{cell.choices.front().direction,
                       cell.normal.cross(cell.choices.front().direction)};
  const Vec3d origin = cell.points.front().position;
  PlaneExtent extent;
  for (const trace::Point& point : cell.points) extent.extend(axes.along(point.position - origin));
  std::vector<Point2> box;
  for (const auto corner : {PlaneExtent::BottomLeft, PlaneExtent::BottomRight,
                            PlaneExtent::TopRight, PlaneExtent::TopLeft}) {
    const Vec2d at = extent.corner(corner);
    box.push_back(plane.at(origin + at.x() * axes.u + at.y() * axes.v));
  }
  return box;
}

/// Labels two sides of that box with world axes, if they are parallel to these.
void draw_axes(const ContactPlane& plane, const std::vector<Point2>& box) {
  Eigen::AlignedBox2d around;
  for (const Point2& corner : box) around.extend(flat(corner));
  const double away = plane.px(30), long_side = 0.45 * around.sizes().minCoeff();
  const Vec2d corner(around.min().x() - away, around.max().y() + away);  // y points down
  for (const auto& [name, axis] :
       {std::pair{"x", Vec3d::UnitX()}, {"y", Vec3d::UnitY()}, {"z", Vec3d::UnitZ()}}) {
    const Vec2d on_page(plane.axes.u.dot(axis), -plane.axes.v.dot(axis));
    if (on_page.norm() < 0.99) continue;  // not in the plane, or oblique in it
    const bool level = std::abs(on_page.x()) > 0.5;
    const bool back = level ? on_page.x() < 0 : on_page.y() > 0;  // the arrows meet at its end
    const Vec2d far = corner + long_side * (level ? Vec2d(1, 0) : Vec2d(0, -1));
    const Vec2d from = back ? far : corner, tip = back ? corner : far;
    const Vec2d along = (tip - from).normalized(), across(-along.y(), along.x());
    const double head = plane.px(8);
    plane.path({pixel(from), pixel(tip - 0.6 * head * along)}, 1.6, kNormal);
    plane.fill({pixel(tip), pixel(tip - head * along + 0.42 * head * across),
                pixel(tip - head * along - 0.42 * head * across)},
               kNormal);
    const Vec2d label_at = 0.5 * (from + tip) + plane.px(8) * (level ? Vec2d(0, 1) : Vec2d(-1, 0));
    plane.text(name, pixel(label_at.x(), label_at.y() + plane.px(level ? 8 : 4)), Align::Center,
               kText, Weight::Bold);
  }
}

// Signs that only the contact plane has. Its legend keeps the order of creation.
constexpr Swatch kTriangleSwatch{LegendGroup::Points, 12, [](auto& pen) {
                                   pen.area(kClipPolygon, 0.10f, 0);
                                   pen.area(kContact, 0.16f, 2);
                                 }};
// Over the contact polygon, as in the map, with the remaining part of it.
constexpr Swatch kKeptAreaSwatch{LegendGroup::Points, 12, [](auto& pen) {
                                   pen.box(with_alpha(kClipPolygon, 0.10f), kClipPolygon, 1.2);
                                   pen.hatched(kDropped);
                                   const std::vector<Point2> half = pen.block(0, 15);
                                   pen.fill(half, kWhite);
                                   pen.fill(half, with_alpha(kClipPolygon, 0.10f));
                                   pen.fill(half, with_alpha(kContact, 0.16f));
                                   pen.outline(half, 2, kContact);
                                 }};
constexpr Swatch kWholeRoseSwatch{LegendGroup::Points, 13,
                                  [](auto& pen) { pen.area(kDropped, 0.2f, 1.5); }};
constexpr Swatch kKeptRoseSwatch{LegendGroup::Points, 14,
                                 [](auto& pen) { pen.area(kContact, 0.3f, 2.5); }};
constexpr Swatch kTiltAxisSwatch{LegendGroup::Points, 15,
                                 [](auto& pen) { pen.level_line(0, 22, 3, kNormal); }};
constexpr Swatch kDeepestSwatch{LegendGroup::Points, 13,
                                [](auto& pen) { draw_deepest_mark(pen.middle(), pen, 0.72); }};
constexpr Swatch kBestPolygonSwatch{LegendGroup::Points, 15,
                                    [](auto& pen) { pen.area(kNormal, 0, 1.6, true); }};
constexpr Swatch kAxesBoxSwatch{LegendGroup::Points, 16,
                                [](auto& pen) { pen.area(kAxis, 0, 2, true); }};
constexpr Swatch kCandidateSwatch{LegendGroup::Points, 17, [](auto& pen) {
                                    pen.level_line(0, 22, 1.5, with_alpha(kDropped, 0.7f));
                                  }};
constexpr Swatch kOutsideTriangleSwatch{LegendGroup::Points, 18,
                                        [](auto& pen) { pen.hatched(kContact); }};

}  // namespace

ContactCells::ContactCells(const std::string& title, const std::string& source,
                           const std::string& up, std::vector<ContactMoment> moments, int choices,
                           int width, int height, const FigureStyle& style, bool rose)
    : title_(title),
      source_(source),
      moments_(std::move(moments)),
      choices_(choices),
      style_(style),
      rose_(rose) {
  frame_patches(up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY());
  gather_ids();
  fit(width, height);
}

std::vector<LegendEntry> ContactCells::legend() const {
  if (cell_count() == 0 || !shows(Detail::Legend) || !style_.legend) return {};
  const auto any_cell = [&](const auto& holds) { return std::ranges::any_of(all_cells(), holds); };
  std::vector<LegendEntry> entries;
  // Assigned, not moved in: GCC 12 reports a false overread for the move of a short string.
  const auto add = [&entries](bool shown, const Swatch& swatch, const char* text) {
    if (!shown) return;
    LegendEntry& entry = entries.emplace_back();
    entry.swatch = &swatch;
    entry.text = text;
  };
  if (choices_ > 0) {  // signs of the shown choice's rule
    const auto by_rule = [&](const char* rule) {
      return any_cell([&](const ContactCell& cell) {
        const std::size_t shown = std::min(static_cast<std::size_t>(choices_), cell.kept.size());
        return shown > 0 && shown <= cell.choices.size() && cell.choices[shown - 1].rule == rule;
      });
    };
    const bool by_distance = by_rule("distance"), grows = by_rule("outside") || by_distance,
               triangle = by_rule("triangle") || grows;
    add(true, kClipPolygonSwatch, "contact polygon");
    add(true, kPlainPointSwatch, "contact point");
    add(true, kKeptSwatch, "kept, in order of choice");
    add(triangle, kTriangleSwatch,
        !grows         ? "largest triangle"
        : choices_ > 4 ? "kept area"
                       : "triangle so far");
    add(grows, kOutsideTriangleSwatch, "added outside");
    add(by_distance, kDecidingEdgesSwatch, "distance to the edge");
    add(by_rule("farthest"), kCandidateSwatch, "other candidates");
    add(choices_ > 3 &&
            any_cell([](const ContactCell& cell) { return !deepest_points(cell.points).empty(); }),
        kDeepestSwatch, "deepest");
    return entries;
  }
  const bool reduces =
      any_cell([](const ContactCell& cell) { return cell.kept.size() < cell.points.size(); });
  if (rose_) {
    add(reduces, kReducedSwatch, "reduced away");
    add(true, kKeptSwatch, "kept");
    add(true, kWholeRoseSwatch, "moment that all points resist, by direction");
    add(true, kKeptRoseSwatch, "moment that the kept points resist");
    add(reduces, kTiltAxisSwatch, "worst tilt: over this axis");
    return entries;
  }
  const bool has_best = any_cell([](const ContactCell& cell) { return cell.best.size() > 2; });
  add(!reduces, kClipPolygonSwatch, "contact polygon");
  add(reduces, kReducedSwatch, "reduced away");
  add(true, kKeptSwatch, reduces ? "kept, in order of choice" : "kept");
  add(any_cell([](const ContactCell& cell) { return !deepest_points(cell.points).empty(); }),
      kDeepestSwatch, "deepest");
  add(reduces, kKeptAreaSwatch, "kept area, hatched: lost");
  add(has_best, kBestPolygonSwatch, "largest area");
  add(any_cell(by_extremes), kAxesBoxSwatch, "box along the axes");
  // The rows below contain the same information about the deepest point.
  if (entries.size() > kMaxLegendEntries)
    std::erase_if(entries,
                  [](const LegendEntry& entry) { return entry.swatch == &kDeepestSwatch; });
  return entries;
}

Drawing ContactCells::frame(int number) const {
  const auto moment = std::ranges::find(moments_, number, &ContactMoment::frame);
  Drawing drawing{.width = layout_.width, .height = layout_.height};
  drawing.words = layout_.words;
  const Pen pen(drawing, static_cast<float>(px(1)), kNumber);
  const auto index = static_cast<std::size_t>(moment - moments_.begin());
  for (std::size_t cell = 0; cell < cell_count(); ++cell) draw_cell(cell, index, pen);
  if (cell_count() == 0) {
    drawing.begin(kPlanePart);
    const Rect& view = layout_.view;
    double y = view.y + 0.5 * view.height;
    for (const char* words : {"nothing is reduced as one patch here:",
                              "nothing touches, or a mesh, a triangle at a time"}) {
      pen.text(words, pixel(view.x + 0.5 * view.width, y), Align::Center, kQuietText,
               Weight::Regular, kName);
      y += 1.3 * pen.px(kName);
    }
  }
  draw_legend(legend(), layout_, drawing);
  draw_captions(moment->title.empty() ? title_ : moment->title, source_, moment->caption, layout_,
                drawing);
  return drawing;
}

void ContactCells::draw_cell(std::size_t number, std::size_t moment, const Pen& pen) const {
  const ContactCell& cell = moments_[moment].cells[number];
  const auto columns = static_cast<std::size_t>(grid_.columns);
  const double gap = pen.px(kGap);
  const Rect rect{
      layout_.view.x + static_cast<double>(number % columns) * (grid_.cell_width + gap),
      layout_.view.y + static_cast<double>(number / columns) * (grid_.cell_height + gap),
      grid_.cell_width, grid_.cell_height};
  const auto width = static_cast<float>(rect.width);
  pen.drawing().begin(kPlanePart, cell.pair, cell.name);
  if (cell_count() > 1 && shows(Detail::Names)) {
    pen.text(pen.fitted(cell.name, Weight::Bold, width, kName),
             pixel(rect.x, rect.y + 0.8 * pen.px(kName)), Align::Left, kText, Weight::Bold, kName);
  }
  const Rect map{rect.x, rect.y + pen.px(name_height()), rect.width, grid_.map_height};
  if (cell.points.empty()) {
    pen.text(pen.fitted("no contact in this frame", Weight::Regular, width),
             pixel(map.x + 0.5 * map.width, map.y + 0.5 * map.height), Align::Center, kQuietText);
  } else {
    const Patch& patch = patches_[number];
    draw_map(cell, {patch.axes, patch.center, grid_.pixels_per_metre, map, pen});
  }
  if (grid_.strip > 0) {
    const double inset = pen.px(3), caption = pen.px(kStripCaption), axis = pen.px(axis_height());
    const double y = map.bottom() + inset;
    pen.text(pen.fitted(kStripText, Weight::Regular, width), pixel(rect.x, y + 0.75 * caption),
             Align::Left, kQuietText);
    const Rect strip{rect.x, y + caption, rect.width, grid_.strip - 2 * inset - caption - axis};
    ids_[number].draw_rows(strip, moment, moments_.size(), pen);
    if (axis > 0) draw_strip_axis(strip, moment, pen);
  }
  double baseline = map.bottom() + grid_.strip + 0.8 * pen.px(kNumberRow);
  for (const ContactCell::Row& row : shown_rows(cell)) {
    const Weight weight = row.strong ? Weight::Bold : Weight::Regular;
    pen.text(pen.fitted(left_of(row), weight, width), pixel(rect.x, baseline), Align::Left, kText,
             weight);
    if (shows(Detail::RowEnds) && !row.right.empty())
      pen.text(row.right, pixel(rect.right(), baseline), Align::Right, kQuietText);
    baseline += pen.px(kNumberRow);
  }
}

/// Both ends of the time axis, and the current time between them.
void ContactCells::draw_strip_axis(const Rect& strip, std::size_t moment, const Pen& pen) const {
  const double baseline = strip.bottom() + pen.px(kStripAxis - 2);
  const std::string end = spell_quantity(*moments_.back().time, "s");
  pen.text("0", pixel(strip.x, baseline), Align::Left, kQuietText);
  pen.text(end, pixel(strip.right(), baseline), Align::Right, kQuietText);
  const double now = strip.x + strip.width * (static_cast<double>(moment) + 0.5) /
                                   static_cast<double>(moments_.size());
  const double half = 0.5 * pen.width_of("now") + pen.px(6);
  if (now - half > strip.x + pen.width_of("0") && now + half < strip.right() - pen.width_of(end))
    pen.text("now", pixel(now, baseline), Align::Center, kText);
}

void ContactCells::draw_map(const ContactCell& cell, const ContactPlane& plane) const {
  if (rose_) return draw_rose(plane, cell, grid_.mark, &cell == &all_cells().front().get());
  const std::vector<Point2> places = plane.at(cell.points);
  const auto polygon_of = [&](const std::vector<int>& points) {
    return convex_polygon(mapped(points, [&](int i) { return flat(at(places, i)); }));
  };
  const auto pixels = [](const std::vector<Vec2d>& polygon) {
    return mapped(polygon, [](const Vec2d& corner) { return pixel(corner); });
  };
  std::vector<int> every(places.size());
  std::iota(every.begin(), every.end(), 0);
  const std::vector<Vec2d> all = polygon_of(every);
  plane.fill(pixels(all), with_alpha(kClipPolygon, 0.10f));
  if (choices_ > 0) {
    plane.outline(pixels(all), 2, kClipPolygon);
    draw_choice(plane, places, cell, choices_, cell_count() == 1);
    return;
  }
  const std::vector<Vec2d> kept = polygon_of(cell.kept);
  if (kept.size() > 2) plane.fill(pixels(kept), with_alpha(kContact, 0.16f));
  plane.hatch(all, kept, kHatchSpacing, 1.1, with_alpha(kDropped, 0.8f));
  plane.outline(pixels(all), 2, kClipPolygon);
  plane.outline(pixels(kept), 2, kContact);
  if (cell.best.size() > 2) plane.outline(pixels(polygon_of(cell.best)), 1.6, kNormal, 6);
  if (by_extremes(cell)) {
    const std::vector<Point2> box = axes_box(plane, cell);
    plane.outline(box, 1.8, kAxis, 6);
    draw_axes(plane, box);
  }

  for (const int i : every) {
    if (std::ranges::find(cell.kept, i) == cell.kept.end())
      draw_dropped_point(at(places, i), plane, grid_.mark);
  }
  for (const int i : cell.kept) draw_kept_point(at(places, i), plane, grid_.mark);
  const std::vector<int> deepest = deepest_points(cell.points);
  for (const int i : deepest) draw_deepest_mark(at(places, i), plane, grid_.mark);
  if (cell.kept.size() < places.size()) plane.number_kept(places, cell.kept, grid_.mark, deepest);
}

}  // namespace contactscope::draw
