#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {

// Gregorius 2015, "Hull vs Hull: Face Contact".
void draw_reference_face(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip || !scene.shows(Layer::ReferenceFace)) return;
  const trace::Polygon& polygon = pair.clip->reference.polygon;
  sketch.surfaces.push_back({polygon, with_alpha(kReferenceFace, 0.35f)});
  sketch.outline(polygon, {3.0f, kReferenceFace});
  sketch.explain(LegendKind::ReferenceFace, "reference face");
}

void draw_incident_face(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip || !scene.shows(Layer::IncidentFace)) return;
  const trace::Polygon& polygon = pair.clip->incident.polygon;
  sketch.surfaces.push_back({polygon, with_alpha(kIncidentFace, 0.35f)});
  sketch.outline(polygon, {3.0f, kIncidentFace, true});
  sketch.explain(LegendKind::IncidentFace, "incident face");
}

}  // namespace contactscope::draw
