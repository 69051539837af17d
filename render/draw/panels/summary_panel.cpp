#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kUsualRows = 5;  // for two hulls in contact
constexpr float kAroundRows = 2.2f;    // lines of text: heading and space below
constexpr float kBetweenPairs = 0.4f;  // of the text height

// "point on face"; for a mesh with many manifolds each type once.
std::string types_of(const trace::Pair& pair) {
  std::vector<std::string> types;
  for (const trace::Manifold& manifold : pair.manifolds)
    if (std::ranges::find(types, manifold.type) == types.end()) types.push_back(manifold.type);
  return separated(types, ", ", spell_features);
}

// "hull and hull" for "hull-hull".
std::string kinds_in_words(std::string kind) {
  const std::size_t dash = kind.find('-');
  return dash == std::string::npos ? kind : kind.replace(dash, 1, " and ");
}

std::string kept_of_all(const trace::Pair& pair) {
  const std::size_t kept = all_points(pair).size();
  const std::string text = std::to_string(kept);
  if (pair.manifolds.size() > 1)
    return text + " in " + std::to_string(pair.manifolds.size()) + " manifolds";
  if (!pair.reduction || pair.reduction->points.size() <= kept) return text;
  return text + " of " + std::to_string(pair.reduction->points.size()) + ", by " +
         in_words(pair.reduction->method);
}

/// Calls `add` for each row with its name and a function that spells its value.
template <class Add>
void for_each_row(const Staging& staging, const trace::Frame& frame, const trace::Pair& pair,
                  Add&& add) {
  if (pair.query) {
    add("asked", [&] { return spell_question(*pair.query); });
    add("answer", [&] { return spell_answer(pair, staging.scales.length); });
    add("by", [&] { return in_words(pair.query->method); });
    return;
  }
  add("pair", [&] { return kinds_in_words(pair.kind); });
  add("state", [&] { return spell_state(state_of(pair, staging.scales.touching)); });
  if (pair.sat) add("axis", [&] { return spell_axis(pair.sat->chosen); });
  if (!pair.manifolds.empty() && !types_of(pair).empty())  // other engines record no types
    add("contact", [&] { return types_of(pair); });
  add(gap_or_overlap(pair.separation), [&] {
    return spell_length(std::abs(pair.separation),
                        noise_of(*staging.header, staging.meshes, frame, pair),
                        staging.scales.length);
  });
  if (!pair.manifolds.empty()) add("points", [&] { return kept_of_all(pair); });
  if (pair.incremental) {
    const trace::Incremental& incremental = *pair.incremental;
    add("cores", [&] {
      return std::string(incremental.query == "gjk" ? "apart, by " : "overlap, by ") +
             in_words(incremental.query);
    });
    add("confirmed", [&] { return "by " + incremental.confirm; });
  }
  if (pair.degenerate) {
    add("no normal", [&] {
      return pair.degenerate->geometry +
             (pair.degenerate->answer == "skip" ? "; no contact made" : "; a direction is chosen");
    });
  }
}

// A degenerate geometry needs a second line. Queries and answers are sentences that may wrap.
std::size_t lines_of(const Staging& staging, const trace::Frame& frame, const trace::Pair& pair) {
  const Layout& layout = staging.layout;
  const float width = static_cast<float>(layout.panels.width) - layout.px(2 * kPanelPadding);
  std::size_t lines = pair.degenerate ? 1 : 0;
  for_each_row(staging, frame, pair, [&](const char*, auto&& spell) {
    lines += pair.query ? Sheet::row_lines(spell(), width, layout.scale, layout.words) : 1;
  });
  return lines;
}

/// Results of the pipeline for each pair, and the time.
class SummaryPanel : public PanelContent {
 public:
  // A pair reserves the rows of a touching one, so that panels below do not move when it separates,
  // and at least the rows of the longest frame.
  SummaryPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    std::size_t rows = 1;
    for (const trace::Frame& frame : frames) {
      for (const trace::Pair& pair : frame.pairs) {
        const std::size_t least = pair.query ? 1 : kUsualRows;
        rows = std::max({rows, least, lines_of(staging, frame, pair)});
      }
    }
    pair_height_ = (kAroundRows + static_cast<float>(rows)) * Sheet::line_height(scale_);
  }

  PanelNeed need(const PanelMoment& moment) const override {
    const std::size_t all = frames_[moment.frame].pairs.size();
    const float least = height_of(std::min<std::size_t>(1, all), moment);
    return {least, least, height_of(all, moment), 0};
  }

  // As many pairs as fit completely. If some do not fit, those with the largest overlaps are shown.
  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const std::vector<trace::Pair>& pairs = frames_[moment.frame].pairs;
    constexpr float kWholePixels = 1;  // pixels; a panel's area is cut to whole pixels
    const auto room = static_cast<float>(sheet.rest().height) + kWholePixels;
    std::size_t shown = pairs.size();
    if (shown > 1 && height_of(shown, moment) > room) {
      const float others = std::max(0.0f, room - height_of(0, moment));
      shown = std::clamp<std::size_t>(static_cast<std::size_t>(others / pair_height_), 1,
                                      pairs.size() - 1);
    }
    std::vector<const trace::Pair*> order;
    for (const trace::Pair& pair : pairs) order.push_back(&pair);
    if (shown < pairs.size())
      std::ranges::stable_sort(order, std::ranges::greater(),
                               [](const trace::Pair* pair) { return overlap_of(*pair); });
    for (std::size_t i = 0; i < shown; ++i) {
      const trace::Pair& pair = *order[i];
      const std::string label = pair.label.empty() ? "" : pair.label + ": ";
      sheet.heading(label + pair.a + ", " + pair.b);
      for_each_row(staging_, frames_[moment.frame], pair,
                   [&](const char* name, auto&& spell) { sheet.row(name, spell()); });
      sheet.skip(kBetweenPairs * sheet.text_height());
    }
    std::string missing = sheet.more(pairs.size() - shown, "pair", "pairs");
    sheet.row("time", printed("%.3f s", frames_[moment.frame].time));
    if (may_sleep(moment)) {
      const std::vector<trace::Body>& bodies = frames_[moment.frame].solver->bodies;
      const auto asleep = std::ranges::count(bodies, std::optional(true), &trace::Body::asleep);
      sheet.row("asleep", std::to_string(asleep) + " of " + std::to_string(bodies.size()));
    }
    if (moment.pipeline_nanoseconds)
      sheet.row("pipeline", printed("%.2f µs", *moment.pipeline_nanoseconds / 1000));
    return missing;
  }

 private:
  bool may_sleep(const PanelMoment& moment) const {
    const auto& solver = frames_[moment.frame].solver;
    return solver && solver->sleep_after;
  }

  /// Height for this number of pairs, and a line for the others.
  float height_of(std::size_t pairs, const PanelMoment& moment) const {
    const bool all = pairs == frames_[moment.frame].pairs.size();
    const std::size_t lines =
        1 + may_sleep(moment) + moment.pipeline_nanoseconds.has_value() + !all;
    return pair_height_ * static_cast<float>(pairs) +
           Sheet::line_height(scale_) * static_cast<float>(lines);
  }

  float pair_height_ = 0;  // pixels
};

}  // namespace

const PanelDrawing kSummaryPanel{.needs = {&Stages::sat, &Stages::reduction, &Stages::query},
                                 .make = make_panel<SummaryPanel>};

}  // namespace contactscope::draw
