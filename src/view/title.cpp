#include "view/title.h"
#include "core/spell.h"

namespace contactscope {
namespace {

constexpr std::string_view kBetween = " | ";

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

std::string known_facts() { return separated(kTitleFactNames, ", "); }

/// Parses the text between braces. Returns an error message, or an empty string.
std::string read_placeholder(std::string_view text, TitlePiece& piece) {
  std::string_view words = text;
  if (const std::size_t colon = words.find(':'); colon != std::string_view::npos) {
    const std::string_view noun = words.substr(colon + 1);
    words = words.substr(0, colon);
    const std::size_t slash = noun.find('/');
    piece.one = trimmed(noun.substr(0, slash));
    piece.many =
        slash == std::string_view::npos ? piece.one + "s" : trimmed(noun.substr(slash + 1));
    if (piece.one.empty() || piece.many.empty())
      return "'{" + std::string(text) + "}' has no noun behind its colon; write {kept:point}";
  }
  constexpr std::string_view kFrom = "from ";
  if (words.starts_with(kFrom)) {
    const std::string number = trimmed(words.substr(kFrom.size()));
    const char* end = number.data() + number.size();
    const auto read = std::from_chars(number.data(), end, piece.from);
    if (read.ec != std::errc() || read.ptr != end || piece.from < 0)
      return "'{" + std::string(text) + "}' needs the number of a frame, as {from 12}";
    return {};
  }
  constexpr std::string_view kOf = " of ", kAnd = " and ";
  if (const std::size_t of = words.find(kOf); of != std::string_view::npos) {
    const std::string_view who = words.substr(of + kOf.size());
    words = words.substr(0, of);
    const std::size_t both = who.find(kAnd);
    piece.of = trimmed(who.substr(0, both));
    if (both != std::string_view::npos) piece.of_other = trimmed(who.substr(both + kAnd.size()));
  }
  const std::string name = trimmed(words);
  const auto found = std::ranges::find(kTitleFactNames, name);
  if (found == kTitleFactNames.end())
    return "unknown placeholder '{" + name + "}'; known: " + known_facts();
  piece.fact = static_cast<TitleFact>(found - kTitleFactNames.begin());
  return {};
}

std::string read_alternative(std::string_view text, TitleAlternative& pieces) {
  TitlePiece piece;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool doubled = i + 1 < text.size() && text[i + 1] == c;
    if ((c == '{' || c == '}') && doubled) {
      piece.text += c;
      ++i;
      continue;
    }
    if (c == '}') return "'}' without its '{'; write }} for a brace";
    if (c != '{') {
      piece.text += c;
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (end == std::string_view::npos) return "'{' without its '}'; write {{ for a brace";
    const std::string problem = read_placeholder(text.substr(i + 1, end - i - 1), piece);
    if (!problem.empty()) return problem;
    pieces.push_back(std::move(piece));
    piece = {};
    i = end;
  }
  pieces.push_back(std::move(piece));
  return {};
}

bool is_plain(const TitleAlternative& pieces) {
  return std::ranges::none_of(pieces,
                              [](const TitlePiece& piece) { return piece.fact || piece.from > 0; });
}

}  // namespace

ParsedTitle parse_title(std::string_view text) {
  ParsedTitle parsed;
  for (std::size_t begin = 0; parsed.problem.empty();) {
    const std::size_t end = text.find(kBetween, begin);
    const std::size_t length = end == std::string_view::npos ? end : end - begin;
    parsed.problem = read_alternative(text.substr(begin, length), parsed.title.emplace_back());
    if (end == std::string_view::npos) break;
    begin = end + kBetween.size();
  }
  return parsed;
}

std::string plain_title(std::string_view text) {
  const ParsedTitle parsed = parse_title(text);
  if (!parsed.problem.empty()) return std::string(text);
  const auto plain = std::ranges::find_if(parsed.title, is_plain);
  const TitleAlternative& shown = plain == parsed.title.end() ? parsed.title.front() : *plain;
  std::string words;
  for (const TitlePiece& piece : shown) {
    words += piece.text;
    if (piece.fact) words += "…" + (piece.many.empty() ? "" : " " + piece.many);
  }
  return words;
}

}  // namespace contactscope
