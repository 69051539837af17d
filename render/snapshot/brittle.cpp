#include "snapshot/compare_trace.h"

namespace contactscope::snapshot {
namespace {

// As in compare_trace.cpp: rounding of all stages, relative to the larger shape.
constexpr double kRoundings = 16;

/// Largest coordinate of a pair's shapes and positions, metres.
double extent_of(const trace::Header& header, const trace::Frame& frame, const trace::Pair& pair) {
  double extent = 0;
  for (const trace::Shape& shape : header.shapes) {
    if (shape.name != pair.a && shape.name != pair.b) continue;
    for (const Vec3d& vertex : shape.vertices)
      extent = std::max(extent, vertex.lpNorm<Eigen::Infinity>());
    extent = std::max(extent, shape.radius);
  }
  for (const auto& [name, pose] : frame.poses)
    if (name == pair.a || name == pair.b)
      extent = std::max(extent, pose.position.lpNorm<Eigen::Infinity>());
  return extent;
}

}  // namespace

std::vector<std::string> brittle_decisions(const trace::Header& header, const trace::Frame& frame) {
  const double ulp = std::ldexp(1.0, header.scalar == "double" ? -52 : -23);
  std::vector<std::string> sentences;
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.decisions.empty()) continue;
    const double extent = extent_of(header, frame, pair);
    const double least = kRoundings * ulp;
    const auto axis = std::ranges::find(pair.decisions, "axis", &trace::Decision::stage);
    for (const trace::Decision& decision : pair.decisions) {
      // The best face of a hull does not matter if another axis made the contact.
      if (decision.stage.starts_with("face_") &&
          (axis == pair.decisions.end() || axis->took != decision.stage))
        continue;
      std::string by;
      if (decision.margin && *decision.margin <= least * extent)
        by = spell_length(std::max(*decision.margin, 0.0));
      else if (decision.margin_area && *decision.margin_area <= least * extent * extent)
        by = "no area";
      else if (decision.margin_cosine && *decision.margin_cosine <= least)
        by = "no angle";
      if (by.empty()) continue;
      sentences.push_back("frame " + std::to_string(frame.frame) + ", " + pair.a + "-" + pair.b +
                          (pair.label.empty() ? "" : " (" + pair.label + ")") + ": " +
                          decision.stage + ": " + decision.took + " over " + decision.over +
                          " by " + by +
                          ", which is within rounding: another machine may choose differently");
    }
  }
  return sentences;
}

TakenDecisions take_decisions(const std::vector<int>& stored, const std::vector<View>& views,
                              const trace::Header& header, std::vector<trace::Frame>& frames) {
  const bool requested = std::ranges::any_of(views, [](const View& view) {
    return view.shows(Layer::FlipDistance) || view.shows(Panel::Code);
  });
  TakenDecisions taken;
  for (trace::Frame& frame : frames) {
    if (std::ranges::count(stored, frame.frame) > 0) {
      std::ranges::copy(brittle_decisions(header, frame), std::back_inserter(taken.brittle));
      for (const trace::Pair& pair : frame.pairs)
        if (!pair.decisions.empty()) taken.margins[{frame.frame, key_of(pair)}] = pair.decisions;
    }
    if (requested) continue;
    for (trace::Pair& pair : frame.pairs) {
      pair.decisions.clear();
      if (pair.sat) pair.sat->tolerance.reset();
    }
  }
  return taken;
}

}  // namespace contactscope::snapshot
