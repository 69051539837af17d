#include "draw/insets/contact_cells.h"

#include <algorithm>
#include <optional>

#include "core/convex_polygon.h"
#include "draw/charts/id_strip.h"
#include "draw/insets/choice_steps.h"
#include "draw/scene/hatch.h"
#include "draw/scene/labels.h"
#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kHatchSpacing = 5;  // pixels between lines
// A patch whose depths differ by less than this part of its extent is level: none is the deepest.
constexpr double kLevelPatch = 1e-6;

Vec2d flat(const Point2& p) {
  return {p.x, p.y};
}

Point2 pixel(const Vec2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

Text written(const std::string& text, double x, double baseline, float size, Weight weight,
             const Color& color) {
  Text result;
  result.text = text;
  result.at = {static_cast<float>(x), static_cast<float>(baseline)};
  result.size = size;
  result.weight = weight;
  result.color = color;
  return result;
}

void outline(const std::vector<Vec2d>& polygon, float width, const Color& color, float dash,
             Drawing& drawing) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Stroke stroke{pixel(polygon[i]), pixel(polygon[(i + 1) % polygon.size()]), width, color,
                  dash > 0 ? Cap::Butt : Cap::Round};
    stroke.dash = dash;
    stroke.gap = 0.7f * dash;
    drawing.primitives.push_back(stroke);
  }
}

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

Fill filled(const std::vector<Vec2d>& polygon, const Color& color) {
  Fill fill;
  fill.color = color;
  for (const Vec2d& corner : polygon) fill.polygon.push_back(pixel(corner));
  return fill;
}

}  // namespace

ContactCells::ContactCells(const std::string& title, const std::string& source,
                           const std::string& up, std::vector<ContactMoment> moments, int choices,
                           int width, int height)
    : title_(title), source_(source), moments_(std::move(moments)), choices_(choices) {
  frame_patches(up);
  fit(width, height);
}

std::vector<LegendEntry> ContactCells::legend() const {
  if (cell_count() == 0 || !detail_.legend) return {};
  if (choices_ > 0) return legend_of_choice();
  std::vector<LegendEntry> entries = {{LegendKind::ClipPolygon, "contact polygon"}};
  const auto any = [&](auto&& holds) {
    return std::ranges::any_of(moments_, [&](const ContactMoment& moment) {
      return std::ranges::any_of(moment.cells, holds);
    });
  };
  const bool reduces =
      any([](const ContactCell& cell) { return cell.kept.size() < cell.points.size(); });
  if (reduces) entries.push_back({LegendKind::Reduced, "reduced away"});
  entries.push_back({LegendKind::Kept, reduces ? "kept, in order of choice" : "kept"});
  if (any([](const ContactCell& cell) { return deepest_of(cell.points).has_value(); })) {
    entries.push_back({LegendKind::Deepest, "deepest"});
  }
  if (reduces) {
    entries.push_back({LegendKind::KeptPolygon, "kept area"});
    entries.push_back({LegendKind::LostArea, "lost area"});
  }
  if (any([](const ContactCell& cell) { return cell.best.size() > 2; })) {
    entries.push_back({LegendKind::BestPolygon, "best polygon"});
  }
  if (any(by_extremes)) entries.push_back({LegendKind::AxesBox, "box along the axes"});
  if (moments_.size() > 1) entries.push_back({LegendKind::KeptIds, "ids kept, over the frames"});
  return entries;
}

/// What the shown choice was made by.
std::vector<LegendEntry> ContactCells::legend_of_choice() const {
  std::vector<LegendEntry> entries = {{LegendKind::ClipPolygon, "contact polygon"},
                                      {LegendKind::PlainPoint, "contact point"},
                                      {LegendKind::Kept, "kept, in order of choice"}};
  const auto shows = [&](const std::string& rule) {
    return std::ranges::any_of(moments_, [&](const ContactMoment& moment) {
      return std::ranges::any_of(moment.cells, [&](const ContactCell& cell) {
        const std::size_t shown = std::min(static_cast<std::size_t>(choices_), cell.kept.size());
        return shown > 0 && shown <= cell.choices.size() && cell.choices[shown - 1].rule == rule;
      });
    });
  };
  // Assigned, not moved in: GCC 12 takes the move of a short string for an overread.
  const auto add = [&entries](LegendKind kind, const char* text) {
    LegendEntry& entry = entries.emplace_back();
    entry.kind = kind;
    entry.text = text;
  };
  const bool grows = shows("outside") || shows("distance");
  if (shows("triangle") || grows) {
    add(LegendKind::KeptPolygon, grows ? "triangle so far" : "largest triangle");
  }
  if (grows) add(LegendKind::OutsideTriangle, "added outside");
  if (shows("outside")) add(LegendKind::InsideTriangle, "edge sees it inside");
  if (shows("distance")) add(LegendKind::DecidingEdges, "distance to the edge");
  if (shows("farthest") || shows("triangle") || grows) {
    add(LegendKind::Candidate, "other candidates");
  }
  return entries;
}

