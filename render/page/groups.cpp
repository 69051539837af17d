#include "page/groups.h"

#include "core/at.h"

namespace contactscope::page {
namespace {

/// Value of an attribute of a tag; empty if missing.
std::string_view attribute_of(std::string_view tag, std::string_view name) {
  const std::string opening = " " + std::string(name) + "=\"";
  const std::size_t begin = tag.find(opening);
  if (begin == std::string_view::npos) return {};
  const std::string_view value = tag.substr(begin + opening.size());
  return value.substr(0, value.find('"'));
}

}  // namespace

std::vector<SvgGroup> groups_in(std::string_view svg) {
  constexpr std::string_view kOpening = "\n<g ", kClosing = "</g>", kClass = "layer ";
  std::vector<SvgGroup> groups;
  for (std::size_t begin = svg.find(kOpening); begin != std::string_view::npos;
       begin = svg.find(kOpening, begin)) {
    const std::size_t inside = svg.find('>', begin) + 1;
    const std::size_t end = svg.find(kClosing, inside);
    const std::string_view tag = svg.substr(begin, inside - begin);
    std::string_view markup = svg.substr(inside, end - inside);
    while (!markup.empty() && markup.front() == '\n') markup.remove_prefix(1);
    begin = end;
    if (markup.empty()) continue;
    std::string_view layer = attribute_of(tag, "class");
    if (layer.starts_with(kClass)) layer.remove_prefix(kClass.size());
    groups.push_back({std::string(layer), std::string(attribute_of(tag, "data-pair")),
                      std::string(attribute_of(tag, "data-role")), std::string(markup)});
  }
  return groups;
}

std::vector<int> GroupStore::add(const std::vector<SvgGroup>& groups) {
  std::map<const SvgGroup*, int> before;  // number of uses in this picture
  std::vector<int> numbers;
  for (const SvgGroup& group : groups) {
    const auto first = numbers_.find({group, 0});
    const int times = first == numbers_.end() ? 0 : before[&first->first.first]++;
    const auto [found, is_new] = numbers_.try_emplace({group, times}, size());
    if (is_new) in_order_.push_back(&found->first.first);
    if (first == numbers_.end()) before[&found->first.first] = 1;
    numbers.push_back(found->second);
  }
  return numbers;
}

std::string GroupStore::text(int number) const {
  const SvgGroup& group = *at(in_order_, number);
  std::string text = "<g id=\"g" + std::to_string(number) + "\" data-layer=\"" + group.layer + '"';
  if (!group.pair.empty()) text += " data-pair=\"" + group.pair + '"';
  if (!group.role.empty()) text += " data-role=\"" + group.role + '"';
  return text + ">\n" + group.markup + "</g>\n";
}

}  // namespace contactscope::page
