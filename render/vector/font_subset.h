#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "draw/scene/drawing.h"
#include "image/font.h"

namespace contactscope::vector {

/// A library that a format needs is not installed. what() says which package has it.
class MissingLibrary : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A font by its weight and number (image/font.h): 0 is the embedded one, others came with --font.
struct FontKey {
  FontWeight weight = FontWeight::Regular;
  std::size_t number = 0;

  FontKey(FontWeight of, std::size_t which = 0) : weight(of), number(which) {}
  friend auto operator<=>(const FontKey&, const FontKey&) = default;
};

/// The characters that texts use, of each font.
using UsedCharacters = std::map<FontKey, std::set<char32_t>>;

/// Adds those of a drawing's texts.
void add_characters(const draw::Drawing& drawing, UsedCharacters& used);

/// A font with the glyphs of these characters alone, as a TrueType file without kerning and
/// ligatures: digits stay tabular, as in pixels. Equal sets give equal bytes. Uses libharfbuzz-subset,
/// which is opened at the first call; throws MissingLibrary where there is none.
std::string font_subset(const FontKey& font, const std::set<char32_t>& characters);

/// Opens libharfbuzz-subset, which font_subset() would do at its first call; throws MissingLibrary.
void require_font_subsets();

/// CSS that embeds subsets of fonts: @font-face rules with data URLs, for the families of families(). A
/// sequence's pictures use the same letters again and again: rules are kept. Several threads may ask at
/// once.
class FontFaces {
 public:
  std::string css(const UsedCharacters& used);

 private:
  std::mutex mutex_;
  std::map<std::pair<FontKey, std::set<char32_t>>, std::string> rules_;
};

/// What texts ask for, as CSS lists it: the embedded font, those that stand in for it, else what looks
/// most like it.
std::string families(const UsedCharacters& used);

}  // namespace contactscope::vector
