#pragma once

#include "draw/staging.h"

/// Text about objects in a picture, from the trace alone.
namespace contactscope::page {

/// "overlap", "2.00 mm", and so on.
using FactRows = std::vector<std::pair<std::string, std::string>>;

/// A contact point and its position in the picture.
struct PointFacts {
  std::string key;                    // the same in every frame with the point
  std::string name;                   // "point 2"
  std::string of;                     // "crate and table"
  draw::Point2 at;                    // pixels
  bool is_contact = false;            // false: dropped in reduction
  std::vector<std::string> layers{};  // that show the point
  FactRows rows{};
};

/// An area of the picture: a face, or the outline of a shape.
struct AreaFacts {
  std::string key, name, of;
  std::string layer;
  std::vector<draw::Point2> polygon{};
  FactRows rows{};
};

struct PairFacts {
  std::string key, name;
  std::string parts;  // as in draw::Part
  FactRows rows{};
};

/// "overlap" or "gap" and its length, for a separation in metres.
std::pair<std::string, std::string> gap_row(double separation);
/// "(0.5, 0, −1)", in metres or without a unit.
std::string spell_vector(const Vec3d& vector);
/// "edge 3 of crate, edge 7 of table" for the id "a:e3 b:e7"; other ids are returned unchanged.
std::string feature_words(const std::string& id, const trace::Pair& pair);

/// Points that the layers of a picture with a camera show.
std::vector<PointFacts> point_facts(const draw::Staging& staging, const trace::Frame& frame,
                                    const draw::Drawing& drawing);
/// Reference and incident faces, clip polygons and shapes, in order of hit testing.
std::vector<AreaFacts> area_facts(const draw::Staging& staging, const trace::Frame& frame,
                                  const draw::Drawing& drawing);
std::vector<PairFacts> pair_facts(const trace::Frame& frame);

/// True if the drawing shows a layer, for the pair if one is given.
bool shows_layer(const draw::Drawing& drawing, std::string_view layer, std::string_view pair = {});
/// Name of a pair in parts of a drawing.
std::string parts_of(const trace::Pair& pair);

}  // namespace contactscope::page
