#include "draw/stages_shown.h"

#include <algorithm>
#include <string>

namespace contactscope::draw {
namespace {

template <class Word>
bool shows_any(const View& view, std::initializer_list<Word> words) {
  return std::ranges::any_of(words, [&](Word word) { return view.shows(word); });
}

}  // namespace

trace::Stages stages_shown(const std::vector<View>& views) {
  trace::Stages stages = trace::Stages::none();
  for (const View& view : views) {
    stages.sat = stages.sat ||
                 shows_any(view, {Layer::SatAxes, Layer::ContactAxis, Layer::Contacts}) ||
                 shows_any(view, {Panel::Summary, Panel::AxisHistory});
    stages.clip = stages.clip || view.story == Story::ClipSteps ||
                  shows_any(view, {Layer::ReferenceFace, Layer::IncidentFace, Layer::SidePlanes,
                                   Layer::ClipPolygons, Layer::Dropped, Layer::Coherent}) ||
                  shows_any(view, {Panel::ContactPlane});
    const bool minkowski = shows_any(view, {Panel::Minkowski});
    const bool gauss_map = shows_any(view, {Panel::GaussMap});
    const bool steps = minkowski || view.story == Story::GjkSteps ||
                       view.story == Story::EpaSteps ||
                       shows_any(view, {Layer::Simplex, Layer::Core});
    stages.minkowski = stages.minkowski || minkowski;
    // Where shapes are apart, what kept them apart says where the gap is.
    stages.gjk = stages.gjk || steps || shows_any(view, {Layer::Contacts});
    stages.penetration = stages.penetration || steps;
    stages.gauss_map = stages.gauss_map || gauss_map;
    stages.sat = stages.sat || gauss_map;
    stages.tree = stages.tree || shows_any(view, {Layer::Tree});
    stages.stability = stages.stability || shows_any(view, {Layer::CenterOfMass, Layer::Support}) ||
                       shows_any(view, {Panel::Stability});
    stages.reduction =
        stages.reduction || view.kind == ViewKind::ContactPlane ||
        shows_any(view, {Layer::Contacts, Layer::Reduced, Layer::Ids, Layer::Coherent}) ||
        shows_any(view, {Panel::Summary, Panel::ContactPlane});
  }
  return stages;
}

}  // namespace contactscope::draw
