#pragma once

#include <string>
#include <vector>

#include "lint/linter.h"
#include "lint/watch.h"

namespace contactscope::lint {

/// How often one thing is wrong, of how many that were looked at, and the first of them.
struct Tally {
  int count = 0, of = 0;
  Finding first;

  /// One more that is wrong; `said` and `is` are made of the first alone.
  template <class Words>
  void wrong(const Moments& frames, const std::string& a, const std::string& b,
             const Words& words) {
    if (count++ > 0) return;
    const auto [said, is] = words();
    first = {"", "", "", 0, 0, frames.now->line, frames.now->frame, a, b, said, is};
  }

  /// Tells it where it is that often: `least` times, and that share.
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
