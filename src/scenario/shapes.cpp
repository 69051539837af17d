#include "scenario/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/input_error.h"
#include "geometry/far_shape.h"
#include "geometry/hull_builder.h"
#include "geometry/obj.h"
#include "geometry/primitives.h"
#include "geometry/triangulate_faces.h"
#include "scenario/dynamics_keys.h"
#include "scenario/mesh_shape.h"
#include "scenario/placement.h"
#include "scenario/shape_values.h"

namespace contactscope::scenario_file {
namespace {

namespace fs = std::filesystem;
using toml_reader::Keys;
using toml_reader::Table;
using toml_reader::Value;

/// Keys of every shape, whatever its type.
const Keys kCommonKeys = {"type", "position", "rotation", "motion", "friction", "restitution"};

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

/// Of shapes that are hulls.
bool merges_coplanar(const Table& table) {
  const auto value = table.find("merge_coplanar");
  return !value || value->boolean();
}

/// A simple shape's hull, whose faces are left in triangles where the file says so.
Hull<double> build_primitive(const Value& at, const Table& table,
                             const std::function<Hull<double>()>& build) {
  Hull<double> hull = build_at(at, build);
  return merges_coplanar(table) ? hull : triangulate_faces(hull);
}

/// Points of a list or file: a hull that can be computed with, within the lengths of a scenario.
Hull<double> hull_of_points(const std::vector<Vec3d>& points, const Value& at, const Table& shape,
                            std::vector<std::string>& warnings) {
  if (points.size() > kMaxHullPoints)
    at.fail("'" + at.name() + "' has " + std::to_string(points.size()) +
            " points; a hull may be built from up to " + std::to_string(kMaxHullPoints));
  for (const Vec3d& point : points)
    if (!(point.cwiseAbs().maxCoeff() <= kLargestLength))
      at.fail("'" + at.name() + "' has a point farther than 1e9 metres from the origin; scale it");
  HullOptions options;
  options.merge_coplanar = merges_coplanar(shape);
  options.allow_flat = true;
  Hull<double> hull = build_at(at, [&] { return build_hull(points, options); });
  if (hull.radius < kSmallestLength)
    at.fail("'" + at.name() + "' is smaller than 1e-9 metres; scale it up");
  if (hull.flat())
    warnings.push_back("line " + std::to_string(at.line()) + ": the hull '" + shape.value().name() +
                       "' is flat: its points lie on one plane, and it is taken as a polygon with "
                       "two sides; give a point off the plane if it is to have a volume");
  return hull;
}

Shape<double> read_hull(const Table& table, const Surroundings& surroundings) {
  const auto vertices = table.find("vertices");
  const auto file = table.find("file");
  if (vertices && file) file->fail("give 'vertices' or 'file', not both");
  if (!vertices && !file)
    table.fail("the hull '" + table.value().name() +
               "' has no points; add vertices = [[x, y, z], ..] or file = \"NAME.obj\"");
  std::vector<std::string>& warnings = surroundings.warnings;
  if (vertices) return hull_of_points(read_points(*vertices), *vertices, table, warnings);
  const fs::path path = existing_obj_file(*file, surroundings.folder);
  std::vector<Vec3d> points;
  try {
    points = load_obj_vertices(path.string());
  } catch (const InputError& error) {
    file->fail(std::string("'file' cannot be used: ") + error.what());
  }
  return hull_of_points(points, *file, table, warnings);
}

Shape<double> read_box(const Table& table, const Surroundings&) {
  const Value value = table.require("half_extents", "half_extents = [0.5, 0.5, 0.5] (metres)");
  value.numbers(3);
  Vec3d half_extents;
  const std::vector<Value> items = value.array();
  for (int i = 0; i < 3; ++i) half_extents[i] = read_length(items[static_cast<std::size_t>(i)]);
  return build_primitive(value, table, [&] { return make_box(half_extents); });
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

Shape<double> read_cylinder(const Table& table, const Surroundings&) {
  const Round round = read_round(table);
  return build_primitive(table.value(), table, [&] {
    return make_cylinder(round.radius, round.half_height, round.segments);
  });
}

Shape<double> read_cone(const Table& table, const Surroundings&) {
  const Round round = read_round(table);
  return build_primitive(table.value(), table, [&] {
    return make_cone(round.radius, round.half_height, round.segments);
  });
}

Shape<double> read_sphere(const Table& table, const Surroundings&) {
  return Sphere<double>{read_length(table.require("radius", "radius = 0.5 (metres)"))};
}

Shape<double> read_capsule(const Table& table, const Surroundings&) {
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

Shape<double> read_plane(const Table& table, const Surroundings&) {
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

/// A type of shape: its own keys, and what reads it.
struct Type {
  std::string name;
  Keys keys;
  Shape<double> (*read)(const Table&, const Surroundings&);
};

const std::vector<Type>& types() {
  static const std::vector<Type> all = {
      {"box", {"half_extents", "merge_coplanar"}, read_box},
      {"hull", {"vertices", "file", "merge_coplanar"}, read_hull},
      {"cylinder", {"radius", "half_height", "segments", "merge_coplanar"}, read_cylinder},
      {"cone", {"radius", "half_height", "segments", "merge_coplanar"}, read_cone},
      {"sphere", {"radius"}, read_sphere},
      {"capsule", {"radius", "points", "half_height"}, read_capsule},
      {"mesh", {"vertices", "triangles", "file", "grid"}, read_mesh},
      {"plane", {"normal", "offset"}, read_plane},
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

ScenarioShape read_shape(const Value& value, const Surroundings& surroundings, double end_time) {
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
  shape.geometry = std::make_shared<const Shape<double>>(type.read(table, surroundings));
  shape.collider = shape.geometry;
  shape.collider_origin = moved_origin(*shape.geometry);
  if (shape.is_moved())
    shape.collider =
        std::make_shared<const Shape<double>>(seen_from(*shape.geometry, shape.collider_origin));
  if (const auto motion = table.find("motion")) {
    if (is_dynamic(*motion))
      shape.body = read_body(*motion, shape);
    else
      shape.motion = read_motion(*motion, shape.pose, end_time);
  }
  table.read("friction", shape.friction, read_friction);
  table.read("restitution", shape.restitution, read_restitution);
  return shape;
}

}  // namespace

std::vector<ScenarioShape> read_shapes(const Value& value, const Surroundings& surroundings,
                                       double end_time) {
  if (!value.is_table())
    value.fail("'shapes' must hold one table for each shape; write [shapes.NAME]");
  std::vector<ScenarioShape> shapes;
  for (const Value& member : value.members())
    shapes.push_back(read_shape(member, surroundings, end_time));
  if (shapes.empty()) value.fail("[shapes] is empty; add a shape as [shapes.NAME]");
  return shapes;
}

}  // namespace contactscope::scenario_file
