#include "draw/contact_cells.h"

#include <algorithm>
#include <ranges>

#include "core/convex_polygon.h"
#include "draw/choice_steps.h"
#include "draw/hatch.h"
#include "draw/id_strip.h"
#include "draw/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kHatchSpacing = 5;  // pixels between lines

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
  std::vector<LegendEntry> entries = {{LegendKind::ClipPolygon, "contact polygon"}};
  if (choices_ > 0) {
    entries.push_back({LegendKind::PlainPoint, "contact point"});
    entries.push_back({LegendKind::Kept, "kept, in order of choice"});
    return entries;
  }
  const auto any = [&](auto&& holds) {
    return std::ranges::any_of(moments_, [&](const ContactMoment& moment) {
      return std::ranges::any_of(moment.cells, holds);
    });
  };
  const bool reduces =
      any([](const ContactCell& cell) { return cell.kept.size() < cell.points.size(); });
  if (reduces) entries.push_back({LegendKind::Reduced, "reduced away"});
  entries.push_back({LegendKind::Kept, reduces ? "kept, in order of choice" : "kept"});
  if (reduces) entries.push_back({LegendKind::LostArea, "lost area"});
  if (any([](const ContactCell& cell) { return cell.best.size() > 2; })) {
    entries.push_back({LegendKind::BestPolygon, "best polygon"});
  }
  if (moments_.size() > 1) entries.push_back({LegendKind::KeptIds, "ids kept, over the frames"});
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
    Text nothing = written(
        "nothing touches, so nothing is reduced", layout_.view.x + 0.5 * layout_.view.width,
        layout_.view.y + 0.5 * layout_.view.height, layout_.px(kName), Weight::Regular, kQuietText);
    nothing.align = Align::Center;
    drawing.primitives.push_back(nothing);
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
  const double strip = layout_.px(strip_height());
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
                 Vec2d(patch.u.dot(direction), -patch.v.dot(direction)), map, layout_},
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
  draw_points(places, cell, drawing);
}

void ContactCells::draw_points(const std::vector<Point2>& places, const ContactCell& cell,
                               Drawing& drawing) const {
  Vec2d middle = Vec2d::Zero();
  for (const Point2& place : places) middle += flat(place) / static_cast<double>(places.size());
  const bool reduces = cell.kept.size() < cell.points.size();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto found = std::ranges::find(cell.kept, static_cast<int>(i));
    if (found == cell.kept.end()) {
      draw_dropped_point(places[i], layout_, drawing);
      continue;
    }
    draw_kept_point(places[i], layout_, drawing);
    if (!reduces) continue;  // nothing was chosen
    draw_choice_number(places[i], static_cast<int>(found - cell.kept.begin()) + 1, middle, layout_,
                       kNumber, drawing);
  }
}

void ContactCells::draw_rows(const Rect& rect, const ContactCell& cell, Drawing& drawing) const {
  double baseline = rect.y + 0.8 * layout_.px(kNumberRow);
  const float size = layout_.px(kNumber);
  for (const ContactCell::Row& row : cell.rows | std::views::take(row_count())) {
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
