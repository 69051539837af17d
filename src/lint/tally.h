#pragma once

#include <string>
#include <vector>

#include "lint/linter.h"
#include "lint/watch.h"

namespace contactscope::lint {

/// Counts occurrences of one problem among all cases, and keeps the first.
struct Tally {
  int count = 0, of = 0;
  Finding first;

  /// Adds an occurrence; `said` and `is` are only built for the first.
  template <class Words>
  void wrong(const Moments& frames, const std::string& a, const std::string& b,
             const Words& words) {
    if (count++ > 0) return;
    const auto [said, is] = words();
    first = {"", "", "", 0, 0, frames.now->line, frames.now->frame, a, b, said, is};
  }

  /// Reports the problem if it occurs at least `least` times and in that share of the cases.
  void report(const char* cause, const char* what, const char* remedy, int least, double share,
              std::vector<Finding>& findings) const {
    if (count < least || count < share * of) return;
    Finding finding = first;
    finding.cause = cause;
    finding.what = what;
    finding.remedy = remedy;
    finding.count = count;
    finding.of = of;
    findings.push_back(finding);
  }
};

}  // namespace contactscope::lint
