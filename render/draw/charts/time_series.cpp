#include "draw/charts/time_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "draw/scene/pair_points.h"

namespace contactscope::draw {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A chart can tell so many lines apart.
constexpr std::size_t kMostPairLines = 4;

/// In one frame; the first of equals, empty where none touches.
std::string deepest_of(const std::vector<PairSeries>& pairs, std::size_t frame) {
  const PairSeries* most = nullptr;
  for (const PairSeries& series : pairs) {
    if (std::isnan(series.penetration[frame])) continue;
    if (most == nullptr || series.penetration[frame] > most->penetration[frame]) most = &series;
  }
  return most == nullptr ? "" : most->name;
}

/// A pair that touches in some frame: where its series is, and the rows of its ids.
struct KnownPair {
  std::size_t index;
  std::map<std::string_view, std::size_t> rows{};
};

/// Which labels a body has pairs of.
using Groups = std::map<std::string_view, std::set<std::string_view>>;

TimeSeries one_series(const std::vector<trace::Frame>& frames, const std::string& label,
                      const Groups& groups) {
  TimeSeries series;
  series.name = label;
  std::vector<PairSeries> pairs;  // in the order of their first contact
  std::map<std::pair<std::string_view, std::string_view>, KnownPair> known;
  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  std::string last_query;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double deepest = 0, points = 0, impulse = 0, energy = 0;
    std::string query;
    for (const trace::Pair& pair : frames[f].pairs) {
      if (pair.label != label) continue;
      if (pair.incremental && query.empty()) query = pair.incremental->query;
      const std::vector<PairPoint> contacts = all_points(pair);
      if (contacts.empty() && (!pair.reduction || pair.reduction->points.empty())) continue;
      const auto [entry, is_new] = known.try_emplace({pair.a, pair.b}, KnownPair{pairs.size()});
      KnownPair& own = entry->second;
      if (is_new) {
        const std::vector<double> none(frames.size(), kNone);
        pairs.push_back({pair.a + "–" + pair.b, none, none});
      }
      const auto note_id = [&](const trace::Point& point, IdState state) {
        const auto [row, is_new_id] = own.rows.try_emplace(point.id, series.ids.size());
        if (is_new_id) {
          series.ids.emplace_back(frames.size(), IdState::Absent);
          series.id_pairs.push_back(own.index);
        }
        IdState& now = series.ids[row->second][f];
        now = std::max(now, state);
      };
      for (const PairPoint& any : contacts) {
        const trace::Point& point = *any.point;
        const double depth = -point.separation, load = point.impulse ? point.impulse->normal : 0;
        deepest = std::max(deepest, depth);
        points += 1;
        impulse += load;
        double& own_depth = pairs[own.index].penetration[f];
        double& own_impulse = pairs[own.index].impulse[f];
        own_depth = std::fmax(own_depth, std::max(0.0, depth));  // of NaN and a number the number
        own_impulse = (std::isnan(own_impulse) ? 0.0 : own_impulse) + load;
        note_id(point, IdState::Kept);
      }
      if (!pair.reduction) continue;
      for (const trace::Point& point : pair.reduction->points) note_id(point, IdState::Dropped);
    }
    if (frames[f].solver) {
      for (const trace::Body& body : frames[f].solver->bodies) {
        const auto group = groups.find(body.name);
        if (group == groups.end() || group->second.contains(label)) energy += body.kinetic_energy;
      }
    }
    series.penetration.push_back(deepest);
    series.points.push_back(points);
    if (!query.empty() && !last_query.empty() && query != last_query)
      series.queries.push_back({f, last_query, query});
    last_query = query;
    if (!solved) continue;
    series.energy.push_back(energy);
    series.impulse.push_back(impulse);
  }
  if (pairs.size() > kMostPairLines) {
    for (std::size_t f = 0; f < frames.size(); ++f) series.deepest.push_back(deepest_of(pairs, f));
  } else if (pairs.size() > 1) {
    series.pairs = std::move(pairs);
    for (PairSeries& pair : series.pairs) {
      if (!solved) pair.impulse.clear();
    }
  }
  return series;
}

}  // namespace

std::vector<TimeSeries> time_series(const std::vector<trace::Frame>& frames) {
  Groups groups;
  std::vector<std::string> labels;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (std::ranges::find(labels, pair.label) == labels.end()) labels.push_back(pair.label);
      for (const std::string* body : {&pair.a, &pair.b}) groups[*body].insert(pair.label);
    }
  }
  std::vector<TimeSeries> all;
  for (const std::string& label : labels) all.push_back(one_series(frames, label, groups));
  return all;
}

}  // namespace contactscope::draw
