#include "draw/charts/series_chart.h"

#include <unordered_map>
#include <unordered_set>
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

/// Number of lines that a chart can distinguish.
constexpr std::size_t kMaxPairLines = 4;

/// Name of the deepest pair in a frame; the first if equal, empty without contact.
std::string deepest_of(const std::vector<PairSeries>& pairs, std::size_t frame) {
  const PairSeries* most = nullptr;
  for (const PairSeries& series : pairs)
    if (const double depth = series.penetration[frame];
        most == nullptr ? !std::isnan(depth) : depth > most->penetration[frame])
      most = &series;
  return most == nullptr ? "" : most->name;
}

/// A pair that touches in some frame: index of its series, and rows of its ids.
struct KnownPair {
  std::size_t index;
  std::map<std::string_view, std::size_t> rows{};
};

/// Series of a label during the pass over the frames.
struct Group {
  TimeSeries series;
  std::vector<PairSeries> pairs;  // in order of their first contact
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
  for (const std::string* body : {&pair.a, &pair.b}) group.bodies.insert(*body);
  if (group.query.empty()) group.query = measured_by(pair);
  const std::vector<PairPoint> contacts = all_points(pair);
  if (contacts.empty() && (!pair.reduction || pair.reduction->points.empty())) return;
  const auto [entry, is_new] =
      group.known[pair.a].try_emplace(pair.b, KnownPair{group.pairs.size()});
  if (is_new) {
    const std::vector<double> none(frames, std::numeric_limits<double>::quiet_NaN());
    group.pairs.push_back({name_in_words(pair.a) + " and " + name_in_words(pair.b), none, none});
  }
  KnownPair& own = entry->second;
  const auto note_id = [&](const trace::Point& point, IdState state) {
    if (!with_ids) return;
    const auto [row, is_new_id] = own.rows.try_emplace(point.id, series.ids.size());
    if (is_new_id) {
      series.ids.emplace_back(frames, IdState::Absent);
      series.id_pairs.push_back(own.index);
    }
    IdState& now = series.ids[row->second][f];
    now = std::max(now, state);
  };
  for (const PairPoint& any : contacts) {
    const trace::Point& point = *any.point;
    const double depth = -point.separation, load = point.impulse ? point.impulse->normal : 0;
    series.penetration[f] = std::max(series.penetration[f], depth);
    series.points[f] += 1;
    series.impulse[f] += load;
    double& own_depth = group.pairs[own.index].penetration[f];
    double& own_impulse = group.pairs[own.index].impulse[f];
    own_depth = std::fmax(own_depth, std::max(0.0, depth));  // a number wins over NaN
    own_impulse = (std::isnan(own_impulse) ? 0.0 : own_impulse) + load;
    note_id(point, IdState::Kept);
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
      }
      add_pair(pair, f, frames.size(), with_ids, *group);
    }
    for (Group& group : groups) {
      if (!group.query.empty() && !group.last_query.empty() && group.query != group.last_query)
        group.series.queries.push_back({f, in_words(group.last_query), in_words(group.query)});
      group.last_query = std::exchange(group.query, "");
    }
  }
  const bool solved = std::ranges::any_of(
      frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
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
    if (group.pairs.size() > kMaxPairLines) {
      for (std::size_t f = 0; f < frames.size(); ++f)
        series.deepest.push_back(deepest_of(group.pairs, f));
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
