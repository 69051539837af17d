#pragma once

#include <set>
#include <string>
#include <vector>

#include "draw/staging.h"
#include "image/picture_origin.h"
#include "page/groups.h"
#include "vector/font_subset.h"

/// One file of HTML with all frames of a sequence, which opens from disk and asks for nothing else:
/// pictures as SVG, a slider, keys, switches of the layers, and the trace's facts of what is pointed
/// at.
namespace contactscope::page {

class Page {
 public:
  /// `origin`: version, scenario, title and command are told in the page; what it is of a frame is
  /// not. Staging outlives the page.
  Page(const draw::Staging& staging, const PictureOrigin& origin);

  /// The next frame, drawn with its panels.
  void add(const trace::Frame& frame, const draw::Drawing& drawing);

  /// All of it. At least one frame was added. Throws vector::MissingLibrary where the font cannot be
  /// embedded.
  std::string html() const;

 private:
  /// Parts of the pictures, pixels.
  struct Areas {
    draw::Rect view, panels;
  };

  Areas areas() const;
  std::vector<int> legend_of(const draw::Drawing& drawing, draw::Drawing& view);

  const draw::Staging& staging_;
  PictureOrigin origin_;
  GroupStore groups_;
  vector::UsedCharacters used_;
  std::vector<std::string> frames_;                          // as JSON
  std::vector<std::pair<std::string, std::string>> legend_;  // signs and texts
  std::set<std::string> layers_;
  std::vector<int> first_view_, first_panels_;
  std::string first_moment_, title_;
  draw::Color ground_{1, 1, 1, 1};
};

}  // namespace contactscope::page
