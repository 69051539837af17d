#include "geometry/hull_builder.h"
#include "geometry/mesh_file.h"
#include "geometry/mesh_seams.h"
#include "geometry/primitives.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHullPoints = 100000;
constexpr int kMaxShapes = 100000;  // per scenario, after scattering

/// For hulls.
bool merges_coplanar(const Value& table) {
  const auto value = table.find("merge_coplanar");
  return !value || value->boolean();
}

/// A hull with triangulated faces if the file requests it; faces of a flat hull stay whole.
template <class Build>
Hull<double> build_merged(const Value& at, const Value& table, const Build& build) {
  Hull<double> hull = build_at(at, "hull", build);
  return hull.flat() || merges_coplanar(table) ? hull : triangulate_faces(hull);
}

/// The hull of a list or file of points, checked for size.
Hull<double> hull_of_points(const std::vector<Vec3d>& points, const Value& at, const Value& shape,
                            const Surroundings& surroundings) {
  if (points.size() > kMaxHullPoints)
    at.fail("'" + at.name() + "' has " + std::to_string(points.size()) +
            " points; a hull may be built from up to " + std::to_string(kMaxHullPoints));
  check_reach(points, at);
  HullOptions options{.allow_flat = true, .for_float = surroundings.scalar == Scalar::Float};
  if (!options.for_float) options.epsilon = epsilon_of_digits(points);
  Hull<double> hull = build_merged(at, shape, [&] { return build_hull(points, options); });
  check_radius(hull.radius, at);
  if (hull.flat())
    surroundings.warnings.push_back(
        "line " + std::to_string(at.line()) + ": the hull '" + shape.name() +
        "' is flat: its points lie on one plane, so it becomes a polygon with "
        "two sides; add a point off the plane to give it a volume");
  return hull;
}

Shape<double> read_hull(const Value& table, const Surroundings& surroundings) {
  const auto vertices = table.find("vertices");
  const auto file = table.find("file");
  table.not_both("vertices", "file");
  if (!vertices && !file)
    table.fail("the hull '" + table.name() +
               "' has no points; add vertices = [[x, y, z], ..] or file = \"NAME.obj\"");
  if (vertices) return hull_of_points(read_points(*vertices), *vertices, table, surroundings);
  return hull_of_points(load_file(*file, surroundings.folder, load_vertices), *file, table,
                        surroundings);
}

Shape<double> read_box(const Value& table, const Surroundings&) {
  const Value value = table.require("half_extents");
  return build_merged(value, table, [&] { return make_box(value.vector3()); });
}

template <Hull<double> (*kMake)(double radius, double half_height, int segments)>
Shape<double> read_round(const Value& table, const Surroundings&) {
  const double radius = table.require("radius").number();
  const double height = table.require("half_height").number();
  const int segments = table.require("segments").integer();
  return build_merged(table, table, [&] { return kMake(radius, height, segments); });
}

Shape<double> read_sphere(const Value& table, const Surroundings&) {
  return Sphere<double>{table.require("radius").number()};
}

Shape<double> read_capsule(const Value& table, const Surroundings&) {
  Capsule<double> capsule;
  capsule.radius = table.require("radius").number();
  table.not_both("points", "half_height");
  const auto points = table.find("points"), half_height = table.find("half_height");
  if (!points && !half_height)
    table.fail("the capsule '" + table.name() +
               "' has no length; add points = [[..], [..]] or half_height = 0.5");
  if (half_height) {
    const double length = half_height->number();
    capsule.points = {Vec3d(0, -length, 0), Vec3d(0, length, 0)};
    return capsule;
  }
  const std::vector<Value> centres = points->array();
  if (centres.size() != 2)
    points->fail("'points' of a capsule are its two centres, [[x, y, z], [x, y, z]]");
  capsule.points = {centres[0].vector3(), centres[1].vector3()};
  return capsule;
}

Shape<double> read_plane(const Value& table, const Surroundings&) {
  const Vec3d normal = read_direction(table.require("normal"));
  return HalfSpace<double>{{normal, table.require("offset").number()}};
}

