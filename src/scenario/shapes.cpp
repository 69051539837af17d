#include "scenario/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <system_error>

#include "core/input_error.h"
#include "geometry/hull_builder.h"
#include "geometry/obj.h"
#include "geometry/primitives.h"
#include "scenario/placement.h"

namespace contactscope::scenario_file {
namespace {

namespace fs = std::filesystem;
using toml_reader::Keys;
using toml_reader::Table;
using toml_reader::Value;

/// Keys of every shape, whatever its type.
const Keys kCommonKeys = {"type", "position", "rotation", "motion"};

// Half of what one face may have: a clip polygon of two such caps fits with room to spare.
constexpr int kMaxSegments = 64;

/// Runs `build`; a hull that cannot be made is an error of the value that describes it.
Hull<double> build_at(const Value& at, const std::function<Hull<double>()>& build) {
  try {
    return build();
  } catch (const HullError& error) {
    at.fail("'" + at.name() + "' makes no hull: " + error.what());
  }
}

/// Points of a list or file: a hull that can be computed with, within the lengths of a scenario.
Hull<double> hull_of_points(const std::vector<Vec3d>& points, const Value& at) {
  if (points.size() > kMaxHullPoints)
    at.fail("'" + at.name() + "' has " + std::to_string(points.size()) +
            " points; a hull may be built from up to " + std::to_string(kMaxHullPoints));
  for (const Vec3d& point : points)
    if (!(point.cwiseAbs().maxCoeff() <= kLargestLength))
      at.fail("'" + at.name() + "' has a point farther than 1e9 metres from the origin; scale it");
  Hull<double> hull = build_at(at, [&] { return build_hull(points); });
  if (hull.radius < kSmallestLength)
    at.fail("'" + at.name() + "' is smaller than 1e-9 metres; scale it up");
  return hull;
}

std::vector<Vec3d> read_points(const Value& value) {
  std::vector<Vec3d> points;
  for (const Value& item : value.array()) points.push_back(item.vector3());
  return points;
}

/// The path of a file that a `file` key names; it must be there.
fs::path existing_file(const Value& value, const fs::path& folder) {
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

Shape<double> read_hull(const Table& table, const fs::path& folder) {
  const auto vertices = table.find("vertices");
  const auto file = table.find("file");
  if (vertices && file) file->fail("give 'vertices' or 'file', not both");
  if (!vertices && !file)
    table.fail("the hull '" + table.value().name() +
               "' has no points; add vertices = [[x, y, z], ..] or file = \"NAME.obj\"");
  if (vertices) return hull_of_points(read_points(*vertices), *vertices);
  const fs::path path = existing_file(*file, folder);
  std::vector<Vec3d> points;
  try {
    points = load_obj_vertices(path.string());
  } catch (const InputError& error) {
    file->fail(std::string("'file' cannot be used: ") + error.what());
  }
  return hull_of_points(points, *file);
}

Shape<double> read_box(const Table& table, const fs::path&) {
  const Value value = table.require("half_extents", "half_extents = [0.5, 0.5, 0.5] (metres)");
  value.numbers(3);
  Vec3d half_extents;
  const std::vector<Value> items = value.array();
  for (int i = 0; i < 3; ++i) half_extents[i] = read_length(items[static_cast<std::size_t>(i)]);
  return build_at(value, [&] { return make_box(half_extents); });
}

/// Keys of the round shapes.
struct Round {
  double radius, half_height;
  int segments;
};

Round read_round(const Table& table) {
  return {read_length(table.require("radius", "radius = 0.5 (metres)")),
          read_length(table.require("half_height", "half_height = 0.5 (metres)")),
          table.require("segments", "segments = 16 (sides of the tessellation)")
              .integer(3, kMaxSegments)};
}

Shape<double> read_cylinder(const Table& table, const fs::path&) {
  const Round round = read_round(table);
  return build_at(table.value(),
                  [&] { return make_cylinder(round.radius, round.half_height, round.segments); });
}

Shape<double> read_cone(const Table& table, const fs::path&) {
  const Round round = read_round(table);
  return build_at(table.value(),
                  [&] { return make_cone(round.radius, round.half_height, round.segments); });
}

Shape<double> read_sphere(const Table& table, const fs::path&) {
  return Sphere<double>{read_length(table.require("radius", "radius = 0.5 (metres)"))};
}

Shape<double> read_capsule(const Table& table, const fs::path&) {
  Capsule<double> capsule;
  capsule.radius = read_length(table.require("radius", "radius = 0.5 (metres)"));
  const auto points = table.find("points");
  const auto half_height = table.find("half_height");
  if (points && half_height) half_height->fail("give 'points' or 'half_height', not both");
  if (!points && !half_height)
    table.fail("the capsule '" + table.value().name() +
               "' has no length; add points = [[..], [..]] or half_height = 0.5");
  if (half_height) {
    const double length = read_length(*half_height);
    capsule.points = {Vec3d(0, -length, 0), Vec3d(0, length, 0)};
    return capsule;
  }
  const std::vector<Value> centres = points->array();
  if (centres.size() != 2)
    points->fail("'points' of a capsule are its two centres, [[x, y, z], [x, y, z]]");
  capsule.points = {read_position(centres[0]), read_position(centres[1])};
  return capsule;
}

Shape<double> read_plane(const Table& table, const fs::path&) {
  const Value normal = table.require("normal", "normal = [0, 1, 0]");
  const Vec3d direction = normal.vector3();
  const double largest = direction.cwiseAbs().maxCoeff();
  if (largest == 0) normal.fail("'normal' is zero; give a direction, such as [0, 1, 0]");
  const Value offset = table.require("offset", "offset = 0.0 (metres)");
  const double distance = offset.number("metres");
  if (std::abs(distance) > kLargestLength)
    offset.fail("'offset' is too far away; it may be up to 1e9 metres");
  // Scaled before it is normalised: squares of tiny or huge components would under- or overflow.
  return HalfSpace<double>{{Vec3d(direction / largest).normalized(), distance}};
}

// Shapes that cannot collide yet. Their keys are checked all the same, so that a file that is
// refused today for its type alone will be right tomorrow.

void check_grid(const Value& value) {
  const Table grid = value.table({"size", "cells", "amplitude"});
  const Value size = grid.require("size", "size = 10.0 (metres, or one for each direction)");
  const Value cells = grid.require("cells", "cells = 16 (or one for each direction)");
  constexpr int kMaxCells = 4096;
  if (size.is_array()) size.numbers(2);
  for (const Value& item : size.is_array() ? size.array() : std::vector<Value>{size})
    read_length(item);
  if (cells.is_array()) cells.numbers(2);
  for (const Value& item : cells.is_array() ? cells.array() : std::vector<Value>{cells})
    item.integer(1, kMaxCells);
  if (const auto amplitude = grid.find("amplitude")) amplitude->not_negative("metres");
}

void check_mesh(const Table& table, const fs::path& folder) {
  const auto vertices = table.find("vertices");
  const auto triangles = table.find("triangles");
  const auto file = table.find("file");
  const auto grid = table.find("grid");
  const bool listed = vertices || triangles;
  if ((listed ? 1 : 0) + (file ? 1 : 0) + (grid ? 1 : 0) != 1)
    table.fail("a mesh needs one of 'vertices' with 'triangles', 'file', or 'grid'");
  if (listed) {
    const auto points = read_points(table.require("vertices", "vertices = [[x, y, z], ..]"));
    for (const Value& triangle : table.require("triangles", "triangles = [[0, 1, 2]]").array()) {
      triangle.numbers(3);
      for (const Value& index : triangle.array())
        index.integer(0, static_cast<int>(points.size()) - 1);
    }
  }
  if (file) existing_file(*file, folder);
  if (grid) check_grid(*grid);
}

/// A type of shape: its own keys, and either what reads it or what checks it.
struct Type {
  std::string name;
  Keys keys;
  Shape<double> (*read)(const Table&, const fs::path&);
  void (*check)(const Table&, const fs::path&);
};

const std::vector<Type>& types() {
  static const std::vector<Type> all = {
      {"box", {"half_extents"}, read_box, nullptr},
      {"hull", {"vertices", "file"}, read_hull, nullptr},
      {"cylinder", {"radius", "half_height", "segments"}, read_cylinder, nullptr},
      {"cone", {"radius", "half_height", "segments"}, read_cone, nullptr},
      {"sphere", {"radius"}, read_sphere, nullptr},
      {"capsule", {"radius", "points", "half_height"}, read_capsule, nullptr},
      {"mesh", {"vertices", "triangles", "file", "grid"}, nullptr, check_mesh},
      {"plane", {"normal", "offset"}, read_plane, nullptr},
  };
  return all;
}

/// Keys of all types, each once.
Keys every_key() {
  Keys keys = kCommonKeys;
  for (const Type& type : types())
    for (const std::string_view key : type.keys)
      if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
  return keys;
}

const Type& type_named(const Value& value) {
  std::vector<std::string> names;
  for (const Type& type : types()) names.push_back(type.name);
  const std::string name = value.one_of(names, "shape type");
  for (const Type& type : types())
    if (type.name == name) return type;
  value.fail("unknown shape type '" + name + "'");  // one_of has refused it
}

ScenarioShape read_shape(const Value& value, const fs::path& folder, double end_time) {
  if (value.name().empty())
    value.fail("a shape has an empty name; write [shapes.NAME] with at least one character");
  if (!value.is_table())
    value.fail("'" + value.name() + "' is no table; write a shape as [shapes." + value.name() +
               "] with its type below");
  const auto named = value.peek("type");
  const Value type_value =
      named ? *named : value.table(every_key()).require("type", "type = \"box\"");
  const Type& type = type_named(type_value);
  Keys keys = type.keys;
  keys.insert(keys.end(), kCommonKeys.begin(), kCommonKeys.end());
  const Table table = value.table(keys);

  ScenarioShape shape;
  shape.name = value.name();
  shape.type = type.name;
  shape.pose = read_pose(table, {});
  if (const auto motion = table.find("motion"))
    shape.motion = read_motion(*motion, shape.pose, end_time);
  if (type.read == nullptr) {
    type.check(table, folder);
    type_value.fail(type.name +
                    " shapes are parsed but cannot collide yet; use another type of shape");
  }
  shape.geometry = std::make_shared<const Shape<double>>(type.read(table, folder));
  return shape;
}

}  // namespace

std::vector<ScenarioShape> read_shapes(const Value& value, const fs::path& folder,
                                       double end_time) {
  if (!value.is_table())
    value.fail("'shapes' must hold one table for each shape; write [shapes.NAME]");
  std::vector<ScenarioShape> shapes;
  for (const Value& member : value.members())
    shapes.push_back(read_shape(member, folder, end_time));
  if (shapes.empty()) value.fail("[shapes] is empty; add a shape as [shapes.NAME]");
  return shapes;
}

}  // namespace contactscope::scenario_file
