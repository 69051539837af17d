#pragma once

#include <memory>
#include <string>

#include "trace/json_node.h"

namespace contactscope::trace {

/// What keeps a line from being JSON, and where.
struct NoJson {
  int column = 0;  // from 1
  std::string why;
};

/// Makes a line of JSON a tree. Its memory is used again for the next line.
class JsonLine {
 public:
  /// The tree is gone with the next call; the line may grow by some bytes of room behind its end. Throws NoJson,
  /// and Complaint where it is JSON that cannot be held: a number beyond a double, or lists in lists without end.
  Node parse(std::string& line);

 private:
  Node parse_again(const std::string& line);

  simdjson::dom::parser parser_;
};

}  // namespace contactscope::trace
