#pragma once

#include "draw/staging.h"

/// Converts a Drawing for vector files: in as few paths as possible.
namespace contactscope::vector {

using draw::Cap;
using draw::Color;
using draw::Disc;
using draw::Part;
using draw::Point2;
using draw::Rect;
using draw::Text;

/// Polygons of one colour painted as one shape, without seams between neighbours.
struct FillPath {
  std::vector<std::vector<Point2>> polygons;
  Color color{};
};

/// A closed line ends at its first point, which is not repeated.
struct Polyline {
  std::vector<Point2> points;
  bool closed = false;
};

/// Lines of one style; the dash pattern restarts for each line.
struct StrokePath {
  std::vector<Polyline> lines;
  float width = 1;  // pixels
  Color color{};
  Cap cap = Cap::Butt;
  float dash = 0, gap = 0, phase = 0;  // as in draw::Stroke
};

/// Text with the position of the rasterizer: its left end on a quarter of a column, its baseline on
/// a row of pixels.
struct PlacedText {
  const Text* text = nullptr;
  Point2 left;      // of the baseline
  float width = 0;  // pixels
};

using Piece = std::variant<FillPath, StrokePath, Disc, PlacedText>;

/// Pieces of one part of the drawing, in painting order.
struct Group {
  const Part* part = nullptr;  // null before the first part
  std::vector<Piece> pieces;
};

/// Pieces of a drawing, which must outlive them. Omits primitives without colour, size or a place on
/// the canvas. Adjacent fills of one colour share a path if they are opaque or do not overlap.
/// Strokes of one style share a path, and are joined end to end into lines.
std::vector<Group> groups_of(const draw::Drawing& drawing);

/// Position of a text in the rasterizer.
PlacedText placed(const Text& text);

// anchors.cpp

/// Positions of contact points, normals, faces, shapes, labels and rectangles in a picture, as
/// JSON: in pixels and as fractions of its size. README.md of this folder lists the keys. Omits
/// objects behind the eye or outside the view. `drawing` is that of the frame, with panels.
std::string anchors_of(const draw::Staging& staging, const trace::Frame& frame,
                       const draw::Drawing& drawing);

}  // namespace contactscope::vector
