#pragma once

#include <memory>
#include <string>

#include "trace/json_node.h"

namespace contactscope::trace {

/// Why and where a line is not JSON.
struct NoJson {
  int column = 0;  // from 1
  std::string why;
};

/// Parses a line of JSON into a tree; reuses its memory for the next line.
class JsonLine {
 public:
  /// The next call invalidates the tree; the line may grow by some bytes of padding. Throws NoJson,
  /// or Complaint for JSON that cannot be held: numbers beyond a double, or too deep nesting.
  Node parse(std::string& line);

 private:
  Node parse_again(const std::string& line);

  simdjson::dom::parser parser_;
};

}  // namespace contactscope::trace
