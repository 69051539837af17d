#include "draw/insets/contact_cells.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "draw/scene/swatches.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kHatchSpacing = 5;  // pixels between lines
// A patch whose depths differ by less than this part of its extent is level: none is the deepest.
constexpr double kLevelPatch = 1e-6;

/// The point of least separation; empty where the patch is level.
std::optional<std::size_t> deepest_of(const std::vector<trace::Point>& points) {
  const auto [least, most] = std::ranges::minmax_element(points, {}, &trace::Point::separation);
  if (least == points.end()) return std::nullopt;
  double extent = 0;
  for (const trace::Point& point : points)
    extent = std::max(extent, (point.position - least->position).norm());
  if (most->separation - least->separation <= kLevelPatch * extent) return std::nullopt;
  return static_cast<std::size_t>(least - points.begin());
}

/// Chosen by nothing but how far they lie along directions.
bool by_extremes(const ContactCell& cell) {
  return cell.choices.size() > 1 &&
         std::ranges::all_of(cell.choices,
                             [](const trace::Choice& choice) { return choice.rule == "support"; });
}

/// Of extremes along axes: the smallest box with sides along them.
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

// The signs of the contact plane alone. Its legend stands in the order in which it is made.
constexpr Swatch kKeptPolygonSwatch{LegendGroup::Points, 12, [](const SwatchPen& pen) {
                                      pen.box(with_alpha(kContact, 0.16f), kContact, 2);
                                    }};
constexpr Swatch kDeepestSwatch{LegendGroup::Points, 13, [](const SwatchPen& pen) {
                                  draw_deepest_mark(pen.middle(), pen, 0.72);
                                }};
constexpr Swatch kLostAreaSwatch{LegendGroup::Points, 14,
                                 [](const SwatchPen& pen) { pen.hatched(kDropped); }};
constexpr Swatch kBestPolygonSwatch{LegendGroup::Points, 15, [](const SwatchPen& pen) {
                                      pen.box(with_alpha(kNormal, 0), kNormal, 1.6, true);
                                    }};
constexpr Swatch kAxesBoxSwatch{LegendGroup::Points, 16, [](const SwatchPen& pen) {
                                  pen.box(with_alpha(kAxis, 0), kAxis, 2, true);
                                }};
constexpr Swatch kCandidateSwatch{LegendGroup::Points, 17, [](const SwatchPen& pen) {
                                    pen.level_line(0, 22, 1.5, with_alpha(kDropped, 0.7f));
                                  }};
constexpr Swatch kOutsideTriangleSwatch{LegendGroup::Points, 18,
                                        [](const SwatchPen& pen) { pen.hatched(kContact); }};
constexpr Swatch kInsideTriangleSwatch{LegendGroup::Points, 19, [](const SwatchPen& pen) {
                                         pen.box(with_alpha(kReferenceFace, 0.12f),
                                                 with_alpha(kReferenceFace, 0.6f), 1.2, true);
                                       }};
// Two rows of a strip: one kept to the end, one given up for the other.
constexpr Swatch kKeptIdsSwatch{LegendGroup::Points, 20, [](const SwatchPen& pen) {
                                  const auto bar = [&](double from, double to, double top,
                                                       const Color& color) {
                                    const Point2 low = pen.at(from, top);
                                    const float x1 = pen.at(to).x, y1 = low.y + pen.px(5);
                                    pen.fill({low, {x1, low.y}, {x1, y1}, {low.x, y1}}, color);
                                  };
                                  constexpr Color kFaint = rgb(0xD5D8DC);
                                  bar(0, 12, -6, kContact);
                                  bar(12, 22, -6, kFaint);
                                  bar(0, 12, 1, kFaint);
                                  bar(12, 22, 1, kContact);
                                }};

}  // namespace

ContactCells::ContactCells(const std::string& title, const std::string& source,
                           const std::string& up, std::vector<ContactMoment> moments, int choices,
                           int width, int height)
    : title_(title), source_(source), moments_(std::move(moments)), choices_(choices) {
  frame_patches(up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY());
  gather_ids();
  fit(width, height);
}

