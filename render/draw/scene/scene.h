#pragma once

#include "draw/scene/quantity.h"
#include "draw/scene/sketch.h"

namespace contactscope::draw {

/// The drawn part of a half-space's plane, in the shape's frame.
struct PlanePatch {
  Vec3d center = Vec3d::Zero();
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitZ();  // unit, perpendicular to each other
  double half_u = 1, half_v = 1;                 // metres
};

/// A shape of the trace with derived data that is computed once: edges with their faces.
struct ShapeMesh {
  struct Edge {
    int from = 0, to = 0;       // vertices
    int left = -1, right = -1;  // faces; -1 when open
    bool smooth = false;        // neighbouring facets of a tessellated surface
  };
  const trace::Shape* shape = nullptr;
  std::vector<Edge> edges;
  std::vector<Vec3d> normals;       // of the faces: local, outward, unit
  double radius = 0;                // metres, about the centre of mass; infinite for a plane
  std::optional<PlanePatch> patch;  // for a plane, after fitting to a sequence
  std::shared_ptr<const trace::Shape> rounded{};  // for a shape with a margin: the rounded `shape`
  const trace::Shape* core = nullptr;  // for a shape with a margin: the trace's shape without it
};

ShapeMesh make_mesh(const trace::Shape& shape);

/// Polygons for a convex shape that is rounded by a margin: faces moved outwards, strips around
/// edges and caps around vertices, which are not quite flat. All corners are on the round surface;
/// strips are inside it by at most 2 % of the margin. The result has no margin.
trace::Shape rounded(const trace::Shape& shape);

/// Meshes of a sequence, in the header's order. The header's shapes must outlive them.
class ShapeMeshes : public std::vector<ShapeMesh> {
 public:
  explicit ShapeMeshes(const std::vector<trace::Shape>& shapes);

  /// Index of the shape with that name; nothing if there is none.
  std::optional<std::size_t> find(std::string_view name) const;
  /// Radius of the smallest shape, metres; infinite without finite shapes.
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
  /// For a shape that deforms: its geometry in this frame; `mesh` points to it.
  std::shared_ptr<const trace::Shape> deformed{};
  std::shared_ptr<const ShapeMesh> deformed_mesh{};

  const trace::Shape& traced() const { return *mesh->shape; }
  bool is_mesh() const { return traced().type == "mesh"; }
  Vec3d normal(int face) const { return pose.rotate(at(mesh->normals, face)); }
  const Vec3d& vertex(int index) const { return at(vertices, index); }
  std::vector<Vec3d> polygon(int face) const;
  /// Ends of an edge, numbered as in the trace, and edge k of triangle t of a mesh as 3 t + k; nothing
  /// if there is no such edge. If the shape has a margin, the edge is the one in the trace, below the
  /// rounded surface.
  std::optional<std::array<Vec3d, 2>> edge(int index) const;
};

inline bool is_ball(const PlacedShape& shape) {
  return shape.traced().radius > 0 && shape.vertices.size() == 1;
}

/// The shapes that exist in one frame, in the header's order.
std::vector<PlacedShape> place_shapes(const ShapeMeshes& meshes, const trace::Frame& frame);

/// Scales of arrows and overlaps, constant over a sequence. The factors are 1, 2 or 5 times a power
/// of ten, so that a legend can state them.
struct SequenceScales {
  double overlap = 1;            // factor of the drawn overlaps
  double gap = 1;                // factor of the drawn gaps of points that do not touch
  double impulse = 0;            // metres per newton second; 0 without impulses
  double longest_impulse = 0;    // metres; longer arrows are cut and marked
  double friction = 0;           // metres per newton second of friction
  double velocity = 0;           // seconds: an arrow is the displacement in it; 0 without motion
  double spin = 0;               // seconds: a curved arrow is the rotation in this time
  double drift = 1;              // factor of the drawn distance between anchors
  double closing = 0;            // metres per second: largest relative velocity along a normal
  double step = 0;               // seconds between frames; 0 for a single frame
  double pixel = 1;              // canvas pixels for one pixel at 720 lines
  LengthUnit length{};           // unit of all lengths
  std::optional<Prefix> load{};  // common prefix of all impulses or forces
  double touching = 0;           // metres: contact points with a larger separation do not touch
  bool heap = false;             // so many contacts that marks at each would hide the bodies
};

/// Camera of a pair that has its own viewport; null: the camera of the whole view.
using CameraOf = std::function<const Camera*(const trace::Pair&)>;

SequenceScales fit_scales(const ShapeMeshes& meshes, const std::vector<trace::Frame>& frames,
                          const Camera& whole, const Layout& layout, const View& view,
                          const CameraOf& camera_of = {});

inline constexpr std::size_t kCrowd = 24;  // number of shapes

/// Poses of the shapes in one frame; a sequence has one for each frame, in order.
struct FramePoses {
  int frame = 0;
  std::vector<std::pair<std::string, Pose<double>>> poses;
};
using SequencePoses = std::vector<FramePoses>;

/// All inputs of the layers for one frame.
struct Scene {
  const View& view;
  const trace::Header& header;
  const trace::Frame& frame;
  const ShapeMeshes& meshes;
  const Camera& camera;
  SequenceScales scales{};
  const SequencePoses* sequence = nullptr;  // if a layer of the view shows earlier or later poses
  std::vector<PlacedShape> shapes = place_shapes(meshes, frame);

