#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/at.h"
#include "draw/charts/series_chart.h"
#include "draw/insets/contact_plane.h"
#include "draw/scene/moments.h"
#include "trace/exploration.h"

namespace contactscope::draw {

/// One reduction, seen along the normal.
struct ContactCell {
  /// A line of text beneath the map.
  struct Row {
    std::string left;
    std::string right;  // quieter; left out where there is no room
    std::string brief;  // what stands for both where there is none for `left`
    bool strong = false;
  };

  std::string name;
  std::string pair{};  // "slab crate"; empty of explorations
  Vec3d normal = Vec3d::Zero();
  std::vector<trace::Point> points;    // all, before
  std::vector<int> kept;               // in the order of choice
  std::vector<int> best;               // points of the best polygon; empty: not drawn
  std::vector<trace::Choice> choices;  // how the kept ones were chosen, where that is known
  std::vector<Row> rows;
};

/// One picture of a sequence: the same cells in every moment. A cell without points is one in which
/// nothing touches.
struct ContactMoment {
  int frame = 0;
  std::string caption;
  std::vector<ContactCell> cells;
  std::string title{};           // empty: that of all
  std::optional<double> time{};  // seconds, where it has one
};

/// Metres: separations of the points of a patch that differ by less are equal, for more is lost in the
/// float of their places.
double separation_noise(const std::vector<trace::Point>& points);

/// The points of least separation: all that tie within that noise. Empty where the patch is level.
std::vector<int> deepest_points(const std::vector<trace::Point>& points);

/// From explorations of one pair, frames in order: a cell a reducer, in `order`, with all measures.
std::vector<ContactMoment> explored(const std::vector<trace::Exploration>& sequence,
                                    const std::vector<std::string>& order);

/// From recorded frames: a cell for every pair whose reduction was recorded, named by its label, or
/// by its reducer where it has none.
std::vector<ContactMoment> reduced(const std::vector<trace::Frame>& frames,
                                   const Moments& telling = {});

/// Small multiples: the contact plane of each cell, at the same scale in all cells and frames. What
/// a cell shows in any frame stands in the middle of its map, wherever in the world that is and
/// however it lies, so that one patch seen in several cells has the same place in each. In a cell:
/// all points, the kept ones with their order of choice, the deepest in squares where the patch is
/// not level (more than one where they tie), the lost area hatched, the best polygon dashed, for extremes along axes the box that
/// they span, and the rows beneath; for a sequence also a strip of which ids are kept over time,
/// one row an id. On a canvas too small for all of it, all cells alike leave out the right of their
/// rows, then the rest of them but their brief form, the strip, all rows but the first, that as
/// well, the legend and the names. Where nothing touches in any frame, a line says so.
class ContactCells {
 public:
  /// `up`: "y" or "z". `choices` as in View: so many choices are shown, the last one with what made
  /// it; 0: all, and the result.
  ContactCells(const std::string& title, const std::string& source, const std::string& up,
               std::vector<ContactMoment> moments, int choices, int width, int height,
               const FigureStyle& style = {});

  /// The picture of the moment with this frame number.
  Drawing frame(int number) const;

  /// What the canvas had no room for, in words: "the legend". Empty where all is shown.
  std::vector<std::string> left_out() const;

 private:
  struct Grid {
    int columns = 1;
    double cell_width = 0, cell_height = 0;  // pixels
    double map_height = 0, strip = 0;
    double pixels_per_metre = 0;  // where there is no room
    double mark = 1;              // size of the marks of points, 1 where there is room
  };

  /// Where the contacts of one cell are in the world, in all frames.
  struct Patch {
    PlaneAxes axes;
    Vec2d center = Vec2d::Zero();  // along them
  };

  /// What beside the maps a canvas may have no room for, in the order in which it is given up.
  enum class Detail { RowEnds, WholeRows, Strip, AllRows, Rows, Legend, Names, None };
  bool shows(Detail detail) const { return detail >= given_up_; }

  // Pixels at 720 lines.
  static constexpr double kName = 15;       // size of a cell's heading
  static constexpr double kNumber = 14;     // size of the numbers beneath
  static constexpr double kNumberRow = 17;  // height of a row of numbers
  static constexpr double kStripCaption = 18, kStripAxis = 14;
  static constexpr double kGap = 14;  // between cells

  /// How much larger text and marks of the cells are than those of the rest of the picture.
  double signs() const;
  double px(double at_720) const { return signs() * layout_.px(at_720); }
  void fit(int width, int height);
  Grid best_grid() const;
  double nearest_points() const;
  double name_height() const { return shows(Detail::Names) ? kName + 4 : 0; }
  bool is_named_away() const;
  double strip_height() const;
  /// Of the line under the strip that says when; none where the moments have no time.
  double axis_height() const { return moments_.back().time ? kStripAxis : 0; }
  std::size_t row_count() const;
  std::span<const ContactCell::Row> shown_rows(const ContactCell& cell) const;
  std::string left_of(const ContactCell::Row& row) const;
  double row_width() const;
  std::size_t cell_count() const { return moments_.empty() ? 0 : moments_.front().cells.size(); }
  /// Of every moment.
  auto all_cells() const { return joined(moments_, &ContactMoment::cells); }
  std::vector<LegendEntry> legend() const;
  void frame_patches(const Vec3d& above);
  void gather_ids();
  void draw_cell(std::size_t cell, std::size_t moment, const Pen& pen) const;
  void draw_strip_axis(const Rect& strip, std::size_t moment, const Pen& pen) const;
  void draw_map(const ContactCell& cell, const ContactPlane& plane) const;

  std::string title_, source_;
  std::vector<ContactMoment> moments_;
  int choices_;
  FigureStyle style_;
  Layout layout_;
  std::vector<Patch> patches_;    // of each cell
  Vec2d extent_ = Vec2d::Zero();  // metres that the largest of them fill
  std::vector<IdHistory> ids_;    // of each cell, a row an id in order of appearance
  Detail given_up_ = Detail{};    // all before this one
  Grid grid_;
};

/// The first `shown` choices of a reducer, the last of them with its candidates. Gregorius 2015,
/// "Contact Point Reduction: 1st Point" to "4th Point (4)": what each was worth, and why the last
/// shown one won. `places`: of all points.
void draw_choice(const ContactPlane& plane, const std::vector<Point2>& places,
                 const ContactCell& cell, int shown);

}  // namespace contactscope::draw
