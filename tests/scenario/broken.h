#pragma once

#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/input_error.h"
#include "scenario/scenario.h"

/// Tables of files with one error each, and the required contents of its message.
namespace contactscope {

struct Broken {
  const char* name;      // of the test
  std::string text;      // of the file
  const char* location;  // "LINE:COLUMN"
  const char* remedy;    // part of the message
};

inline std::ostream& operator<<(std::ostream& out, const Broken& broken) {
  return out << broken.text.substr(0, 2000);
}

inline std::string name_of_test(const ::testing::TestParamInfo<Broken>& test) {
  return test.param.name;
}

/// Two boxes, lines 1 to 7; `rest` begins on line 8, inside [shapes.floor].
inline std::string two_boxes(const std::string& rest = "") {
  return R"(title = "Two boxes"
[shapes.crate]
type = "box"
half_extents = [0.5, 0.5, 0.5]
[shapes.floor]
type = "box"
half_extents = [2, 0.5, 2]
)" + rest;
}

/// A file of one shape; its keys begin on line 3.
inline std::string one_shape(const std::string& keys) {
  return "title = \"One shape\"\n[shapes.rock]\n" + keys;
}

/// what() of the InputError that parsing throws.
inline std::string complaint(const std::string& text, const std::string& path = "group/idea.toml") {
  try {
    parse_scenario(text, path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace contactscope
