#include "draw/time_series.h"

#include <algorithm>
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

class Ids {
 public:
  Ids(std::size_t frames, std::vector<std::vector<IdState>>& rows) : frames_(frames), rows_(rows) {}

  void note(const trace::Pair& pair, const trace::Point& point, std::size_t frame, IdState state) {
    const std::string key = pair.a + '\n' + pair.b + '\n' + point.id;
    const auto [entry, is_new] = known_.try_emplace(key, rows_.size());
    if (is_new) rows_.emplace_back(frames_, IdState::Absent);
    IdState& now = rows_[entry->second][frame];
    if (now != IdState::Kept) now = state;
  }

 private:
  std::size_t frames_;
  std::vector<std::vector<IdState>>& rows_;
  std::map<std::string, std::size_t> known_;
};

TimeSeries one_series(const std::vector<trace::Frame>& frames, const std::string& label,
                      const std::map<std::string, std::set<std::string>>& groups) {
  TimeSeries series;
  series.name = label;
  Ids ids(frames.size(), series.ids);
  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double deepest = 0, points = 0, impulse = 0, energy = 0;
    for (const trace::Pair& pair : frames[f].pairs) {
      if (pair.label != label) continue;
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          deepest = std::max(deepest, -point.separation);
          points += 1;
          if (point.impulse) impulse += point.impulse->normal;
          ids.note(pair, point, f, IdState::Kept);
        }
      }
      if (!pair.reduction) continue;
      for (const trace::Point& point : pair.reduction->points) {
        ids.note(pair, point, f, IdState::Dropped);
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
    if (!solved) continue;
    series.energy.push_back(energy);
    series.impulse.push_back(impulse);
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
