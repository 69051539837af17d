#pragma once

#include <memory>
#include <vector>

#include "core/view.h"
#include "draw/insets/contact_cells.h"
#include "draw/insets/inset.h"
#include "draw/layers/layer.h"
#include "draw/magnifier.h"
#include "draw/scene/moments.h"
#include "draw/title.h"
#include "draw/viewports.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// What a whole sequence shares, so that only what changes moves.
struct Staging {
  const trace::Header* header = nullptr;  // outlives the staging
  View view;
  const LayerTable* layers = &kLayers;
  ShapeMeshes meshes;
  Layout layout;
  Camera camera;
  std::shared_ptr<const ContactCells> cells{};  // of a contact plane, which has no camera
  FigureStyle style{};
  Moments moments{};
  SequenceScales scales{};
  std::shared_ptr<const SequencePoses> sequence{};  // where a layer looks back
  std::vector<Inset> insets{};                      // of the view's panels; `view` names the others
  StagedTitle title{};
  std::vector<PairViewport> viewports{};  // of a view whose pairs stand side by side
  std::optional<Magnifier> magnifier{};
};

/// Looks through all frames, and draws none. The view's own eye, target and lens are used where it
/// names them; the rest is fitted: to the contact patches, seen from 30 degrees above the contact
/// plane and about half as wide as the view, or to all shapes when nothing touches or the view asks
/// for it. Views of single pairs are fitted to the `stored` frames where some of these are there. What a style leaves to do with complete drawings, finish() does.
Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& view, int width, int height, const FigureStyle& style = {},
              const LayerTable& layers = kLayers, const std::vector<int>& stored = {});

/// One frame as the view shows it, made from the trace alone; nothing of the pipeline is computed
/// again. The same frame gives the same drawing.
Drawing illustrate(const Staging& staging, const trace::Frame& frame);

/// The part before pixels: what the view's layers add for this frame, in the world.
Sketch sketch_frame(const Staging& staging, const trace::Frame& frame);

/// What the frame is to the layers of a staged view.
Scene scene_of(const Staging& staging, const trace::Frame& frame);

/// The legend of the whole picture, without drawing it, and what labels say in its place. What
/// layers, insets and panels show alike is explained once.
LegendChoice legend_of(const Staging& staging, const trace::Frame& frame);

/// What a scenario calls the pair, above its shapes where it covers none. Of several pairs that
/// share a name the last one bears it: of a stack the uppermost. `pair` is one of the scene's.
void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

/// Whether shapes bear their names in the picture, so that no legend needs to list them.
bool names_shapes(const Scene& scene);
/// Names up to three shapes, copies once, on their own ground and away from the contact: "A:
/// floor".
void draw_shape_names(const Scene& scene, Sketch& sketch);

/// The optional stages of the pipeline that the layers and panels of these views look at. Manifolds
/// are always there.
Stages stages_shown(const std::vector<View>& views);

}  // namespace contactscope::draw
