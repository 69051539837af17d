#include "draw/layers/layer.h"
#include "draw/scene/mesh_surface.h"
#include "draw/scene/swatches.h"

namespace contactscope::draw {

// Gregorius 2015, "Hull vs Hull: Face Contact".
const LayerDrawing kReferenceFaceLayer{
    .needs = {&trace::Stages::clip},
    .beneath = draw_touched_triangles,
    .search =
        [](const Scene&, const trace::Pair& pair, Sketch& sketch) {
          if (!pair.clip) return;
          sketch.face(pair.clip->reference.polygon, with_alpha(kReferenceFace, 0.35f),
                      {3.0f, kReferenceFace});
          sketch.explain(kReferenceFaceSwatch, "reference face");
        },
};

const LayerDrawing kIncidentFaceLayer{
    .needs = {&trace::Stages::clip},
    .search =
        [](const Scene&, const trace::Pair& pair, Sketch& sketch) {
          if (!pair.clip) return;
          sketch.face(pair.clip->incident.polygon, with_alpha(kIncidentFace, 0.35f),
                      {3.0f, kIncidentFace, true});
          sketch.explain(kIncidentFaceSwatch, "incident face");
        },
};

}  // namespace contactscope::draw
