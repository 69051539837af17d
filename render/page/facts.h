#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/staging.h"

/// What a page says of the things in a picture, in words: from the trace alone.
namespace contactscope::page {

/// "overlap", "2.00 mm", and so on.
using FactRows = std::vector<std::pair<std::string, std::string>>;

/// A contact point, and where it is in the picture.
struct PointFacts {
  std::string key;                    // the same in every frame that has it
  std::string name;                   // "point 2"
  std::string of;                     // "crate and table"
  draw::Point2 at;                    // pixels
  bool is_contact = false;            // not one that was dropped
  std::vector<std::string> layers{};  // that show it
  FactRows rows{};
};

/// A part of the picture that has a border: a face, or the outline of a shape.
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

/// "overlap" and its length, or "gap": of a separation in metres.
std::pair<std::string, std::string> gap_row(double separation);
/// "(0.5, 0, −1)", of metres or without a unit.
std::string spell_vector(const Vec3d& vector);
/// "edge 3 of crate, edge 7 of table" of an id as "a:e3 b:e7"; another engine's as it stands.
std::string feature_words(const std::string& id, const trace::Pair& pair);

/// Of a picture with a camera: the points that layers of it show, where it shows any of that pair.
std::vector<PointFacts> point_facts(const draw::Staging& staging, const trace::Frame& frame,
                                    const draw::Drawing& drawing);
/// Reference and incident faces, clip polygons and shapes, the one to be found first before the others.
std::vector<AreaFacts> area_facts(const draw::Staging& staging, const trace::Frame& frame,
                                  const draw::Drawing& drawing);
std::vector<PairFacts> pair_facts(const trace::Frame& frame);

/// Whether the drawing shows a layer, of that pair where one is given.
bool shows_layer(const draw::Drawing& drawing, std::string_view layer, std::string_view pair = {});
/// How parts of a drawing name a pair.
std::string parts_of(const trace::Pair& pair);

}  // namespace contactscope::page
