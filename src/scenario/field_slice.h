#pragma once

#include "field/distance_field.h"
#include "scenario/scenario.h"
#include "trace/field_slice.h"

namespace contactscope {

/// The direction, world, any length, that slices through fields face: towards the eye of the first
/// view that shows them and sets its eye, else towards a typical fitted camera.
Vec3d facing_slices(const Scenario& scenario);

/// Distances on a plane through the centre of the surface, the lattice plane whose normal is
/// closest to `toward`; its axes are counter-clockwise from there. About as many values as a square
/// with kSliceValues per side, eight per cell at most: cells that use their triangles resolve
/// features thinner than a cell. `pose` places the field's shape in the world.
trace::FieldSlice slice_through(const std::string& name, const PlacedField& field,
                                const Pose<double>& pose, const Vec3d& toward);

inline constexpr int kSliceValues = 96;

}  // namespace contactscope
