#include "core/key_table.h"

#include <regex>

namespace contactscope {

/// meanings.txt, embedded by the build: words here, each with other words for it.
std::string_view meanings();

namespace {

/// Calls `visit` with each part of the text.
template <class Visit>
void each_part(std::string_view text, std::string_view separator, const Visit& visit) {
  while (true) {
    const std::size_t end = text.find(separator);
    visit(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + separator.size());
  }
}

/// The number that begins the text, and what follows it; nullopt if there is none.
std::optional<std::pair<double, std::string_view>> number_in(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return std::pair(number, text);
}

/// Finds "LOW to HIGH", "LOW or more", "more than LOW" or "more than LOW, up to HIGH" in the type.
void read_range(Key& key) {
  constexpr std::string_view kMoreThan = "more than ";
  const std::size_t more = key.type.find(kMoreThan);
  key.excludes_low = more != std::string_view::npos;
  const std::size_t first = key.type.find_first_of("-0123456789");
  const auto low = number_in(key.type.substr(std::min(first, key.type.size())));
  if (!low) return;
  const std::string_view to = key.excludes_low ? ", up to " : " to ";
  const bool has_high = low->second.starts_with(to);
  const auto high = has_high ? number_in(low->second.substr(to.size())) : std::nullopt;
  if (!high && !key.excludes_low && !low->second.starts_with(" or more")) return;
  key.low = low->first;
  key.high = high ? high->first : std::numeric_limits<double>::infinity();
  const std::size_t unit = key.type.size() - (high ? high->second : low->second).size();
  const std::size_t begin = key.excludes_low ? more : first;
  key.range = key.type.substr(begin, key.type.find(',', unit) - begin);
}

/// A line "| `a`, `b` | type | default | text |".
Key parse_row(std::string_view line) {
  line.remove_prefix(2);
  line.remove_suffix(2);
  Key key;
  std::string_view* const cells[] = {&key.names, &key.type, &key.otherwise, &key.text};
  std::size_t cell = 0;
  each_part(line, " | ", [&](std::string_view part) {
    if (cell < std::size(cells)) *cells[cell++] = part;
  });
  bool is_inside = false;
  each_part(key.type, "\"", [&](std::string_view part) {
    if (is_inside) key.words.push_back(part);
    is_inside = !is_inside;
  });
  read_range(key);
  return key;
}

/// Breaks a line before `width` columns.
std::string wrapped(std::string_view text, std::string_view indent) {
  constexpr std::size_t kWidth = 98;
  std::string lines(indent);
  std::size_t column = indent.size();
  each_part(text, " ", [&](std::string_view word) {
    if (column > indent.size() && column + 1 + word.size() > kWidth) {
      lines.append("\n").append(indent);
      column = indent.size();
    }
    if (column > indent.size()) lines += ' ';
    lines += word;
    column += 1 + word.size();
  });
  return lines + "\n";
}

/// Number of edits from `a` to `b`: a letter changed, added or removed, or two neighbours swapped
/// (Damerau 1964, each letter edited at most once). Both words are short.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

/// In lower case, without underscores; options, such as -v and -V, as they are.
std::string folded(std::string_view word) {
  if (word.starts_with('-')) return std::string(word);
  std::string text;
  for (const char c : word)
    if (c != '_') text += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return text;
}

/// The word here that has this meaning, of those in `candidates`. `word` is folded.
std::string meant_by(const std::string& word, const std::vector<std::string_view>& candidates) {
  std::istringstream lines{std::string(meanings())};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string here;
    std::getline(words, here, ':');
    if (std::ranges::find(candidates, here) == candidates.end()) continue;
    for (std::string other; words >> other;)
      if (folded(other) == word) return here;
  }
  return {};
}

}  // namespace

std::string Key::example() const {
  const std::size_t as = otherwise.find("as `");
  std::string line = std::string(name) + " = ";
  line += as == std::string_view::npos ? ".." : plain(otherwise.substr(as + 3));
  return type.empty() ? line : line + " (" + plain(type) + ")";
}

