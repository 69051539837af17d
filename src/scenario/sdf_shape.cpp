#include "field/distance_field.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

constexpr int kMaxBand = 64;  // cells on each side of the surface

/// Cells on each side of the surface; 0 for "dense".
int read_band(const Value& value) {
  if (value.is_string()) {
    value.one_of({"dense"}, "band (or a number of cells)");
    return 0;
  }
  return value.integer(1, kMaxBand);
}

/// Which of the cells on the surface use their triangles: all, none, or the ones that are not
/// smooth.
void read_exact(const Value& value, FieldSettings& settings) {
  if (value.is_string()) {
    value.one_of({"where_needed"}, "exact (or true, or false)");
    settings.smooth = kSmoothPart;
  } else {
    settings.exact = value.boolean();
  }
}

}  // namespace

Shape<double> read_sdf(const Value& table, const Surroundings& surroundings) {
  const Value of = table.require("of", "of = { type = \"box\", half_extents = [0.5, 0.5, 0.5] }");
  if (!of.is_table())
    of.fail(
        "'of' is the shape of the distance field, written inline: of = { type = \"sphere\", "
        "radius = 0.5 }");
  const Shape<double> shape = read_plain_shape(of, surroundings);
  FieldSettings settings;
  table.read("cells", settings.cells,
             [](const Value& value) { return value.integer(kFewestFieldCells, kMaxFieldCells); });
  table.read("band", settings.band, read_band);
  table.read("interpolation", settings.interpolation,
             word_of<FieldInterpolation>({"trilinear", "cubic"}, "interpolation"));
  if (const auto exact = table.find("exact")) read_exact(*exact, settings);
  const PlacedField placed =
      build_at(of, "distance field", [&] { return build_distance_field(shape, settings); });
  return field_shape(placed, shape);
}

}  // namespace contactscope::scenario_file
