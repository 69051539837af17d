#include "field/distance_field.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

/// Cells on each side of the surface; 0 for "dense".
int read_band(const Value& value) { return value.is_string() ? value.word() : value.integer(); }

/// Which of the cells on the surface use their triangles: all, none, or the ones that are not
/// smooth.
void read_exact(const Value& value, FieldSettings& settings) {
  if (value.is_string()) {
    value.string();
    settings.smooth = kSmoothPart;
  } else {
    settings.exact = value.boolean();
  }
}

}  // namespace

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
