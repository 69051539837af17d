#pragma once

#include "trace/shape.h"

namespace contactscope::trace {

struct ClipFace {
  std::string shape;
  int face = -1;
  Vec3d normal = Vec3d::Zero();  // outward, unit
  Polygon polygon;

  static constexpr auto fields() {
    return field::list(field::exact<&ClipFace::shape>, field::exact<&ClipFace::face>,
                       field::direction<&ClipFace::normal>.optional(),
                       field::position<&ClipFace::polygon>.says(""));
  }
};

/// One side plane and the polygon after clipping against it.
struct ClipStep {
  Vec3d normal = Vec3d::Zero();  // outward, unit; points with normal . x > offset are cut off
  double offset = 0;
  Polygon polygon;

  static constexpr auto fields() {
    return field::list(field::direction<&ClipStep::normal>.in("plane"),
                       field::length<&ClipStep::offset>.in("plane"),
                       field::position<&ClipStep::polygon>.says(""));
  }
};

struct DroppedPoint {
  Vec3d position = Vec3d::Zero();
  std::string reason;  // "above the reference face"

  static constexpr auto fields() {
    return field::list(field::position<&DroppedPoint::position>.says(""),
                       field::exact<&DroppedPoint::reason>);
  }
};

struct Clip {
  ClipFace reference;
  ClipFace incident;
  std::vector<ClipStep>
      steps;  // step k clips against the side plane of the reference polygon's edge k
  std::vector<DroppedPoint> dropped;

  static constexpr auto fields() {
    return field::list(field::fact<&Clip::reference>.called("reference face"),
                       field::fact<&Clip::incident>.called("incident face"),
                       field::facts<&Clip::steps>.entries("clip step", "side planes"),
                       field::facts<&Clip::dropped>.entries("dropped point"));
  }
};

}  // namespace contactscope::trace
