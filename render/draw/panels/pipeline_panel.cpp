#include <algorithm>
#include <cmath>
#include <cstdint>

#include "draw/panels/panel.h"
#include "draw/scene/answers.h"
#include "draw/scene/pair_words.h"
#include "draw/scene/quantity.h"

/// How many pairs each stage of the pipeline let through: the survey's "Collision Pipeline",
/// Gregorius 2015, "Collision Pipeline".
namespace contactscope::draw {
namespace {

constexpr double kBarHeight = 10, kAfterBar = 6;  // pixels at 720 lines
constexpr float kSpacing = 5;                     // likewise, between rows of a sheet

struct StageCount {
  std::string name;
  std::int64_t count;
  Color color;
};

/// What the narrow phase does with the pairs of a sequence.
struct PairUse {
  bool asked = false;     // some are asked whether they overlap, or how far apart they are
  bool collided = false;  // some are asked for their contacts
};

PairUse use_of(const Frames& frames) {
  PairUse use;
  for (const trace::Frame& frame : frames)
    for (const trace::Pair& pair : frame.pairs) (pair.query ? use.asked : use.collided) = true;
  if (!use.asked) use.collided = true;  // also where no pair comes so far
  return use;
}

std::vector<StageCount> stages_of(const trace::Frame& frame, const PairUse& use) {
  std::vector<StageCount> stages;
  const int shapes = count_of(frame.poses);
  if (frame.broad_phase) {
    stages.push_back({"pairs of " + std::to_string(shapes) + " shapes",
                      std::int64_t{shapes} * (shapes - 1) / 2, kShapeEdge});
    const bool ends = frame.broad_phase->method == "sweep_and_prune";
    stages.push_back({ends ? "ends that passed each other" : "pairs of boxes compared",
                      frame.broad_phase->comparisons, with_alpha(kDropped, 0.7f)});
    stages.push_back({"boxes overlap: narrow phase", frame.broad_phase->pairs, kBox});
  } else {
    stages.push_back({"pairs: narrow phase", count_of(frame.pairs), kBox});
  }
  int asked = 0, overlapping = 0, touching = 0, points = 0;
  for (const trace::Pair& pair : frame.pairs) {
    asked += pair.query.has_value();
    overlapping += pair.query && pair.query->touching.value_or(pair.overlap.value_or(false));
    touching += !pair.manifolds.empty();
    for (const trace::Manifold& manifold : pair.manifolds) points += count_of(manifold.points);
  }
  if (use.asked) {
    stages.push_back({"pairs asked, no contacts made", asked, with_alpha(kBox, 0.6f)});
    stages.push_back({"of these overlap or touch", overlapping, answer_color(AnswerKind::Yes)});
  }
  if (use.collided) {
    stages.push_back({"pairs in contact", touching, with_alpha(kContact, 0.6f)});
    stages.push_back({"contact points", points, kContact});
  }
  return stages;
}

/// What a bar is as long as: a stage often lets one of a thousand through.
double digits(std::int64_t count) {
  return std::log10(1 + static_cast<double>(count));
}

class PipelinePanel : public PanelContent {
 public:
  PipelinePanel(const Staging& staging, const Frames& frames)
      : frames_(frames), use_(use_of(frames)), scale_(staging.layout.scale) {
    for (const trace::Frame& frame : frames)
      for (const StageCount& stage : stages_of(frame, use_)) most_ = std::max(most_, stage.count);
  }

  PanelNeed need(const PanelMoment& moment) const override {
    const auto rows = static_cast<float>(stages_of(frames_[moment.frame], use_).size());
    const float bar = static_cast<float>(kBarHeight + kAfterBar) * scale_;
    const float height = Sheet::heading_height(scale_) + Sheet::line_height(scale_) +
                         rows * (Sheet::line_height(scale_) + bar + kSpacing * scale_);
    return {height, height, height, 0};
  }

  /// A bar a stage, on the same scale in every frame, so that a bar that grows is a count that
  /// does.
  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    sheet.heading(frame.broad_phase ? "broad phase: " + in_words(frame.broad_phase->method)
                                    : "what each stage lets through");
    for (const StageCount& stage : stages_of(frame, use_)) {
      const Rect row = sheet.rest();
      const Pen& pen = sheet.pen();
      const std::string number = spell_count(stage.count);
      pen.text(number,
               {static_cast<float>(row.right()),
                static_cast<float>(row.y) + pen.px(1) + sheet.text_height() * 0.86f},
               Align::Right, kText, Weight::Bold);
      sheet.line(stage.name, kText);
      const Rect rest = sheet.rest();
      const double share = digits(stage.count) / std::max(1.0, digits(most_));
      const double width = stage.count == 0 ? 0 : std::max(1.0, rest.width * share);
      pen.fill({rest.x, rest.y, rest.width, pen.px(kBarHeight)}, with_alpha(kDropped, 0.1f));
      pen.fill({rest.x, rest.y, width, pen.px(kBarHeight)}, stage.color);
      sheet.skip(pen.px(kBarHeight + kAfterBar));
    }
    sheet.line("bars on a logarithmic scale", kQuietText);
    return {};
  }

 private:
  const Frames& frames_;
  PairUse use_;
  float scale_;
  std::int64_t most_ = 0;
};

}  // namespace

std::unique_ptr<PanelContent> make_pipeline_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<PipelinePanel>(staging, frames);
}

}  // namespace contactscope::draw
