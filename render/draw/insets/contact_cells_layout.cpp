#include "draw/insets/contact_cells.h"

// Layout of contact cells, and the details that a canvas has no room for.
namespace contactscope::draw {
namespace {

constexpr double kRowGap = 6;     // between the left and right text of a row
constexpr double kReserve = 20;   // around the patch in a map, for rings and digits
constexpr double kMaxStrip = 30;  // height of the strip of ids; more with few cells
constexpr std::size_t kFewCells = 4;
constexpr double kStripRow = 4;     // per id, minimum if there is room
constexpr double kWideRow = 16;     // per id, maximum
constexpr double kCloseMarks = 30;  // distance between points from which marks have full size
constexpr double kMinMark = 0.6;
constexpr double kMinMap = 44;  // minimum useful height of a map
// With few cells, text, rings and digits can be large enough to be legible at half size.
constexpr double kLargeSigns = 1.5, kLargerSigns = 1.2;
constexpr std::size_t kSomeCells = 6;

}  // namespace

double ContactCells::signs() const {
  if (choices_ > 0) return cell_count() <= 2 ? kLargerSigns : 1;
  return cell_count() <= kFewCells ? kLargeSigns : cell_count() <= kSomeCells ? kLargerSigns : 1;
}

/// Gives up one detail after the other until the maps have room.
void ContactCells::fit(int width, int height) {
  for (int given_up = 0; given_up <= static_cast<int>(Detail::None); ++given_up) {
    given_up_ = static_cast<Detail>(given_up);
    const std::vector<float> widths = mapped(legend(), [&](const LegendEntry& entry) {
      return legend_entry_width(entry, interface_scale(width, height, style_), style_.words.get());
    });
    layout_ = make_layout(width, height, false, {widths}, 0, style_, title_);
    grid_ = best_grid();
    if (grid_.map_height >= px(kMinMap) && grid_.cell_width >= row_width()) return;
  }
}

/// Distance to the nearest other point, metres: median over all points.
double ContactCells::nearest_points() const {
  std::vector<double> nearest;
  for (const ContactMoment& moment : moments_) {
    for (const ContactCell& cell : moment.cells) {
      for (const trace::Point& point : cell.points) {
        double least = std::numeric_limits<double>::infinity();
        for (const trace::Point& other : cell.points)
          if (&other != &point) least = std::min(least, (other.position - point.position).norm());
        nearest.push_back(least);
      }
      if (!cell.points.empty()) break;  // the others usually have the same points
    }
  }
  if (nearest.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::ranges::nth_element(nearest, middle);
  return *middle;
}

std::vector<std::string> ContactCells::left_out() const {
  std::vector<std::string> list;
  const auto any_row = [&](const auto& holds) {
    return choices_ == 0 && std::ranges::any_of(all_cells(), [&](const ContactCell& cell) {
             return std::ranges::any_of(cell.rows, holds);
           });
  };
  if (any_row([](const ContactCell::Row&) { return true; }) && !shows(Detail::WholeRows)) {
    list.emplace_back(!shows(Detail::Rows)      ? "the numbers"
                      : !shows(Detail::AllRows) ? "all numbers but the first"
                                                : "parts of the numbers");
  } else if (any_row([](const ContactCell::Row& row) { return !row.right.empty(); }) &&
             !shows(Detail::RowEnds)) {
    list.emplace_back("the numbers on the right");
  }
  if (!shows(Detail::Strip) && moments_.size() > 1 && choices_ == 0)
    list.emplace_back("the points over time");
  if (!shows(Detail::Legend)) list.emplace_back("the legend");
  if (!shows(Detail::Names) && cell_count() > 1) list.emplace_back("the names");
  return list;
}

/// Axes and centre of each cell's patch, and the extent of the largest.
void ContactCells::frame_patches(const Vec3d& above) {
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    Patch& patch = patches_.emplace_back();
    const auto touching = std::ranges::find_if(
        moments_, [&](const ContactMoment& moment) { return !moment.cells[cell].points.empty(); });
    patch.axes =
        axes_from_above(touching == moments_.end() ? above : touching->cells[cell].normal, above);
    PlaneExtent extent;
    for (const ContactMoment& moment : moments_) {
      const auto places = mapped(moment.cells[cell].points, [&](const trace::Point& point) {
        return patch.axes.along(point.position);
      });
      for (const Vec2d& place : places) {
        const Vec2d middle = rose_ ? Vec2d(0.5 * (mean_of(places) + place)) : place;  // of a disc
        const Vec2d radius = Vec2d::Constant((place - middle).norm());
        extent.extend(Vec2d(middle - radius)).extend(Vec2d(middle + radius));
      }
    }
    if (extent.isEmpty()) continue;
    patch.center = extent.center();
    extent_ = extent_.cwiseMax(extent.sizes());
  }
  // A patch of size zero is drawn in the middle, at any scale.
  const double least = 1e-3 * std::max(extent_.maxCoeff(), 1e-12);
  extent_ = extent_.cwiseMax(Vec2d::Constant(least));
}

/// Every cell has a row for every id of any cell, so that equal ids have equal heights.
void ContactCells::gather_ids() {
  if (moments_.size() < 2) return;
  std::map<std::string, std::size_t> known;  // row of each id, in order of appearance
  for (const ContactCell& cell : all_cells()) {
    for (const trace::Point& point : cell.points)
      if (!point.id.empty()) known.try_emplace(point.id, known.size());
  }
  if (known.empty()) return;  // engines may record no ids
  const std::vector<IdState> absent(moments_.size(), IdState::Absent);
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    std::vector<std::vector<IdState>> rows(known.size(), absent);
    for (std::size_t m = 0; m < moments_.size(); ++m) {
      const ContactCell& now = moments_[m].cells[cell];
      for (std::size_t i = now.points.size(); i-- > 0;) {  // the first of equal ids wins
        if (now.points[i].id.empty()) continue;
        const bool kept = std::ranges::find(now.kept, static_cast<int>(i)) != now.kept.end();
        rows[known[now.points[i].id]][m] = kept ? IdState::Kept : IdState::Dropped;
      }
    }
    ids_.emplace_back(rows, std::vector<std::size_t>(rows.size(), 0));
  }
}

