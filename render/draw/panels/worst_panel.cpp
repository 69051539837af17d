#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr float kBetweenRankings = 6;  // pixels at 720 lines
constexpr double kNumberColumn = 18;
constexpr float kRowHeight = 0.9f;  // of a line of text: rows are numbers on bars, read across

constexpr std::size_t kRankedRows = 5, kFewRankedRows = 3;

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
      most_ = std::clamp(frame.pairs.size(), most_, most_rows_);
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
                    ranked_pairs(frame, ranking.by, most_rows_, staging_.meshes, before(moment))};
    });
    const std::size_t left_out = divide(all, sheet);
    for (const Ranked& one : all) draw_ranking(one, moment, sheet);
    return sheet.more(left_out, "ranking", "rankings");
  }

 private:
  std::vector<Ranking> rankings() const {
    std::vector<Ranking> shown;
    for (const Ranking& ranking : kRankings) {
      if (is_of_pair_ && ranking.by != Rank::Overlap) continue;
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
    while (all.front().rows > 1 && !fits()) --all.front().rows;
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
    // The picture numbers the pairs and marks the first one, unless others are in focus.
    const std::vector<std::string>& focus = staging_.view.focus_on;
    const bool is_numbered = ranking.by == Rank::Overlap && focus.empty();
    const auto is_in_focus = [&](const std::string& name) {
      return std::ranges::find(focus, name) != focus.end();
    };
    for (std::size_t i = 0; i < std::min(rows, ranked.size()); ++i) {
      const Rect row = {sheet.rest().x, sheet.rest().y, sheet.rest().width,
                        static_cast<double>(row_height())};
      const double share = ranked[i].value / ranked.front().value;
      pen.fill({row.x, row.y, share * row.width, row.height - pen.px(2)},
               with_alpha(ranking.color, 0.16f));
      const trace::Pair& pair = *ranked[i].pair;
      const bool is_marked =
          focus.size() == 2 ? is_in_focus(pair.a) && is_in_focus(pair.b) : is_numbered && i == 0;
      const Weight weight = is_marked ? Weight::Bold : Weight::Regular;
      const Color ink = is_marked ? kContact : kText;
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
      pen.text(pen.fitted(pair_name(pair), weight, room),
               pixel(row.x + static_cast<double>(name), baseline), Align::Left, ink, weight);
      sheet.skip_to(row.bottom());
    }
    sheet.skip_to(static_cast<double>(end));
  }

  bool has_impulses_ = false;
  /// A pair in focus has the room for its charts.
  const bool is_of_pair_ = staging_.view.focus_on.size() == 2;
  const std::size_t most_rows_ = is_of_pair_ ? kFewRankedRows : kRankedRows;
  std::size_t most_ = 1;  // rows of a ranking
};

// Pixels at 720 lines.
constexpr double kMinBars = 40, kMaxBars = 120, kBelowBars = 20, kAboveBars = 18, kBinLabel = 13;

constexpr int kShownDecades = 4;  // below the deepest overlap of the sequence; the rest share a bin
constexpr std::array kBinEnds = {1.0, 2.0, 5.0};
constexpr int kBins = kShownDecades * static_cast<int>(kBinEnds.size()) + 1;

using Bins = std::array<std::size_t, kBins>;

