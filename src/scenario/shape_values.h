#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "scenario/toml_reader.h"

/// Values that several types of shapes share.
namespace contactscope::scenario_file {

/// What a shape is read in.
struct Surroundings {
  std::filesystem::path folder;        // that names of files are relative to
  std::vector<std::string>& warnings;  // what a reader should know though nothing is wrong
};

/// [[x, y, z], ..], metres.
std::vector<Vec3d> read_points(const toml_reader::Value& value);

/// The path of a Wavefront file that a `file` key names; it must be there.
std::filesystem::path existing_obj_file(const toml_reader::Value& value,
                                        const std::filesystem::path& folder);

}  // namespace contactscope::scenario_file
