#include "view/shape_name.h"

namespace contactscope {

std::string_view kind_of_name(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789_- ");
  return last == std::string_view::npos ? name : name.substr(0, last + 1);
}

std::string name_in_words(std::string_view name) {
  std::string words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto is_digit = [&](std::size_t at) { return name[at] >= '0' && name[at] <= '9'; };
    const bool parts = name[i] == '_' || name[i] == ' ';
    // "crate1" becomes "crate 1", but "box3d" stays: its number is inside the name.
    const bool counts = is_digit(i) && i > 0 && !is_digit(i - 1) &&
                        name.find_first_not_of("0123456789", i) == std::string_view::npos;
    if ((parts || counts) && !words.empty() && words.back() != ' ') words += ' ';
    if (!parts) words += name[i];
  }
  return words;
}

}  // namespace contactscope