/// Whether the scenario translates the strip's caption to nothing, because only one frame matters.
bool ContactCells::is_named_away() const {
  return style_.words && style_.words->of(kStripText).empty();
}

double ContactCells::strip_height() const {
  if (!shows(Detail::Strip) || choices_ > 0 || ids_.empty()) return 0;
  const auto rows = static_cast<double>(ids_.front().row_count());
  if (rows == 0 || is_named_away()) return 0;
  const double wide = cell_count() > kFewCells ? 1 : 1.75;
  return wide * std::min(kMaxStrip, kStripRow * rows) + kStripCaption + axis_height() + 6;
}

std::size_t ContactCells::row_count() const {
  if (!shows(Detail::Rows) || choices_ > 0) return 0;  // pictures of choices do not show the result
  std::size_t most = 0;
  for (const ContactCell& cell : all_cells()) most = std::max(most, cell.rows.size());
  return shows(Detail::AllRows) && !rose_ ? most : std::min<std::size_t>(most, 1);
}

std::span<const ContactCell::Row> ContactCells::shown_rows(const ContactCell& cell) const {
  return std::span(cell.rows).first(std::min(row_count(), cell.rows.size()));
}

/// The left text of a row, or its brief form if there is no room.
std::string ContactCells::left_of(const ContactCell::Row& row) const {
  return (shows(Detail::WholeRows) && !rose_) || row.brief.empty() ? row.left : row.brief;
}

/// Width of the widest row of any cell, pixels.
double ContactCells::row_width() const {
  const auto size = static_cast<float>(px(kNumber));
  double widest = 0;
  for (const ContactCell& cell : all_cells()) {
    for (const ContactCell::Row& row : shown_rows(cell)) {
      const auto width_of = [&](const std::string& text, Weight weight) {
        return text_width(style_.words ? style_.words->of(text) : text, size, weight);
      };
      double width = width_of(left_of(row), row.strong ? Weight::Bold : Weight::Regular);
      if (shows(Detail::RowEnds) && !row.right.empty())
        width += px(kRowGap) + width_of(row.right, Weight::Regular);
      widest = std::max(widest, width);
    }
  }
  return widest;
}

/// The number of columns with the largest patches, among those with room for the rows, if there are
/// any. The strip gets the height that a patch leaves free.
ContactCells::Grid ContactCells::best_grid() const {
  const int count = static_cast<int>(cell_count());
  if (count == 0) return Grid{};
  const double gap = px(kGap);
  const double reserve = px(2 * kReserve);
  const double needed = row_width();
  // Height of everything except the map in a cell.
  const double furniture =
      px(name_height() + strip_height() + kNumberRow * static_cast<double>(row_count()));
  const auto grid_of = [&](int columns) {
    const int rows = (count + columns - 1) / columns;
    Grid grid{.columns = columns};
    grid.cell_width = (layout_.view.width - (columns - 1) * gap) / columns;
    grid.cell_height = (layout_.view.height - (rows - 1) * gap) / rows;
    grid.map_height = grid.cell_height - furniture;
    // 0 if there is no room at all.
    grid.pixels_per_metre = std::max(0.0, std::min((grid.cell_width - reserve) / extent_.x(),
                                                   (grid.map_height - reserve) / extent_.y()));
    return grid;
  };
  Grid best;
  for (int columns = 1; columns <= count; ++columns) {
    const Grid grid = grid_of(columns);
    if (grid.pixels_per_metre == 0) continue;
    const bool fits = grid.cell_width >= needed;
    const bool best_fits = best.cell_width >= needed;
    const bool is_larger = grid.pixels_per_metre > best.pixels_per_metre;
    if (fits == best_fits ? is_larger : fits) best = grid;
  }
  // No room at all: a tiny canvas shows a dot in each cell.
  if (best.pixels_per_metre == 0) best = grid_of(static_cast<int>(std::ceil(std::sqrt(count))));

  best.strip = px(strip_height());
  if (best.strip > 0) {
    const double used = reserve + best.pixels_per_metre * extent_.y();
    const double wide = px(kWideRow * static_cast<double>(ids_.front().row_count()) +
                           kStripCaption + axis_height() + 6);
    const double more = std::clamp(wide - best.strip, 0.0, std::max(0.0, best.map_height - used));
    best.strip += more;
    best.map_height -= more;
  }
  const double between = nearest_points() * best.pixels_per_metre / px(1);
  best.mark = std::clamp(between / kCloseMarks, kMinMark, 1.0);
  return best;
}

}  // namespace contactscope::draw
