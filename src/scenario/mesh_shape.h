#pragma once

#include "geometry/shape.h"
#include "scenario/shape_values.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// A shape of type "mesh": `vertices` with `triangles`, an .obj `file`, or a `grid`. What was left
/// out of it, triangles without an area, is warned of.
Shape<double> read_mesh(const toml_reader::Table& table, const Surroundings& surroundings);

}  // namespace contactscope::scenario_file
