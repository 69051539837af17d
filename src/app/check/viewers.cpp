#include "app/check/viewers.h"

#include <sstream>

#include "app/check/reports/report.h"
#include "app/render/figure_canvas.h"
#include "draw/staging.h"
#include "view/title.h"
#include "viewer/viewer.h"

namespace contactscope::app {
namespace {

std::string viewer_of(const Scenario& scenario, const trace::Header& header,
                      const std::vector<trace::Frame>& frames) {
  draw::FigureStyle style;
  style.words = words_of(scenario);
  const draw::Staging staging = draw::stage(
      header, frames, scenario.views.front(), scenario.snapshots.width, scenario.snapshots.height,
      style, draw::kLayers, mapped(frames, &trace::Frame::frame));
  PictureOrigin origin;
  origin.scenario = scenario.name;
  origin.title = plain_title(scenario.title);
  viewer::Viewer page(staging, origin);
  for (const trace::Frame& frame : frames) page.add(frame);
  return page.html();
}

}  // namespace

void Viewers::add(const Scenario& scenario, const snapshot::StoredScenario& archive,
                  const Sequence& sequence, const std::string& candidate,
                  snapshot::ReportFolder& report) {
  constexpr int kMax = 20;
  if (candidate.empty() || viewer::three_script().empty() || scenarios_++ >= kMax) return;
  std::istringstream text(*snapshot::read_stored_trace(archive.root, archive.scenario));
  const trace::Trace stored = trace::read_trace(text, "stored");
  const auto add_page = [&](const trace::Header& header, const std::vector<trace::Frame>& frames,
                            const char* which) {
    report.add_file(viewer_path(candidate, which), viewer_of(scenario, header, frames));
  };
  add_page(sequence.header, sequence.frames, "actual");
  add_page(stored.header, stored.frames, "expected");
}

}  // namespace contactscope::app
