#pragma once

#include "study/picture_row.h"

/// Results of plots that are too long for their row in pictures.cpp.
namespace contactscope::record {

inline constexpr const char* kGuarded = "no threshold, each gap judged by its own rounding error";

using PictureResult = std::string(Picture& plot);
PictureResult result_of_thresholds, result_of_broad_phases, result_of_updates, result_of_refitting,
    result_of_coherence, result_near_plane, result_of_last_bits, result_of_impacts,
    result_of_bullets, result_of_fields, result_of_building, result_of_points, result_of_plate,
    result_of_jitter, result_of_ratios, result_of_energy, result_of_distance, result_of_overlaps;

}  // namespace contactscope::record
