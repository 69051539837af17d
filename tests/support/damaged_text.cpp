#include "support/damaged_text.h"

#include <vector>

namespace contactscope::test {

std::string damaged(std::string text, const std::string& other, Random& random) {
  const auto place = [&] { return static_cast<std::size_t>(random.index(int(text.size()) + 1)); };
  const auto length = [&] { return static_cast<std::size_t>(1 + random.index(12)); };
  const std::vector<std::string> pieces = {"1e999", "-1", "nan",  "[",    "]]",
                                           "{",     "\"", "\0",   "\xff", "\n[",
                                           "=",     "..", "\\u0", ",",    "99999999999"};
  for (int count = 1 + random.index(3); count > 0; --count) {
    const std::size_t at = place();
    switch (random.index(6)) {
      case 0:
        text.erase(at, length());
        break;
      case 1:
        text.insert(at, pieces[static_cast<std::size_t>(random.index(int(pieces.size())))]);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.index(256));
        break;
      case 3:
        text.resize(at);
        break;
      case 4: {
        const std::size_t from = place();
        text.insert(at, text.substr(from, length() * 4));
        break;
      }
      default:
        text.insert(at, other.substr(static_cast<std::size_t>(random.index(int(other.size()))),
                                     length() * 4));
    }
  }
  return text;
}

}  // namespace contactscope::test
