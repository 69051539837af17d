#pragma once

#include "draw/charts/series_chart.h"
#include "draw/insets/contact_plane.h"
#include "trace/exploration.h"

namespace contactscope::draw {

/// A reduction, seen along the normal.
struct ContactCell {
  /// A line of text below the map.
  struct Row {
    std::string left;
    std::string right;  // quieter; left out if there is no room
    std::string brief;  // replaces both if there is no room for `left`
    bool strong = false;
  };

  std::string name;
  std::string pair{};  // "slab crate"; empty for explorations
  Vec3d normal = Vec3d::Zero();
  std::vector<trace::Point> points;    // all, before reduction
  std::vector<int> kept;               // in order of choice
  std::vector<int> best;               // corners of the best polygon; empty: not drawn
  std::vector<trace::Choice> choices;  // the steps of the choice, if known
  std::vector<Row> rows;
};

/// One picture of a sequence, always with the same cells. A cell without points has no contact.
struct ContactMoment {
  int frame = 0;
  std::string caption;
  std::vector<ContactCell> cells;
  std::string title{};           // empty: the common title
  std::optional<double> time{};  // seconds, if known
};

/// Points of least separation, with ties within the rounding of positions in float. Empty for a
/// level patch.
std::vector<int> deepest_points(const std::vector<trace::Point>& points);

/// From explorations of a pair, frames in order: a cell for each reducer, in `order`.
std::vector<ContactMoment> explored(const std::vector<trace::Exploration>& sequence,
                                    const std::vector<std::string>& order);

/// From recorded frames: a cell for each pair with a recorded reduction, named by label or reducer.
std::vector<ContactMoment> reduced(const std::vector<trace::Frame>& frames,
                                   const Moments& labelled = {});

/// Small multiples: the contact plane of each cell, with one scale for all cells and frames. The
/// contents of a cell are centred over all frames, regardless of their pose in the world, so that a
/// patch has the same place in several cells. A cell shows all points; the kept ones with their
/// order of choice; squares around the deepest if the patch is not level (several if tied);
/// hatching for the lost area; the best polygon dashed; for extremes along axes their bounding box;
/// and rows of text below. A sequence also has a strip of the ids kept over time, one row per id.
/// If the canvas is too small, all cells leave out the right of their rows, then use the brief
/// rows, then leave out the strip, all rows but the first, that row, the legend and the names.
/// Without any contact, a line reports it. With `rose`, a map has the moments that the points resist
/// by direction, and one row.
class ContactCells {
 public:
  /// `up`: "y" or "z". `choices` as in View: number of choices shown, the last one with its
  /// candidates; 0: all, and the result.
  ContactCells(const std::string& title, const std::string& source, const std::string& up,
               std::vector<ContactMoment> moments, int choices, int width, int height,
               const FigureStyle& style = {}, bool rose = false);

  /// The picture of the frame with this number.
  Drawing frame(int number) const;

  /// Details that did not fit on the canvas: "the legend". Empty if everything is shown.
  std::vector<std::string> left_out() const;

 private:
  struct Grid {
    int columns = 1;
    double cell_width = 0, cell_height = 0;  // pixels
    double map_height = 0, strip = 0;
    double pixels_per_metre = 0;  // 0 if there is no room
    double mark = 1;              // size of the points' marks, 1 if there is room
  };

  /// Position of one cell's contacts in the world, over all frames.
  struct Patch {
    PlaneAxes axes;
    Vec2d center = Vec2d::Zero();  // along the axes
  };

  /// Details other than the maps, in the order in which they are given up.
  enum class Detail { RowEnds, WholeRows, Strip, AllRows, Rows, Legend, Names, None };
  bool shows(Detail detail) const { return detail >= given_up_; }

  // Pixels at 720 lines.
  static constexpr double kName = 15;       // size of a cell's heading
  static constexpr double kNumber = 14;     // size of the numbers below
  static constexpr double kNumberRow = 17;  // height of a row of numbers
  static constexpr double kStripCaption = 18, kStripAxis = 14;
  static constexpr const char* kStripText = "points over time, orange: kept";
  static constexpr double kGap = 14;  // between cells

  /// Factor of the text and marks in cells compared with the rest of the picture.
  double signs() const;
  double px(double at_720) const { return signs() * layout_.px(at_720); }
  void fit(int width, int height);
  Grid best_grid() const;
  double nearest_points() const;
  double name_height() const { return shows(Detail::Names) ? kName + 4 : 0; }
  bool is_named_away() const;
  double strip_height() const;
  /// Height of the time labels below the strip; 0 if the moments have no time.
  double axis_height() const { return moments_.back().time ? kStripAxis : 0; }
  std::size_t row_count() const;
  std::span<const ContactCell::Row> shown_rows(const ContactCell& cell) const;
  std::string left_of(const ContactCell::Row& row) const;
  double row_width() const;
  std::size_t cell_count() const { return moments_.empty() ? 0 : moments_.front().cells.size(); }
  /// Cells of all moments.
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
  bool rose_;
  Layout layout_;
  std::vector<Patch> patches_;    // of each cell
  Vec2d extent_ = Vec2d::Zero();  // metres, of the largest patch
  std::vector<IdHistory> ids_;    // for each cell, one row per id in order of appearance
  Detail given_up_ = Detail{};    // all details before this one
  Grid grid_;
};

Vec2d mean_of(const std::vector<Vec2d>& points);

/// Longest arm of points from `center` along the unit direction `toward`: the moment that they
/// resist for each newton that presses a body on them through `center`. Negative: it tips anyway.
double longest_arm(const std::vector<Vec2d>& points, const Vec2d& center, const Vec2d& toward);

/// The direction in which the kept points resist the smallest share of the moment that all points
/// resist about their middle.
struct WeakestTilt {
  Vec2d arm = Vec2d::Zero();  // of all points, in that direction
  double share = 1;           // 1: nothing is lost in any direction
};
WeakestTilt weakest_tilt(const std::vector<Vec2d>& all, const std::vector<Vec2d>& kept);

/// Draws these moments as a polar diagram in the scale of the map, and the axis and share of the
/// weakest tilt. `mark`: size of the points' marks. `explains`: says what a radius is.
void draw_rose(const ContactPlane& plane, const ContactCell& cell, double mark, bool explains);

/// Draws the first `shown` choices of a reducer, the last one with its candidates. Gregorius 2015,
/// "Contact Point Reduction: 1st Point" to "4th Point (4)": the value of each candidate, and why
/// the last choice won; if the picture `is_alone`, also the barycentric coordinates of the fourth
/// point. `places`: of all points.
void draw_choice(const ContactPlane& plane, const std::vector<Point2>& places,
                 const ContactCell& cell, int shown, bool is_alone);

}  // namespace contactscope::draw
