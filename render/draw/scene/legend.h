#pragma once

#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "draw/scene/pen.h"

/// Legend of a picture: the meaning of each sign.
namespace contactscope::draw {

class SwatchPen;

/// Sections of a legend, in order.
enum class LegendGroup {
  Shapes,
  Cores,
  Faces,
  Points,
  Forces,
  Motion,
  Masses,
  Axes,
  Trees,
  Differences,
  Directions,
};

/// A sign of the legend: a constant next to the code that draws the sign, identified by its
/// address.
struct Swatch {
  LegendGroup group;
  int place;  // order within the group
  void (*draw)(const SwatchPen&);
  Color ink = kText;  // of a label in the scene that replaces the entry
};

struct LegendEntry {
  const Swatch* swatch = nullptr;
  std::string text;
  /// World position at which a label in the scene can replace the entry. Nothing if only the legend
  /// can explain the sign, because it is everywhere or because the text states its scale.
  std::optional<Vec3d> anchor{};
  bool in_panel = false;  // shown by a panel and not by the view

  bool operator==(const LegendEntry& other) const {
    return swatch == other.swatch && text == other.text;
  }
};

/// Maximum number of entries in a legend if the others can be labelled in the scene.
inline constexpr std::size_t kMaxLegendEntries = 5;

/// Maximum number of labels that replace entries; more would crowd the scene.
inline constexpr std::size_t kMaxInPlace = 2;

/// Splits a picture's signs into legend entries and labels in the scene.
struct LegendChoice {
  std::vector<LegendEntry> listed;    // in legend order
  std::vector<LegendEntry> labelled;  // each with an anchor
};

/// Lists up to kMaxLegendEntries. If there are more, signs without an anchor are listed first,
/// then points, forces and motion, which occur often. Next are faces, lines and bodies, which are
/// single objects, and last the signs of panels. Two of the others are labelled in the scene, but
/// no points, forces, motion or masses, because these have labels already.
LegendChoice choose_legend(const std::vector<LegendEntry>& sorted);

/// Text of a label in the scene: the words before the first ", " or ": ".
std::string label_of(const LegendEntry& entry);

class Legend {
 public:
  /// Adds an entry unless it is there already.
  void explain(const Swatch& swatch, const std::string& text,
               const std::optional<Vec3d>& anchor = std::nullopt) {
    explain(LegendEntry{&swatch, text, anchor});
  }
  void explain(const LegendEntry& entry);
  /// Adds the entries of another legend that are new.
  void explain(const Legend& other);
  const std::vector<LegendEntry>& entries() const { return entries_; }
  /// Entries in legend order; signs that look alike are merged.
  std::vector<LegendEntry> sorted() const;

 private:
  std::vector<LegendEntry> entries_;
};

/// Draws a swatch. Lengths and places are pixels at 720 lines from the middle of its left end.
class SwatchPen : public Pen {
 public:
  SwatchPen(const Layout& layout, const Point2& left, Drawing& drawing)
      : Pen(drawing, layout.scale, kLegendSize), left_(left) {}

  static constexpr double kLegendSize = 17;  // of the text

  Point2 at(double right, double down = 0) const {
    return {left_.x + px(right), left_.y + px(down)};
  }
  Point2 middle() const { return at(11); }
  /// Corners of a box between two lengths, `half` above and below the middle.
  std::vector<Point2> block(double left, double right, double half = 7) const {
    return {at(left, -half), at(right, -half), at(right, half), at(left, half)};
  }

  void level_line(double from, double to, double width, const Color& color, double down = 0) const {
    line(at(from, down), at(to, down), width, color);
  }
  void dashes(double width, const Color& color, double down = 0) const {
    line(at(0, down), at(23, down), width, color, 6, 2.5);
  }
  /// A ring, or a disc where `inner` is 0.
  void dot(double inner, double outer, const Color& color) const {
    ring(middle(), inner, outer, color);
  }
  void box(const Color& fill_color, const Color& border, double width, bool dashed = false) const;
  /// A box filled with its border's colour at opacity `alpha`.
  void area(const Color& color, float alpha, double width, bool dashed = false) const {
    box(with_alpha(color, alpha), color, width, dashed);
  }
  void hatched(const Color& color) const;
  void crossed(const Color& color) const { cross(middle(), 4.5, 2, color, Cap::Round); }
  /// Arrow head with its tip at `tip`; `size` < 0: to the left.
  void head(double tip, double size, const Color& color) const;
  void arrow(double width, double size, const Color& color) const {
    level_line(0, 14, width, color);
    head(22, size, color);
  }
  /// An arrow whose head is two strokes.
  void open_arrow(double width, const Color& color) const {
    level_line(0, 21, width, color);
    for (const double side : {-4.5, 4.5}) path({at(21), at(12, side)}, width, color);
  }
  /// A line down from the middle.
  void whisker(double width, const Color& color) const {
    line(middle(), {middle().x, at(0, 9).y}, width, color);
  }

