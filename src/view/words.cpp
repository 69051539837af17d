#include "view/words.h"

namespace contactscope {

/// words.txt, embedded by the build.
std::string_view listed_words();

const std::vector<std::string_view>& known_words() {
  static const std::vector<std::string_view> words = [] {
    std::vector<std::string_view> lines;
    for (std::string_view rest = listed_words(); !rest.empty();) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      if (!line.empty() && line.front() != '#') lines.push_back(line);
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    }
    return lines;
  }();
  return words;
}

std::string_view place_in(std::string_view key) {
  const std::size_t begin = key.find('{'), end = key.find('}', begin);
  return end == key.npos ? std::string_view() : key.substr(begin, end + 1 - begin);
}

void Words::replace(std::string_view key, const std::string& by) {
  texts_.insert_or_assign(std::string(key), by);
}

void Words::rename(std::string_view name, const std::string& by) {
  // Pictures show "old crate" for old_crate.
  for (const std::string& shown : {std::string(name), name_in_words(name)}) {
    replace(shown, by);
    replace("A: " + shown, by.empty() ? by : "A: " + by);
    replace("B: " + shown, by.empty() ? by : "B: " + by);
    replace(shown + ": {answer}", by.empty() ? by : by + ": {answer}");
  }
}

void Words::replace(const Words& others) {
  for (const auto& [key, by] : others.texts_) replace(key, by);
}

std::string Words::of(std::string_view text) const {
  if (const auto whole = texts_.find(text); whole != texts_.end()) return whole->second;
  for (const auto& [key, by] : texts_) {
    const std::string_view place = place_in(key);
    if (place.empty()) continue;
    const std::string_view before(key.data(), place.data());
    const std::string_view after = std::string_view(key).substr(before.size() + place.size());
    if (text.size() <= before.size() + after.size() || !text.starts_with(before) ||
        !text.ends_with(after))
      continue;
    std::string result = by;
    const std::string_view filled =
        text.substr(before.size(), text.size() - before.size() - after.size());
    if (!by.empty()) result.replace(by.find(place), place.size(), filled);
    return result;
  }
  return std::string(text);
}

std::string_view kind_of_name(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789_- ");
  return last == std::string_view::npos ? name : name.substr(0, last + 1);
}

std::string name_in_words(std::string_view name) {
  std::string words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool parts = name[i] == '_' || name[i] == ' ';
    // "crate1" becomes "crate 1". "box3d", whose number is inside, and the parts "car/5" stay.
    const bool counts =
        name[i] >= '0' && name[i] <= '9' && i > 0 &&
        std::string_view("0123456789-./:#").find(name[i - 1]) == std::string_view::npos &&
        name.find_first_not_of("0123456789", i) == std::string_view::npos;
    if ((parts || counts) && !words.empty() && words.back() != ' ') words += ' ';
    if (!parts) words += name[i];
  }
  return words;
}

}  // namespace contactscope
