#pragma once

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

/// The characters that texts use, of each weight.
using UsedCharacters = std::map<FontWeight, std::set<char32_t>>;

/// Adds those of a drawing's texts.
void add_characters(const draw::Drawing& drawing, UsedCharacters& used);

/// The embedded font with the glyphs of these characters alone, as a TrueType file without kerning and
/// ligatures: digits stay tabular, as in pixels. Equal sets give equal bytes. Uses libharfbuzz-subset,
/// which is opened at the first call; throws MissingLibrary where there is none.
std::string font_subset(FontWeight weight, const std::set<char32_t>& characters);

/// Opens libharfbuzz-subset, which font_subset() would do at its first call; throws MissingLibrary.
void require_font_subsets();

/// CSS that embeds the font's subsets: @font-face rules with data URLs, for the family kFontFamily. A
/// sequence's pictures use the same letters again and again: rules are kept. Several threads may ask at
/// once.
class FontFaces {
 public:
  std::string css(const UsedCharacters& used);

 private:
  std::mutex mutex_;
  std::map<std::pair<FontWeight, std::set<char32_t>>, std::string> rules_;
};

/// What texts ask for: the embedded font, else what looks most like it.
inline constexpr const char* kFontFamily = "Roboto";
inline constexpr const char* kFontFamilies =
    "Roboto, 'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif";

}  // namespace contactscope::vector
