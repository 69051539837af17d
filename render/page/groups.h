#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace contactscope::page {

/// A group of a picture in SVG: what one part of the drawing shows.
struct SvgGroup {
  std::string layer, pair, role;  // as in draw::Part, escaped as in SVG
  std::string markup;             // what is inside

  friend auto operator<=>(const SvgGroup&, const SvgGroup&) = default;
};

/// The groups of a picture that svg_of() wrote, those without content left out.
std::vector<SvgGroup> groups_in(std::string_view svg);

/// The groups of many pictures, each distinct one once. One that a picture has several times is told
/// apart by how often it was there before: a picture hangs each number in one place.
class GroupStore {
 public:
  /// Their numbers, in the same order.
  std::vector<int> add(const std::vector<SvgGroup>& groups);
  /// `<g id="g7" ...>...</g>`, one a line.
  std::string text(int number) const;
  int size() const { return static_cast<int>(in_order_.size()); }

 private:
  std::map<std::pair<SvgGroup, int>, int> numbers_;
  std::vector<const SvgGroup*> in_order_;
};

}  // namespace contactscope::page
