#pragma once

#include <memory>
#include <vector>

#include "core/view.h"
#include "draw/insets/contact_cells.h"
#include "draw/insets/inset.h"
#include "draw/layers/layer.h"
#include "draw/scene/camera.h"
#include "draw/scene/layout.h"
#include "draw/scene/scene.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// What a whole sequence shares, so that only what changes moves: layout, camera, and the factor by
/// which overlaps are exaggerated.
struct Staging {
  const trace::Header* header = nullptr;  // outlives the staging
  View view;
  const LayerTable* layers = &kLayers;
  ShapeMeshes meshes;
  Layout layout;
  Camera camera;
  double depth_factor = 1;
  std::shared_ptr<const ContactCells> cells{};  // of a contact plane, which has no camera
  SequenceScales scales{};
  std::vector<Inset> insets{};  // of the view's panels; `view` names the others
};

/// Looks through all frames, and draws none. The view's own eye, target and lens are used where it
/// names them; the rest is fitted: to the contact patches, seen from 30 degrees above the contact
/// plane and about half as wide as the view, or to all shapes when nothing touches or the view asks
/// for it.
Staging stage(const trace::Header& header, const std::vector<trace::Frame>& frames,
              const View& view, int width, int height, const LayerTable& layers = kLayers);

}  // namespace contactscope::draw
