#include <cmath>
#include <numbers>

#include "geometry/obj.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

/// A number from -1e9 to 1e9 `unit`.
double read_bounded(const Value& value, const char* unit) {
  const double number = value.number(unit);
  if (std::abs(number) > kLargestLength)
    value.fail("'" + value.name() + "' is too large; it may be up to 1e9 " + unit);
  return number;
}

TravellingWave read_wave(const Value& value) {
  const Value& table = value.table({"axis", "direction", "amplitude", "wavelength", "speed"});
  TravellingWave wave;
  wave.axis = read_direction(table.require("axis", "axis = [1, 0, 0], along which it travels"));
  wave.direction = read_direction(
      table.require("direction", "direction = [0, 1, 0], along which vertices move"));
  wave.amplitude = read_bounded(table.require("amplitude", "amplitude = 0.1 (metres)"), "metres");
  wave.wavelength = read_length(table.require("wavelength", "wavelength = 1.0 (metres)"));
  wave.speed =
      read_bounded(table.require("speed", "speed = 1.0 (metres per second)"), "metres per second");
  return wave;
}

Twist read_twist(const Value& value) {
  const Value& table = value.table({"axis", "degrees", "radians"});
  const auto degrees = table.find("degrees"), radians = table.find("radians");
  if (degrees && radians) radians->fail("give 'degrees' or 'radians', not both");
  Twist twist;
  twist.axis = read_direction(table.require("axis", "axis = [0, 1, 0]"));
  if (radians)
    twist.rate = read_bounded(*radians, "radians");
  else
    twist.rate =
        read_bounded(
            table.require("degrees", "degrees = 90.0 (per metre along the axis, per second)"),
            "degrees") /
        180 * std::numbers::pi;
  return twist;
}

/// The vertices of a file that must have the same triangles as `mesh`.
std::vector<Vec3d> read_vertices(const Value& file, const Mesh<double>& mesh,
                                 const std::filesystem::path& folder) {
  ObjMesh obj = load_obj(file, folder, load_obj_mesh);
  const auto differs = [&](const char* what, std::size_t of_file, std::size_t of_mesh) {
    if (of_file != of_mesh)
      file.fail(
          std::string("the number of ") + what + " is " + std::to_string(of_file) + " in '" +
          file.string() + "', and " + std::to_string(of_mesh) +
          " in the mesh that it deforms; give a file with the same triangles and moved vertices");
  };
  differs("vertices", obj.vertices.size(), mesh.vertices.size());
  differs("triangles", obj.triangles.size(), mesh.triangles.size());
  for (int i = 0; i < mesh.triangle_count(); ++i)
    if (at(obj.triangles, i) != at(mesh.triangles, i))
      file.fail(
          "triangle " + std::to_string(i) + " of '" + file.string() +
          "' has other vertices than in the mesh that it deforms; write the file with the same "
          "faces in the same order");
  check_reach(obj.vertices, file);
  return std::move(obj.vertices);
}

std::vector<VertexKeyframe> read_vertex_keyframes(const Value& value, const Mesh<double>& mesh,
                                                  const std::filesystem::path& folder) {
  std::vector<VertexKeyframe> keyframes;
  for (const Value& item : value.array_of_tables()) {
    const Value& table = item.table({"time", "file"});
    const Value time = table.require("time", "time = 0.5 (seconds)");
    const double seconds = time.number("seconds");
    if (!keyframes.empty() && seconds <= keyframes.back().time)
      time.fail("keyframes must be in order of time, each later than the one before");
    const Value file = table.require("file", "file = \"NAME.obj\"");
    keyframes.push_back({seconds, read_vertices(file, mesh, folder)});
  }
  if (keyframes.empty())
    value.fail("'keyframes' is empty; add { time = 0.0, file = \"NAME.obj\" } or leave it out");
  return keyframes;
}

}  // namespace

Deformation read_deformation(const Value& value, const ScenarioShape& shape,
                             const std::filesystem::path& folder) {
  const auto* const mesh = std::get_if<Mesh<double>>(shape.geometry.get());
  if (mesh == nullptr)
    value.fail("'" + shape.name + "' is a " + shape.type +
               ", and only a mesh deforms; give it type = \"mesh\", or leave out 'deform'");
  const Value& table = value.table({"wave", "twist", "keyframes"});
  const auto wave = table.find("wave"), twist = table.find("twist");
  const auto keyframes = table.find("keyframes");
  if (wave.has_value() + twist.has_value() + keyframes.has_value() != 1)
    table.fail("'deform' needs exactly one of 'wave', 'twist' and 'keyframes'");
  if (wave) return read_wave(*wave);
  if (twist) return read_twist(*twist);
  return read_vertex_keyframes(*keyframes, *mesh, folder);
}

}  // namespace contactscope::scenario_file
