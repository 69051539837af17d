#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/at.h"
#include "core/view.h"
#include "draw/scene/camera.h"
#include "draw/scene/quantity.h"
#include "draw/scene/sketch.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The part of a half-space's plane that is drawn, in the shape's frame.
struct PlanePatch {
  Vec3d center = Vec3d::Zero();
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitZ();  // unit, at right angles to each other
  double half_u = 1, half_v = 1;                 // metres
};

/// A shape of the trace with what drawing derives from it once: edges with their faces.
struct ShapeMesh {
  struct Edge {
    int from = 0, to = 0;       // vertices
    int left = -1, right = -1;  // faces; -1 when open
    bool smooth = false;        // neighbouring facets of a tessellated surface
  };
  const trace::Shape* shape = nullptr;
  std::vector<Edge> edges;
  std::vector<Vec3d> normals;       // of the faces, local, outward, unit
  double radius = 0;                // metres, about the centre of mass; infinite for a plane
  std::optional<PlanePatch> patch;  // of a plane, once it is fitted to a sequence
  std::shared_ptr<const trace::Shape> rounded{};  // of a shape with a margin: what `shape` is then
  const trace::Shape* core = nullptr;  // of a shape with a margin: what the trace has, without it
};

ShapeMesh make_mesh(const trace::Shape& shape);

/// Those of a sequence, in the header's order, which outlives them.
class ShapeMeshes : public std::vector<ShapeMesh> {
 public:
  explicit ShapeMeshes(const std::vector<trace::Shape>& shapes);

  /// The place of the shape of that name; nothing where there is none.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Metres, of the smallest shape; infinite where there is none, or nothing but planes.
  double smallest_radius() const;

 private:
  std::unordered_map<std::string_view, std::size_t> places_;
};

/// A shape placed in the world in one frame.
struct PlacedShape {
  const ShapeMesh* mesh = nullptr;
  Pose<double> pose;
  std::vector<Vec3d> vertices;  // world
  bool is_a = true;             // colour: the role in the first pair that names it
  std::size_t place = 0;        // among the header's shapes
  /// Of a shape that deforms: what `mesh` is made of, in this frame alone.
  std::shared_ptr<const trace::Shape> deformed{};
  std::shared_ptr<const ShapeMesh> deformed_mesh{};

  const trace::Shape& traced() const { return *mesh->shape; }
  bool is_mesh() const { return traced().type == "mesh"; }
  Vec3d normal(int face) const { return pose.rotate(at(mesh->normals, face)); }
  const Vec3d& vertex(int index) const { return at(vertices, index); }
  std::vector<Vec3d> polygon(int face) const;
  /// Ends of an edge, numbered as in the trace; nothing where there is no such edge. Of a shape
  /// with a margin the edge is inside, where the trace has it.
  std::optional<std::array<Vec3d, 2>> edge(int index) const;
};

/// The shapes that are there in one frame, in the header's order.
std::vector<PlacedShape> place_shapes(const ShapeMeshes& meshes, const trace::Frame& frame);

/// How long arrows and overlaps are drawn, the same in a whole sequence. The factors are 1, 2 or 5
/// times a power of ten, so that a legend can state them.
struct SequenceScales {
  double overlap = 1;            // overlaps are drawn this many times as long
  double gap = 1;                // and gaps of points that do not touch yet
  double impulse = 0;            // metres for one newton second; 0 where there are no impulses
  double longest_impulse = 0;    // metres; longer arrows are cut there, and marked as such
  double friction = 0;           // metres for one newton second of friction
  double velocity = 0;           // seconds: an arrow is the way in this time; 0 where nothing moves
  double spin = 0;               // seconds: a curved arrow is the turn in this time
  double drift = 1;              // how far anchors are apart is drawn this many times as long
  double closing = 0;            // metres a second: largest relative velocity along a normal
  double step = 0;               // seconds from a frame to the next; 0 of one frame alone
  double pixel = 1;              // pixels for one at 720 lines
  LengthUnit length{};           // of all numbers
  std::optional<Prefix> load{};  // of all impulses or forces, of the usual ones
  double touching = 0;  // metres: a contact point whose separation is larger does not touch
};

/// By which camera a pair is seen that has a viewport of its own; null: by that of the whole view.
using CameraOf = std::function<const Camera*(const trace::Pair&)>;

SequenceScales fit_scales(const ShapeMeshes& meshes, const std::vector<trace::Frame>& frames,
                          const Camera& whole, const Layout& layout, const View& view,
                          const CameraOf& camera_of = {});

inline constexpr std::size_t kCrowd = 24;  // shapes

/// Where the shapes are in each frame of a sequence, first to last.
struct FramePoses {
  int frame = 0;
  std::vector<std::pair<std::string, Pose<double>>> poses;
};
using SequencePoses = std::vector<FramePoses>;

/// All that the layers look at in one frame.
struct Scene {
  const View& view;
  const trace::Header& header;
  const trace::Frame& frame;
  const ShapeMeshes& meshes;
  const Camera& camera;
  SequenceScales scales{};
  const SequencePoses* sequence = nullptr;  // where the view shows where shapes have been
  std::vector<PlacedShape> shapes = place_shapes(meshes, frame);

  bool shows(Layer layer) const { return view.shows(layer); }
  /// So many shapes that lengths, names and signs of each would cover all of them.
  bool crowded() const { return header.shapes.size() > kCrowd; }
  /// Null where there is none of that name.
  const PlacedShape* find(std::string_view name) const;
  /// Ends of an edge of the shape of that name; nothing where there is no such edge.
  std::optional<std::array<Vec3d, 2>> edge(std::string_view name, int index) const {
    const PlacedShape* shape = find(name);
    return shape == nullptr ? std::nullopt : shape->edge(index);
  }
  /// What the solver moves.
  std::span<const trace::Body> bodies() const;
  const trace::Body* body(std::string_view name) const;
  /// Metres: what the separation of this pair may be off by; see noise_of().
  double noise(const trace::Pair& pair) const;
};

/// Metres: half a last digit of the scalar at the pair's contact, or at the smaller shape where
/// there is none, counted from the origin and with the smaller shape's size. 0 where the trace
/// names no scalar.
double noise_of(const trace::Header& header, const ShapeMeshes& meshes, const trace::Frame& frame,
                const trace::Pair& pair);

Vec3d up_axis(const trace::Header& header);

/// What lies between two points.
enum class Measured { Gap, Overlap };

/// Their distance. Of a gap a two-headed arrow, or where that would be too short to be one, two that
/// point at it from outside; of an overlap a line between two bars. `text`: what it is in the legend;
/// empty: a label says it.
void draw_measure(const Scene& scene, Measured what, const Vec3d& from, const Vec3d& to,
                  float width, const std::string& text, Sketch& sketch);

/// A gap of `metres`, known to `noise` metres, between two points, with "gap" and its length
/// `clearance` pixels away along `aside`.
void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres, double noise,
              double clearance, const Vec3d& aside, Sketch& sketch);

/// Adds an arc of a circle about `axis` (unit) through `center` that ends in a head: a turn by
/// `angle` radians > 0, counter-clockwise against the axis. Its middle is nearest to the eye.
void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch);

/// Points that a picture of the shape must hold: vertices, of a round shape points all around it,
/// of a plane none.
std::vector<Vec3d> extent_points(const PlacedShape& shape);

/// What the shapes of one frame ask a picture to hold. A mesh may be a landscape: it counts as far
/// as half the size of the other shapes around them, or whole where it is alone.
std::vector<Vec3d> extent_points(const std::vector<PlacedShape>& shapes);

}  // namespace contactscope::draw
