#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/staging.h"

/// Several pictures as one: frames of a sequence side by side, or thumbnails of many scenarios.
namespace contactscope::draw {

/// Cells of one size in rows, each with room for a caption above it.
struct CellGrid {
  int columns = 1;
  int width = 0, height = 0;    // of a cell without its caption, whole pixels
  double x = 0, y = 0;          // of the first caption
  double caption = 0;           // its height
  double across = 0, down = 0;  // from one cell to the next

  /// Where cell `i` is, on whole pixels.
  Rect cell(int i) const;
};

/// How many columns so many cells stand in where nobody says: up to four in a row, rows of about the
/// same length.
int usual_columns(int cells);

/// One picture of several frames: one camera, one title above, one legend below of what is seen in any
/// of them; above each cell its moment, and what a story says of its step. Each cell is drawn for its own
/// size, so that its type is as large as the page's.
class Strip {
 public:
  /// `shown`: the frames of the cells, in order; `frames`: those of the sequence, to which the camera
  /// is fitted. `height` 0: as high as cells of four to three need. The view's panels stand in each
  /// cell. Header and frames outlive the strip. Of a view of a scene.
  Strip(const trace::Header& header, const std::vector<trace::Frame>& frames,
        const std::vector<trace::Frame>& shown, const View& view, int width, int height,
        int columns, const FigureStyle& style);

  /// What each cell is drawn with.
  const Staging& cell() const { return *cell_; }
  int width() const { return page_.width; }
  int height() const { return page_.height; }

  /// All but the cells, unfinished.
  Drawing page() const;
  /// Puts a finished cell into a finished page.
  void place(int i, const Drawing& cell, Drawing& page) const;

 private:
  void lay_out(const std::vector<trace::Frame>& frames, const View& view, int width, int height,
               int columns);
  /// The heading of a cell, in as many lines as it takes.
  std::vector<std::string> heading_lines(int i) const;

  const trace::Header* header_;
  const std::vector<trace::Frame>* shown_;
  FigureStyle style_;
  std::string title_{};
  std::vector<LegendEntry> legend_{};
  std::vector<std::string> headings_{};  // what stories say of their steps
  Layout page_{};
  CellGrid grid_{};
  std::optional<Staging> cell_{};
};

/// The style of a cell in a page of this style whose text is at `scale`: no captions of its own, and type
/// as large as the page's.
FigureStyle cell_style(FigureStyle page, float scale);

/// A page of thumbnails: each with a name and a title.
class ContactSheet {
 public:
  struct Entry {
    std::string name, title;
  };

  ContactSheet(std::string title, int cells, int width, int columns, const FigureStyle& style);

  int cell_width() const { return grid_.width; }
  int cell_height() const { return grid_.height; }
  FigureStyle thumbnail_style() const { return cell_style(style_, page_.scale); }
  int width() const { return page_.width; }
  int height() const { return page_.height; }

  /// All but the thumbnails, unfinished.
  Drawing page(const std::vector<Entry>& entries) const;
  void place(int i, const Drawing& thumbnail, Drawing& page) const;

 private:
  std::string title_;
  FigureStyle style_;
  Layout page_{};
  CellGrid grid_{};
};

}  // namespace contactscope::draw