/// Histogram of the overlaps of a frame's points. The bins end at 1, 2 and 5 times powers of ten,
/// and are the same in all frames of a sequence, as is their height for a point.
class OverlapsPanel : public PanelContent {
 public:
  OverlapsPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    double deepest = 0;  // metres
    each_overlap(frames, [&](double overlap) { deepest = std::max(deepest, overlap); });
    if (deepest <= 0) return;
    // Upper ends, from the least; the last one is at least the deepest overlap.
    int last = static_cast<int>(std::floor(3 * std::log10(deepest))) - 2;
    while (end_at(last) < deepest) ++last;
    first_ = last - kBins + 1;
    for (const trace::Frame& frame : frames)
      most_ = std::max(most_, std::ranges::max(bins_of(frame)));
  }

  PanelNeed need(const PanelMoment&) const override {
    return need_of(kMinBars, 1.5 * kMinBars, kMaxBars, kAboveBars + kBelowBars);
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    const trace::Frame& frame = frames_[moment.frame];
    const Bins bins = bins_of(frame);
    const auto overlapping = std::accumulate(bins.begin(), bins.end(), std::int64_t{0});
    double deepest = 0;
    each_overlap({&frame, 1}, [&](double overlap) { deepest = std::max(deepest, overlap); });
    const auto points = static_cast<std::int64_t>(count_contacts(frame).points);
    sheet.heading(points == 0 ? "overlaps: no contact points"
                              : "overlaps of " + spell_count(overlapping) + " of " +
                                    spell_count(points) + " points");
    if (most_ == 0) {
      sheet.line("no point overlaps in any frame", kText);
      return {};
    }
    const Pen pen(sheet.pen().drawing(), sheet.pen().scale(), kBinLabel);
    const Rect rest = sheet.rest();
    const double top = rest.y + pen.px(kAboveBars);
    const double height =
        std::min<double>(pen.px(kMaxBars), rest.bottom() - pen.px(kBelowBars) - top);
    const double foot = top + height, width = rest.width / kBins;
    const int marked = deepest > 0 ? bin_of(deepest) : -1;
    for (int i = 0; i < kBins; ++i) {
      const std::size_t count = bins[static_cast<std::size_t>(i)];
      const double left = rest.x + i * width;
      const double high = height * static_cast<double>(count) / static_cast<double>(most_);
      const Rect bar = {left + pen.px(1), foot - high, width - pen.px(2), high};
      pen.fill(bar, i == marked ? kContact : with_alpha(kContact, 0.45f));
      if (count > 0)
        pen.text(Said{std::to_string(count)}, pixel(left + 0.5 * width, bar.y - pen.px(4)),
                 Align::Center, i == marked ? kContact : kQuietText,
                 i == marked ? Weight::Bold : Weight::Regular);
      // A label at each power of ten.
      const int end = first_ + i;
      if (((end % 3) + 3) % 3 != 0) continue;
      const double right = left + width;
      pen.line(pixel(right, foot), pixel(right, foot + pen.px(4)), 1, kQuietText);
      if (right > rest.right() - pen.px(12)) continue;
      const Prefix unit = staging_.scales.length.value_or(prefix_for(end_at(end)));
      pen.text(Said{spell_number(end_at(end) / unit.size) + " " + unit.name + "m"},
               pixel(right, foot + pen.px(17)), Align::Center, kQuietText);
    }
    pen.line(pixel(rest.x, foot), pixel(rest.right(), foot), 1.2, kQuietText);
    sheet.skip_to(foot + pen.px(kBelowBars));
    return {};
  }

 private:
  template <class Visit>
  static void each_overlap(std::span<const trace::Frame> frames, const Visit& visit) {
    for (const trace::Frame& frame : frames)
      for (const trace::Pair& pair : frame.pairs)
        for (const auto& [manifold, point] : all_points(pair))
          if (point->separation < 0) visit(-point->separation);
  }

  /// 1, 2 or 5 times a power of ten, metres; 0 is 1 m.
  static double end_at(int index) {
    const int decade = static_cast<int>(std::floor(index / 3.0));
    return kBinEnds[static_cast<std::size_t>(index - 3 * decade)] * std::pow(10.0, decade);
  }

  int bin_of(double overlap) const {
    int bin = 0;
    while (bin + 1 < kBins && end_at(first_ + bin) < overlap) ++bin;
    return bin;
  }

  Bins bins_of(const trace::Frame& frame) const {
    Bins bins{};
    each_overlap({&frame, 1},
                 [&](double overlap) { ++bins[static_cast<std::size_t>(bin_of(overlap))]; });
    return bins;
  }

  int first_ = 0;         // end of the first bin
  std::size_t most_ = 0;  // points in a bin
};

}  // namespace

const PanelDrawing kWorstPanel{.make = make_panel<WorstPanel>};

const PanelDrawing kOverlapsPanel{.make = make_panel<OverlapsPanel>};

}  // namespace contactscope::draw
