#include <cmath>

#include "core/input_error.h"
#include "field/closed_surface.h"
#include "field/field_builder.h"

namespace contactscope {
namespace {

/// Placement of a shape's lattice.
struct Lattice {
  Vec3d origin, size;
  double cell;
};

/// Cells around the surface in a dense lattice; otherwise the band and one more.
constexpr int kDenseRim = 2;

Lattice lattice_around(const Aabb<double>& box, const FieldSettings& settings) {
  Lattice lattice;
  lattice.cell = box.extent().maxCoeff() / settings.cells;
  const int rim = settings.band > 0 ? settings.band + 1 : kDenseRim;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil(box.extent()[axis] / lattice.cell) + 2 * rim;
    lattice.size[axis] = DistanceField::kBlock * std::ceil(cells / DistanceField::kBlock);
  }
  lattice.origin = box.center() - 0.5 * lattice.cell * lattice.size;
  return lattice;
}

PlacedField build_on_mesh(const Mesh<double>& mesh, const FieldSettings& settings) {
  ClosedSurface closed = close_surface(mesh);
  const Lattice lattice = lattice_around(closed.mesh.tree.bounds(), settings);
  const bool watertight = closed.mesh.triangle_count() == closed.own_triangles;
  auto surface = std::make_shared<Mesh<double>>(std::move(closed.mesh));
  for (Vec3d& vertex : surface->vertices) vertex = (vertex - lattice.origin) / lattice.cell;
  // The normals do not change.
  surface->tree.refit(surface->vertices, surface->triangles);
  FieldBuilder builder(std::move(surface), watertight, lattice.size, settings);
  return {std::make_shared<const DistanceField>(builder.build()), lattice.origin, lattice.cell};
}

PlacedField build_on_core(const Capsule<double>& core, const FieldSettings& settings) {
  Aabb<double> box;
  for (const Vec3d& end : core.points) {
    box.include(Vec3d(end - Vec3d::Constant(core.radius)));
    box.include(Vec3d(end + Vec3d::Constant(core.radius)));
  }
  const Lattice lattice = lattice_around(box, settings);
  Capsule<double> in_lattice{core.points, core.radius / lattice.cell};
  for (Vec3d& end : in_lattice.points) end = (end - lattice.origin) / lattice.cell;
  FieldBuilder builder(in_lattice, lattice.size, settings);
  return {std::make_shared<const DistanceField>(builder.build()), lattice.origin, lattice.cell};
}

}  // namespace

PlacedField build_distance_field(const Shape<double>& shape, const FieldSettings& settings) {
  if (settings.cells < kFewestFieldCells || settings.cells > kMaxFieldCells)
    throw ShapeError("a field has " + std::to_string(kFewestFieldCells) + " to " +
                     std::to_string(kMaxFieldCells) + " cells along its longest side");
  if (settings.band < 0) throw ShapeError("the band of a field is 1 cell or more; 0 is dense");
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return build_on_core({{Vec3d::Zero(), Vec3d::Zero()}, sphere->radius}, settings);
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return build_on_core(*capsule, settings);
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) {
    if (hull->flat()) throw ShapeError("a flat hull has no inside; give one with a volume");
    return build_on_mesh(surface_of(*hull), settings);
  }
  if (const auto* mesh = std::get_if<Mesh<double>>(&shape)) return build_on_mesh(*mesh, settings);
  throw ShapeError("a plane is infinite, and a lattice is not; give a box or a mesh instead");
}

}  // namespace contactscope
