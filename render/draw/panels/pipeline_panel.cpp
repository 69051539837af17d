#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// Number of pairs that pass each stage of the pipeline: the survey's "Collision Pipeline",
/// Gregorius 2015, "Collision Pipeline".
namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kCountText = 15, kBeforeBar = 4, kBarHeight = 14, kAfterBar = 14;
constexpr double kLargest = 1.4;  // factor of these sizes if there is room

struct StageCount {
  std::string name;
  std::int64_t count;
  Color color;
  bool of_pairs = true;  // bars compare pairs only, not ends or points
};

/// Use of pairs by the narrow phase in a sequence.
struct PairUse {
  bool requested = false;  // some pairs have a query of overlap or distance
  bool collided = false;   // some pairs compute contacts
};

PairUse use_of(const View& view, const Frames& frames) {
  PairUse use;
  // A view of broad phase cells alone does not show later stages.
  if (view.shows(Layer::Cells) && !view.shows(Layer::Contacts)) return use;
  for (const trace::Frame& frame : frames)
    for (const trace::Pair& pair : frame.pairs) (pair.query ? use.requested : use.collided) = true;
  if (!use.requested) use.collided = true;  // even if no pair gets that far
  return use;
}

// Few boxes make a single column that is only swept, so it is called a sweep, as in the view.
std::string name_of(const trace::BroadPhase& phase) {
  return phase.method == "columns" && phase.cells.size() == 1 ? "sweep along " + phase.swept
                                                              : in_words(phase.method);
}

std::vector<StageCount> stages_of(const trace::Frame& frame, const PairUse& use) {
  std::vector<StageCount> stages;
  const int shapes = count_of(frame.poses);
  if (frame.broad_phase) {
    stages.push_back({"pairs of " + std::to_string(shapes) + " shapes",
                      std::int64_t{shapes} * (shapes - 1) / 2, kShapeEdge});
    const bool ends = frame.broad_phase->method == "sweep_and_prune";
    stages.push_back({ends ? "ends that passed each other" : "tests of two boxes",
                      frame.broad_phase->comparisons, with_alpha(kDropped, 0.7f), !ends});
    stages.push_back({"whose boxes overlap", frame.broad_phase->pairs, kBox});
  } else {
    stages.push_back({"pairs: narrow phase", count_of(frame.pairs), kBox});
  }
  int requested = 0, overlapping = 0, touching = 0, points = 0;
  for (const trace::Pair& pair : frame.pairs) {
    requested += pair.query.has_value();
    overlapping += pair.query && pair.query->touching.value_or(pair.overlap.value_or(false));
    touching += !pair.manifolds.empty();
    for (const trace::Manifold& manifold : pair.manifolds) points += count_of(manifold.points);
  }
  if (use.requested) {
    stages.push_back({"pairs asked, no contacts made", requested, with_alpha(kBox, 0.6f)});
    stages.push_back({"of these overlap or touch", overlapping, answer_color(AnswerKind::Yes)});
  }
  if (use.collided) {
    stages.push_back({"pairs in contact", touching, with_alpha(kContact, 0.6f)});
    stages.push_back({"contact points", points, kContact, false});
  }
  return stages;
}

class PipelinePanel : public PanelContent {
 public:
  PipelinePanel(const Staging& staging, const Frames& frames)
      : PanelContent(staging, frames), use_(use_of(staging.view, frames)) {
    for (const trace::Frame& frame : frames)
      for (const StageCount& stage : stages_of(frame, use_))
        if (stage.of_pairs) most_ = std::max(most_, stage.count);
  }

  PanelNeed need(const PanelMoment& moment) const override {
    const float rows = scale_ * height_of(stages_of(frames_[moment.frame], use_));
    const float heading = Sheet::heading_height(scale_);
    const float large = heading + static_cast<float>(kLargest) * rows;
    return {heading + rows, large, large, 0};
  }

  /// One bar for each count of pairs, with one scale for all frames, so that bars can be compared
  /// between frames. Everything is enlarged if there is room.
  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    sheet.heading(frame.broad_phase ? "broad phase: " + name_of(*frame.broad_phase)
                                    : "what each stage lets through");
    const std::vector<StageCount> stages = stages_of(frame, use_);
    const Rect rest = sheet.rest();
    const Pen& pen = sheet.pen();
    const double larger =
        std::clamp(rest.height / static_cast<double>(scale_ * height_of(stages)), 1.0, kLargest);
    const double size = larger * kCountText;
    double y = rest.y;
    for (const StageCount& stage : stages) {
      const double baseline = y + 0.86 * static_cast<double>(pen.px(size));
      const std::string number = spell_count(stage.count);
      pen.text(number, pixel(rest.right(), baseline), Align::Right, kText, Weight::Bold, size);
      const float taken = text_width(number, pen.px(size), Weight::Bold) + pen.px(size);
      pen.text(
          pen.fitted(stage.name, Weight::Regular, static_cast<float>(rest.width) - taken, size),
          pixel(rest.x, baseline), Align::Left, kText, Weight::Regular, size);
      y += static_cast<double>(pen.px(larger * (kCountText + kBeforeBar)));
      if (stage.of_pairs) {
        const double share = static_cast<double>(stage.count) / static_cast<double>(most_);
        const double width = stage.count == 0 ? 0 : std::max<double>(pen.px(2), rest.width * share);
        const double high = pen.px(larger * kBarHeight);
        pen.fill({rest.x, y, rest.width, high}, with_alpha(kDropped, 0.1f));
        pen.fill({rest.x, y, width, high}, stage.color);
        y += high;
      }
      y += static_cast<double>(pen.px(larger * kAfterBar));
    }
    sheet.skip_to(y);
    return {};
  }

 private:
  /// Minimum height of all rows, pixels at 720 lines.
  static float height_of(const std::vector<StageCount>& stages) {
    double height = 0;
    for (const StageCount& stage : stages)
      height += kCountText + kBeforeBar + kAfterBar + (stage.of_pairs ? kBarHeight : 0);
    return static_cast<float>(height);
  }

  PairUse use_;
  std::int64_t most_ = 1;  // pairs
};

}  // namespace

const PanelDrawing kPipelinePanel{.make = make_panel<PipelinePanel>};

}  // namespace contactscope::draw
