#include "draw/reducer_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/convex_polygon.h"
#include "draw/hatch.h"
#include "draw/palette.h"
#include "draw/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kGap = 14;          // between cells
constexpr double kName = 15;         // size of a cell's heading
constexpr double kNumber = 14;       // size of the numbers beneath
constexpr double kNumberRow = 17;    // height of a row of numbers
constexpr double kReserve = 20;      // around the patch in a map, for rings and digits
constexpr double kMostStrip = 30;    // height of the strip of ids
constexpr double kStripRow = 4;      // of one id, where there is room
constexpr double kHatchSpacing = 5;  // pixels between lines

Vec2d flat(const Point2& p) {
  return {p.x, p.y};
}

Point2 pixel(const Vec2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

const trace::ReducerAnswer& answer_of(const trace::Exploration& exploration,
                                      const std::string& reducer) {
  return *std::ranges::find(exploration.reducers, reducer, &trace::ReducerAnswer::name);
}

std::string percent(double share) {
  std::array<char, 32> text{};
  // Only what is whole may be called so.
  const double value = 100 * share;
  const char* format = value < 99.995 || value >= 99.99999 ? "%.1f %%" : "%.3f %%";
  if (value > 99.94 && value < 99.99999) format = "%.2f %%";
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
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

ReducerCells::ReducerCells(const std::string& title, const std::string& source,
                           const std::string& up, const std::vector<trace::Exploration>& sequence,
                           std::vector<std::string> order, int width, int height)
    : title_(title), source_(source), sequence_(sequence), order_(std::move(order)) {
  const float scale = interface_scale(width, height);
  std::vector<float> widths;
  for (const LegendEntry& entry : legend()) widths.push_back(legend_entry_width(entry, scale));
  layout_ = make_layout(width, height, false, {widths});

  // Seen from above where there is an above: x to the right, as on a map.
  const Vec3d above = up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  Vec3d normal = sequence_.front().normal;
  if (normal.dot(above) < 0) normal = -normal;
  const Vec3d right = Vec3d::UnitX() - normal.x() * normal;
  u_ = right.norm() > 0.1 ? Vec3d(right.normalized()) : any_perpendicular(normal);
  v_ = normal.cross(u_);

  double low_u = std::numeric_limits<double>::max(), high_u = -low_u;
  double low_v = low_u, high_v = -low_u;
  for (const trace::Exploration& exploration : sequence_) {
    for (const trace::Point& point : exploration.points) {
      low_u = std::min(low_u, u_.dot(point.position));
      high_u = std::max(high_u, u_.dot(point.position));
      low_v = std::min(low_v, v_.dot(point.position));
      high_v = std::max(high_v, v_.dot(point.position));
      if (std::ranges::find(ids_, point.id) == ids_.end()) ids_.push_back(point.id);
    }
  }
  center_ = 0.5 * (low_u + high_u) * u_ + 0.5 * (low_v + high_v) * v_;
  // A patch without size is drawn in the middle, at any scale.
  const double least = std::max({high_u - low_u, high_v - low_v, 1e-12});
  extent_u_ = std::max(high_u - low_u, 1e-3 * least);
  extent_v_ = std::max(high_v - low_v, 1e-3 * least);
  grid_ = best_grid();
}

double ReducerCells::strip_height() const {
  if (sequence_.size() < 2) return 0;
  return std::min(kMostStrip, kStripRow * static_cast<double>(ids_.size())) + 6;
}

/// Height of a cell beside its map, at 720 lines.
double ReducerCells::furniture() const {
  return kName + 4 + strip_height() + 3 * kNumberRow;
}

/// The number of columns that draws the patch largest.
ReducerCells::Grid ReducerCells::best_grid() const {
  const double gap = layout_.px(kGap);
  const double reserve = layout_.px(2 * kReserve);
  Grid best;
  best.pixels_per_metre = 0;
  const int count = static_cast<int>(order_.size());
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    Grid grid;
    grid.columns = columns;
    grid.cell_width = (layout_.view.width - (columns - 1) * gap) / columns;
    grid.cell_height = (layout_.view.height - (rows - 1) * gap) / rows;
    grid.map_height = grid.cell_height - layout_.px(furniture());
    grid.pixels_per_metre =
        std::min((grid.cell_width - reserve) / extent_u_, (grid.map_height - reserve) / extent_v_);
    if (grid.pixels_per_metre > best.pixels_per_metre) best = grid;
  }
  // No room at all: what a canvas this small shows is a dot in each cell.
  if (best.pixels_per_metre <= 0) {
    best.columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
    const int rows = (count + best.columns - 1) / best.columns;
    best.cell_width = layout_.view.width / best.columns;
    best.cell_height = layout_.view.height / rows;
    best.map_height = std::max(1.0, best.cell_height - layout_.px(furniture()));
    best.pixels_per_metre = 1e-3;
  }
  return best;
}

std::vector<LegendEntry> ReducerCells::legend() const {
  std::vector<LegendEntry> entries = {{LegendKind::ClipPolygon, "contact polygon"},
                                      {LegendKind::Reduced, "reduced away"},
                                      {LegendKind::Kept, "kept, in order of choice"},
                                      {LegendKind::LostArea, "lost area"},
                                      {LegendKind::BestPolygon, "best polygon"}};
  if (sequence_.size() > 1) entries.push_back({LegendKind::KeptIds, "ids kept, over the frames"});
  return entries;
}

Rect ReducerCells::cell_rect(std::size_t cell) const {
  const auto column = static_cast<double>(static_cast<int>(cell) % grid_.columns);
  const auto row = static_cast<double>(static_cast<int>(cell) / grid_.columns);
  const double gap = layout_.px(kGap);
  return {layout_.view.x + column * (grid_.cell_width + gap),
          layout_.view.y + row * (grid_.cell_height + gap), grid_.cell_width, grid_.cell_height};
}

Point2 ReducerCells::at(const Rect& map, const Vec3d& position) const {
  const Vec3d from_center = position - center_;
  return {
      static_cast<float>(map.x + 0.5 * map.width + grid_.pixels_per_metre * u_.dot(from_center)),
      static_cast<float>(map.y + 0.5 * map.height - grid_.pixels_per_metre * v_.dot(from_center))};
}

Drawing ReducerCells::frame(std::size_t index) const {
  const trace::Exploration& exploration = sequence_[index];
  Drawing drawing;
  drawing.width = layout_.width;
  drawing.height = layout_.height;
  for (std::size_t cell = 0; cell < order_.size(); ++cell) {
    draw_cell(cell_rect(cell), exploration, answer_of(exploration, order_[cell]), index, drawing);
  }
  draw_legend(legend(), layout_, drawing);
  std::string moment = exploration.a + " and " + exploration.b;
  if (!exploration.label.empty()) moment += " (" + exploration.label + ")";
  moment += ", frame " + std::to_string(exploration.frame);
  draw_captions(title_, source_, moment, layout_, drawing);
  return drawing;
}

void ReducerCells::draw_cell(const Rect& cell, const trace::Exploration& exploration,
                             const trace::ReducerAnswer& answer, std::size_t index,
                             Drawing& drawing) const {
  const double name_height = layout_.px(kName + 4);
  drawing.primitives.push_back(written(answer.name, cell.x, cell.y + 0.8 * layout_.px(kName),
                                       layout_.px(kName), Weight::Bold, kText));
  const Rect map{cell.x, cell.y + name_height, cell.width, grid_.map_height};
  draw_map(map, exploration, answer, drawing);
  const double strip = layout_.px(strip_height());
  if (strip > 0) {
    const double inset = layout_.px(3);
    draw_strip({cell.x, map.y + map.height + inset, cell.width, strip - 2 * inset}, answer.name,
               index, drawing);
  }
  const double top = map.y + map.height + strip;
  draw_numbers({cell.x, top, cell.width, cell.y + cell.height - top}, answer, drawing);
}

void ReducerCells::draw_map(const Rect& map, const trace::Exploration& exploration,
                            const trace::ReducerAnswer& answer, Drawing& drawing) const {
  std::vector<Vec2d> places;
  for (const trace::Point& point : exploration.points)
    places.push_back(flat(at(map, point.position)));
  const auto chosen = [&](const std::vector<int>& indices) {
    std::vector<Vec2d> result;
    for (const int i : indices) result.push_back(places[static_cast<std::size_t>(i)]);
    return convex_polygon(result);
  };
  const std::vector<Vec2d> all = convex_polygon(places);
  const std::vector<Vec2d> kept = chosen(answer.kept);

  drawing.primitives.push_back(filled(all, with_alpha(kClipPolygon, 0.10f)));
  if (kept.size() > 2) drawing.primitives.push_back(filled(kept, with_alpha(kContact, 0.16f)));
  hatch(all, kept, layout_.px(kHatchSpacing), layout_.px(1.1), with_alpha(kDropped, 0.8f), drawing);
  outline(all, layout_.px(2), kClipPolygon, 0, drawing);
  outline(kept, layout_.px(2), kContact, 0, drawing);
  if (exploration.best.size() > 2) {
    outline(chosen(exploration.best), layout_.px(1.6), kNormal, layout_.px(6), drawing);
  }

  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& place : places) middle += place / static_cast<double>(places.size());
  const float cross = layout_.px(3.6);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point2 p = pixel(places[i]);
    const auto found = std::ranges::find(answer.kept, static_cast<int>(i));
    if (found == answer.kept.end()) {
      for (const auto& [color, width] :
           {std::pair{with_alpha(kWhite, 0.9f), 4.5f}, {kDropped, 2.0f}}) {
        drawing.primitives.push_back(Stroke{{p.x - cross, p.y - cross},
                                            {p.x + cross, p.y + cross},
                                            layout_.px(width),
                                            color,
                                            Cap::Round});
        drawing.primitives.push_back(Stroke{{p.x - cross, p.y + cross},
                                            {p.x + cross, p.y - cross},
                                            layout_.px(width),
                                            color,
                                            Cap::Round});
      }
      continue;
    }
    drawing.primitives.push_back(Disc{p, 0, layout_.px(5.6), kWhite});
    drawing.primitives.push_back(Disc{p, 0, layout_.px(4.2), kContact});
    drawing.primitives.push_back(Disc{p, layout_.px(6.4), layout_.px(8.2), kContact});
    if (answer.kept.size() == exploration.points.size()) continue;  // nothing was chosen
    Vec2d out = places[i] - middle;
    out = out.norm() > 1 ? Vec2d(out.normalized()) : Vec2d(0, -1);
    const double reach = layout_.px(15);
    Text digit = written(std::to_string(found - answer.kept.begin() + 1), p.x + reach * out.x(),
                         p.y + reach * out.y() + layout_.px(4.8), layout_.px(kNumber), Weight::Bold,
                         kContact);
    digit.align = Align::Center;
    digit.halo = layout_.px(2);
    drawing.primitives.push_back(digit);
  }
}

