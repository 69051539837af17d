#include "app/moved_layers.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "draw/staging.h"
#include "vector/svg.h"

namespace contactscope::app {
namespace {

using Parts = std::vector<std::pair<std::string, std::string>>;  // what each shows, by layer

/// An SVG of a drawing by its groups; runs of one layer count together.
Parts parts_of(const std::string& svg) {
  constexpr std::string_view kBegin = "<g id=\"";
  Parts parts;
  for (std::size_t at = svg.find(kBegin); at != std::string::npos;) {
    const std::size_t next = svg.find(kBegin, at + 1);
    const std::size_t begin = at + kBegin.size();
    std::string name = svg.substr(begin, svg.find('"', begin) - begin);
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back())) != 0)
      name.pop_back();
    if (name.ends_with('-')) name.pop_back();
    auto part = std::ranges::find(parts, name, &Parts::value_type::first);
    if (part == parts.end()) part = parts.insert(parts.end(), {name, {}});
    part->second += svg.substr(at, next == std::string::npos ? next : next - at);
    at = next;
  }
  return parts;
}

}  // namespace

std::vector<std::string> moved_layers(const draw::Staging& staging, const trace::Frame& expected,
                                      const trace::Frame& actual) {
  vector::SvgOptions options;
  options.embed_font = false;
  const Parts before = parts_of(vector::svg_of(draw::illustrate(staging, expected), options));
  const Parts now = parts_of(vector::svg_of(draw::illustrate(staging, actual), options));
  std::vector<std::string> moved;
  for (const auto& [name, text] : now) {
    const auto other = std::ranges::find(before, name, &Parts::value_type::first);
    if (other == before.end() || other->second != text) moved.push_back(name);
  }
  for (const auto& [name, text] : before)
    if (std::ranges::find(now, name, &Parts::value_type::first) == now.end()) moved.push_back(name);
  return moved;
}

}  // namespace contactscope::app
