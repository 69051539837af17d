#pragma once

#include <string>
#include <variant>
#include <vector>

/// What a picture consists of, in pixels, in the order of painting. Perspective, depth order and
/// hidden lines are already resolved, so that pixels and vector files come from one list.
namespace contactscope::draw {

/// Straight (not premultiplied) sRGB colour, 0 to 1.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;
};

/// Pixels from the top left corner of the canvas, y down; pixel centres at half-integers.
struct Point2 {
  float x = 0, y = 0;
};

/// Filled convex polygon, either winding, without anti-aliased border (neighbours share edges).
struct Fill {
  std::vector<Point2> polygon;
  Color color;
};

enum class Cap { Butt, Round };

/// Straight line with analytic anti-aliasing. `dash` and `gap` in pixels, no dashes when gap is 0;
/// `phase` is the distance already run along the dash pattern at `from`.
struct Stroke {
  Point2 from, to;
  float width = 1;  // pixels
  Color color;
  Cap cap = Cap::Butt;
  float dash = 0, gap = 0, phase = 0;
};

/// Disc or ring with analytic anti-aliasing: painted where inner <= distance from centre <= outer.
struct Disc {
  Point2 center;
  float inner = 0, outer = 1;  // pixels
  Color color;
};

enum class Weight { Regular, Bold };
enum class Align { Left, Center, Right };

/// One line of UTF-8 text. `at` is on the baseline, at its left end, middle or right end.
struct Text {
  std::string text;
  Point2 at;
  float size = 14;  // pixels from ascender to descender
  Weight weight = Weight::Regular;
  Align align = Align::Left;
  Color color;
  float halo = 0;  // width in pixels of a soft border around the letters
  Color halo_color{1, 1, 1, 1};
};

using Primitive = std::variant<Fill, Stroke, Disc, Text>;

struct Drawing {
  int width = 0, height = 0;  // pixels
  Color background{1, 1, 1, 1};
  std::vector<Primitive> primitives;  // painted in this order
};

}  // namespace contactscope::draw
