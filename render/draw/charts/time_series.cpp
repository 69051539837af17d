#include "draw/charts/series_chart.h"

#include <unordered_set>
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

/// Number of lines that a chart can distinguish.
constexpr std::size_t kMaxPairLines = 4;

/// A pair that touches in some frame: its place in their order, and rows of its ids.
struct KnownPair {
  std::size_t index;
  std::map<std::string_view, std::size_t> rows{};
};

/// The deepest pair of a frame; the first if equal.
struct Deepest {
  const trace::Pair* pair = nullptr;
  double depth = 0;  // metres
};

std::string name_of_pair(const trace::Pair& pair) {
  return name_in_words(pair.a) + " and " + name_in_words(pair.b);
}

/// Series of a label during the pass over the frames.
struct Group {
  TimeSeries series;
  std::vector<PairSeries> pairs;  // the first in order of their first contact
  std::size_t touching = 0;       // number of pairs that touch in some frame, or more than lines
  std::vector<Deepest> deepest;   // by frame
  std::unordered_map<std::string_view, std::unordered_map<std::string_view, KnownPair>> known;
  std::unordered_set<std::string_view> bodies;
  std::string query, last_query;  // of the current and the previous frame
};

/// Method that measured a pair's depth: the query of an incremental manifold's cores; for a round
/// shape and a hull "shallow" for closest points, or "deep" if its core is inside (Gregorius 2015,
/// "Shallow and Deep Penetration"). Empty for others.
std::string measured_by(const trace::Pair& pair) {
  if (pair.incremental) return pair.incremental->query;
  const bool round = pair.kind == "hull-sphere" || pair.kind == "hull-capsule";
  if (!round || pair.manifolds.size() != 1) return {};
  return pair.manifolds.front().axis == "closest_points" ? "shallow" : "deep";
}

void add_pair(const trace::Pair& pair, std::size_t f, std::size_t frames, bool with_ids,
              Group& group) {
  TimeSeries& series = group.series;
  if (group.query.empty()) group.query = measured_by(pair);
  if (std::ranges::all_of(pair.manifolds, &std::vector<trace::Point>::empty,
                          &trace::Manifold::points) &&
      (!pair.reduction || pair.reduction->points.empty()))
    return;
  KnownPair* own = nullptr;
  if (with_ids || group.touching <= kMaxPairLines) {
    const auto [entry, is_new] = group.known[pair.a].try_emplace(pair.b, KnownPair{group.touching});
    if (is_new && group.touching++ < kMaxPairLines) {
      const std::vector<double> none(frames, std::numeric_limits<double>::quiet_NaN());
      group.pairs.push_back({name_of_pair(pair), none, none});
    }
    own = &entry->second;
  }
  PairSeries* const line =
      own != nullptr && own->index < group.pairs.size() ? &group.pairs[own->index] : nullptr;
  const auto note_id = [&](const trace::Point& point, IdState state) {
    if (!with_ids) return;
    const auto [row, is_new_id] = own->rows.try_emplace(point.id, series.ids.size());
    if (is_new_id) {
      series.ids.emplace_back(frames, IdState::Absent);
      series.id_pairs.push_back(own->index);
    }
    IdState& now = series.ids[row->second][f];
    now = std::max(now, state);
  };
  Deepest& most = group.deepest[f];
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      const double depth = -point.separation, load = point.impulse ? point.impulse->normal : 0;
      series.penetration[f] = std::max(series.penetration[f], depth);
      series.points[f] += 1;
      series.impulse[f] += load;
      if (most.pair == nullptr || depth > most.depth) most = {&pair, std::max(0.0, depth)};
      note_id(point, IdState::Kept);
      if (line == nullptr) continue;
      double& own_depth = line->penetration[f];
      double& own_impulse = line->impulse[f];
      own_depth = std::fmax(own_depth, std::max(0.0, depth));  // a number wins over NaN
      own_impulse = (std::isnan(own_impulse) ? 0.0 : own_impulse) + load;
    }
  }
  if (!pair.reduction) return;
  for (const trace::Point& point : pair.reduction->points) note_id(point, IdState::Dropped);
}

/// Whether bodies move without kinetic energy: the trace does not record it.
bool lacks_energies(const std::vector<trace::Frame>& frames) {
  bool moves = false;
  for (const trace::Frame& frame : frames) {
    if (!frame.solver) continue;
    for (const trace::Body& body : frame.solver->bodies) {
      if (body.kinetic_energy != 0) return false;
      moves = moves || !body.velocity.isZero(0) || !body.angular_velocity.isZero(0);
    }
  }
  return moves;
}

}  // namespace

std::vector<TimeSeries> time_series(const std::vector<trace::Frame>& frames, bool with_ids) {
  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  std::vector<Group> groups;  // by label, in order of appearance
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (const trace::Pair& pair : frames[f].pairs) {
      auto group = std::ranges::find(
          groups, pair.label, [](const Group& g) -> const std::string& { return g.series.name; });
      if (group == groups.end()) {
        group = groups.emplace(group);
        TimeSeries& series = group->series;
        series.name = pair.label;
        for (auto* values : {&series.penetration, &series.impulse, &series.points, &series.energy})
          values->assign(frames.size(), 0);
        group->deepest.resize(frames.size());
      }
      if (solved) group->bodies.insert({pair.a, pair.b});
      add_pair(pair, f, frames.size(), with_ids, *group);
    }
    for (Group& group : groups) {
      if (!group.query.empty() && !group.last_query.empty() && group.query != group.last_query)
        group.series.queries.push_back({f, in_words(group.last_query), in_words(group.query)});
      group.last_query = std::exchange(group.query, "");
    }
  }
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!frames[f].solver) continue;
    for (const trace::Body& body : frames[f].solver->bodies) {
      const auto has_body = [&](const Group& group) { return group.bodies.contains(body.name); };
      const bool is_alone = std::ranges::none_of(groups, has_body);
      for (Group& group : groups)
        if (is_alone || has_body(group)) group.series.energy[f] += body.kinetic_energy;
    }
  }
  const bool has_energy = solved && !lacks_energies(frames);
  std::vector<TimeSeries> all;
  for (Group& group : groups) {
    TimeSeries& series = all.emplace_back(std::move(group.series));
    if (group.touching > kMaxPairLines) {
      for (const Deepest& most : group.deepest)
        series.deepest.push_back(most.pair == nullptr ? "" : name_of_pair(*most.pair));
    } else if (group.pairs.size() > 1) {
      series.pairs = std::move(group.pairs);
    }
    if (!has_energy) series.energy.clear();
    // A bouncing ball would change too often.
    std::erase_if(series.queries, [&](const SeriesChart::Change& change) {
      return solved && (change.before == "shallow" || change.after == "shallow");
    });
    if (solved) continue;
    series.impulse.clear();
    for (PairSeries& pair : series.pairs) pair.impulse.clear();
  }
  return all;
}

}  // namespace contactscope::draw
