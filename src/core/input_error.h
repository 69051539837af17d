#pragma once

#include "core/standard.h"

namespace contactscope {

/// Wrong user input. what() is "FILE:LINE:COLUMN: what is wrong, and what would be right"; line and
/// column count from 1 and are left out when 0. The program exits with status 2.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, int line, int column, const std::string& message)
      : std::runtime_error(located(file, line, column) + message) {}

 private:
  static std::string located(const std::string& file, int line, int column) {
    if (line <= 0) return file + ": ";
    return file + ":" + std::to_string(line) + ":" + std::to_string(column) + ": ";
  }
};

/// A hull or mesh cannot be made from this input. what() gives the reason and the remedy. Geometry
/// does not know file names; the code that reads a file catches this and adds the location.
struct ShapeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws InputError if `path` is a pipe, device or socket: opening or reading one may block
/// forever. Folders and missing paths are left to the caller. `wanted`: "give a scenario (.toml)".
void require_regular_file(const std::string& path, const std::string& wanted);

/// Name of a well-known mesh, robot or scene format, detected from the first bytes: "STL", "URDF
/// (XML)". Empty for other or too short files. `size` is that of the whole file, in bytes.
std::string foreign_format(std::string_view begin, std::uintmax_t size);

/// Error message for such a file: its format and what to use instead. Empty for all other files.
std::string foreign_format_remedy(std::string_view begin, std::uintmax_t size);

}  // namespace contactscope
