#include "draw/stages_shown.h"

#include <algorithm>
#include <string>

namespace contactscope::draw {
namespace {

bool names_any(const std::vector<std::string>& names, std::initializer_list<const char*> wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

}  // namespace

trace::Stages stages_shown(const std::vector<View>& views) {
  trace::Stages stages = trace::Stages::none();
  for (const View& view : views) {
    stages.sat = stages.sat || names_any(view.layers, {"sat_axes", "contact_axis", "contacts"}) ||
                 names_any(view.panels, {"summary", "axis_history"});
    stages.clip = stages.clip || view.story == Story::ClipSteps ||
                  names_any(view.layers, {"reference_face", "incident_face", "side_planes",
                                          "clip_polygons", "dropped", "coherent"}) ||
                  names_any(view.panels, {"contact_plane"});
    const bool minkowski = names_any(view.panels, {"minkowski"});
    const bool gauss_map = names_any(view.panels, {"gauss_map"});
    const bool steps = minkowski || view.story == Story::GjkSteps ||
                       view.story == Story::EpaSteps || names_any(view.layers, {"simplex", "core"});
    stages.minkowski = stages.minkowski || minkowski;
    // Where shapes are apart, what kept them apart says where the gap is.
    stages.gjk = stages.gjk || steps || names_any(view.layers, {"contacts"});
    stages.penetration = stages.penetration || steps;
    stages.gauss_map = stages.gauss_map || gauss_map;
    stages.sat = stages.sat || gauss_map;
    stages.tree = stages.tree || names_any(view.layers, {"tree"});
    stages.stability = stages.stability || names_any(view.layers, {"center_of_mass", "support"}) ||
                       names_any(view.panels, {"stability"});
    stages.reduction = stages.reduction || view.kind == ViewKind::ContactPlane ||
                       names_any(view.layers, {"contacts", "reduced", "ids", "coherent"}) ||
                       names_any(view.panels, {"summary", "contact_plane"});
  }
  return stages;
}

}  // namespace contactscope::draw
