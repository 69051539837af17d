#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace contactscope::page
