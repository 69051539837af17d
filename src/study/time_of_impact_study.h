#pragma once

#include <vector>

#include "study/impact_cases.h"
#include "study/study.h"

namespace contactscope {

/// The study `time_of_impact` with these finders, timed in turn.
std::vector<trace::Study> study_impact_finders(const std::vector<ImpactFinderInfo>& finders,
                                               const StudyOptions& options,
                                               const StudyProgress& progress);

}  // namespace contactscope