bool ContactCells::any_cell(const std::function<bool(const ContactCell&)>& holds) const {
  return std::ranges::any_of(moments_, [&](const ContactMoment& moment) {
    return std::ranges::any_of(moment.cells, holds);
  });
}

std::vector<LegendEntry> ContactCells::legend() const {
  if (cell_count() == 0 || !shows(Detail::Legend)) return {};
  if (choices_ > 0) return legend_of_choice();
  const bool reduces =
      any_cell([](const ContactCell& cell) { return cell.kept.size() < cell.points.size(); });
  const bool deepest =
      any_cell([](const ContactCell& cell) { return deepest_of(cell.points).has_value(); });
  const bool best = any_cell([](const ContactCell& cell) { return cell.best.size() > 2; });
  std::vector<LegendEntry> entries = {{&kClipPolygonSwatch, "contact polygon"}};
  if (reduces) entries.push_back({&kReducedSwatch, "reduced away"});
  entries.push_back({&kKeptSwatch, reduces ? "kept, in order of choice" : "kept"});
  if (deepest) entries.push_back({&kDeepestSwatch, "deepest"});
  if (reduces) entries.push_back({&kKeptPolygonSwatch, "kept area"});
  if (reduces) entries.push_back({&kLostAreaSwatch, "lost area"});
  if (best) entries.push_back({&kBestPolygonSwatch, "best polygon"});
  if (any_cell(by_extremes)) entries.push_back({&kAxesBoxSwatch, "box along the axes"});
  if (moments_.size() > 1) entries.push_back({&kKeptIdsSwatch, "ids kept, over the frames"});
  return entries;
}

/// What the shown choice was made by.
std::vector<LegendEntry> ContactCells::legend_of_choice() const {
  std::vector<LegendEntry> entries = {{&kClipPolygonSwatch, "contact polygon"},
                                      {&kPlainPointSwatch, "contact point"},
                                      {&kKeptSwatch, "kept, in order of choice"}};
  const auto by_rule = [&](const std::string& rule) {
    return any_cell([&](const ContactCell& cell) {
      const std::size_t shown = std::min(static_cast<std::size_t>(choices_), cell.kept.size());
      return shown > 0 && shown <= cell.choices.size() && cell.choices[shown - 1].rule == rule;
    });
  };
  // Assigned, not moved in: GCC 12 takes the move of a short string for an overread.
  const auto add = [&entries](const Swatch& swatch, const char* text) {
    LegendEntry& entry = entries.emplace_back();
    entry.swatch = &swatch;
    entry.text = text;
  };
  const bool grows = by_rule("outside") || by_rule("distance");
  const bool triangle = by_rule("triangle") || grows;
  if (triangle) add(kKeptPolygonSwatch, grows ? "triangle so far" : "largest triangle");
  if (grows) add(kOutsideTriangleSwatch, "added outside");
  if (by_rule("outside")) add(kInsideTriangleSwatch, "edge sees it inside");
  if (by_rule("distance")) add(kDecidingEdgesSwatch, "distance to the edge");
  if (by_rule("farthest") || triangle) add(kCandidateSwatch, "other candidates");
  return entries;
}

