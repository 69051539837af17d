#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "draw/scene/legend.h"
#include "draw/scene/visibility.h"

/// What the stages of the pipeline look like, still in the world: the layers add to a Sketch, and
/// compose() turns it into a Drawing. Lengths in metres where they belong to the scene, in pixels
/// at 720 lines where they belong to the picture.
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

/// A line through many points, whose dashes run on from one to the next.
struct Curve {
  std::vector<Vec3d> points;
  LineStyle style;
  bool closed = false;
};

/// Arrow of a length in pixels along a world direction, or between two points when `to` is set.
struct Arrow {
  Vec3d from = Vec3d::Zero();
  Vec3d direction = Vec3d::Zero();  // unit
  float pixels = 0;
  std::optional<Vec3d> to{};
  bool double_headed = false;
  bool bars = false;  // strokes across its ends, and no heads: what overlaps, measured
  float width = 2;
  float head = 9;  // pixels
  Color color{};
  bool halo = true;
  bool open = false;         // a head of two strokes
  float head_share = 0.45f;  // largest share of the length that the head takes
  bool may_leave = false;    // cut at the border of the view; others are left out there
};

/// For what is drawn to scale: as long as it is, also beyond the border of the view.
inline Arrow arrow_to_scale(const Vec3d& from, const Vec3d& way, float width, float head,
                            const Color& color) {
  return {.from = from,
          .to = from + way,
          .width = width,
          .head = head,
          .color = color,
          .may_leave = true};
}

enum class MarkKind {
  Dot,
  Half,  // filled on its left
  Hollow,
  Ring,
  WideRing,  // hollow, around what stands in the same place
  Apart,     // a point that does not touch yet
  Cross,
  SmallCross,
  Core,
  Quartered,       // a centre of mass
  SmallQuartered,  // and where it is projected to
  Origin,          // of a space that has one
  HeldOrigin,      // within what the picture is about
  Square,          // a contact point that has no age
  Node,            // where lines meet
  Speck,           // a point among hundreds
};

/// Something of a fixed size on the screen.
struct Mark {
  MarkKind kind = MarkKind::Dot;
  Vec3d at;
  Color color;
};

/// What a number beside a point counts: each has a form of its own around it, everywhere alike.
enum class Badge {
  None,
  Choice,   // the place in the order in which a reducer chose it: a circle
  Age,      // frames since it was found: a square
  Support,  // which vertex of a simplex or polytope it is of: a diamond
};

/// Text that wants to stand near a point and finds its own place.
struct Label {
  Vec3d at;
  std::string text;
  Color color;
  float size = 14;
  bool bold = true;
  double clearance = 8;  // pixels between the point and the text
  // Places are tried starting in this direction (world); none: away from the sketch's centre.
  std::optional<Vec3d> direction;
  bool leader = false;          // a line to the point also from near by
  bool foot = false;            // its leader ends in a small dot
  std::vector<Vec2d> ground{};  // convex, on the screen: on it the label needs no leader
  std::string of{};             // what it names, "point b:v4", where another drawing may ask for it
  Badge badge = Badge::None;
};

/// What is added to a sketch from here on shows this: a layer, and of which pair.
struct SketchPart {
  std::string layer, pair;
  // How many of each kind the sketch had when it began.
  std::size_t surfaces = 0, curves = 0, lines = 0, arrows = 0, marks = 0, labels = 0;
};

struct Sketch {
  std::vector<SketchPart> parts;  // in order; what stands before the first is of none
  std::vector<Surface> surfaces;
  Occluders occluders;
  std::vector<RoundBody> bodies;      // that surfaces belong to
  std::vector<ConvexShadow> shadows;  // of bodies
  std::vector<Curve> curves;
  std::vector<Line> lines;
  std::vector<Arrow> arrows;
  std::vector<Mark> marks;
  std::vector<Label> labels;
  std::vector<Eigen::AlignedBox2d> pair_labels;  // text on the screen that others keep clear of
  std::string heading;                           // over the view: which step of a story this is
  Legend legend;
  Vec3d center = Vec3d::Zero();  // labels stand away from it

  /// What is added from here on belongs to this layer, and to that pair where one is given.
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
  /// A line that no label covers, on a wider one.
  void bordered_line(const Vec3d& from, const Vec3d& to, const LineStyle& style, float border,
                     const Color& color = with_alpha(kWhite, 0.85f)) {
    lines.push_back({from, to, {border, color}});
    lines.push_back({from, to, style, true});
  }
  void mark(MarkKind kind, const Vec3d& at, const Color& color) {
    marks.push_back({kind, at, color});
  }
  Label& label(const Vec3d& at, const std::string& text, const Color& color, float size,
               double clearance, const std::optional<Vec3d>& direction = std::nullopt) {
    labels.push_back({at, text, color, size, true, clearance, direction});
    return labels.back();
  }
  /// `anchor`: a place at the thing, where a label can say it in the legend's place.
  void explain(const Swatch& swatch, const std::string& text,
               const std::optional<Vec3d>& anchor = std::nullopt) {
    legend.explain(swatch, text, anchor);
  }
};

/// A mark at its place on the screen. Returns the radius that labels keep off, pixels of the
/// canvas; 0: they may cover it.
float draw_mark(MarkKind kind, const Point2& at, const Color& color, const Pen& pen);

/// A disc quartered black and white, as drawings mark a centre of mass, with a white halo; pixels.
void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing);

/// A filled square with a white halo; `half`: of its width, pixels.
void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing);

/// The form around a number, on white: `middle` of the number, `height` of its digits and `width`
/// of all of them, pixels of the canvas.
void draw_badge(Badge badge, const Point2& middle, float width, float height, const Color& color,
                const Pen& pen);
/// How much wider and higher than its number a badge is, on each side, as shares of the digits'
/// height.
inline constexpr float kBadgeRoom = 0.34f;

/// What became of a point of an incremental manifold in a frame.
enum class PointState { New, Persisted, Broken };
/// As a trace spells it.
PointState point_state(const std::string& state);

/// How such a point looks: new ones filled, persisted ones half-filled, broken ones hollow.
void draw_state_dot(PointState state, const Point2& center, float radius, const Color& color,
                    Drawing& drawing);

/// Resolves a sketch into pixels: surfaces in depth order, lines split into seen and hidden parts,
/// arrows, marks, and labels where they find place. Adds to `drawing`.
void compose(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
