#pragma once

#include "core/standard.h"

/// Layers of a view, in drawing order. A row has the enumerator and the name used in scenarios and
/// on the command line. Each layer has its own file in render/draw/layers, which defines
/// kShapesLayer etc.
// clang-format off
#define CONTACTSCOPE_LAYERS(ROW)               \
  ROW(Shapes, "shapes")                        \
  ROW(CenterOfMass, "center_of_mass")          \
  ROW(ReferenceFace, "reference_face")         \
  ROW(SidePlanes, "side_planes")               \
  ROW(ClipPolygons, "clip_polygons")           \
  ROW(Dropped, "dropped")                      \
  ROW(IncidentFace, "incident_face")           \
  ROW(Features, "features")                    \
  ROW(Candidates, "candidates")                \
  ROW(Tree, "tree")                            \
  ROW(Cells, "cells")                          \
  ROW(Bounds, "bounds")                        \
  ROW(CandidatePairs, "candidate_pairs")       \
  ROW(Islands, "islands")                      \
  ROW(Field, "field")                          \
  ROW(Intersections, "intersections")          \
  ROW(Volumes, "volumes")                      \
  ROW(TestedAxes, "tested_axes")               \
  ROW(Answer, "answer")                        \
  ROW(SatAxes, "sat_axes")                     \
  ROW(SatQueries, "sat_queries")               \
  ROW(Projections, "projections")              \
  ROW(ContactAxis, "contact_axis")             \
  ROW(Orientation, "orientation")              \
  ROW(Core, "core")                            \
  ROW(Simplex, "simplex")                      \
  ROW(Support, "support")                      \
  ROW(Coherent, "coherent")                    \
  ROW(Normals, "normals")                      \
  ROW(Exits, "ways_out")                     \
  ROW(Contacts, "contacts")                    \
  ROW(Reduced, "reduced")                      \
  ROW(SurfacePoints, "surface_points")         \
  ROW(Ids, "ids")                              \
  ROW(FlipDistance, "flip_distance")           \
  ROW(Persistent, "persistent")                \
  ROW(Impulses, "impulses")                    \
  ROW(Loads, "loads")                          \
  ROW(Friction, "friction")                    \
  ROW(Overlap, "overlap")                      \
  ROW(RelativeVelocity, "relative_velocity")   \
  ROW(Ahead, "ahead")                          \
  ROW(Sweep, "sweep")                          \
  ROW(Trail, "trail")                          \
  ROW(Prism, "prism")                          \
  ROW(Velocities, "velocities")                \
  ROW(Masses, "masses")                        \
  ROW(Names, "names")

/// Panels of a view, in the same form.
#define CONTACTSCOPE_PANELS(ROW)               \
  ROW(Summary, "summary")                      \
  ROW(Worst, "worst")                          \
  ROW(Lint, "lint")                            \
  ROW(Overlaps, "overlaps")                    \
  ROW(ContactPlane, "contact_plane")           \
  ROW(AxisHistory, "axis_history")             \
  ROW(Code, "code")                            \
  ROW(Stability, "stability")                  \
  ROW(Plots, "plots")                          \
  ROW(Pipeline, "pipeline")                    \
  ROW(Endpoints, "endpoints")                  \
  ROW(NodePairs, "node_pairs")                 \
  ROW(TreeCost, "tree_cost")                   \
  ROW(AxisIntervals, "axis_intervals")         \
  ROW(Answers, "answers")                      \
  ROW(Approach, "approach")                    \
  ROW(Minkowski, "minkowski")                  \
  ROW(GaussMap, "gauss_map")

/// Charts that panels plot over the time of a sequence, in the same form.
#define CONTACTSCOPE_CHARTS(ROW)               \
  ROW(Overlap, "overlap")                      \
  ROW(Energy, "energy")                        \
  ROW(Impulse, "impulse")                      \
  ROW(Points, "points")                        \
  ROW(Ids, "ids")                              \
  ROW(Margin, "margin")                        \
  ROW(Verdict, "verdict")
// clang-format on

namespace contactscope {

#define CONTACTSCOPE_ENUMERATOR(word, name) word,
#define CONTACTSCOPE_NAME(word, name) std::string_view(name),

enum class Layer { CONTACTSCOPE_LAYERS(CONTACTSCOPE_ENUMERATOR) };
inline constexpr std::array kLayerNames = {CONTACTSCOPE_LAYERS(CONTACTSCOPE_NAME)};

enum class Panel { CONTACTSCOPE_PANELS(CONTACTSCOPE_ENUMERATOR) };
inline constexpr std::array kPanelNames = {CONTACTSCOPE_PANELS(CONTACTSCOPE_NAME)};

enum class Chart { CONTACTSCOPE_CHARTS(CONTACTSCOPE_ENUMERATOR) };
inline constexpr std::array kChartNames = {CONTACTSCOPE_CHARTS(CONTACTSCOPE_NAME)};

#undef CONTACTSCOPE_ENUMERATOR
#undef CONTACTSCOPE_NAME

constexpr std::string_view name_of(Layer layer) {
  return kLayerNames[static_cast<std::size_t>(layer)];
}
constexpr std::string_view name_of(Panel panel) {
  return kPanelNames[static_cast<std::size_t>(panel)];
}

/// The Layer, Panel or Chart with that name; nullopt if there is none.
template <class Word, std::size_t N>
constexpr std::optional<Word> word_named(const std::array<std::string_view, N>& names,
                                         std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Word>(found - names.begin());
}

}  // namespace contactscope
