#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "draw/scene/drawing.h"

/// A Drawing as vector files want it: what is seen, in as few paths as give the same picture.
namespace contactscope::vector {

using draw::Cap;
using draw::Color;
using draw::Disc;
using draw::Part;
using draw::Point2;
using draw::Rect;
using draw::Text;

/// Polygons of one colour, painted as one shape, so that no seam shows between neighbours.
struct FillPath {
  std::vector<std::vector<Point2>> polygons;
  Color color{};
};

/// A line through some points. A closed one ends where it began, which is not listed twice.
struct Polyline {
  std::vector<Point2> points;
  bool closed = false;
};

/// Lines of one style, each with its dashes from the beginning.
struct StrokePath {
  std::vector<Polyline> lines;
  float width = 1;  // pixels
  Color color{};
  Cap cap = Cap::Butt;
  float dash = 0, gap = 0, phase = 0;  // as of a draw::Stroke
};

/// Text with its left end and baseline where the rasterizer puts them: on a quarter of a column and on
/// a row of pixels.
struct PlacedText {
  const Text* text = nullptr;
  Point2 left;      // of the baseline
  float width = 0;  // pixels
};

using Piece = std::variant<FillPath, StrokePath, Disc, PlacedText>;

/// The pieces of one part of the drawing, in the order of painting.
struct Group {
  const Part* part = nullptr;  // null before the first part
  std::vector<Piece> pieces;
};

/// All that is seen of a drawing, which outlives them: without what has no colour, no size or no place
/// on the canvas, and without what later opaque fills cover whole (visible.h). Neighbouring fills of one
/// colour are one path where they do not overlap, or are opaque; strokes of one style are one path, and
/// one line where an end meets a beginning.
std::vector<Group> groups_of(const draw::Drawing& drawing);

/// Where the rasterizer puts a text.
PlacedText placed(const Text& text);

}  // namespace contactscope::vector
