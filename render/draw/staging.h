#pragma once

#include "draw/insets/contact_cells.h"
#include "draw/insets/inset.h"
#include "draw/layers/layer.h"
#include "draw/viewports.h"
#include "view/title.h"

namespace contactscope::draw {

/// A title with placeholders, and their values over the whole sequence.
struct StagedTitle {
  Title title;
  /// Text of each placeholder over the sequence, in order of the pieces; empty without a value.
  std::vector<std::string> of_sequence;
};

/// Data that all pictures of a sequence share, so that only changes move.
struct Staging {
  const trace::Header* header = nullptr;  // outlives the staging
  View view;
  const LayerTable* layers = &kLayers;
  ShapeMeshes meshes;
  Layout layout;
  Camera camera;
  std::shared_ptr<const ContactCells> cells{};  // of a contact plane view, which has no camera
  FigureStyle style{};
  Moments moments{};
  SequenceScales scales{};
  std::shared_ptr<const SequencePoses> sequence{};  // if a layer looks back
  std::vector<Inset> insets{};                      // insets of the view; `view` has the rest
  StagedTitle title{};
  std::vector<PairViewport> viewports{};  // if the view shows pairs side by side
  std::optional<Magnifier> magnifier{};
  /// Whether the camera was fitted to all shapes except those that are outside of `home`.
  bool leaves_out = false;
};

/// Frames that the camera is fitted to.
struct FittedFrames {
  std::vector<trace::Frame> frames;
  bool all = true;  // false: a sample of the drawn frames
};

/// Prepares a sequence from all frames, without drawing. Uses the view's eye, target and lens if
/// given. Otherwise fits the camera to the contact patches (30 degrees above the contact plane,
/// patches half as wide as the view), or to all shapes without contact or if the view requests it.
/// Fits views of pairs to the `stored` frames, if any. finish() applies the rest of the style.
///
/// `fitted`: of a trace, the frames that are drawn. The camera then leaves out bodies outside the
/// HomeRegion of these frames, and the parts of large shapes around it. Without `fitted`, as for a
/// scenario, it fits all frames, and leaves bodies out only if some fly far off.
Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& view, int width, int height, const FigureStyle& style = {},
              const LayerTable& layers = kLayers, const std::vector<int>& stored = {},
              const FittedFrames* fitted = nullptr);

/// Frame and shapes that Focus::Deepest or Worst means; no shapes if none overlap.
Fault::Place place_in_focus(const View& view, const std::vector<trace::Frame>& frames,
                            const ShapeMeshes& meshes);

/// Draws one frame from the trace alone, without computing contacts. Equal frames give equal
/// drawings.
Drawing illustrate(const Staging& staging, const trace::Frame& frame);

/// The result of the view's layers for this frame, in the world.
Sketch sketch_frame(const Staging& staging, const trace::Frame& frame);

/// The layers' input for a frame of a staged view.
Scene scene_of(const Staging& staging, const trace::Frame& frame);

/// Legend of the whole picture, without drawing, and the labels that replace entries. Signs shared
/// by layers, insets and panels are explained once.
LegendChoice legend_of(const Staging& staging, const trace::Frame& frame);

/// Draws a pair's label above its shapes, if possible without covering any. If several pairs share
/// a label, only the last one gets it, the top one of a stack. `pair` belongs to the scene.
void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

/// Marks the pairs that the panel lint lists.
void draw_faults(const Scene& scene, Sketch& sketch);

/// Names up to three shapes, copies once, on the shapes and away from the contact: "A: floor".
void draw_shape_names(const Scene& scene, Sketch& sketch);

/// Optional stages of the pipeline that the layers and panels of these views need.
Stages stages_shown(const std::vector<View>& views);

// title.cpp

/// Examines the frames if a placeholder refers to all of them.
StagedTitle stage_title(const std::string& text, const std::vector<trace::Frame>& frames,
                        const LengthUnit& unit = {});

/// The first alternative for which this frame has all values; otherwise the last, with "…" for
/// others.
std::string fill_title(const Staging& staging, const trace::Frame& frame);

/// Adds the optional stages of the pipeline that a title needs.
void add_stages(const Title& title, Stages& stages);

}  // namespace contactscope::draw
