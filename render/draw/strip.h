#pragma once

#include "draw/staging.h"

/// Composite pictures: frames of a sequence side by side, or thumbnails of many scenarios.
namespace contactscope::draw {

/// Cells of one size in rows, each with a caption above.
struct CellGrid {
  int columns = 1;
  int width = 0, height = 0;    // of a cell without caption, whole pixels
  double x = 0, y = 0;          // of the first caption
  double caption = 0;           // its height
  double across = 0, down = 0;  // offset from one cell to the next

  /// Rectangle of cell `i`, on whole pixels.
  Rect cell(int i) const;
};

/// Default number of columns for this number of cells: up to four, with rows of similar length.
int usual_columns(int cells);

/// One picture of several frames with one camera, one title above, and one legend below for all of
/// them. Above each cell are its moment and the step of a story. Each cell is drawn at its own
/// size, so that its text is as large as the page's.
class Strip {
 public:
  /// `shown`: frames of the cells, in order; `frames`: frames of the sequence, to which the camera
  /// is fitted, or to `fitted` as in stage(). `height` 0: height for cells in the ratio 4:3. The view's panels are in each cell.
  /// Header and frames outlive the strip. The view must show a scene.
  Strip(const trace::Header& header, const std::vector<trace::Frame>& frames,
        const std::vector<trace::Frame>& shown, const View& view, int width, int height,
        int columns, const FigureStyle& style, const FittedFrames* fitted = nullptr);

  /// Staging of the cells.
  const Staging& cell() const { return *cell_; }
  int width() const { return page_.width; }
  int height() const { return page_.height; }

  /// The page without its cells, before finish().
  Drawing page() const;
  /// Adds a finished cell to a finished page.
  void place(int i, const Drawing& cell, Drawing& page) const;

 private:
  void lay_out(const std::vector<trace::Frame>& frames, const View& view, int width, int height,
               int columns, const FittedFrames* fitted);
  /// Heading of a cell, broken into lines.
  std::vector<std::string> heading_lines(int i) const;

  const trace::Header* header_;
  const std::vector<trace::Frame>* shown_;
  FigureStyle style_;
  std::string title_{};
  std::vector<LegendEntry> legend_{};
  std::vector<std::string> headings_{};  // step headings of stories
  Layout page_{};
  CellGrid grid_{};
  std::optional<Staging> cell_{};
};

/// Style of a cell on a page of this style with text at `scale`: no captions, text as on the page.
FigureStyle cell_style(FigureStyle page, float scale);

/// A page of thumbnails, each with a name and a title.
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

  /// The page without its thumbnails, before finish().
  Drawing page(const std::vector<Entry>& entries) const;
  void place(int i, const Drawing& thumbnail, Drawing& page) const;

 private:
  std::string title_;
  FigureStyle style_;
  Layout page_{};
  CellGrid grid_{};
};

}  // namespace contactscope::draw
