#include "scenario/shape_values.h"

#include <system_error>

namespace contactscope::scenario_file {

namespace fs = std::filesystem;
using toml_reader::Value;

std::vector<Vec3d> read_points(const Value& value) {
  std::vector<Vec3d> points;
  for (const Value& item : value.array()) points.push_back(item.vector3());
  return points;
}

fs::path existing_obj_file(const Value& value, const fs::path& folder) {
  const std::string name = value.non_empty_string();
  if (name.find('\0') != std::string::npos) value.fail("'file' contains a NUL character");
  if (fs::path(name).extension() != ".obj")
    value.fail("'file' is '" + name + "', which is no .obj file; give a Wavefront .obj");
  const fs::path path = folder / name;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    value.fail("there is no file '" + path.string() +
               "'; names are relative to the scenario's folder");
  if (status.type() != fs::file_type::regular)
    value.fail("'" + path.string() + "' is no plain file; give a Wavefront .obj");
  return path;
}

}  // namespace contactscope::scenario_file
