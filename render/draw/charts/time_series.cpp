#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "draw/charts/series_plots.h"
#include "draw/scene/pair_points.h"

namespace contactscope::draw {
namespace {

std::vector<std::string> labels_of(const std::vector<trace::Frame>& frames) {
  std::vector<std::string> labels;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (std::ranges::find(labels, pair.label) == labels.end()) labels.push_back(pair.label);
    }
  }
  return labels;
}

/// Which labels a body has pairs of.
std::map<std::string, std::set<std::string>> groups_of(const std::vector<trace::Frame>& frames) {
  std::map<std::string, std::set<std::string>> groups;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      groups[pair.a].insert(pair.label);
      groups[pair.b].insert(pair.label);
    }
  }
  return groups;
}

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

TimeSeries one_series(const std::vector<trace::Frame>& frames, const std::string& label,
                      const std::map<std::string, std::set<std::string>>& groups) {
  TimeSeries series;
  series.name = label;
  std::vector<PairSeries> pairs;  // in the order of their first contact
  std::map<std::array<std::string, 2>, std::size_t> pair_of;
  std::map<std::array<std::string, 3>, std::size_t> row_of;  // of ids
  const auto pair_index = [&](const trace::Pair& pair) {
    const auto [entry, is_new] = pair_of.try_emplace({pair.a, pair.b}, pairs.size());
    if (is_new) {
      const std::vector<double> none(frames.size(), kNone);
      pairs.push_back({pair.a + "–" + pair.b, none, none});
    }
    return entry->second;
  };
  const auto note_id = [&](const trace::Pair& pair, const trace::Point& point, std::size_t f,
                           IdState state) {
    const auto [entry, is_new] = row_of.try_emplace({pair.a, pair.b, point.id}, series.ids.size());
    if (is_new) {
      series.ids.emplace_back(frames.size(), IdState::Absent);
      series.id_pairs.push_back(pair_index(pair));
    }
    IdState& now = series.ids[entry->second][f];
    if (now != IdState::Kept) now = state;
  };

  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double deepest = 0, points = 0, impulse = 0, energy = 0;
    std::string query;
    for (const trace::Pair& pair : frames[f].pairs) {
      if (pair.label != label) continue;
      if (pair.incremental && query.empty()) query = pair.incremental->query;
      for (const PairPoint& any : all_points(pair)) {
        const trace::Point& point = *any.point;
        const double depth = -point.separation, load = point.impulse ? point.impulse->normal : 0;
        deepest = std::max(deepest, depth);
        points += 1;
        impulse += load;
        PairSeries& own = pairs[pair_index(pair)];
        double &own_depth = own.penetration[f], &own_impulse = own.impulse[f];
        own_depth = std::max(std::isnan(own_depth) ? 0.0 : own_depth, depth);
        own_impulse = (std::isnan(own_impulse) ? 0.0 : own_impulse) + load;
        note_id(pair, point, f, IdState::Kept);
      }
      if (!pair.reduction) continue;
      for (const trace::Point& point : pair.reduction->points)
        note_id(pair, point, f, IdState::Dropped);
    }
    if (frames[f].solver) {
      for (const trace::Body& body : frames[f].solver->bodies) {
        const auto known = groups.find(body.name);
        if (known == groups.end() || known->second.contains(label)) energy += body.kinetic_energy;
      }
    }
    series.penetration.push_back(deepest);
    series.points.push_back(points);
    series.query.push_back(query);
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
  const std::map<std::string, std::set<std::string>> groups = groups_of(frames);
  std::vector<TimeSeries> all;
  for (const std::string& label : labels_of(frames)) {
    all.push_back(one_series(frames, label, groups));
  }
  return all;
}

}  // namespace contactscope::draw