Drawing ContactCells::frame(int number) const {
  const auto moment = std::ranges::find(moments_, number, &ContactMoment::frame);
  Drawing drawing;
  drawing.width = layout_.width;
  drawing.height = layout_.height;
  const Pen pen(drawing, layout_.scale, kNumber);
  const auto index = static_cast<std::size_t>(moment - moments_.begin());
  for (std::size_t cell = 0; cell < cell_count(); ++cell) draw_cell(cell, index, pen);
  if (cell_count() == 0) {
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
  draw_captions(title_, source_, moment->caption, layout_, drawing);
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
  if (cell_count() > 1 && shows(Detail::Names)) {
    pen.text(fitted(cell.name, pen.px(kName), Weight::Bold, width),
             pixel(rect.x, rect.y + 0.8 * pen.px(kName)), Align::Left, kText, Weight::Bold, kName);
  }
  const Rect map{rect.x, rect.y + pen.px(name_height()), rect.width, grid_.map_height};
  if (cell.points.empty()) {
    pen.text(fitted("no contact in this frame", pen.px(kNumber), Weight::Regular, width),
             pixel(map.x + 0.5 * map.width, map.y + 0.5 * map.height), Align::Center, kQuietText);
  } else {
    const Patch& patch = patches_[number];
    draw_map(cell, {patch.axes, patch.center, grid_.pixels_per_metre, map, pen});
  }
  if (grid_.strip > 0) {
    const double inset = pen.px(3);
    ids_[number].draw_rows({rect.x, map.bottom() + inset, rect.width, grid_.strip - 2 * inset},
                           moment, moments_.size(), pen);
  }
  const double top = map.bottom() + grid_.strip;
  draw_rows({rect.x, top, rect.width, rect.bottom() - top}, cell, pen);
}

void ContactCells::draw_map(const ContactCell& cell, const ContactPlane& plane) const {
  const std::vector<Point2> places = plane.at(cell.points);
  const auto polygon_of = [&](const std::vector<int>& points) {
    std::vector<Vec2d> corners;
    for (const int i : points) corners.push_back(flat(places[static_cast<std::size_t>(i)]));
    return convex_polygon(corners);
  };
  const auto pixels = [](const std::vector<Vec2d>& polygon) {
    std::vector<Point2> corners;
    for (const Vec2d& corner : polygon) corners.push_back(pixel(corner));
    return corners;
  };
  std::vector<int> every(places.size());
  std::iota(every.begin(), every.end(), 0);
  const std::vector<Vec2d> all = polygon_of(every);
  plane.fill(pixels(all), with_alpha(kClipPolygon, 0.10f));
  if (choices_ > 0) {
    plane.outline(pixels(all), 2, kClipPolygon);
    draw_choice(plane, places, cell.kept, cell.choices, choices_);
    return;
  }
  const std::vector<Vec2d> kept = polygon_of(cell.kept);
  if (kept.size() > 2) plane.fill(pixels(kept), with_alpha(kContact, 0.16f));
  plane.hatch(all, kept, kHatchSpacing, 1.1, with_alpha(kDropped, 0.8f));
  plane.outline(pixels(all), 2, kClipPolygon);
  plane.outline(pixels(kept), 2, kContact);
  if (cell.best.size() > 2) plane.outline(pixels(polygon_of(cell.best)), 1.6, kNormal, 6);
  if (by_extremes(cell)) plane.outline(axes_box(plane, cell), 1.8, kAxis, 6);

  for (const int i : every) {
    if (std::ranges::find(cell.kept, i) == cell.kept.end())
      draw_dropped_point(places[static_cast<std::size_t>(i)], plane, grid_.mark);
  }
  for (const int i : cell.kept)
    draw_kept_point(places[static_cast<std::size_t>(i)], plane, grid_.mark);
  const std::optional<std::size_t> deepest = deepest_of(cell.points);
  if (deepest) draw_deepest_mark(places[*deepest], plane, grid_.mark);
  if (cell.kept.size() < places.size()) plane.number_kept(places, cell.kept, grid_.mark, deepest);
}

void ContactCells::draw_rows(const Rect& rect, const ContactCell& cell, const Pen& pen) const {
  double baseline = rect.y + 0.8 * pen.px(kNumberRow);
  for (const ContactCell::Row& row : shown_rows(cell)) {
    const Weight weight = row.strong ? Weight::Bold : Weight::Regular;
    pen.text(fitted(left_of(row), pen.px(kNumber), weight, static_cast<float>(rect.width)),
             pixel(rect.x, baseline), Align::Left, kText, weight);
    if (shows(Detail::RowEnds) && !row.right.empty())
      pen.text(row.right, pixel(rect.right(), baseline), Align::Right, kQuietText);
    baseline += pen.px(kNumberRow);
  }
}

}  // namespace contactscope::draw
