#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/cli/options.h"

namespace contactscope::app {

/// A claim of one of the source documents, or a step of the course.
struct SourceRow {
  std::string id, place, claim;
  std::vector<std::string> shown;  // scenes with or without ":FRAME", "study NAME", or files
};

/// Rows of "sources", of one document ("gregorius", ...), or of "course", in their order.
std::vector<SourceRow> source_rows(const std::string& what);

/// Writes the rows with the stored pictures of their scenes and studies as a page, OUT/WHAT.html,
/// without network: the path that a student walks. Returns the path. A scene without a picture of
/// the frame shows its nearest one.
std::string write_source_page(const std::string& what, const Options& options);

}  // namespace contactscope::app
