#include "draw/charts/time_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

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

/// Pairs by the names of their shapes, in the order of their first contact, and what they did.
class Pairs {
 public:
  explicit Pairs(std::size_t frames) : frames_(frames) {}

  std::size_t index(const trace::Pair& pair) {
    const auto [entry, is_new] = known_.try_emplace({pair.a, pair.b}, series_.size());
    if (is_new) {
      const std::vector<double> none(frames_, kNone);
      series_.push_back({pair.a + "–" + pair.b, none, none});
    }
    return entry->second;
  }
  void note(const trace::Pair& pair, const trace::Point& point, std::size_t frame) {
    PairSeries& series = series_[index(pair)];
    double& depth = series.penetration[frame];
    depth = std::max(std::isnan(depth) ? 0.0 : depth, -point.separation);
    double& impulse = series.impulse[frame];
    if (std::isnan(impulse)) impulse = 0;
    if (point.impulse) impulse += point.impulse->normal;
  }
  std::string deepest(std::size_t frame) const {
    const PairSeries* most = nullptr;
    for (const PairSeries& series : series_) {
      if (std::isnan(series.penetration[frame])) continue;
      if (most == nullptr || series.penetration[frame] > most->penetration[frame]) most = &series;
    }
    return most == nullptr ? "" : most->name;
  }
  std::vector<PairSeries> take() { return std::move(series_); }
  std::size_t size() const { return series_.size(); }

 private:
  std::size_t frames_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;
  std::vector<PairSeries> series_;
};

class Ids {
 public:
  Ids(std::size_t frames, TimeSeries& series) : frames_(frames), series_(series) {}

  void note(const trace::Pair& pair, std::size_t pair_index, const trace::Point& point,
            std::size_t frame, IdState state) {
    const std::string key = pair.a + '\n' + pair.b + '\n' + point.id;
    const auto [entry, is_new] = known_.try_emplace(key, series_.ids.size());
    if (is_new) {
      series_.ids.emplace_back(frames_, IdState::Absent);
      series_.id_pairs.push_back(pair_index);
    }
    IdState& now = series_.ids[entry->second][frame];
    if (now != IdState::Kept) now = state;
  }

 private:
  std::size_t frames_;
  TimeSeries& series_;
  std::map<std::string, std::size_t> known_;
};

TimeSeries one_series(const std::vector<trace::Frame>& frames, const std::string& label,
                      const std::map<std::string, std::set<std::string>>& groups) {
  TimeSeries series;
  series.name = label;
  Ids ids(frames.size(), series);
  Pairs pairs(frames.size());
  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double deepest = 0, points = 0, impulse = 0, energy = 0;
    std::string query;
    for (const trace::Pair& pair : frames[f].pairs) {
      if (pair.label != label) continue;
      if (pair.incremental && query.empty()) query = pair.incremental->query;
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          deepest = std::max(deepest, -point.separation);
          points += 1;
          if (point.impulse) impulse += point.impulse->normal;
          pairs.note(pair, point, f);
          ids.note(pair, pairs.index(pair), point, f, IdState::Kept);
        }
      }
      if (!pair.reduction) continue;
      for (const trace::Point& point : pair.reduction->points) {
        ids.note(pair, pairs.index(pair), point, f, IdState::Dropped);
      }
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
    for (std::size_t f = 0; f < frames.size(); ++f) series.deepest.push_back(pairs.deepest(f));
  } else if (pairs.size() > 1) {
    series.pairs = pairs.take();
    if (!solved) {
      for (PairSeries& pair : series.pairs) pair.impulse.clear();
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
