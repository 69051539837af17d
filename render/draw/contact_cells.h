#pragma once

#include <string>
#include <vector>

#include "draw/drawing.h"
#include "draw/layout.h"
#include "trace/exploration.h"

namespace contactscope::draw {

/// Small multiples: one cell a reducer, each with the contact plane seen along the normal, at the
/// same scale and place in all cells and all frames. In a cell: all points, the kept ones with
/// their order of choice, the lost area hatched, the best polygon dashed, and the numbers beneath;
/// for a sequence also a strip of which ids are kept over time, one row an id.
class ReducerCells {
 public:
  /// `sequence`: one pair's explorations, frames in order, not empty; outlives this. `order`: the
  /// names of the reducers, as cells follow each other. `up`: "y" or "z".
  ReducerCells(const std::string& title, const std::string& source, const std::string& up,
               const std::vector<trace::Exploration>& sequence, std::vector<std::string> order,
               int width, int height);

  /// The picture of sequence[index].
  Drawing frame(std::size_t index) const;

 private:
  struct Grid {
    int columns = 1;
    double cell_width = 0, cell_height = 0;  // pixels
    double map_height = 0;
    double pixels_per_metre = 1;
  };

  Grid best_grid() const;
  double furniture() const;
  double strip_height() const;
  std::vector<LegendEntry> legend() const;
  Rect cell_rect(std::size_t cell) const;
  Point2 at(const Rect& map, const Vec3d& position) const;
  void draw_cell(const Rect& cell, const trace::Exploration& exploration,
                 const trace::ReducerAnswer& answer, std::size_t index, Drawing& drawing) const;
  void draw_map(const Rect& map, const trace::Exploration& exploration,
                const trace::ReducerAnswer& answer, Drawing& drawing) const;
  void draw_numbers(const Rect& cell, const trace::ReducerAnswer& answer, Drawing& drawing) const;
  void draw_strip(const Rect& strip, const std::string& reducer, std::size_t index,
                  Drawing& drawing) const;

  std::string title_, source_;
  const std::vector<trace::Exploration>& sequence_;
  std::vector<std::string> order_;
  Layout layout_;
  Vec3d u_ = Vec3d::UnitX(), v_ = Vec3d::UnitY();  // of the contact plane: right and up on the page
  Vec3d center_ = Vec3d::Zero();
  double extent_u_ = 1, extent_v_ = 1;  // metres that the sequence fills
  std::vector<std::string> ids_;        // in order of appearance
  Grid grid_;
};

}  // namespace contactscope::draw
