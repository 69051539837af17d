#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "draw/scene/pen.h"
#include "trace/trace.h"

/// The legend of a picture: what each sign in it means.
namespace contactscope::draw {

class SwatchPen;

/// What a legend explains, in its order.
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

/// How a sign looks in the legend, and where it stands there. Each is a constant beside the code
/// that draws the sign, and is known by its address.
struct Swatch {
  LegendGroup group;
  int place;  // within the group
  void (*draw)(const SwatchPen&);
  Color ink = kText;  // of a label that stands at the thing in its place
};

struct LegendEntry {
  const Swatch* swatch = nullptr;
  std::string text;
  /// Where a label at the thing itself can say it, world; nothing: the legend alone can, because
  /// the sign is everywhere, or because its scale stands there.
  std::optional<Vec3d> anchor{};
  bool beside = false;  // a panel shows it, and the view does not

  /// Whether both say the same.
  bool operator==(const LegendEntry& other) const {
    return swatch == other.swatch && text == other.text;
  }
};

/// So many at most stand in a legend, where the others can be labelled.
inline constexpr std::size_t kMostLegendEntries = 5;

/// So many labels at most stand in for entries: more are a crowd.
inline constexpr std::size_t kMostInPlace = 2;

/// Of a picture's signs those that its legend explains, and those that labels do.
struct LegendChoice {
  std::vector<LegendEntry> listed;    // in the order in which a picture lists them
  std::vector<LegendEntry> labelled;  // each with an anchor
};

/// Up to kMostLegendEntries are listed. Of more, those that have no place in the picture are listed
/// first, then points, forces and motion, which are many in a picture, before faces, lines and
/// bodies, of which each is one thing that can be pointed at, and what panels show alone last. Of the
/// others two are labelled that are no points, forces or bodies: these bear a number or a word of
/// their own.
LegendChoice choose_legend(const std::vector<LegendEntry>& sorted);

/// What a label at the thing says: the words before the first ", " or ": ".
std::string label_of(const LegendEntry& entry);

class Legend {
 public:
  /// Adds an entry unless it stands there already.
  void explain(const Swatch& swatch, const std::string& text,
               const std::optional<Vec3d>& anchor = std::nullopt) {
    explain(LegendEntry{&swatch, text, anchor});
  }
  void explain(const LegendEntry& entry);
  /// Adds those of another that are new.
  void explain(const Legend& other);
  const std::vector<LegendEntry>& entries() const { return entries_; }
  /// In the order in which a picture lists them, signs that look alike once.
  std::vector<LegendEntry> sorted() const;

 private:
  std::vector<LegendEntry> entries_;
};

/// Draws a swatch. Its own lengths and places are in pixels at 720 lines, places from the left end
/// of the swatch, halfway up.
class SwatchPen : public Pen {
 public:
  SwatchPen(const Layout& layout, const Point2& left, Drawing& drawing)
      : Pen(drawing, layout.scale, kLegendSize), left_(left) {}

  static constexpr double kLegendSize = 17;  // of the text

  Point2 at(double right, double down = 0) const {
    return {left_.x + px(right), left_.y + px(down)};
  }
  Point2 middle() const { return at(11); }

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
  /// A box filled with so much of its border's colour.
  void area(const Color& color, float alpha, double width, bool dashed = false) const {
    box(with_alpha(color, alpha), color, width, dashed);
  }
  void hatched(const Color& color) const;
  void crossed(const Color& color) const { cross(middle(), 4.5, 2, color, Cap::Round); }
  /// Head of an arrow whose tip is there; `size` < 0: to the left.
  void head(double tip, double size, const Color& color) const;
  void arrow(double width, double size, const Color& color) const {
    level_line(0, 14, width, color);
    head(22, size, color);
  }
  /// Its head is two strokes.
  void open_arrow(double width, const Color& color) const {
    level_line(0, 21, width, color);
    for (const double side : {-4.5, 4.5}) path({at(21), at(12, side)}, width, color);
  }
  /// Down from the middle.
  void whisker(double width, const Color& color) const {
    line(middle(), {middle().x, at(0, 9).y}, width, color);
  }

 private:
  Point2 left_;
};

// Swatches of signs that several drawings share: the same thing looks the same in a view, in the
// contact plane and in an inset. The others stand in the file of the one drawing that they are of.

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

inline constexpr Swatch kFreeAxisSwatch{LegendGroup::Masses, 1,
                                        [](auto& pen) { pen.dashes(2.5, kNormal); }};

/// What a body stands on, and the axis about which it turns where it is not stable.
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
/// Of a measure that is too narrow for its arrow.
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

/// Width of an entry's swatch and text in pixels, and the gap to the next. `words`: those of the
/// picture's reader; null: the program's own.
float legend_entry_width(const LegendEntry& entry, float scale, const Words* words);

/// Paints the legend into its rectangle.
void draw_legend(const std::vector<LegendEntry>& entries, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
