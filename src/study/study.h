#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trace/study.h"

namespace contactscope {

struct StudyOptions {
  std::uint64_t seed = 1;          // the same seed gives the same cases and so the same errors
  std::optional<int> cases;        // a point, >= 1; each study has a default of its own
  std::optional<int> repetitions;  // of the passes that are timed, >= 1; likewise
  std::optional<int> frames;  // of what is simulated by the study of the solver, >= 1; likewise
};

/// Told of each step; may throw to stop the study.
using StudyProgress = std::function<void(int done, int total, const std::string& what)>;

/// One result for each measure of error, the main one first.
using RunStudy = std::vector<trace::Study>(const StudyOptions& options,
                                           const StudyProgress& progress);

// Each is in the file of its name, with what it measures.
RunStudy study_reducers, study_hull_precision, study_penetration, study_limits,
    study_manifold_stability, study_solver;

struct StudyInfo {
  std::string name;
  std::string summary;  // one line
  RunStudy* run;
};

/// Every study, in the order in which to list them.
const std::vector<StudyInfo>& studies();

/// Processor, compiler and build of this program, and the time now.
trace::StudyContext study_context(const std::string& scalar);

}  // namespace contactscope