/// A type of shape: the table of its keys, and its reader.
struct Type {
  std::string_view name, keys;
  Shape<double> (*read)(const Value&, const Surroundings&);
};
constexpr Type kTypes[] = {
    {"box", "Box", read_box},
    {"hull", "Hull", read_hull},
    {"cylinder", "Cylinder and cone", read_round<make_cylinder>},
    {"cone", "Cylinder and cone", read_round<make_cone>},
    {"sphere", "Sphere", read_sphere},
    {"capsule", "Capsule", read_capsule},
    {"mesh", "Mesh", read_mesh},
    {"plane", "Plane", read_plane},
    {"sdf", "Sdf", read_sdf},
};

/// The type of a shape. A table without one may have the keys of all.
const Type& read_type(const Value& value) {
  Keys tables{"shapes.NAME"};
  if (!value.find("type"))
    for (const Type& type : kTypes) tables.push_back(type.keys);
  const Value table = value.find("type") ? value.among(tables) : value.table(tables);
  return *std::ranges::find(kTypes, table.require("type").string(), &Type::name);
}

/// Adds a shape's collider, settings and motion.
ScenarioShape completed(ScenarioShape shape, const Value& table, const Surroundings& surroundings,
                        double end_time) {
  shape.collider = shape.geometry;
  shape.collider_origin = moved_origin(*shape.geometry);
  if (shape.type == "sphere") table.read("center", shape.collider_origin, &Value::vector3);
  if (shape.is_moved())
    shape.collider =
        std::make_shared<const Shape<double>>(seen_from(*shape.geometry, shape.collider_origin));
  if (const auto motion = table.find("motion")) {
    if (is_dynamic(*motion))
      shape.body = read_body(*motion, shape);
    else
      shape.motion = read_motion(*motion, shape.pose, end_time);
    if (const auto deform = motion->find("deform"))
      shape.motion.deformation = std::make_shared<const Deformation>(
          read_deformation(*deform, shape, surroundings.folder));
  }
  return shape;
}

/// Adds the shape of one table, or its scattered copies.
void read_shape(const Value& value, const Surroundings& surroundings, double end_time,
                std::vector<ScenarioShape>& shapes) {
  if (value.name().empty())
    value.fail("a shape has an empty name; write [shapes.NAME] with at least one character");
  if (!value.is_table())
    value.fail("'" + value.name() + "' is not a table; write a shape as [shapes." + value.name() +
               "] with its type below");
  const Type& type = read_type(value);
  const Value table = value.table({type.keys, "shapes.NAME"});

  ScenarioShape shape;
  shape.name = value.name();
  shape.type = type.name;
  shape.pose = read_pose(table, {});
  shape.geometry = std::make_shared<const Shape<double>>(type.read(table, surroundings));
  table.read("tree", shape.tree);
  table.read("weld", shape.weld);
  table.read("friction", shape.friction);
  table.read("restitution", shape.restitution);
  const auto scatter = table.find("scatter");
  if (!scatter) {
    shapes.push_back(completed(std::move(shape), table, surroundings, end_time));
    return;
  }
  for (ScenarioShape& copy : scattered(shape, *scatter, table)) {
    if (count_of(shapes) == kMaxShapes)
      scatter->fail("the scene has more than " + std::to_string(kMaxShapes) +
                    " shapes; scatter fewer");
    shapes.push_back(completed(std::move(copy), table, surroundings, end_time));
  }
}

/// The solver assumes that the surface of a scripted shape moves with its pose.
void refuse_deforming_with_bodies(const Value& value, const std::vector<ScenarioShape>& shapes) {
  const auto body = std::ranges::find_if(shapes, &ScenarioShape::dynamic);
  const auto deforming = std::ranges::find_if(shapes, &ScenarioShape::deforms);
  if (body == shapes.end() || deforming == shapes.end()) return;
  value.find(deforming->name)
      ->find("motion")
      ->find("deform")
      ->fail("'" + body->name +
             "' is dynamic, and the solver does not know the surface velocity of a "
             "mesh that deforms; leave out 'deform', or move '" +
             body->name + "' by keyframes");
}

