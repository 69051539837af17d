#include <numbers>

#include "geometry/obj.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

TravellingWave read_wave(const Value& value) {
  const Value table = value.table({"wave"});
  TravellingWave wave;
  wave.axis = read_direction(table.require("axis"));
  wave.direction = read_direction(table.require("direction"));
  wave.amplitude = table.require("amplitude").number();
  wave.wavelength = table.require("wavelength").number();
  wave.speed = table.require("speed").number();
  return wave;
}

Twist read_twist(const Value& value) {
  const Value table = value.table({"twist"});
  table.not_both("degrees", "radians");
  Twist twist;
  twist.axis = read_direction(table.require("axis"));
  if (const auto radians = table.find("radians"))
    twist.rate = radians->number();
  else
    twist.rate = table.require("degrees").number() / 180 * std::numbers::pi;
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
    const Value table = item.table({"keyframe of deform"});
    const Value time = table.require("time");
    const double seconds = time.number();
    if (!keyframes.empty() && seconds <= keyframes.back().time)
      time.fail("keyframes must be in order of time, each later than the one before");
    const Value file = table.require("file");
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
  const Value table = value.table({"deform"});
  const auto wave = table.find("wave"), twist = table.find("twist");
  const auto keyframes = table.find("keyframes");
  if (wave.has_value() + twist.has_value() + keyframes.has_value() != 1)
    table.fail("'deform' needs exactly one of 'wave', 'twist' and 'keyframes'");
  if (wave) return read_wave(*wave);
  if (twist) return read_twist(*twist);
  return read_vertex_keyframes(*keyframes, *mesh, folder);
}

}  // namespace contactscope::scenario_file
