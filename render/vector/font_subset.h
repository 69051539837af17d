#pragma once

#include <compare>
#include <mutex>

#include "draw/scene/drawing.h"

namespace contactscope::vector {

/// A library that a format needs is missing. what() names its package.
class MissingLibrary : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A font by weight and number (image/font.h): 0 is embedded, others are from --font.
struct FontKey {
  FontWeight weight = FontWeight::Regular;
  std::size_t number = 0;

  FontKey(FontWeight of, std::size_t which = 0) : weight(of), number(which) {}
  friend auto operator<=>(const FontKey&, const FontKey&) = default;
};

/// Characters of texts by font.
using UsedCharacters = std::map<FontKey, std::set<char32_t>>;

/// Adds the characters of a drawing's texts.
void add_characters(const draw::Drawing& drawing, UsedCharacters& used);

/// A TrueType file with only the glyphs of these characters, without kerning and ligatures: digits
/// stay tabular, as in pixels. Equal sets give equal bytes. The first call opens
/// libharfbuzz-subset; throws MissingLibrary if there is none.
std::string font_subset(const FontKey& font, const std::set<char32_t>& characters);

/// Opens libharfbuzz-subset ahead of font_subset(); throws MissingLibrary.
void require_font_subsets();

/// CSS with subsets of fonts for families(): @font-face rules with data URLs. Rules are cached,
/// because the pictures of a sequence share most characters. Thread-safe.
class FontFaces {
 public:
  std::string css(const UsedCharacters& used);

 private:
  std::mutex mutex_;
  std::map<std::pair<FontKey, std::set<char32_t>>, std::string> rules_;
};

/// CSS font-family list: the embedded font, added fonts, then similar system fonts.
std::string families(const UsedCharacters& used);

/// A shared library opened when a format first needs it, because its dependencies (fonts, X11)
/// would slow down every start of the program. It is never closed.
class SharedLibrary {
 public:
  /// `name` is for the loader, "libcairo.so.2"; `package` provides it. Throws MissingLibrary.
  SharedLibrary(const std::string& name, const std::string& package, const std::string& purpose);

  /// Looks up a function, also in the library's dependencies.
  template <class Function> void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string name_, package_;
  void* handle_ = nullptr;
};

/// Members of a struct for the functions that a list of rows names, and its constructor, which finds
/// them in its member `library`.
#define CONTACTSCOPE_MEMBER(name) decltype(&::name) name = nullptr;
#define CONTACTSCOPE_FIND(name) library.find(#name, name);
#define CONTACTSCOPE_FUNCTIONS(Struct, ROWS) \
  ROWS(CONTACTSCOPE_MEMBER)                  \
  Struct() { ROWS(CONTACTSCOPE_FIND) }

}  // namespace contactscope::vector