const Key* KeyTable::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

std::string plain(std::string_view markdown) {
  static const std::regex mark("`|\\[([^\\]]*)\\]\\([^)]*\\)");  // or a link
  return std::regex_replace(std::string(markdown), mark, "$1");
}

std::vector<KeyTable> parse_key_tables(std::string_view markdown) {
  std::vector<KeyTable> tables;
  std::string_view heading;
  bool is_in_table = false;
  each_part(markdown, "\n", [&](std::string_view line) {
    if (line.starts_with('#')) heading = line.substr(line.find(' ') + 1);
    const bool is_header = line.starts_with("| key | type | default |");
    if (is_header) {
      tables.push_back({plain(heading), heading, {}});
      std::erase_if(tables.back().name, [](char c) { return c == '[' || c == ']'; });
    } else if (is_in_table && line.starts_with("| `")) {
      const Key row = parse_row(line);
      each_part(row.names, ", ", [&](std::string_view name) {
        tables.back().keys.push_back(row);
        tables.back().keys.back().name = name.substr(1, name.size() - 2);
      });
    }
    is_in_table = is_header || (is_in_table && line.starts_with('|'));
  });
  return tables;
}

std::string printed(const std::vector<KeyTable>& tables) {
  std::string text;
  for (const KeyTable& table : tables) {
    text += (text.empty() ? "" : "\n") + plain(table.heading) + "\n";
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const Key& key = table.keys[i];
      if (i > 0 && key.names == table.keys[i - 1].names) continue;  // printed with that one
      std::string line = plain(key.names) + ": " + plain(key.type);
      if (key.otherwise.starts_with("required") || key.otherwise == "needed")
        line += "; " + plain(key.otherwise);
      else
        line += "; default: " + plain(key.otherwise);
      text += wrapped(line, "  ") + wrapped(plain(key.text), "      ");
    }
  }
  return text;
}

std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  // Up to a third of the letters may be wrong: "half_extent" is near "half_extents", "foo" is near
  // nothing. Long words are not misspelled keys and would only cost time.
  constexpr std::size_t kLongest = 64;
  if (word.size() > kLongest) return {};
  const std::string plain = folded(word);
  for (const std::string_view candidate : candidates)
    if (folded(candidate) == plain) return std::string(candidate);
  if (const std::string here = meant_by(plain, candidates); !here.empty()) return here;
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const std::size_t allowed = std::max(word.size(), candidate.size()) / 3;
    if (distance > allowed || (!best.empty() && distance >= best_distance)) continue;
    best = candidate;
    best_distance = distance;
  }
  // A part of a word: "flicker" of "pairs_flicker".
  constexpr std::size_t kPart = 4;
  for (std::size_t i = 0; best.empty() && word.size() >= kPart && i < candidates.size(); ++i)
    if (candidates[i].find(word) != std::string_view::npos) best = candidates[i];
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.empty() ? "" : "did you mean '" + near + "'? ";
}

std::string near_or_all(std::string_view word, const std::vector<std::string_view>& names) {
  constexpr std::size_t kMaxListed = 20;
  const std::string near = did_you_mean(word, names);
  if (names.size() <= kMaxListed) return near + "known: " + quoted_list(names);
  return near.empty() ? "known: " + quoted_list({names.begin(), names.begin() + kMaxListed}, ", ") +
                            " and " + std::to_string(names.size() - kMaxListed) + " more"
                      : near.substr(0, near.size() - 1);
}

std::string quoted_list(const std::vector<std::string_view>& words, const char* last) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 == words.size() ? last : ", ";
    list.append(1, '\'').append(words[i]).append(1, '\'');
  }
  return list;
}

std::string not_among(const std::vector<std::string_view>& words, const std::string& text) {
  if (words.empty() || std::ranges::find(words, text) != words.end()) return {};
  return "is '" + text + "'; " + did_you_mean(text, words) + "it may be " +
         quoted_list(words, " or ");
}

}  // namespace contactscope
