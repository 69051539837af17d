#include "draw/panels/panel.h"
#include "draw/scene/contact_facts.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr float kBetweenRankings = 6;  // pixels at 720 lines
constexpr double kNumberColumn = 18;

struct Ranking {
  Rank by;
  std::size_t rows;
  const char* title;
  Color color;
};
constexpr Ranking kRankings[] = {
    {Rank::Overlap, 5, "by overlap", kContact},
    {Rank::Impulse, 3, "by impulse", kImpulse},
    {Rank::Change, 3, "by change of overlap since the last frame", kDropped},
};

/// The pairs of a frame with the largest overlaps, impulses and changes, among any number of pairs.
class WorstPanel : public PanelContent {
 public:
  WorstPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    for (const trace::Frame& frame : frames)
      for (const trace::Pair& pair : frame.pairs)
        has_impulses_ = has_impulses_ || impulse_of(pair) > 0;
  }

  PanelNeed need(const PanelMoment&) const override {
    const float heading = Sheet::heading_height(scale_);
    float all = heading;
    for (const Ranking& ranking : rankings()) all += height_of(ranking);
    return {heading + height_of(kRankings[0]), all, all, 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    const ContactCounts counts = count_contacts(frame);
    if (counts.pairs == 0) {
      sheet.heading("no pair in contact");
      return {};
    }
    sheet.heading("worst of " + spell_count(static_cast<std::int64_t>(counts.pairs)) +
                  (counts.pairs == 1 ? " pair" : " pairs") + " in contact");
    std::size_t left_out = 0;
    for (const Ranking& ranking : rankings()) {
      constexpr double kWholePixels = 1;  // a panel's area is cut to whole pixels
      if (left_out > 0 ||
          sheet.rest().height + kWholePixels < static_cast<double>(height_of(ranking))) {
        ++left_out;
        continue;
      }
      draw_ranking(ranking, moment, sheet);
    }
    return left_out == 0 ? "" : counted(left_out, "ranking", "rankings");
  }

 private:
  std::vector<Ranking> rankings() const {
    std::vector<Ranking> shown;
    for (const Ranking& ranking : kRankings) {
      if (ranking.by == Rank::Impulse && !has_impulses_) continue;
      if (ranking.by == Rank::Change && frames_.size() < 2) continue;
      shown.push_back(ranking);
    }
    return shown;
  }

  /// Pixels.
  float height_of(const Ranking& ranking) const {
    return static_cast<float>(ranking.rows + 1) * Sheet::line_height(scale_) +
           kBetweenRankings * scale_;
  }

  /// Nothing for the first frame, and if the frame before is missing.
  const trace::Frame* before(const PanelMoment& moment) const {
    if (moment.before != nullptr) return moment.before;
    const std::size_t frame = moment.frame;
    if (frame == 0 || frames_[frame].frame - frames_[frame - 1].frame != 1) return nullptr;
    return &frames_[frame - 1];
  }

  std::string spelled(Rank by, const trace::Frame& frame, const RankedPair& ranked) const {
    if (by == Rank::Impulse) return spell_quantity(ranked.value, "N s", 3, staging_.scales.load);
    return spell_length(ranked.value,
                        noise_of(*staging_.header, staging_.meshes, frame, *ranked.pair),
                        staging_.scales.length);
  }

  void draw_ranking(const Ranking& ranking, const PanelMoment& moment, Sheet& sheet) const {
    const trace::Frame& frame = frames_[moment.frame];
    const std::vector<RankedPair> ranked =
        ranked_pairs(frame, ranking.by, ranking.rows, staging_.meshes, before(moment));
    const float end = static_cast<float>(sheet.rest().y) + height_of(ranking);
    sheet.line(ranking.title, kQuietText);
    if (ranked.empty())
      sheet.line(ranking.by == Rank::Change && before(moment) == nullptr
                     ? "no frame before this one"
                     : "none",
                 kText);
    const Pen& pen = sheet.pen();
    const bool is_numbered = ranking.by == Rank::Overlap;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      const Rect row = {sheet.rest().x, sheet.rest().y, sheet.rest().width,
                        static_cast<double>(sheet.line_height())};
      const double share = ranked[i].value / ranked.front().value;
      pen.fill({row.x, row.y, share * row.width, row.height - pen.px(2)},
               with_alpha(ranking.color, 0.16f));
      const bool is_first = is_numbered && i == 0;
      const Weight weight = is_first ? Weight::Bold : Weight::Regular;
      const Color ink = is_first ? kContact : kText;
      const double baseline = row.y + 0.78 * row.height;
      const std::string value = spelled(ranking.by, frame, ranked[i]);
      pen.text(Said{value}, pixel(row.right() - pen.px(4), baseline), Align::Right, ink, weight);
      // The picture has the same numbers.
      if (is_numbered)
        pen.text(Said{std::to_string(i + 1)}, pixel(row.x + pen.px(4), baseline), Align::Left, ink,
                 Weight::Bold);
      const float name = pen.px(kNumberColumn);
      const float room =
          static_cast<float>(row.width) - name - pen.px(14) - pen.width_of(Said{value}, weight);
      pen.text(pen.fitted(pair_name(*ranked[i].pair), weight, room),
               pixel(row.x + static_cast<double>(name), baseline), Align::Left, ink, weight);
      sheet.skip_to(row.bottom());
    }
    sheet.skip_to(static_cast<double>(end));
  }

  bool has_impulses_ = false;
};

}  // namespace

const PanelDrawing kWorstPanel{.make = make_panel<WorstPanel>};

}  // namespace contactscope::draw
