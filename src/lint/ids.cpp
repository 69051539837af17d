#include "lint/watch.h"
#include "trace/find.h"

namespace contactscope::lint {
namespace {

/// Whether each point of one has a point of the other within `near` metres.
bool same_places(const trace::Pair& one, const trace::Pair& other, double near) {
  const auto candidates = joined(other.manifolds, &trace::Manifold::points);
  const auto has_place = [&](const trace::Point& point) {
    return std::ranges::any_of(candidates, [&](const trace::Point& candidate) {
      return (candidate.position - point.position).norm() <= near;
    });
  };
  return std::ranges::all_of(joined(one.manifolds, &trace::Manifold::points), has_place);
}

class IdsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs) see_alike(frames, pair);
    if (frames.before == nullptr) return earlier_.clear();
    for (const trace::Pair& pair : frames.now->pairs) {
      const trace::Pair* const before = same_pair(*frames.before, pair);
      if (before == nullptr) continue;
      const std::multiset<std::string> ids = trace::point_ids(pair),
                                       old = trace::point_ids(*before);
      if (ids.empty() || ids.size() != old.size() || !stands_still(solids, frames, pair)) continue;
      const std::optional<Placed> a = place(solids, frames.now, pair.a, {});
      const std::optional<Placed> b = place(solids, frames.now, pair.b, {});
      constexpr double kSamePlace = 1e-3;  // relative to the smaller shape
      const double near = kSamePlace * std::min(a->size(), b->size());
      if (!same_places(pair, *before, near)) continue;
      ++changed_.of;
      if (ids == old) {
        see_swapped(frames, pair, *before, near);
        continue;
      }
      // No point keeps its id. If all have their earlier ones again, nothing changed in between.
      std::vector<std::string> kept;
      std::ranges::set_intersection(ids, old, std::back_inserter(kept));
      constexpr int kLongest = 10;  // frames
      Earlier& earlier = earlier_[{pair.a, pair.b, pair.label}];
      const bool is_back =
          kept.empty() && ids == earlier.ids && frames.now->frame <= earlier.frame + kLongest;
      earlier = {old, frames.now->frame};
      const Mark mark{frames.now->frame, frames.now->line, pair.a, pair.b};
      changed_.wrong_at(mark, frames, is_back ? 1 : 0, [&] {
        std::vector<std::string> now, then;
        std::ranges::set_difference(ids, old, std::back_inserter(now));
        std::ranges::set_difference(old, ids, std::back_inserter(then));
        return std::pair("'" + now.front().substr(now.front().find(' ') + 1) + "'",
                         "in the frame before, the point there was '" +
                             then.front().substr(then.front().find(' ') + 1) + "'");
      });
    }
  }

  void report(std::vector<Finding>& findings) override {
    constexpr int kRepeats = 10;
    alike_.report(findings, "points of a manifold have the same id",
                  "name each point by the features that make it, or leave 'id' out: solvers warm "
                  "start from the point with the same id");
    changed_.report(findings, "ids change while nothing moves",
                    "name each point by the features that make it, not by its index or address: "
                    "solvers warm start from the point with the same id",
                    1, 0.002, kRepeats);
  }

 private:
  struct Earlier {
    std::multiset<std::string> ids;  // before they changed
    int frame = 0;                   // in which they changed
  };

  /// For manifolds with several points.
  void see_alike(const Moments& frames, const trace::Pair& pair) {
    for (const trace::Manifold& manifold : pair.manifolds) {
      std::set<std::string> names;
      std::size_t named = 0;
      for (const trace::Point& point : manifold.points) {
        if (point.id.empty()) continue;
        ++named;
        names.insert(point.id);
      }
      if (named < 2) continue;
      ++alike_.of;
      if (names.size() == named) continue;
      alike_.wrong(frames, pair.a, pair.b, [&] {
        return std::pair(std::to_string(named) + " points have " + std::to_string(names.size()) +
                             (names.size() == 1 ? " id" : " ids"),
                         std::string("they are different points"));
      });
    }
  }

  /// Finds ids that all persist, but each on another point than in the previous frame.
  void see_swapped(const Moments& frames, const trace::Pair& pair, const trace::Pair& before,
                   double near) {
    const auto places = [](const trace::Pair& of) {
      std::map<std::pair<int, std::string>, std::vector<Vec3d>> all;
      for (const trace::Manifold& manifold : of.manifolds)
        for (const trace::Point& point : manifold.points)
          all[{manifold.triangle.value_or(-1), point.id}].push_back(point.position);
      return all;
    };
    const auto then = places(before);
    for (const auto& place : places(pair)) {
      const auto& name = place.first;
      const std::vector<Vec3d>& now = place.second;
      const auto found = then.find(name);
      if (now.size() != 1 || found == then.end() || found->second.size() != 1) continue;
      if ((now.front() - found->second.front()).norm() <= near) continue;
      return changed_.wrong(frames, pair.a, pair.b, [&] {
        return std::pair("'" + name.second + "' at " + spelled(now.front()),
                         "in the frame before, it was at " + spelled(found->second.front()));
      });
    }
  }

  static bool stands_still(const Solids& solids, const Moments& frames, const trace::Pair& pair) {
    for (const std::string& name : {pair.a, pair.b}) {
      const std::optional<Placed> now = place(solids, frames.now, name, {});
      const std::optional<Placed> then = place(solids, frames.before, name, {});
      if (!now || !then) return false;
      constexpr double kStill = 1e-4;  // relative to its size, and to a full turn
      const double size = std::min(now->size(), 1e6);
      if ((now->pose.position - then->pose.position).norm() > kStill * size) return false;
      if (now->pose.rotation.angularDistance(then->pose.rotation) > kStill) return false;
    }
    return true;
  }

  std::map<std::tuple<std::string, std::string, std::string>, Earlier> earlier_;  // a, b, label
  Tally changed_{"ids_change"}, alike_{"ids_alike", "manifolds"};
};

}  // namespace

std::unique_ptr<Watch> watch_ids() { return std::make_unique<IdsWatch>(); }

}  // namespace contactscope::lint
