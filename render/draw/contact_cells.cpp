#include "draw/contact_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <ranges>

#include "core/convex_polygon.h"
#include "draw/choice_steps.h"
#include "draw/hatch.h"
#include "draw/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kGap = 14;          // between cells
constexpr double kName = 15;         // size of a cell's heading
constexpr double kNumber = 14;       // size of the numbers beneath
constexpr double kNumberRow = 17;    // height of a row of numbers
constexpr double kRowGap = 6;        // between the left and the right of a row
constexpr double kReserve = 20;      // around the patch in a map, for rings and digits
constexpr double kMostStrip = 30;    // height of the strip of ids
constexpr double kStripRow = 4;      // of one id, where there is room
constexpr double kLeastMap = 44;     // height of a map that shows anything
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
  frame_patch(up);
  fit(width, height);
}

/// Gives up one thing after the other until the maps have room.
void ContactCells::fit(int width, int height) {
  const float scale = interface_scale(width, height);
  std::vector<float> widths;
  for (const LegendEntry& entry : legend()) widths.push_back(legend_entry_width(entry, scale));
  const auto arranged = [&] {
    layout_ = make_layout(width, height, false, {widths});
    grid_ = best_grid();
    return grid_.map_height >= layout_.px(kLeastMap) && grid_.cell_width >= row_width();
  };
  for (bool Detail::*given_up :
       {&Detail::row_ends, &Detail::whole_rows, &Detail::strip, &Detail::all_rows, &Detail::rows,
        &Detail::legend, &Detail::names}) {
    if (arranged()) return;
    detail_.*given_up = false;
    if (!detail_.legend) widths.clear();
  }
  arranged();
}

std::vector<std::string> ContactCells::left_out() const {
  std::vector<std::string> list;
  const bool has_rows = choices_ == 0 && std::ranges::any_of(moments_, [](const auto& moment) {
                          return std::ranges::any_of(
                              moment.cells, [](const auto& cell) { return !cell.rows.empty(); });
                        });
  if (has_rows && !detail_.rows) {
    list.emplace_back("the numbers");
  } else if (has_rows && !detail_.all_rows) {
    list.emplace_back("all numbers but the first");
  } else if (has_rows && !detail_.whole_rows) {
    list.emplace_back("parts of the numbers");
  } else if (has_row_ends() && choices_ == 0 && !detail_.row_ends) {
    list.emplace_back("the numbers on the right");
  }
  if (!detail_.strip && moments_.size() > 1 && choices_ == 0) {
    list.emplace_back("the ids over time");
  }
  if (!detail_.legend) list.emplace_back("the legend");
  if (!detail_.names && cell_count() > 1) list.emplace_back("the names");
  return list;
}

/// Axes, middle and extent of all patches of the sequence. Seen from above where there is an above,
/// with x to the right, as on a map.
void ContactCells::frame_patch(const std::string& up) {
  const Vec3d above = up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  Vec3d normal = above;
  for (const ContactMoment& moment : moments_) {
    const auto touching = std::ranges::find_if(
        moment.cells, [](const ContactCell& cell) { return !cell.points.empty(); });
    if (touching == moment.cells.end()) continue;
    normal = touching->normal;
    break;
  }
  if (normal.dot(above) < 0) normal = -normal;
  const Vec3d right = Vec3d::UnitX() - normal.x() * normal;
  u_ = right.norm() > 0.1 ? Vec3d(right.normalized()) : any_perpendicular(normal);
  v_ = normal.cross(u_);

  double low_u = std::numeric_limits<double>::max(), high_u = -low_u;
  double low_v = low_u, high_v = -low_u;
  for (const ContactMoment& moment : moments_) {
    for (const ContactCell& cell : moment.cells) {
      for (const trace::Point& point : cell.points) {
        low_u = std::min(low_u, u_.dot(point.position));
        high_u = std::max(high_u, u_.dot(point.position));
        low_v = std::min(low_v, v_.dot(point.position));
        high_v = std::max(high_v, v_.dot(point.position));
        if (std::ranges::find(ids_, point.id) == ids_.end()) ids_.push_back(point.id);
      }
    }
  }
  if (ids_.empty()) return;
  center_ = 0.5 * (low_u + high_u) * u_ + 0.5 * (low_v + high_v) * v_;
  // A patch without size is drawn in the middle, at any scale.
  const double least = std::max({high_u - low_u, high_v - low_v, 1e-12});
  extent_u_ = std::max(high_u - low_u, 1e-3 * least);
  extent_v_ = std::max(high_v - low_v, 1e-3 * least);
}

