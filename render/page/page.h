#pragma once

#include "draw/staging.h"
#include "image/png.h"
#include "vector/font_subset.h"

/// A self-contained HTML file with all frames of a sequence: SVG pictures, a slider, keyboard
/// control, layer switches, and facts of the trace about the object under the pointer.
namespace contactscope::page {

/// A group of a picture in SVG: one part of the drawing.
struct SvgGroup {
  std::string layer, pair, role;  // as in draw::Part, escaped as in SVG
  std::string markup;             // its content

  friend auto operator<=>(const SvgGroup&, const SvgGroup&) = default;
};

/// Non-empty groups of a picture written by svg_of().
std::vector<SvgGroup> groups_in(std::string_view svg);

/// Distinct groups of many pictures. Repeated groups in one picture get different numbers, because
/// the page inserts each number at one place.
class GroupStore {
 public:
  /// Returns the groups' numbers, in order.
  std::vector<int> add(const std::vector<SvgGroup>& groups);
  /// `<g id="g7" ...>...</g>`, one per line.
  std::string text(int number) const;
  int size() const { return static_cast<int>(in_order_.size()); }

 private:
  std::map<std::pair<SvgGroup, int>, int> numbers_;
  std::vector<const SvgGroup*> in_order_;
};

class Page {
 public:
  /// The page shows version, scenario, title and command of `origin`, but not its frame. Staging
  /// must outlive the page.
  Page(const draw::Staging& staging, const PictureOrigin& origin);

  /// Adds the next frame, drawn with its panels.
  void add(const trace::Frame& frame, const draw::Drawing& drawing);

  /// The whole page; at least one frame was added. Throws vector::MissingLibrary if the font cannot
  /// be embedded.
  std::string html() const;

  /// Approximate length of html() with the frames so far.
  std::size_t size() const { return size_; }

 private:
  /// Regions of the pictures, pixels.
  struct Areas {
    draw::Rect view, panels;
  };

  Areas areas() const;
  std::vector<int> legend_of(const draw::Drawing& drawing, draw::Drawing& view);

  const draw::Staging& staging_;
  PictureOrigin origin_;
  GroupStore groups_;
  std::size_t size_ = 0;
  vector::UsedCharacters used_;
  std::vector<std::string> frames_;                          // as JSON
  std::vector<std::pair<std::string, std::string>> legend_;  // symbols and texts
  std::set<std::string> layers_;
  std::vector<int> first_view_, first_panels_;
  std::string first_moment_, title_;
  draw::Color ground_{1, 1, 1, 1};
};

}  // namespace contactscope::page