 private:
  Point2 left_;
};

// Swatches that several drawings share: a sign looks the same in a view, in the contact plane and
// in an inset. All others are in the file of their only drawing.

inline constexpr Swatch kReferenceFaceSwatch{
    LegendGroup::Faces, 0, [](auto& pen) { pen.area(kReferenceFace, 0.35f, 2.5); }};
inline constexpr Swatch kIncidentFaceSwatch{
    LegendGroup::Faces, 2, [](auto& pen) { pen.area(kIncidentFace, 0.35f, 2.5, true); }};
inline constexpr Swatch kClipPolygonSwatch{LegendGroup::Faces, 3,
                                           [](auto& pen) { pen.area(kClipPolygon, 0.2f, 2.5); }};
inline constexpr Swatch kSupportSwatch{LegendGroup::Faces, 4,
                                       [](auto& pen) { pen.area(kClipPolygon, 0.28f, 2.5); }};

inline constexpr Swatch kSupportLineSwatch{
    LegendGroup::Faces, 4, [](auto& pen) { pen.level_line(0, 22, 3, kClipPolygon); }};

inline constexpr Swatch kDroppedSwatch{LegendGroup::Points, 0,
                                       [](auto& pen) { pen.crossed(kDropped); }};
inline constexpr Swatch kReducedSwatch{LegendGroup::Points, 1,
                                       [](auto& pen) { pen.crossed(kDropped); }};
inline constexpr Swatch kContactSwatch{LegendGroup::Points, 3, [](auto& pen) {
                                         pen.whisker(2.5, kContact);
                                         pen.dot(0, 4.8, kContact);
                                       }};
inline constexpr Swatch kPlainPointSwatch{LegendGroup::Points, 9,
                                          [](auto& pen) { pen.dot(0, 4.8, kContact); }};
inline constexpr Swatch kKeptSwatch{LegendGroup::Points, 11, [](auto& pen) {
                                      pen.dot(0, 3.6, kContact);
                                      pen.dot(6.2, 8.2, kContact);
                                    }};

inline constexpr Swatch kNormalSwatch{LegendGroup::Forces, 0,
                                      [](auto& pen) { pen.arrow(3, 10, kNormal); }};

inline constexpr float kKeptFill = 0.22f;  // opacity of the area of the kept points
/// A kept point and the border of that area.
inline constexpr Swatch kSpannedSwatch{LegendGroup::Points, 11, [](auto& pen) {
                                         pen.level_line(-4, 26, 2, kContact);
                                         pen.dot(0, 8.2, kWhite);
                                         pen.dot(0, 3.6, kContact);
                                         pen.dot(6.2, 8.2, kContact);
                                       }};
inline constexpr const char* kSpannedWords = "kept, in order of choice, and their area";

inline constexpr Swatch kFreeAxisSwatch{LegendGroup::Masses, 1,
                                        [](auto& pen) { pen.dashes(2.5, kNormal); }};

/// Explains the support of a body, and the axis about which it turns if it is not stable.
inline void explain_support(const trace::Stability& stability, bool turns, Legend& legend) {
  if (stability.support.size() > 2)
    legend.explain(kSupportSwatch, "support: hull of the contact points",
                   Vec3d(0.5 * (stability.support[0] + stability.support[1])));
  if (stability.support.size() == 2)
    legend.explain(kSupportLineSwatch, "support: a line between two points",
                   Vec3d(0.3 * stability.support[0] + 0.7 * stability.support[1]));
  if (turns)
    legend.explain(kFreeAxisSwatch, "axis about which the body turns", (*stability.axis)[1]);
}

inline constexpr Swatch kDecidingEdgesSwatch{LegendGroup::Axes, 0,
                                             [](auto& pen) { pen.level_line(0, 22, 4, kAxis); }};
inline constexpr Swatch kAxisSwatch{LegendGroup::Axes, 1, [](auto& pen) {
                                      pen.level_line(6, 16, 3, kAxis);
                                      pen.head(22, 8, kAxis);
                                      pen.head(0, -8, kAxis);
                                    }};
/// For a measure that is too narrow for its arrow.
inline constexpr Swatch kNarrowAxisSwatch{LegendGroup::Axes, 2, [](auto& pen) {
                                            pen.level_line(0, 3, 3, kAxis);
                                            pen.head(10, 8, kAxis);
                                            pen.level_line(19, 22, 3, kAxis);
                                            pen.head(12, -8, kAxis);
                                          }};

inline constexpr Swatch kOverlapSwatch{LegendGroup::Axes, 1, [](auto& pen) {
                                         pen.level_line(4, 18, 3, kAxis);
                                         for (const double at : {4.0, 18.0})
                                           pen.line(pen.at(at, -6), pen.at(at, 6), 3, kAxis);
                                       }};

/// Width of an entry's swatch and text, and the gap to the next entry, in pixels. `words`:
/// translations for the reader; null: none.
float legend_entry_width(const LegendEntry& entry, float scale, const Words* words);

/// Draws the legend into its rectangle.
void draw_legend(const std::vector<LegendEntry>& entries, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
