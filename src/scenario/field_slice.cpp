#include "scenario/run_facts.h"

namespace contactscope {

Vec3d facing_slices(const Scenario& scenario) {
  for (const View& view : scenario.views)
    if (view.shows(Layer::Field) && view.eye)
      return *view.eye - view.target.value_or(Vec3d::Zero());
  return scenario.up == "z" ? Vec3d(-Vec3d::UnitY()) : Vec3d::UnitZ();
}

trace::FieldSlice slice_through(const std::string& name, const PlacedField& field,
                                const Pose<double>& pose, const Vec3d& toward) {
  const DistanceField& values = *field.field;
  const Vec3d facing = pose.rotation.conjugate() * toward;
  int through = 0;
  facing.cwiseAbs().maxCoeff(&through);
  // Counter-clockwise as seen by the viewer.
  const int one = (through + 1) % 3, other = (through + 2) % 3;
  const int along = facing[through] > 0 ? one : other, across = facing[through] > 0 ? other : one;
  // A long, narrow slice has as many values in total as a square one.
  const double side = std::sqrt(values.size()[along] * values.size()[across]);
  // Several values per cell, or several cells per value.
  const double per_cell = std::min(8.0, std::round(kSliceValues / side));
  const double step = per_cell >= 1 ? 1 / per_cell : std::ceil(side / kSliceValues);
  const auto count_along = [&](int axis) {
    return 1 + static_cast<int>(std::floor(values.size()[axis] / step + 0.5 / kSliceValues));
  };
  const int columns = count_along(along), rows = count_along(across);
  const auto place = [&](double u, double v) {
    Vec3d point = values.surface_box().center();
    point[along] = u;
    point[across] = v;
    return point;
  };
  trace::FieldSlice slice;
  slice.name = name;
  slice.cell = field.cell;
  slice.origin = pose.transform(field.origin + field.cell * place(0, 0));
  slice.next = pose.rotate(Vec3d(field.cell * step * Vec3d::Unit(along)));
  slice.next_row = pose.rotate(Vec3d(field.cell * step * Vec3d::Unit(across)));
  slice.columns = columns;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double distance = values.sample(place(column * step, row * step)).distance;
      slice.distances.push_back(std::round(1000 * distance) / 1000);
    }
  }
  for (int j = 0; j < static_cast<int>(values.size()[across]); ++j) {
    for (int i = 0; i < static_cast<int>(values.size()[along]); ++i) {
      const Vec3d middle = place(i + 0.5, j + 0.5);
      if (!values.in_band(middle)) continue;
      slice.band.push_back({i, j});
      if (values.sample(middle).source == FieldSample::Source::Exact) slice.exact.push_back({i, j});
    }
  }
  return slice;
}

}  // namespace contactscope
