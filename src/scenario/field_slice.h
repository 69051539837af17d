#pragma once

#include "field/distance_field.h"
#include "scenario/scenario.h"
#include "trace/field_slice.h"

namespace contactscope {

/// The direction, world, any length, that slices through fields are to look at: to the eye of the first
/// view that shows them and says where its eye is, else to where a fitted camera mostly is.
Vec3d facing_slices(const Scenario& scenario);

/// Distances on a plane through the middle of the surface: of the lattice's three planes the one whose
/// normal is nearest to `toward`, its first axis and second so that they are counter-clockwise from
/// there. About as many as a square of kSliceValues a side has, eight a cell at most: cells that ask their
/// triangles know of what is thinner than a cell. `pose` places the field's shape in the world.
trace::FieldSlice slice_through(const std::string& name, const PlacedField& field,
                                const Pose<double>& pose, const Vec3d& toward);

inline constexpr int kSliceValues = 96;

}  // namespace contactscope
