#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/input_error.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

namespace fs = std::filesystem;

/// Largest scenario file. A hull of 100000 vertices written with 17 digits each takes 6 MB.
constexpr std::size_t kMaxScenarioBytes = std::size_t{16} << 20;

/// Most names that one dotted key may join. The deepest key of the format joins three,
/// [shapes.crate.motion]; a table nested a hundred thousand deep would exhaust the stack.
constexpr int kMaxDottedNames = 16;

[[noreturn]] void fail_at(const std::string& path, std::string_view text, std::size_t offset,
                          const std::string& message) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw InputError(path, static_cast<int>(line), static_cast<int>(offset - line_start + 1),
                   message);
}

/// Length of the UTF-8 sequence that begins at `offset`, 0 when it is malformed. The table is
/// Unicode 15, section 3.9, table 3-7, "Well-Formed UTF-8 Byte Sequences".
std::size_t utf8_length(std::string_view text, std::size_t offset) {
  const auto byte = [&](std::size_t i) {
    return offset + i < text.size() ? static_cast<unsigned char>(text[offset + i]) : 0u;
  };
  const auto within = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned lead = byte(0);
  if (lead <= 0x7F) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return within(1, 0x80, 0xBF) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool second = within(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF);
    return second && within(2, 0x80, 0xBF) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool second = within(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
    return second && within(2, 0x80, 0xBF) && within(3, 0x80, 0xBF) ? 4 : 0;
  }
  return 0;
}

/// Offset just behind the string that opens at `start`, where a quote stands; the end of the text
/// when it does not close (the parser will say so).
std::size_t skip_string(std::string_view text, std::size_t start) {
  const char quote = text[start];
  const bool escapes = quote == '"';
  const bool multi_line = text.substr(start, 3) == std::string(3, quote);
  const std::size_t width = multi_line ? 3 : 1;
  for (std::size_t i = start + width; i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, width) == std::string_view(text).substr(start, width)) {
      return i + width;
    } else if (!multi_line && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

/// Follows strings and comments as TOML's grammar has them, and counts the names that dots join.
void check_dotted_keys(const std::string& text, const std::string& path) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '"' || c == '\'') {
      i = skip_string(text, i);
    } else {
      if (c == '.') {
        if (++dots >= kMaxDottedNames)
          fail_at(path, text, i,
                  "this key joins more than " + std::to_string(kMaxDottedNames) +
                      " names; a scenario nests no deeper than [shapes.NAME.motion]");
      } else if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' &&
                 c != ' ' && c != '\t') {
        dots = 0;
      }
      ++i;
    }
  }
}

}  // namespace

std::string read_scenario_text(const std::string& path) {
  const auto refuse = [&](const std::string& message) { throw InputError(path, 0, 0, message); };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    refuse("there is no such file; give the path of a scenario (.toml)");
  if (error)
    refuse("cannot be looked at (" + error.message() +
           "); give the path of a scenario (.toml) that can be read");
  if (status.type() == fs::file_type::directory)
    refuse("this is a folder; give the path of a scenario (.toml) in it");
  if (status.type() != fs::file_type::regular)
    refuse("this is no plain file; give the path of a scenario (.toml)");

  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kMaxScenarioBytes)
    refuse("the file has " + std::to_string(size) + " bytes; a scenario may have " +
           std::to_string(kMaxScenarioBytes) + ", and large meshes belong into an .obj file");
  std::ifstream in(path, std::ios::binary);
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !in || in.gcount() != static_cast<std::streamsize>(text.size()))
    refuse("the file cannot be read; check its permissions");
  return text;
}

void check_scenario_text(const std::string& text, const std::string& path) {
  if (text.size() > kMaxScenarioBytes)
    throw InputError(path, 0, 0,
                     "the text has " + std::to_string(text.size()) +
                         " bytes; a scenario may have " + std::to_string(kMaxScenarioBytes));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(path, 1, 1,
                     "the file is empty; a scenario needs a title and at least one [shapes.NAME]");
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\0')
      fail_at(path, text, i, "there is a NUL byte here; a scenario is a text file in UTF-8");
    const std::size_t length = utf8_length(text, i);
    if (length == 0)
      fail_at(path, text, i, "this byte is not UTF-8; save the file in that encoding");
    i += length;
  }
  check_dotted_keys(text, path);
}

}  // namespace contactscope::scenario_file
