#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/view.h"
#include "draw/scene/camera.h"
#include "draw/scene/sequence_scales.h"
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
};

ShapeMesh make_mesh(const trace::Shape& shape);

/// A shape placed in the world in one frame.
struct PlacedShape {
  const ShapeMesh* mesh = nullptr;
  Pose<double> pose;
  std::vector<Vec3d> vertices;  // world
  bool is_a = true;             // colour: the role in the first pair that names it

  Vec3d normal(int face) const {
    return pose.rotate(mesh->normals[static_cast<std::size_t>(face)]);
  }
  std::vector<Vec3d> polygon(int face) const;
};

/// All that the layers look at in one frame.
struct Scene {
  const View& view;
  const trace::Header& header;
  const trace::Frame& frame;
  std::vector<PlacedShape> shapes;
  const Camera& camera;
  double depth_factor = 1;  // overlaps are drawn this many times as long
  SequenceScales scales{};

  bool shows(Layer layer) const { return view.shows(layer); }
  const PlacedShape* find(const std::string& name) const;
};

/// Points that a picture of the shape must hold: vertices, of a round shape points all around it,
/// of a plane none.
std::vector<Vec3d> extent_points(const PlacedShape& shape);

/// Whether some of it is in the picture. Planes and meshes count as such.
bool in_view(const Camera& camera, const PlacedShape& shape);

std::vector<PlacedShape> place_shapes(const std::vector<ShapeMesh>& meshes,
                                      const trace::Frame& frame);

/// What the shapes of one frame ask a picture to hold. A mesh may be a landscape: it counts as far
/// as half the size of the other shapes around them, or whole where it is alone.
std::vector<Vec3d> extent_points(const std::vector<PlacedShape>& shapes);

/// Faces, silhouette and edges of a polyhedron: hidden lines are faint.
void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

// The layers, one file each, named after what they show.
void draw_shapes(const Scene& scene, Sketch& sketch);
void draw_reference_face(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_incident_face(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// A corner that the side planes cut away and that was kept all the same, because nothing else was
/// left: the contact point is above it on the reference face.
bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped);
void draw_clipping(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_contacts(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_id(const trace::Point& point, Sketch& sketch);
/// The names of the edges that the ids of the pair's points consist of, each beside its edge.
void draw_edge_names(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// How far apart the shapes are, and where; of two spheres the line between their centres too.
void draw_gap(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// A length between two points: a two-headed arrow, or where that would be too short to be one, two
/// that point at it from outside. Adds it to the legend as `text`.
void draw_measure(const Scene& scene, const Vec3d& from, const Vec3d& to, float width,
                  const std::string& text, Sketch& sketch);
/// A gap of `metres` between two points, with its length `clearance` pixels away along `aside`.
void draw_labelled_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres,
                       float clearance, const Vec3d& aside, Sketch& sketch);
/// The best axis of every query, or only the one that was chosen.
void draw_sat_axes(const Scene& scene, const trace::Pair& pair, bool all_queries, Sketch& sketch);
/// The two edges of an edge contact, named by number: those of the separating axis test as far as the
/// Gauss map is recorded, without that test those in the id of the point.
void draw_deciding_edges(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// The boxes of a mesh's tree that the query looked at, and the triangles that it found.
void draw_tree(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// What a scenario calls the pair, above its shapes where it covers none.
void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_coherent_points(const trace::Pair& pair, Sketch& sketch);
/// The points of an incremental manifold by what became of them, and how far their places drifted.
void draw_persistent_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// The outline of both shapes without their margins.
void draw_cores(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// What a body stands on, and about what it turns where that does not hold it.
void draw_support(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// What the panel "stability" shows of the pair, for the legend.
void explain_stability_panel(const trace::Pair& pair, Sketch& sketch);
/// Centres of mass of bodies, and the projection of the pair's into the contact plane.
void draw_centers_of_mass(const Scene& scene, Sketch& sketch);
/// The points on both shapes that GJK's simplex, or EPA's nearest face, comes from.
void draw_simplex_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_velocities(const Scene& scene, Sketch& sketch);
void draw_masses(const Scene& scene, Sketch& sketch);
/// How fast the bodies of the pair move against each other at their points.
void draw_relative_velocity(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
/// Where bodies would be a frame later if nothing stopped them, and gaps that contacts look ahead
/// over.
void draw_ahead(const Scene& scene, Sketch& sketch);
/// How deep the pair is, measured beside its deepest point.
void draw_overlap(const Scene& scene, const trace::Pair& pair, Sketch& sketch);
void draw_impulses(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

}  // namespace contactscope::draw