double ContactCells::strip_height() const {
  if (!detail_.strip || moments_.size() < 2 || choices_ > 0 || ids_.empty()) return 0;
  return std::min(kMostStrip, kStripRow * static_cast<double>(ids_.size())) + 6;
}

std::size_t ContactCells::row_count() const {
  if (!detail_.rows || choices_ > 0) return 0;  // the result of choices is another picture's
  std::size_t most = 0;
  for (const ContactMoment& moment : moments_) {
    for (const ContactCell& cell : moment.cells) most = std::max(most, cell.rows.size());
  }
  return detail_.all_rows ? most : std::min<std::size_t>(most, 1);
}

bool ContactCells::has_row_ends() const {
  return std::ranges::any_of(moments_, [](const ContactMoment& moment) {
    return std::ranges::any_of(moment.cells, [](const ContactCell& cell) {
      return std::ranges::any_of(cell.rows,
                                 [](const ContactCell::Row& row) { return !row.right.empty(); });
    });
  });
}

/// What of a row there is room for on the left.
std::string ContactCells::left_of(const ContactCell::Row& row) const {
  return detail_.whole_rows || row.brief.empty() ? row.left : row.brief;
}

/// Width that the widest row of any cell needs, pixels.
double ContactCells::row_width() const {
  const std::size_t count = row_count();
  const float size = layout_.px(kNumber);
  double widest = 0;
  for (const ContactMoment& moment : moments_) {
    for (const ContactCell& cell : moment.cells) {
      for (const ContactCell::Row& row : cell.rows | std::views::take(count)) {
        const FontWeight weight = row.strong ? FontWeight::Bold : FontWeight::Regular;
        double width = text_width(left_of(row), size, weight);
        if (detail_.row_ends && !row.right.empty()) {
          width += layout_.px(kRowGap) + text_width(row.right, size, FontWeight::Regular);
        }
        widest = std::max(widest, width);
      }
    }
  }
  return widest;
}

double ContactCells::name_height() const {
  return detail_.names ? kName + 4 : 0;
}

/// Height of a cell beside its map, at 720 lines.
double ContactCells::furniture() const {
  return name_height() + strip_height() + kNumberRow * static_cast<double>(row_count());
}

/// The number of columns that draws the patch largest, of those with room for the rows if there are
/// such.
ContactCells::Grid ContactCells::best_grid() const {
  const double gap = layout_.px(kGap);
  const double reserve = layout_.px(2 * kReserve);
  const double needed = row_width();
  Grid best;
  best.pixels_per_metre = 0;
  const int count = static_cast<int>(cell_count());
  if (count == 0) return Grid{};
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    Grid grid;
    grid.columns = columns;
    grid.cell_width = (layout_.view.width - (columns - 1) * gap) / columns;
    grid.cell_height = (layout_.view.height - (rows - 1) * gap) / rows;
    grid.map_height = grid.cell_height - layout_.px(furniture());
    if (grid.cell_width <= reserve || grid.map_height <= reserve) continue;
    grid.pixels_per_metre =
        std::min((grid.cell_width - reserve) / extent_u_, (grid.map_height - reserve) / extent_v_);
    const bool fits = grid.cell_width >= needed;
    const bool best_fits = best.cell_width >= needed;
    const bool is_larger = grid.pixels_per_metre > best.pixels_per_metre;
    if (fits == best_fits ? is_larger : fits) best = grid;
  }
  // No room at all: what a canvas this small shows is a dot in each cell.
  if (best.pixels_per_metre <= 0) {
    best.columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
    const int rows = (count + best.columns - 1) / best.columns;
    best.cell_width = (layout_.view.width - (best.columns - 1) * gap) / best.columns;
    best.cell_height = (layout_.view.height - (rows - 1) * gap) / rows;
    best.map_height = best.cell_height - layout_.px(furniture());
  }
  return best;
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