  bool shows(Layer layer) const { return view.shows(layer); }
  /// Whether there are so many shapes that lengths, names and signs of each would cover them.
  bool crowded() const {
    return (view.layout == ViewLayout::SideBySide ? header.shapes.size() : shapes.size()) >
               kCrowd ||
           scales.heap;
  }
  /// Whether a shape is only context: in a crowd it would hide the shapes that the view focuses on.
  bool is_context(const PlacedShape& shape) const;
  /// Null if there is no shape of that name.
  const PlacedShape* find(std::string_view name) const;
  /// Ends of an edge of the shape with that name; nothing if there is no such edge.
  std::optional<std::array<Vec3d, 2>> edge(std::string_view name, int index) const {
    const PlacedShape* shape = find(name);
    return shape == nullptr ? std::nullopt : shape->edge(index);
  }
  /// Bodies of the solver; empty without one.
  std::span<const trace::Body> bodies() const;
  const trace::Body* body(std::string_view name) const;
  /// Uncertainty of this pair's separation, metres; see noise_of().
  double noise(const trace::Pair& pair) const;
};

/// Half a unit in the last digit of the scalar type, in metres. Measured at the pair's contact, or
/// at the smaller shape without one, for its distance from the origin and at least the shape's
/// size. 0 if the trace names no scalar.
double noise_of(const trace::Header& header, const ShapeMeshes& meshes, const trace::Frame& frame,
                const trace::Pair& pair);

Vec3d up_axis(const trace::Header& header);

/// Shapes that no solver moves and whose pose differs `seconds` later (earlier if negative), as
/// bodies with that motion.
std::vector<trace::Body> scripted_bodies(const ShapeMeshes& meshes,
                                         std::span<const trace::Placement> now,
                                         std::span<const trace::Placement> later, double seconds);

enum class Measured { Gap, Overlap };

/// Draws the distance between two points. A gap is a two-headed arrow, or two arrows from outside
/// if it is short. An overlap is a line between two bars. `text`: for the legend; empty with a
/// label.
void draw_measure(const Scene& scene, Measured what, const Vec3d& from, const Vec3d& to,
                  float width, const std::string& text, Sketch& sketch);

/// Draws a gap of `metres` with an uncertainty of `noise` metres between two points. The label
/// "gap" with the length is `clearance` pixels away along `aside`.
void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres, double noise,
              double clearance, const Vec3d& aside, Sketch& sketch);

/// Draws a circular arc with an arrow head about `axis` (unit) through `center`: a rotation by
/// `angle` > 0 radians, counter-clockwise about the axis. Its middle is nearest to the eye.
void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch);

/// Points of the shape for fitting the view: vertices, points around a round shape, none for a
/// plane.
std::vector<Vec3d> extent_points(const PlacedShape& shape);

/// Points of one frame's shapes for fitting the view. A mesh may be a landscape: it counts only up
/// to half the size of the other shapes around them. It counts fully if there are no others.
std::vector<Vec3d> extent_points(const std::vector<PlacedShape>& shapes);

/// Where the bodies of a sequence stay together. A fitted camera frames this region, so bodies that
/// fly off do not shrink the rest.
///
/// The middle is the median of all bodies that touch something in some frame. Three quarters of
/// them are within some distance of it. A body belongs to the region up to three times that
/// distance if it touches something, otherwise up to one and a half times. A uniform line, disc or
/// ball of bodies needs at most 1.33. Shapes much larger than the median body, such as floors, are
/// no bodies: only their part around the region counts.
struct HomeRegion {
  Eigen::AlignedBox3d box;     // around the bodies in it, metres
  Eigen::AlignedBox3d around;  // the same, a little larger
  Vec3d middle = Vec3d::Zero();
  double reach = 0;  // metres from the middle: of bodies that touch nothing
  double reach_in_contact = 0;
  std::vector<bool> is_large{};  // for each shape of the header
  bool fly_off = false;          // some body is far outside in some frame
  bool cuts_off = false;         // some body is outside, or some large shape reaches out

  bool holds(const Vec3d& center, bool touches) const {
    return (center - middle).norm() <= (touches ? reach_in_contact : reach);
  }
};

/// Nothing if no frame has a body. `only`: for each shape of the header whether it counts; empty:
/// all do.
std::optional<HomeRegion> home_region(const ShapeMeshes& meshes,
                                      const std::vector<trace::Frame>& frames,
                                      const std::vector<bool>& only = {});

/// Shapes that have contact points in a frame, by their places in the header.
std::vector<bool> shapes_in_contact(const ShapeMeshes& meshes, const trace::Frame& frame);

/// Removes the shapes outside the region, and limits large ones to the box around it.
void keep_home(const HomeRegion& home, const std::vector<bool>& in_contact,
               std::vector<PlacedShape>& shapes);

}  // namespace contactscope::draw
