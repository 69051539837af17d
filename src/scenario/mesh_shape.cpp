#include "core/spell.h"
#include "field/distance_field.h"
#include "geometry/mesh_file.h"
#include "geometry/mesh_seams.h"
#include "geometry/primitives.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

constexpr std::size_t kMaxTriangles = 4'000'000;  // limit of a grid

/// "triangle 3 has", "triangles 3, 5 and 9 more have"
std::string some_triangles(const std::vector<int>& triangles) {
  constexpr std::size_t kMaxListed = 3;
  const auto listed = std::span(triangles).first(std::min(triangles.size(), kMaxListed));
  std::string text = triangles.size() == 1 ? "triangle " : "triangles ";
  text += separated(listed, ", ");
  if (triangles.size() > kMaxListed)
    text += " and " + std::to_string(triangles.size() - kMaxListed) + " more";
  return text + (triangles.size() == 1 ? " has" : " have");
}

void warn(const std::string& name, const MeshReport& report, std::vector<std::string>& warnings) {
  const std::string mesh = "mesh '" + name + "': ";
  if (!report.zero_area_triangles.empty())
    warnings.push_back(mesh + some_triangles(report.zero_area_triangles) + " no area and " +
                       (report.zero_area_triangles.size() == 1 ? "was" : "were") +
                       " left out; indices start at 0, in traces they count kept triangles only");
  if (!report.flipped_edges.empty())
    warnings.push_back(
        mesh + std::to_string(report.flipped_edges.size()) +
        " of its edges join triangles of opposite winding; such an edge counts as a border");
  if (!report.non_manifold_edges.empty())
    warnings.push_back(mesh + std::to_string(report.non_manifold_edges.size()) +
                       " of its edges are shared by more than two triangles; such an edge counts "
                       "as a border");
}

/// Rigid meshes drop triangles without area; deforming ones may give them an area.
using MeshBuilder = decltype(build_mesh);

/// A mesh from points and triangles; errors name `at`, or `place` for the size.
Mesh<double> mesh_from(const std::vector<Vec3d>& points,
                       const std::vector<std::array<int, 3>>& triangles, const Value& at,
                       const Value& place, MeshBuilder& build, MeshReport& report) {
  Mesh<double> mesh = build_at(at, "mesh", [&] { return build(points, triangles, &report); });
  check_radius(0.5 * mesh.tree.bounds().extent().norm(), place);
  return mesh;
}

Mesh<double> read_listed(const Value& table, MeshBuilder& build, MeshReport& report) {
  const Value vertices = table.require("vertices");
  const Value triangles = table.require("triangles");
  const std::vector<Vec3d> points = read_points(vertices);
  if (points.empty()) vertices.fail("'vertices' is empty; list at least three points");
  check_reach(points, vertices);
  std::vector<std::array<int, 3>> corners;
  for (const Value& triangle : triangles.array()) {
    triangle.numbers(3);
    const std::vector<Value> indices = triangle.array();
    const auto corner = [&](std::size_t k) { return indices[k].integer(0, count_of(points) - 1); };
    corners.push_back({corner(0), corner(1), corner(2)});
  }
  return mesh_from(points, corners, triangles, vertices, build, report);
}

Mesh<double> read_file(const Value& file, const std::filesystem::path& folder, MeshBuilder& build,
                       MeshReport& report) {
  const FileMesh obj = load_file(file, folder, load_mesh);
  if (obj.triangles.size() > kMaxTriangles)
    file.fail("'file' has " + std::to_string(obj.triangles.size()) +
              " triangles; a mesh may have up to " + std::to_string(kMaxTriangles));
  check_reach(obj.vertices, file);
  return mesh_from(obj.vertices, obj.triangles, file, file, build, report);
}

std::vector<Value> for_each_direction(const Value& value) {
  if (!value.is_array()) return {value, value};
  value.numbers(2);
  return value.array();
}

Mesh<double> read_grid(const Value& value) {
  const Value grid = value.table({"grid"});
  const std::vector<Value> size = for_each_direction(grid.require("size"));
  const std::vector<Value> cells = for_each_direction(grid.require("cells"));
  double amplitude = 0;
  grid.read("amplitude", amplitude);
  const double size_x = size[0].number(), size_z = size[1].number();
  const int cells_x = cells[0].integer(), cells_z = cells[1].integer();
  return build_at(value, "mesh",
                  [&] { return make_grid(size_x, size_z, cells_x, cells_z, amplitude); });
}

/// Cells on each side of the surface; 0 for "dense".
int read_band(const Value& value) { return value.is_string() ? value.word() : value.integer(); }

/// Cells on the surface that use their triangles: all, none, or those that are not smooth.
void read_exact(const Value& value, FieldSettings& settings) {
  if (value.is_string()) {
    value.string();
    settings.smooth = kSmoothPart;
  } else {
    settings.exact = value.boolean();
  }
}

}  // namespace

Shape<double> read_mesh(const Value& table, const Surroundings& surroundings) {
  const auto vertices = table.find("vertices");
  const auto triangles = table.find("triangles");
  const auto file = table.find("file");
  const auto grid = table.find("grid");
  const bool listed = vertices || triangles;
  if (listed + file.has_value() + grid.has_value() != 1)
    table.fail("a mesh needs one of 'vertices' with 'triangles', 'file', or 'grid'");
  const auto motion = table.find("motion");
  MeshBuilder& build =
      motion && motion->find("deform") ? build_mesh_with_flat_triangles : build_mesh;
  MeshReport report;
  Mesh<double> mesh;
  if (listed) mesh = read_listed(table, build, report);
  if (file) mesh = read_file(*file, surroundings.folder, build, report);
  if (grid) mesh = read_grid(*grid);
  warn(table.name(), report, surroundings.warnings);
  if (const auto seam = table.find("weld")) weld(mesh, seam->number());
  return mesh;
}

Shape<double> read_sdf(const Value& table, const Surroundings& surroundings) {
  const Value of = table.require("of");
  if (!of.is_table())
    of.fail(
        "'of' is the shape of the distance field, written inline: of = { type = \"sphere\", "
        "radius = 0.5 }");
  const Shape<double> shape = read_plain_shape(of, surroundings);
  FieldSettings settings;
  table.read("cells", settings.cells);
  table.read("band", settings.band, read_band);
  table.read("interpolation", settings.interpolation);
  if (const auto exact = table.find("exact")) read_exact(*exact, settings);
  const PlacedField placed =
      build_at(of, "distance field", [&] { return build_distance_field(shape, settings); });
  return field_shape(placed, shape);
}

}  // namespace contactscope::scenario_file