Drawing ContactCells::frame(int number) const {
  const auto moment = std::ranges::find(moments_, number, &ContactMoment::frame);
  Drawing drawing;
  drawing.width = layout_.width;
  drawing.height = layout_.height;
  const auto index = static_cast<std::size_t>(moment - moments_.begin());
  for (std::size_t cell = 0; cell < cell_count(); ++cell) draw_cell(cell, index, drawing);
  if (cell_count() == 0) {
    double line = 0;
    for (const char* words : {"nothing is reduced as one patch here:",
                              "nothing touches, or a mesh, a triangle at a time"}) {
      Text nothing = written(words, layout_.view.x + 0.5 * layout_.view.width,
                             layout_.view.y + 0.5 * layout_.view.height + line, layout_.px(kName),
                             Weight::Regular, kQuietText);
      nothing.align = Align::Center;
      drawing.primitives.push_back(nothing);
      line += 1.3 * layout_.px(kName);
    }
  }
  draw_legend(legend(), layout_, drawing);
  draw_captions(title_, source_, moment->caption, layout_, drawing);
  return drawing;
}

void ContactCells::draw_cell(std::size_t number, std::size_t moment, Drawing& drawing) const {
  const Rect rect = cell_rect(number);
  const ContactCell& cell = moments_[moment].cells[number];
  const double name_room = layout_.px(name_height());
  if (cell_count() > 1 && detail_.names) {
    drawing.primitives.push_back(written(
        fitted(cell.name, layout_.px(kName), FontWeight::Bold, static_cast<float>(rect.width)),
        rect.x, rect.y + 0.8 * layout_.px(kName), layout_.px(kName), Weight::Bold, kText));
  }
  const Rect map{rect.x, rect.y + name_room, rect.width, grid_.map_height};
  if (cell.points.empty()) {
    Text none = written(fitted("no contact in this frame", layout_.px(kNumber), FontWeight::Regular,
                               static_cast<float>(map.width)),
                        map.x + 0.5 * map.width, map.y + 0.5 * map.height, layout_.px(kNumber),
                        Weight::Regular, kQuietText);
    none.align = Align::Center;
    drawing.primitives.push_back(none);
  } else {
    draw_map(map, cell, patches_[number], drawing);
  }
  const double strip = grid_.strip;
  if (strip > 0) {
    const double inset = layout_.px(3);
    draw_strip({rect.x, map.y + map.height + inset, rect.width, strip - 2 * inset}, number, moment,
               drawing);
  }
  const double top = map.y + map.height + strip;
  if (choices_ == 0 && detail_.rows)
    draw_rows({rect.x, top, rect.width, rect.y + rect.height - top}, cell, drawing);
}

void ContactCells::draw_map(const Rect& map, const ContactCell& cell, const Patch& patch,
                            Drawing& drawing) const {
  std::vector<Point2> places;
  std::vector<Vec2d> flats;
  for (const trace::Point& point : cell.points) {
    places.push_back(at(map, patch, point.position));
    flats.push_back(flat(places.back()));
  }
  const auto chosen = [&](const std::vector<int>& indices) {
    std::vector<Vec2d> result;
    for (const int i : indices) result.push_back(flats[static_cast<std::size_t>(i)]);
    return convex_polygon(result);
  };
  const std::vector<Vec2d> all = convex_polygon(flats);
  drawing.primitives.push_back(filled(all, with_alpha(kClipPolygon, 0.10f)));
  if (choices_ > 0) {
    outline(all, layout_.px(2), kClipPolygon, 0, drawing);
    const Vec3d direction = choices_ <= static_cast<int>(cell.choices.size())
                                ? cell.choices[static_cast<std::size_t>(choices_) - 1].direction
                                : Vec3d(Vec3d::Zero());
    draw_choice({places, cell.kept, cell.choices, choices_,
                 Vec2d(patch.u.dot(direction), -patch.v.dot(direction)), grid_.pixels_per_metre,
                 map, layout_},
                drawing);
    return;
  }
  const std::vector<Vec2d> kept = chosen(cell.kept);
  if (kept.size() > 2) drawing.primitives.push_back(filled(kept, with_alpha(kContact, 0.16f)));
  hatch(all, kept, layout_.px(kHatchSpacing), layout_.px(1.1), with_alpha(kDropped, 0.8f), drawing);
  outline(all, layout_.px(2), kClipPolygon, 0, drawing);
  outline(kept, layout_.px(2), kContact, 0, drawing);
  if (cell.best.size() > 2) {
    outline(chosen(cell.best), layout_.px(1.6), kNormal, layout_.px(6), drawing);
  }
  if (by_extremes(cell)) draw_axes_box(map, cell, patch, drawing);
  draw_points(map, places, cell, drawing);
}

