#pragma once

#include <string>

#include "app/cli/sequence.h"
#include "scenario/scenario.h"
#include "snapshot/report_folder.h"
#include "snapshot/store.h"

namespace contactscope::app {

/// Pages in 3D of changed scenarios for the report of a check: of all frames of the run, and of the
/// stored ones. Only for the first scenarios, because each page contains three.js.
class Viewers {
 public:
  /// `candidate`: path of the run's trace in the report; empty if it has been accepted. Does nothing
  /// then, and without three.js.
  void add(const Scenario& scenario, const snapshot::StoredScenario& archive,
           const Sequence& sequence, const std::string& candidate, snapshot::ReportFolder& report);

 private:
  int scenarios_ = 0;
};

}  // namespace contactscope::app