void ReducerCells::draw_numbers(const Rect& cell, const trace::ReducerAnswer& answer,
                                Drawing& drawing) const {
  const auto row = [&](int number, const std::string& text, Weight weight) {
    const double baseline = cell.y + (number + 0.8) * layout_.px(kNumberRow);
    drawing.primitives.push_back(
        written(text, cell.x, baseline, layout_.px(kNumber), weight, kText));
  };
  row(0, "area " + percent(answer.area_ratio), Weight::Regular);
  std::array<char, 32> lost{};
  const bool loses = answer.wrench_error > 1e-6;
  std::snprintf(lost.data(), lost.size(), "moments −%.1f %%", 100 * answer.wrench_error);
  row(1, loses ? lost.data() : "moments whole", Weight::Regular);
  std::string verdict = answer.deepest_kept ? "deepest kept" : "deepest lost";
  if (!answer.supports_center_of_mass) verdict += ", tips over";
  const bool good = answer.deepest_kept && answer.supports_center_of_mass;
  row(2, verdict, good ? Weight::Regular : Weight::Bold);
  if (answer.median) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.0f ns", *answer.median);
    Text right = written(time.data(), cell.x + cell.width, cell.y + 0.8 * layout_.px(kNumberRow),
                         layout_.px(kNumber), Weight::Regular, kQuietText);
    right.align = Align::Right;
    drawing.primitives.push_back(right);
  }
}

