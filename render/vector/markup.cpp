#include "vector/markup.h"

#include <algorithm>
#include <cmath>

namespace contactscope::vector {

void add_number(double value, std::string& out) {
  add_hundredths(std::llround(value * 100), out);
}

void add_hundredths(std::int64_t hundredths, std::string& out) {
  const std::int64_t size = hundredths < 0 ? -hundredths : hundredths;
  if (hundredths < 0) out += '-';
  const std::int64_t whole = size / 100, rest = size % 100;
  if (whole > 0 || rest == 0) out += std::to_string(whole);
  if (rest == 0) return;
  out += '.';
  out += static_cast<char>('0' + rest / 10);
  if (rest % 10 != 0) out += static_cast<char>('0' + rest % 10);
}

std::string number(double value) {
  std::string out;
  add_number(value, out);
  return out;
}

std::string hex(const draw::Color& color) {
  std::string out = "#";
  bool brief = true;
  for (const float channel : {color.r, color.g, color.b}) {
    const int byte = static_cast<int>(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f);
    out += "0123456789abcdef"[byte / 16];
    out += "0123456789abcdef"[byte % 16];
    brief = brief && byte / 16 == byte % 16;
  }
  return brief ? std::string{'#', out[1], out[3], out[5]} : out;
}

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

}  // namespace contactscope::vector