/// Of extremes along axes: the smallest box with sides along them, and the axes.
void ContactCells::draw_axes_box(const Rect& map, const ContactCell& cell, const Patch& patch,
                                 Drawing& drawing) const {
  const Vec3d u = cell.choices.front().direction;
  const Vec3d v = cell.normal.cross(u);
  const Vec3d origin = cell.points.front().position;
  double low_u = 0, high_u = 0, low_v = 0, high_v = 0;
  for (const trace::Point& point : cell.points) {
    const Vec3d way = point.position - origin;
    low_u = std::min(low_u, u.dot(way));
    high_u = std::max(high_u, u.dot(way));
    low_v = std::min(low_v, v.dot(way));
    high_v = std::max(high_v, v.dot(way));
  }
  std::vector<Vec2d> box;
  for (const auto& [x, y] :
       {std::pair{low_u, low_v}, {high_u, low_v}, {high_u, high_v}, {low_u, high_v}}) {
    box.push_back(flat(at(map, patch, origin + x * u + y * v)));
  }
  outline(box, layout_.px(1.8), kAxis, layout_.px(6), drawing);
}

void ContactCells::draw_points(const Rect& map, const std::vector<Point2>& places,
                               const ContactCell& cell, Drawing& drawing) const {
  Vec2d middle = Vec2d::Zero();
  for (const Point2& place : places) middle += flat(place) / static_cast<double>(places.size());
  const bool reduces = cell.kept.size() < cell.points.size();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::ranges::find(cell.kept, static_cast<int>(i)) == cell.kept.end())
      draw_dropped_point(places[i], layout_, grid_.mark, drawing);
  }
  for (const int kept : cell.kept)
    draw_kept_point(places[static_cast<std::size_t>(kept)], layout_, grid_.mark, drawing);
  const std::optional<std::size_t> deepest = deepest_of(cell.points);
  if (deepest) draw_deepest_mark(places[*deepest], layout_, grid_.mark, kNormal, drawing);
  if (!reduces) return;  // nothing was chosen

  // Digits keep off all points and each other; one without room is left out.
  LabelPlacer placer(map);
  for (const Point2& place : places) placer.block(place, layout_.px(kKeptReach * grid_.mark));
  if (deepest) placer.block(places[*deepest], layout_.px(12 * grid_.mark));
  const float size = layout_.px(kNumber);
  for (std::size_t k = 0; k < cell.kept.size(); ++k) {
    const Point2& place = places[static_cast<std::size_t>(cell.kept[k])];
    Vec2d away = flat(place) - middle;
    away = away.norm() > 1 ? Vec2d(away.normalized()) : Vec2d(0, -1);
    const std::string digit = std::to_string(k + 1);
    const auto found = placer.place(place, text_width(digit, size, FontWeight::Bold),
                                    0.76f * ascent(size, FontWeight::Bold), 0,
                                    layout_.px(kKeptReach * grid_.mark + 2), pixel(away));
    if (!found) continue;
    if (found->needs_leader) {
      drawing.primitives.push_back(
          Stroke{place, found->leader_end, layout_.px(1), kContact, Cap::Butt});
    }
    Text text = written(digit, found->left_baseline.x, found->left_baseline.y, size, Weight::Bold,
                        kContact);
    text.halo = layout_.px(2);
    drawing.primitives.push_back(text);
  }
}

void ContactCells::draw_rows(const Rect& rect, const ContactCell& cell, Drawing& drawing) const {
  double baseline = rect.y + 0.8 * layout_.px(kNumberRow);
  const float size = layout_.px(kNumber);
  for (const ContactCell::Row& row : shown_rows(cell)) {
    const FontWeight weight = row.strong ? FontWeight::Bold : FontWeight::Regular;
    drawing.primitives.push_back(
        written(fitted(left_of(row), size, weight, static_cast<float>(rect.width)), rect.x,
                baseline, size, row.strong ? Weight::Bold : Weight::Regular, kText));
    if (detail_.row_ends && !row.right.empty()) {
      Text right =
          written(row.right, rect.x + rect.width, baseline, size, Weight::Regular, kQuietText);
      right.align = Align::Right;
      drawing.primitives.push_back(right);
    }
    baseline += layout_.px(kNumberRow);
  }
}

/// One row an id, in the order of appearance.
void ContactCells::draw_strip(const Rect& strip, std::size_t cell, std::size_t moment,
                              Drawing& drawing) const {
  std::vector<std::vector<IdState>> rows;
  for (const std::string& id : ids_) {
    std::vector<IdState>& states = rows.emplace_back();
    for (const ContactMoment& at_moment : moments_) {
      const ContactCell& facts = at_moment.cells[cell];
      const auto found = std::ranges::find(facts.points, id, &trace::Point::id);
      if (found == facts.points.end()) {
        states.push_back(IdState::Absent);
        continue;
      }
      const auto place = static_cast<int>(found - facts.points.begin());
      const bool kept = std::ranges::find(facts.kept, place) != facts.kept.end();
      states.push_back(kept ? IdState::Kept : IdState::Dropped);
    }
  }
  draw_id_strip(rows, moments_.size(), moment, strip, layout_.scale, drawing);
}

}  // namespace contactscope::draw
