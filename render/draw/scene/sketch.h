#pragma once

#include "draw/scene/legend.h"
#include "draw/scene/visibility.h"

/// The stages of the pipeline as marks in the world. Layers add to a Sketch, and compose() turns it
/// into a Drawing. Lengths of the scene are in metres, of the picture in pixels at 720 lines.
namespace contactscope::draw {

struct LineStyle {
  float width = 1;  // pixels
  Color color{};
  bool dashed = false;
  enum class Hidden { Same, Faint, Gone } hidden = Hidden::Same;
};

struct Line {
  Vec3d from, to;
  LineStyle style;
  bool keep_clear = false;  // no label may cover it
};

/// A polyline whose dashes continue across its points.
struct Curve {
  std::vector<Vec3d> points;
  LineStyle style;
  bool closed = false;
};

/// Arrow with a length in pixels along a world direction, or between two points if `to` is set.
struct Arrow {
  Vec3d from = Vec3d::Zero();
  Vec3d direction = Vec3d::Zero();  // unit
  float pixels = 0;
  std::optional<Vec3d> to{};
  bool double_headed = false;
  bool bars = false;  // strokes across the ends instead of heads: measure of an overlap
  float width = 2;
  float head = 9;  // pixels
  Color color{};
  bool halo = true;
  bool open = false;         // a head of two strokes
  float head_share = 0.45f;  // largest share of the length for the head
  bool may_leave = false;    // clipped at the border of the view; other arrows are left out
};

enum class MarkKind {
  Dot,
  Half,  // left half filled
  Hollow,
  Ring,
  WideRing,    // hollow, around another mark
  Separation,  // a point that does not touch yet
  Cross,
  SmallCross,
  Core,
  Quartered,       // a centre of mass
  SmallQuartered,  // its projection
  Origin,          // origin of the Minkowski difference
  HeldOrigin,      // origin inside the difference
  Square,          // a contact point without an age
  Node,            // where lines meet
  Speck,           // a point among hundreds
};

/// A mark of a fixed size on the screen.
struct Mark {
  MarkKind kind = MarkKind::Dot;
  Vec3d at;
  Color color;
  float size = 1;  // factor of the radius of a speck or a point behind a body
};

/// Meaning of a number next to a point. Each meaning has its own shape around the number.
enum class Badge {
  None,
  Choice,   // place in a reducer's order of choice: a circle
  Age,      // frames since it was found: a square
  Support,  // number of a vertex of a simplex or polytope: a diamond
};

/// Text near a point. Its place is found automatically.
struct Label {
  Vec3d at;
  std::string text;
  Color color;
  float size = 14;
  bool bold = true;
  double clearance = 8;  // pixels between the point and the text
  // World direction in which places are tried first; none: away from the sketch's centre.
  std::optional<Vec3d> direction;
  bool leader = false;          // draw a line to the point even if near
  bool foot = false;            // end the leader in a small dot
  std::vector<Vec2d> ground{};  // convex, on the screen: needs no leader inside
  Badge badge = Badge::None;
};

/// Assigns following elements of a sketch to a layer and a pair.
struct SketchPart {
  std::string layer, pair;
  // Numbers of elements of each kind at the start of the part.
  std::size_t surfaces = 0, curves = 0, lines = 0, arrows = 0, marks = 0, labels = 0;
};

struct Sketch {
  std::vector<SketchPart> parts;  // in order; elements before the first belong to no part
  std::vector<Surface> surfaces;
  Occluders occluders;
  std::vector<RoundBody> bodies;                              // round bodies of the surfaces
  std::vector<ConvexShadow> shadows;                          // of convex bodies
  mutable std::shared_ptr<const HiddenLines> hidden_lines{};  // the last of hidden_lines_of()
  std::vector<Curve> curves;
  std::vector<Line> lines;
  std::vector<Arrow> arrows;
  std::vector<Mark> marks;
  std::vector<Label> labels;
  std::vector<Eigen::AlignedBox2d> pair_labels;  // label boxes on the screen, which others avoid
  std::string heading;                           // above the view: step of a story
  Legend legend;
  Vec3d center = Vec3d::Zero();  // labels are placed away from it