/// One row an id, in the order of appearance: grey while the point is there, vermilion while it is
/// kept. A line marks this frame.
void ReducerCells::draw_strip(const Rect& strip, const std::string& reducer, std::size_t index,
                              Drawing& drawing) const {
  const double row = strip.height / static_cast<double>(ids_.size());
  const double column = strip.width / static_cast<double>(sequence_.size());
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
    const auto state = [&](const trace::Exploration& exploration) {
      const auto found = std::ranges::find(exploration.points, ids_[id], &trace::Point::id);
      if (found == exploration.points.end()) return State::Absent;
      const auto place = static_cast<int>(found - exploration.points.begin());
      const std::vector<int>& kept = answer_of(exploration, reducer).kept;
      return std::ranges::find(kept, place) == kept.end() ? State::Dropped : State::Kept;
    };
    std::size_t from = 0;
    while (from < sequence_.size()) {
      const State now = state(sequence_[from]);
      std::size_t to = from + 1;
      while (to < sequence_.size() && state(sequence_[to]) == now) ++to;
      if (now == State::Kept) bar(id, from, to, kContact);
      if (now == State::Dropped) bar(id, from, to, rgb(0xD5D8DC));
      from = to;
    }
  }
  const auto x = static_cast<float>(strip.x + column * (static_cast<double>(index) + 0.5));
  const auto y0 = static_cast<float>(strip.y - layout_.px(2));
  const auto y1 = static_cast<float>(strip.y + strip.height + layout_.px(2));
  drawing.primitives.push_back(
      Stroke{{x, y0}, {x, y1}, layout_.px(3.5), with_alpha(kWhite, 0.8f), Cap::Butt});
  drawing.primitives.push_back(Stroke{{x, y0}, {x, y1}, layout_.px(1.5), kNormal, Cap::Butt});
}

}  // namespace contactscope::draw
