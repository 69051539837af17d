#pragma once

#include "core/vec3.h"
#include "trace/field.h"

/// Slices of a signed distance field, and queries of the field during contact search.
namespace contactscope::trace {

/// Distances on a plane through the centre of a field, stored under its shape's name. It is a plane
/// of the lattice, so its cells are squares there.
struct FieldSlice {
  std::string name;
  double cell = 0;                 // metres, side of a lattice cell
  Vec3d origin = Vec3d::Zero();    // world, metres: first value, a corner of the lattice
  Vec3d next = Vec3d::Zero();      // metres, from one value to the next in its row
  Vec3d next_row = Vec3d::Zero();  // metres, from one row to the next
  int columns = 0;                 // values per row
  std::vector<double> distances;   // in cells, rounded to 1/1000; row by row, negative inside
  /// Cells with their own nodes: offset from the origin in cells, along a row and across rows.
  std::vector<std::array<int, 2>> band;
  std::vector<std::array<int, 2>> exact;  // likewise: cells that use their triangles

  int rows() const { return columns > 0 ? static_cast<int>(distances.size()) / columns : 0; }

  static constexpr auto fields() {
    using F = FieldSlice;
    return field::list(field::name(&F::name), field::exact<&F::cell>,
                       field::position<&F::origin>.says("origin of the slice"),
                       field::position<&F::next>.says("way to the next value"),
                       field::position<&F::next_row>.says("way to the next row"),
                       field::exact<&F::columns>, field::length<&F::distances>.says("distance"),
                       field::exact<&F::band>.says("band cell"),
                       field::exact<&F::exact>.where_set().says("exact cell"));
  }
  friend bool operator==(const FieldSlice&, const FieldSlice&) = default;
};

/// A point at which the contact search queried a field.
struct FieldProbe {
  Vec3d position = Vec3d::Zero();  // world
  double separation = 0;           // metres: the distance there, minus the radius of a round shape

  static constexpr auto fields() {
    return field::list(field::position<&FieldProbe::position>.says("asked point"),
                       field::length<&FieldProbe::separation>);
  }
  friend bool operator==(const FieldProbe&, const FieldProbe&) = default;
};

/// How the contacts with a field were found.
struct FieldProbes {
  std::string method;              // "sampled", "conservative"
  std::vector<FieldProbe> probes;  // in the order of the queries

  static constexpr auto fields() {
    return field::list(field::exact<&FieldProbes::method>,
                       field::facts<&FieldProbes::probes>.entries("asked point", "asked points"));
  }
  friend bool operator==(const FieldProbes&, const FieldProbes&) = default;
};

}  // namespace contactscope::trace