/// Joins the surfaces of shapes that do not move; see join_seams().
void join_unmoved(std::vector<ScenarioShape>& shapes) {
  std::vector<ScenarioShape*> unmoved;
  for (ScenarioShape& shape : shapes) {
    const Motion& motion = shape.motion;
    const bool is_joined = shape.hull() != nullptr || shape.is_mesh();
    if (!is_joined || shape.dynamic() || shape.deforms() || !motion.keyframes.empty() ||
        !motion.velocity.isZero(0) || !motion.angular_velocity.isZero(0))
      continue;
    unmoved.push_back(&shape);
  }
  if (unmoved.size() < 2) return;
  std::vector<Shape<double>> colliders =
      mapped(unmoved, [](const ScenarioShape* shape) { return *shape->collider; });
  std::vector<PlacedSurface> placed;
  for (std::size_t i = 0; i < unmoved.size(); ++i)
    placed.push_back({&colliders[i], collider_pose_at(*unmoved[i], 0), unmoved[i]->weld});
  for (const std::size_t joined : join_seams(placed))
    unmoved[joined]->collider = std::make_shared<const Shape<double>>(std::move(colliders[joined]));
}

}  // namespace

Shape<double> read_plain_shape(const Value& value, const Surroundings& surroundings) {
  const Type& type = read_type(value);
  const Value table = value.table({type.keys, "shapes.NAME"});
  if (type.name == "sdf") value.fail("'of' is a distance field already; give it another type");
  for (const Key& key : key_table("shapes.NAME").keys)
    if (const auto given = table.find(key.name); given && key.name != "type")
      given->fail("'" + value.name() + "' is a form without a place; remove '" + given->name() +
                  "', or give it to the shape");
  if (type.name == "sphere" && table.find("center"))
    table.find("center")->fail("a field's sphere is about the field's own origin; remove 'center'");
  return type.read(table, surroundings);
}

std::vector<Vec3d> read_points(const Value& value) {
  return mapped(value.array(), &Value::vector3);
}

void check_reach(const std::vector<Vec3d>& points, const Value& at) {
  for (const Vec3d& point : points)
    if (!(point.cwiseAbs().maxCoeff() <= kLargestLength))
      at.fail("'" + at.name() + "' has a point farther than 1e9 metres from the origin; scale it");
}

void check_radius(double radius, const Value& at) {
  if (radius < kSmallestLength)
    at.fail("'" + at.name() + "' is smaller than 1e-9 metres; scale it up");
}

fs::path existing_mesh_file(const Value& value, const fs::path& folder) {
  const std::string name = value.non_empty_string();
  if (!is_mesh_file(name))
    value.fail("'file' is '" + name + "', which is no mesh; give a .obj, .stl, .ply or .off");
  const fs::path path = folder / name;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    value.fail("there is no file '" + path.string() +
               "'; names are relative to the scenario's folder");
  if (status.type() != fs::file_type::regular)
    value.fail("'" + path.string() + "' is not a regular file; give one with a mesh");
  return path;
}

std::vector<ScenarioShape> read_shapes(const Value& value, const Surroundings& surroundings,
                                       double end_time) {
  if (!value.is_table())
    value.fail("'shapes' must hold one table for each shape; write [shapes.NAME]");
  std::vector<ScenarioShape> shapes;
  for (const Value& member : value.members()) read_shape(member, surroundings, end_time, shapes);
  std::set<std::string_view> names;
  for (const ScenarioShape& shape : shapes)
    if (!names.insert(shape.name).second)
      value.fail("two shapes are named '" + shape.name +
                 "', one of them a copy from 'scatter'; rename the other");
  if (shapes.empty()) value.fail("[shapes] is empty; add a shape as [shapes.NAME]");
  refuse_deforming_with_bodies(value, shapes);
  join_unmoved(shapes);
  return shapes;
}

}  // namespace contactscope::scenario_file
