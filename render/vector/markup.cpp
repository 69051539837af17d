#include "vector/markup.h"

#include <algorithm>
#include <cmath>

#include "core/spell.h"

namespace contactscope::vector {

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
  add_hundredths(std::llround(value * 100), out);
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
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t length = utf8_length(text, i);
    const std::string_view one = text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
    if (length != 1) {
      const bool is_known = length > 0 && one != "\xEF\xBF\xBE" && one != "\xEF\xBF\xBF";
      out += is_known ? one : kReplacement;
      continue;
    }
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

std::string in_script(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 8);
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string_view line_end = json.substr(i, 3);
    if (json[i] == '<')
      out += "\\u003c";
    else if (json[i] == '>')
      out += "\\u003e";
    else if (json[i] == '&')
      out += "\\u0026";
    else if (line_end == "\xE2\x80\xA8" || line_end == "\xE2\x80\xA9") {
      out += line_end.back() == '\xA8' ? "\\u2028" : "\\u2029";
      i += 2;
    } else
      out += json[i];
  }
  return out;
}

}  // namespace contactscope::vector
