#include "core/words.h"

#include <algorithm>
#include <array>
#include <map>

namespace contactscope {
namespace {

// Maximum nesting of parts; no text of the program is nested deeper.
constexpr int kDeepest = 6;

/// Separators, in the order in which they are tried.
constexpr std::array<std::string_view, 6> kBetweenParts = {"; ", ", ", ": ", " = ", " × ", "  "};

/// Splits a pattern into literal text and place names by turns; the first and last are literal.
std::vector<std::string> pieces_of(std::string_view pattern) {
  std::vector<std::string> pieces(1);
  while (!pattern.empty()) {
    const std::size_t open = pattern.find('{');
    const std::size_t close = open == std::string_view::npos ? open : pattern.find('}', open);
    if (close == std::string_view::npos) break;
    pieces.back() += pattern.substr(0, open);
    pieces.emplace_back(pattern.substr(open + 1, close - open - 1));
    pieces.emplace_back();
    pattern.remove_prefix(close + 1);
  }
  pieces.back() += pattern;
  return pieces;
}

bool is_number_place(std::string_view name) {
  return name == "n" || name == "m" || name == "k";
}

/// "12", "−0.25 mm", "3 × 4", "1.5e−6 N s/m": begins with a digit or a sign and has no word of more
/// than two letters.
bool is_number(std::string_view text) {
  for (const std::string_view sign : {"−", "-", "+", "< ", "±"}) {
    if (text.starts_with(sign)) text.remove_prefix(sign.size());
  }
  if (text.empty() || text[0] < '0' || text[0] > '9') return false;
  std::size_t letters = 0, longest = 0;
  for (const char c : text) {
    letters = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? letters + 1 : 0;
    longest = std::max(longest, letters);
  }
  return longest <= 2 && text.find(',') == std::string_view::npos;
}

using Places = std::map<std::string, std::string_view, std::less<>>;

/// Matches `text` against the pieces from `piece` on and fills `places`. Of several matches it
/// takes the one whose earlier places are shortest.
bool match(const std::vector<std::string>& pieces, std::size_t piece, std::string_view text,
           Places& places) {
  if (!text.starts_with(pieces[piece])) return false;
  text.remove_prefix(pieces[piece].size());
  if (piece + 1 == pieces.size()) return text.empty();
  const std::string& name = pieces[piece + 1];
  const std::string& next = pieces[piece + 2];
  const bool is_last = piece + 3 == pieces.size();
  // The "{from 12}" of a title matches empty text.
  for (std::size_t end = name.starts_with("from ") ? 0 : 1; end <= text.size(); ++end) {
    if (is_last && next.empty()) end = text.size();
    if (!text.substr(end).starts_with(next)) continue;
    const std::string_view found = text.substr(0, end);
    if (is_number_place(name) && !is_number(found)) continue;
    if (!match(pieces, piece + 2, text.substr(end), places)) continue;
    places[name] = found;
    return true;
  }
  return false;
}

}  // namespace

void Words::replace(std::string_view what, std::string_view by) {
  const auto known = std::ranges::find(entries_, what, &Entry::what);
  if (known != entries_.end())
    known->by = by;
  else
    entries_.push_back({std::string(what), std::string(by), pieces_of(what)});
}

void Words::replace(const Words& others) {
  for (const Entry& entry : others.entries_) replace(entry.what, entry.by);
}

std::string Words::mistake(std::string_view what, std::string_view by) {
  if (by.empty()) return {};  // an empty translation hides the text
  const std::vector<std::string> wanted = pieces_of(what), given = pieces_of(by);
  const auto has = [](const std::vector<std::string>& pieces, const std::string& name) {
    for (std::size_t i = 1; i < pieces.size(); i += 2) {
      if (pieces[i] == name) return true;
    }
    return false;
  };
  for (std::size_t i = 1; i < given.size(); i += 2) {
    if (!has(wanted, given[i]))
      return "{" + given[i] + "} does not stand in '" + std::string(what) + "'";
  }
  for (std::size_t i = 1; i < wanted.size(); i += 2) {
    if (!has(given, wanted[i])) return "{" + wanted[i] + "} is missing";
  }
  return {};
}

std::optional<std::string> Words::whole(std::string_view text, int depth) const {
  for (const Entry& entry : entries_) {
    if (entry.pieces.size() == 1 && entry.what == text) return entry.by;
  }
  for (const Entry& entry : entries_) {
    if (entry.pieces.size() == 1) continue;
    Places places;
    if (!match(entry.pieces, 0, text, places)) continue;
    std::string result;
    const std::vector<std::string> pieces = pieces_of(entry.by);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto place = i % 2 == 1 ? places.find(pieces[i]) : places.end();
      result += place == places.end() ? pieces[i] : translated(place->second, depth + 1);
    }
    return result;
  }
  return std::nullopt;
}

std::string Words::translated(std::string_view text, int depth) const {
  if (depth > kDeepest || text.empty()) return std::string(text);
  if (const std::optional<std::string> found = whole(text, depth)) return *found;
  for (const std::string_view between : kBetweenParts) {
    const std::size_t at = text.find(between);
    if (at == std::string_view::npos) continue;
    const std::string_view before = text.substr(0, at), after = text.substr(at + between.size());
    const std::string first = translated(before, depth + 1), rest = translated(after, depth + 1);
    // A text with a hidden part is hidden as a whole.
    if ((first.empty() && !before.empty()) || (rest.empty() && !after.empty())) return {};
    return first + std::string(between) + rest;
  }
  const std::size_t open = text.find(" (");
  if (open != std::string_view::npos && text.ends_with(')')) {
    const std::string_view inside = text.substr(open + 2, text.size() - open - 3);
    return translated(text.substr(0, open), depth + 1) + " (" + translated(inside, depth + 1) + ")";
  }
  return std::string(text);
}

std::string Words::of(std::string_view text) const {
  return entries_.empty() ? std::string(text) : translated(text, 0);
}

}  // namespace contactscope
