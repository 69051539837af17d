#pragma once

#include <stdexcept>
#include <string>

namespace contactscope {

/// What a user wrote is wrong. what() is "FILE:LINE:COLUMN: what is wrong, and what would be
/// right"; line and column count from 1 and are left out when 0. The program exits with 2 on it.
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

/// A hull or a mesh cannot be made from what was given: what() says why, and what would be right.
/// Geometry knows no file; whoever reads one catches this and adds the place.
struct ShapeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contactscope
