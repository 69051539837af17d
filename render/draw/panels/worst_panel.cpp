#include <algorithm>
#include <cmath>

#include "draw/panels/panel.h"
#include "draw/scene/contact_facts.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr float kBetweenRankings = 6;  // pixels at 720 lines
constexpr double kNumberColumn = 18;
constexpr float kRowHeight = 0.9f;  // of a line of text: rows are numbers on bars, read across

constexpr std::size_t kRankedRows = 5;
constexpr std::size_t kFewRankedRows = 3;

struct Ranking {
  Rank by;
  const char* title;
  Color color;
};
constexpr Ranking kRankings[] = {
    {Rank::Overlap, "by overlap", kContact},
    {Rank::Impulse, "by impulse", kImpulse},
    {Rank::Change, "by change of overlap since the last frame", kDropped},
};

struct Ranked {
  Ranking ranking;
  std::vector<RankedPair> pairs{};
  std::size_t rows = 1;
};

/// The pairs of a frame with the largest overlaps, impulses and changes, among any number of pairs.
class WorstPanel : public PanelContent {
 public:
  WorstPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    for (const trace::Frame& frame : frames) {
      most_ = std::clamp(frame.pairs.size(), most_, kRankedRows);
      for (const trace::Pair& pair : frame.pairs)
        has_impulses_ = has_impulses_ || impulse_of(pair) > 0;
    }
  }

  PanelNeed need(const PanelMoment&) const override {
    const float heading = Sheet::heading_height(scale_);
    return {heading + height_of(most_), heading + height_of_all(std::min(kFewRankedRows, most_)),
            heading + height_of_all(most_), 0};
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
    std::vector<Ranked> all = mapped(rankings(), [&](const Ranking& ranking) {
      return Ranked{ranking,
                    ranked_pairs(frame, ranking.by, kRankedRows, staging_.meshes, before(moment))};
    });
    const std::size_t left_out = divide(all, sheet);
    for (const Ranked& one : all) draw_ranking(one, moment, sheet);
    return sheet.more(left_out, "ranking", "rankings");
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

  float row_height() const { return std::floor(kRowHeight * Sheet::line_height(scale_)); }
  /// Height of a ranking, pixels.
  float height_of(std::size_t rows) const {
    return Sheet::line_height(scale_) + static_cast<float>(rows) * row_height() +
           kBetweenRankings * scale_;
  }
  float height_of_all(std::size_t rows_of_others) const {
    return height_of(most_) + static_cast<float>(rankings().size() - 1) * height_of(rows_of_others);
  }

  /// Divides the room: overlaps have all rows, because the picture has their numbers, and the others
  /// the rest in turns. Returns the number of rankings without room.
  std::size_t divide(std::vector<Ranked>& all, const Sheet& sheet) const {
    constexpr double kWholePixels = 1;  // a panel's area is cut to whole pixels
    const std::size_t count = all.size();
    const auto fits = [&] {
      float height = all.size() < count ? sheet.line_height() : 0;  // of the note
      for (const Ranked& one : all) height += height_of(one.rows);
      return static_cast<double>(height) <= sheet.rest().height + kWholePixels;
    };
    all.front().rows = std::max<std::size_t>(all.front().pairs.size(), 1);
    while (all.size() > 1 && !fits()) all.pop_back();
    for (std::size_t rows = 2; rows <= kRankedRows; ++rows)
      for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].rows + 1 != rows || rows > all[i].pairs.size()) continue;
        ++all[i].rows;
        if (!fits()) --all[i].rows;
      }
    return count - all.size();
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

  void draw_ranking(const Ranked& one, const PanelMoment& moment, Sheet& sheet) const {
    const auto& [ranking, ranked, rows] = one;
    const trace::Frame& frame = frames_[moment.frame];
    const float end = static_cast<float>(sheet.rest().y) + height_of(rows);
    sheet.line(ranking.title, kQuietText);
    if (ranked.empty())
      sheet.line(ranking.by == Rank::Change && before(moment) == nullptr
                     ? "no frame before this one"
                     : "none",
                 kText);
    const Pen& pen = sheet.pen();
    const bool is_numbered = ranking.by == Rank::Overlap;
    for (std::size_t i = 0; i < std::min(rows, ranked.size()); ++i) {
      const Rect row = {sheet.rest().x, sheet.rest().y, sheet.rest().width,
                        static_cast<double>(row_height())};
      const double share = ranked[i].value / ranked.front().value;
      pen.fill({row.x, row.y, share * row.width, row.height - pen.px(2)},
               with_alpha(ranking.color, 0.16f));
      const bool is_first = is_numbered && i == 0;
      const Weight weight = is_first ? Weight::Bold : Weight::Regular;
      const Color ink = is_first ? kContact : kText;
      const double baseline = row.y + 0.77 * row.height;
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
  std::size_t most_ = 1;  // rows of a ranking
};

}  // namespace

const PanelDrawing kWorstPanel{.make = make_panel<WorstPanel>};

}  // namespace contactscope::draw
