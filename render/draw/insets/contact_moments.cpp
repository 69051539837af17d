#include "draw/insets/contact_cells.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kLittle = 0.01;  // share of the depth

std::string percent(double share) {
  const double value = 100 * share;
  // Only exactly whole shares are written as 100 %.
  if (value > 99.9995) return "100 %";
  const int decimals = value > 99.94 ? 3 : value < 0.995 ? 2 : 1;
  return printed("%.*f %%", decimals, value);
}

std::vector<ContactCell::Row> rows_of(const trace::ReducerAnswer& answer) {
  const std::string area = "area " + percent(answer.area_ratio);
  std::vector<ContactCell::Row> rows = {
      {area, answer.median ? printed("%.0f ns", *answer.median) : "", area}};
  const double lost = 100 * answer.wrench_error;
  if (answer.wrench_error > 1e-6)
    rows.push_back({printed("lost arm %.1f %% of r", lost), "", printed("arm −%.0f %%", lost)});
  else
    rows.push_back({"no arm lost", "", "arm whole"});
  const bool tips_over = answer.supports_center_of_mass == false;
  const std::string verdict = answer.deepest_kept ? "kept" : "lost";
  const std::string brief = tips_over ? verdict + ", tips over" : "deepest " + verdict;
  rows.push_back(
      {tips_over ? "deepest " + brief : brief, "", brief, !answer.deepest_kept || tips_over});
  return rows;
}

// Relative to the largest coordinate: sixteen units in the last place of a float.
constexpr double kNoise = 16 * 1.1920929e-7;

/// Metres: smaller differences between the separations of a patch's points count as equal, because
/// the rounding of positions in float is as large.
double separation_noise(const std::vector<trace::Point>& points) {
  double largest = 0;
  for (const trace::Point& point : points)
    largest = std::max({largest, point.position.cwiseAbs().maxCoeff(),
                        (point.position - points.front().position).norm()});
  return kNoise * largest;
}

std::vector<ContactCell::Row> rows_of(const trace::Reduction& reduction) {
  const bool has_best = reduction.best_area > 0;
  const std::string area = spell_area(reduction.area);
  const std::string share = has_best ? percent(reduction.area / reduction.best_area) : area;
  double deepest = 0, kept = 0;
  std::vector<ContactCell::Row> rows = {
      {has_best ? share + " of the largest area, " + area : "area " + area, "", "area " + share,
       has_best}};
  if (deepest_points(reduction.points).empty()) return rows;  // no information for a level patch
  for (const trace::Point& point : reduction.points) deepest = std::min(deepest, point.separation);
  for (const int i : reduction.kept) kept = std::min(kept, at(reduction.points, i).separation);
  const bool has_deepest = kept - deepest <= separation_noise(reduction.points);
  const bool matters = kept - deepest > kLittle * -deepest;
  rows.push_back({has_deepest ? "deepest kept, " + spell_length(-deepest)
                  : matters   ? "deepest lost: " + spell_length(-deepest) +
                                  ", deepest kept: " + spell_length(-kept)
                            : "deepest lost by " + spell_length(kept - deepest),
                  "", has_deepest ? "deepest kept" : "deepest lost", !has_deepest && matters});
  return rows;
}

}  // namespace

std::vector<int> deepest_points(const std::vector<trace::Point>& points) {
  const auto [least, most] = std::ranges::minmax_element(points, {}, &trace::Point::separation);
  if (least == points.end()) return {};
  const double noise = separation_noise(points);
  if (most->separation - least->separation <= noise) return {};
  std::vector<int> deepest;
  for (int i = 0; i < count_of(points); ++i)
    if (at(points, i).separation - least->separation <= noise) deepest.push_back(i);
  return deepest;
}

std::vector<ContactMoment> explored(const std::vector<trace::Exploration>& sequence,
                                    const std::vector<std::string>& order) {
  std::vector<ContactMoment> moments;
  for (const trace::Exploration& exploration : sequence) {
    ContactMoment& moment = moments.emplace_back();
    moment.frame = exploration.frame;
    if (exploration.a.empty()) {  // points without shapes
      moment.caption = std::to_string(exploration.points.size()) + " points";
    } else {
      moment.caption = name_in_words(exploration.a) + " and " + name_in_words(exploration.b);
      if (!exploration.label.empty()) moment.caption += " (" + exploration.label + ")";
    }
    if (exploration.triangle)
      moment.caption += ", triangle " + std::to_string(*exploration.triangle);
    if (!exploration.a.empty()) moment.caption += ", frame " + std::to_string(exploration.frame);
    for (const std::string& name : order) {
      const trace::ReducerAnswer& answer =
          *std::ranges::find(exploration.reducers, name, &trace::ReducerAnswer::name);
      ContactCell& cell = moment.cells.emplace_back();
      cell.name = in_words(name);
      cell.normal = exploration.normal;
      cell.points = exploration.points;
      cell.kept = answer.kept;
      if (exploration.points.size() > answer.kept.size()) cell.best = exploration.best;
      cell.rows = rows_of(answer);
    }
  }
  return moments;
}

std::vector<ContactMoment> reduced(const std::vector<trace::Frame>& frames,
                                   const Moments& labelled) {
  // A pair may touch in some frames only, but its cell is in all of them.
  const std::vector<const trace::Pair*> cells =
      distinct_pairs(frames, [](const trace::Pair& pair) { return pair.reduction.has_value(); });
  const bool several_bodies = std::ranges::any_of(cells, [&](const trace::Pair* pair) {
    return pair->a != cells.front()->a || pair->b != cells.front()->b;
  });
  std::set<std::string_view> labels;
  for (const trace::Pair* pair : cells) labels.insert(pair->label);
  const bool labels_distinguish = labels.size() == cells.size();
  std::vector<ContactMoment> moments = mapped(frames, [&](const trace::Frame& frame) {
    // Points without shapes have no time either.
    const bool is_timeless = !frame.pairs.empty() && frame.pairs.front().a.empty();
    ContactMoment moment{frame.frame, is_timeless ? std::string() : labelled.of(frame), {}};
    if (!is_timeless) moment.time = frame.time;
    return moment;
  });
  for (const trace::Pair* known : cells) {
    const std::string& method = known->reduction->method;
    std::string name =
        known->label.empty() || known->label == method ? in_words(method) : known->label;
    if (several_bodies && !labels_distinguish)
      name = name_in_words(known->a) + " and " + name_in_words(known->b) + ": " + name;
    const std::vector<const trace::Pair*> history = pair_history(frames, *known);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      ContactCell& cell = moments[f].cells.emplace_back();
      cell.name = name;
      cell.pair = known->a + " " + known->b;
      const trace::Pair* pair = history[f];
      if (pair == nullptr || !pair->reduction || pair->manifolds.empty()) continue;
      const trace::Reduction& reduction = *pair->reduction;
      cell.normal = pair->manifolds.front().normal;
      cell.points = reduction.points;
      cell.kept = reduction.kept;
      cell.best = reduction.best;
      cell.choices = reduction.choices;
      cell.rows = rows_of(reduction);
    }
  }
  return moments;
}

}  // namespace contactscope::draw
