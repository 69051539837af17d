#include <cstddef>

#include "image/font.h"

namespace contactscope {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

/// Bytes that a sequence starting with `lead` has; 0 when no sequence starts so.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;  // 0xC0 and 0xC1 only start overlong forms
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

bool is_scalar_value(char32_t code, std::size_t length) {
  const char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= smallest[length] && code <= 0x10FFFF && !surrogate;
}

}  // namespace

std::vector<char32_t> code_points(std::string_view utf8) {
  std::vector<char32_t> out;
  out.reserve(utf8.size());
  for (std::size_t i = 0; i < utf8.size();) {
    const unsigned char lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = sequence_length(lead);
    bool valid = length != 0 && i + length <= utf8.size();
    char32_t code = length <= 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; valid && k < length; ++k) {
      const unsigned char next = static_cast<unsigned char>(utf8[i + k]);
      valid = (next & 0xC0) == 0x80;
      code = code << 6 | (next & 0x3Fu);
    }
    valid = valid && is_scalar_value(code, length);
    out.push_back(valid ? code : kReplacement);
    i += valid ? length : 1;
  }
  return out;
}

}  // namespace contactscope
