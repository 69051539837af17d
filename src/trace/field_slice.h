#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/field.h"

/// What is seen of a signed distance field, and of the search for contacts in it.
namespace contactscope::trace {

/// Distances on a plane through the middle of a field, under the name of its shape. The plane is one of
/// the lattice's, so that its cells are squares in it.
struct FieldSlice {
  std::string name;
  double cell = 0;                 // metres, the side of one of the lattice's
  Vec3d origin = Vec3d::Zero();    // world, metres: of the first value, a corner of the lattice
  Vec3d next = Vec3d::Zero();      // metres, from a value to the next one of its row
  Vec3d next_row = Vec3d::Zero();  // metres, from a row to the next
  int columns = 0;                 // values of a row
  std::vector<double> distances;   // cells, rounded to thousandths; row by row, negative inside
  /// Cells that have nodes of their own: how many cells from the origin along a row, and across.
  std::vector<std::array<int, 2>> band;
  std::vector<std::array<int, 2>> exact;  // likewise: cells that are answered by their triangles

  int rows() const { return columns > 0 ? static_cast<int>(distances.size()) / columns : 0; }

  static constexpr auto fields() {
    using F = FieldSlice;
    return field::list(field::name(&F::name), field::exact("cell", &F::cell),
                       field::position("origin", &F::origin).says("origin of the slice"),
                       field::position("next", &F::next).says("way to the next value"),
                       field::position("next_row", &F::next_row).says("way to the next row"),
                       field::exact("columns", &F::columns),
                       field::length("distances", &F::distances).says("distance"),
                       field::exact("band", &F::band).says("band cell"),
                       field::exact("exact", &F::exact).where_set().says("exact cell"));
  }
  friend bool operator==(const FieldSlice&, const FieldSlice&) = default;
};

/// A point at which a field was asked while contacts were looked for.
struct FieldProbe {
  Vec3d position = Vec3d::Zero();  // world
  double separation = 0;           // metres: the distance there, less the radius of a round shape

  static constexpr auto fields() {
    return field::list(field::position("position", &FieldProbe::position).says("asked point"),
                       field::length("separation", &FieldProbe::separation));
  }
  friend bool operator==(const FieldProbe&, const FieldProbe&) = default;
};

/// How contacts with a field were looked for.
struct FieldProbes {
  std::string method;              // "sampled", "conservative"
  std::vector<FieldProbe> probes;  // in the order in which they were asked

  static constexpr auto fields() {
    return field::list(
        field::exact("method", &FieldProbes::method),
        field::facts("probes", &FieldProbes::probes).entries("asked point", "asked points"));
  }
  friend bool operator==(const FieldProbes&, const FieldProbes&) = default;
};

}  // namespace contactscope::trace
