#pragma once

#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

/// Where shapes stand and how they move: the keys position, rotation and motion.
namespace contactscope::scenario_file {

/// Lengths that a file may name, metres. Products of four lengths (a squared area) of this range
/// stay within what a float holds at full precision, so that no stage meets an infinity or a zero
/// that the geometry does not have.
inline constexpr double kSmallestLength = 1e-9;
inline constexpr double kLargestLength = 1e9;

/// A length greater than zero, in metres, from kSmallestLength to kLargestLength.
double read_length(const toml_reader::Value& value);
/// Three coordinates in metres, each at most kLargestLength from zero.
Vec3d read_position(const toml_reader::Value& value);
/// A table with one of axis and degrees or radians, quat_wxyz, quat_xyzw, matrix. The result is a
/// unit quaternion.
Quatd read_rotation(const toml_reader::Value& value);

/// The keys position and rotation of a table; what is left out is taken from `otherwise`.
Pose<double> read_pose(const toml_reader::Table& table, const Pose<double>& otherwise);

/// The key `key` of a motion, at most 1e9 `unit`; zero when it is missing.
Vec3d read_velocity(const toml_reader::Table& table, const char* key, const char* unit);

/// A [shapes.NAME.motion] table of a shape that is not dynamic. `start` is the shape's own pose; `end_time` the time of the last
/// frame in seconds, until which constant velocities must stay within kLargestLength.
Motion read_motion(const toml_reader::Value& value, const Pose<double>& start, double end_time);

}  // namespace contactscope::scenario_file