  /// Assigns following elements to a layer, and to a pair if given.
  void begin(std::string_view layer, std::string_view pair = {}) {
    parts.push_back({std::string(layer), std::string(pair), surfaces.size(), curves.size(),
                     lines.size(), arrows.size(), marks.size(), labels.size()});
  }
  void outline(const std::vector<Vec3d>& polygon, const LineStyle& style) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      line(polygon[i], polygon[(i + 1) % polygon.size()], style);
  }
  void face(const std::vector<Vec3d>& polygon, const Color& fill, const LineStyle& style) {
    surfaces.push_back({polygon, fill});
    outline(polygon, style);
  }
  void line(const Vec3d& from, const Vec3d& to, const LineStyle& style) {
    lines.push_back({from, to, style});
  }
  /// A line over a wider one, which no label covers.
  void bordered_line(const Vec3d& from, const Vec3d& to, const LineStyle& style, float border,
                     const Color& color = with_alpha(kWhite, 0.85f)) {
    lines.push_back({from, to, {border, color}});
    lines.push_back({from, to, style, true});
  }
  void mark(MarkKind kind, const Vec3d& at, const Color& color, float size = 1) {
    marks.push_back({kind, at, color, size});
  }
  Label& label(const Vec3d& at, const std::string& text, const Color& color, float size,
               double clearance, const std::optional<Vec3d>& direction = std::nullopt) {
    labels.push_back({at, text, color, size, true, clearance, direction});
    return labels.back();
  }
  /// An arrow of a fixed length on the screen, along a unit direction.
  Arrow& arrow(const Vec3d& from, const Vec3d& direction, float pixels, float width, float head,
               const Color& color) {
    return arrows.emplace_back(
        Arrow{from, direction, pixels, {}, false, false, width, head, color});
  }
  /// A two-headed arrow between two points.
  Arrow& measure(const Vec3d& from, const Vec3d& to, float width, float head, const Color& color) {
    return arrows.emplace_back(Arrow{from, Vec3d::Zero(), 0, to, true, false, width, head, color});
  }
  /// An arrow in true scale, clipped at the border of the view.
  Arrow& arrow_to_scale(const Vec3d& from, const Vec3d& offset, float width, float head,
                        const Color& color) {
    Arrow& added = measure(from, from + offset, width, head, color);
    added.double_headed = false;
    added.may_leave = true;
    return added;
  }
  /// The head of a line or curve, from its neck to its tip.
  void arrow_head(const Vec3d& neck, const Vec3d& tip, float width, float head,
                  const Color& color) {
    Arrow& added = measure(neck, tip, width, head, color);
    added.double_headed = added.halo = false;
    added.head_share = 1;
  }
  /// `anchor`: a position at which a label can replace the legend's entry.
  void explain(const Swatch& swatch, const std::string& text,
               const std::optional<Vec3d>& anchor = std::nullopt) {
    legend.explain(swatch, text, anchor);
  }
};

/// Finds what the sketch hides from a camera. Kept in the sketch until more is sketched.
const HiddenLines& hidden_lines_of(const Sketch& sketch, const Camera& camera);

/// Draws a mark. Returns the radius that labels avoid, canvas pixels; 0: labels may cover it.
float draw_mark(MarkKind kind, const Point2& at, const Color& color, const Pen& pen,
                float size = 1);

/// Symbol of a centre of mass: a disc quartered black and white, with a white halo; pixels.
void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing);

/// A filled square with a white halo; `half`: half its width, pixels.
void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing);

/// Draws the shape around a number, on white. `middle` of the number, `height` of its digits,
/// `width` of the whole number, canvas pixels.
void draw_badge(Badge badge, const Point2& middle, float width, float height, const Color& color,
                const Pen& pen);
/// Extra size of a badge on each side of its number, as a share of the digits' height.
inline constexpr float kBadgeRoom = 0.34f;

/// State of a point of an incremental manifold in a frame.
enum class PointState { New, Persisted, Broken };
/// Converts from the spelling of traces.
PointState point_state(const std::string& state);

/// Dot of a point's state: filled if new, half-filled if persisted, hollow if broken.
void draw_state_dot(PointState state, const Point2& center, float radius, const Color& color,
                    Drawing& drawing);

/// Resolves a sketch into pixels: surfaces in depth order, lines with visible and hidden parts,
/// arrows, marks, and labels at free places. Adds to `drawing`.
void compose(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