Rect ContactCells::cell_rect(std::size_t cell) const {
  const auto column = static_cast<double>(static_cast<int>(cell) % grid_.columns);
  const auto row = static_cast<double>(static_cast<int>(cell) / grid_.columns);
  const double gap = layout_.px(kGap);
  return {layout_.view.x + column * (grid_.cell_width + gap),
          layout_.view.y + row * (grid_.cell_height + gap), grid_.cell_width, grid_.cell_height};
}

Point2 ContactCells::at(const Rect& map, const Vec3d& position) const {
  const Vec3d from_center = position - center_;
  return {
      static_cast<float>(map.x + 0.5 * map.width + grid_.pixels_per_metre * u_.dot(from_center)),
      static_cast<float>(map.y + 0.5 * map.height - grid_.pixels_per_metre * v_.dot(from_center))};
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
    draw_map(map, cell, drawing);
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

void ContactCells::draw_map(const Rect& map, const ContactCell& cell, Drawing& drawing) const {
  std::vector<Point2> places;
  std::vector<Vec2d> flats;
  for (const trace::Point& point : cell.points) {
    places.push_back(at(map, point.position));
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
                 Vec2d(u_.dot(direction), -v_.dot(direction)), map, layout_},
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

/// One row an id, in the order of appearance: grey while the point is there, vermilion while it is
/// kept. A line marks this frame.
void ContactCells::draw_strip(const Rect& strip, std::size_t cell, std::size_t moment,
                              Drawing& drawing) const {
  const double row = strip.height / static_cast<double>(ids_.size());
  const double column = strip.width / static_cast<double>(moments_.size());
  const auto bar = [&](std::size_t id, std::size_t from, std::size_t to, const Color& color) {
    const double gap = row > 2.5 ? 0.18 * row : 0;
    const auto x0 = static_cast<float>(strip.x + column * static_cast<double>(from));
    const auto x1 = static_cast<float>(strip.x + column * static_cast<double>(to));
    const auto y0 = static_cast<float>(strip.y + row * static_cast<double>(id) + gap);
    const auto y1 = static_cast<float>(strip.y + row * static_cast<double>(id + 1) - gap);
    drawing.primitives.push_back(Fill{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, color});
  };
  for (std::size_t id = 0; id < ids_.size(); ++id) {
    enum class State { Absent, Dropped, Kept };
    const auto state = [&](const ContactMoment& at_moment) {
      const ContactCell& facts = at_moment.cells[cell];
      const auto found = std::ranges::find(facts.points, ids_[id], &trace::Point::id);
      if (found == facts.points.end()) return State::Absent;
      const auto place = static_cast<int>(found - facts.points.begin());
      return std::ranges::find(facts.kept, place) == facts.kept.end() ? State::Dropped
                                                                      : State::Kept;
    };
    std::size_t from = 0;
    while (from < moments_.size()) {
      const State now = state(moments_[from]);
      std::size_t to = from + 1;
      while (to < moments_.size() && state(moments_[to]) == now) ++to;
      if (now == State::Kept) bar(id, from, to, kContact);
      if (now == State::Dropped) bar(id, from, to, rgb(0xD5D8DC));
      from = to;
    }
  }
  const auto x = static_cast<float>(strip.x + column * (static_cast<double>(moment) + 0.5));
  const auto y0 = static_cast<float>(strip.y - layout_.px(2));
  const auto y1 = static_cast<float>(strip.y + strip.height + layout_.px(2));
  drawing.primitives.push_back(
      Stroke{{x, y0}, {x, y1}, layout_.px(3.5), with_alpha(kWhite, 0.8f), Cap::Butt});
  drawing.primitives.push_back(Stroke{{x, y0}, {x, y1}, layout_.px(1.5), kNormal, Cap::Butt});
}

}  // namespace contactscope::draw
