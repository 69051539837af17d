#pragma once

#include <vector>

#include "scenario/default_view.h"
#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// [[views]], at least one.
std::vector<View> read_views(const toml_reader::Value& value);

/// First, middle and last frame, in the default size.
SnapshotSettings default_snapshots(int frames);

/// [snapshots] of a scenario with `frames` frames.
SnapshotSettings read_snapshots(const toml_reader::Value& value, int frames);

}  // namespace contactscope::scenario_file
