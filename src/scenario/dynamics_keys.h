#pragma once

#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

/// What the solver goes by: dynamic shapes, [world] and [solver].
namespace contactscope::scenario_file {

/// Whether a [shapes.NAME.motion] table says dynamic = true.
bool is_dynamic(const toml_reader::Value& motion);

/// Such a table. `shape` has its name, type and geometry already.
ScenarioBody read_body(const toml_reader::Value& motion, const ScenarioShape& shape);

/// `up` is that of the file: what gravity points away from by default.
WorldSettings default_world(const std::string& up);
WorldSettings read_world(const toml_reader::Value& value, const std::string& up);

/// Nothing: the default. Settled by the smallest dynamic one of `shapes`.
SolverSettings read_solver(const std::optional<toml_reader::Value>& value,
                           const std::vector<ScenarioShape>& shapes);

/// A coefficient of Coulomb's friction, 0 to 1000.
double read_friction(const toml_reader::Value& value);

/// The share of a velocity that a bounce gives back, 0 to 1.
double read_restitution(const toml_reader::Value& value);

}  // namespace contactscope::scenario_file
