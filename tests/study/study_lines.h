#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "trace/study.h"

namespace contactscope::test {

/// The series of a method in a panel, by growing parameter.
inline const trace::StudySeries& line_of(const trace::Study& study, const std::string& panel,
                                         const std::string& method) {
  const auto line = std::ranges::find_if(study.series, [&](const trace::StudySeries& series) {
    return series.method == method && series.panel == panel;
  });
  if (line == study.series.end()) throw std::out_of_range(method + ", " + panel);
  return *line;
}

}  // namespace contactscope::test
