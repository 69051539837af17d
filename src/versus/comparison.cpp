#include "versus/comparison.h"

#include "trace/find.h"
#include "versus/request.h"

namespace contactscope::versus {
namespace {

const trace::Frame* frame_of(const trace::Trace& trace, int number) {
  const auto found = std::ranges::find(trace.frames, number, &trace::Frame::frame);
  return found == trace.frames.end() ? nullptr : &*found;
}

/// Sums, whose means become the score.
class Scorer {
 public:
  Scorer(const trace::Trace& request, const EngineRun& engine_run)
      : request_(request), engine_run_(engine_run) {
    score_.name = engine_run.name;
    score_.failure = engine_run.failure;
    add(request.header.shapes);
  }

  Score score() {
    for (const trace::Frame& requested : request_.frames) {
      add(requested.shapes);
      const trace::Frame* const record = frame_of(engine_run_.trace, requested.frame);
      if (record == nullptr) continue;
      solids_.deform(requested.deformed);
      for (const Truth& truth : truths_of(solids_, requested))
        judge_pair(requested, *record, truth);
    }
    finish();
    return score_;
  }

 private:
  void add(const std::vector<trace::Shape>& shapes) {
    shapes_.insert(shapes_.end(), shapes.begin(), shapes.end());
    for (const trace::Shape& shape : shapes) solids_.add(shape);
  }

  void judge_pair(const trace::Frame& requested, const trace::Frame& record, const Truth& truth) {
    const std::optional<trace::Pair> pair = pair_of(record, truth.a, truth.b);
    if (!truth.separation) return;
    ++score_.pairs;
    const trace::Point* const deepest = pair ? trace::deepest_point(*pair) : nullptr;
    if (deepest == nullptr) {
      score_.missed += truth.touches();
      return;
    }
    if (truth.is_separated()) {
      score_.invented += deepest->separation < -truth.tolerance;
      return;
    }
    if (!truth.touches()) return;
    ++score_.touching;
    const double error = std::abs(deepest->separation - *truth.separation);
    score_.mean_depth_error += error;
    if (!(error <= score_.worst_depth_error)) {
      score_.worst_depth_error = error;
      score_.worst_place =
          "frame " + std::to_string(requested.frame) + ", " + truth.a + "-" + truth.b;
    }
    for (const trace::Manifold& manifold : pair->manifolds)
      score_.points += static_cast<double>(manifold.points.size());
    judge_normal(requested, *pair, truth);
    if (truth.area > 0) {
      ++score_.patches;
      trace::Manifold all = pair->manifolds.front();  // engines may report one patch as several
      const auto points = joined(pair->manifolds, &trace::Manifold::points);
      all.points.assign(points.begin(), points.end());
      score_.area += area_of(all) / truth.area;
    }
    judge_ids(requested, *pair);
  }

  void judge_normal(const trace::Frame& requested, const trace::Pair& pair, const Truth& truth) {
    const auto a = lint::place(solids_, &requested, pair.a, {});
    const auto b = lint::place(solids_, &requested, pair.b, {});
    const auto has_end = [](const lint::Placed& placed) {
      return placed.solid->is_convex() || placed.solid->is_plane();
    };
    if (!has_end(*a) || !has_end(*b)) return;
    for (const trace::Manifold& manifold : pair.manifolds) {
      const double along = separation_along(*a, *b, manifold.normal.normalized());
      // A plane is only bounded along its normal.
      if (std::isfinite(along))
        score_.worst_normal = std::max(score_.worst_normal, *truth.separation - along);
    }
  }

  void judge_ids(const trace::Frame& requested, const trace::Pair& pair) {
    std::multiset<std::string> all = trace::point_ids(pair);
    if (all.empty()) {
      trace::Frame named{.frame = requested.frame, .poses = requested.poses, .pairs = {pair}};
      trace::name_points(shapes_, named);
      all = trace::point_ids(named.pairs.front());
      score_.ids_are_made_up = score_.ids_are_made_up || !all.empty();
    }
    const std::set<std::string> ids(all.begin(), all.end());
    auto& [frame, before] = last_ids_[{pair.a, pair.b}];
    if (!ids.empty() && !before.empty() && frame + 1 == requested.frame) {
      std::size_t kept = 0;
      for (const std::string& id : ids) kept += before.count(id);
      score_.ids_kept += static_cast<double>(kept) / static_cast<double>(ids.size());
      ++score_.id_frames;
    }
    frame = requested.frame;
    before = ids;
  }

  void finish() {
    const auto mean = [](double& sum, int count) {
      if (count > 0) sum /= count;
    };
    mean(score_.mean_depth_error, score_.touching);
    mean(score_.points, score_.touching);
    mean(score_.area, score_.patches);
    mean(score_.ids_kept, score_.id_frames);
    if (!engine_run_.trace.frames.empty())
      score_.findings = lint::lint(engine_run_.trace, {.shapes_are_given = true});
  }

  const trace::Trace& request_;
  const EngineRun& engine_run_;
  lint::Solids solids_;
  std::vector<trace::Shape> shapes_;
  std::map<std::pair<std::string, std::string>, std::pair<int, std::set<std::string>>> last_ids_;
  Score score_;
};

}  // namespace

std::optional<trace::Pair> pair_of(const trace::Frame& frame, const std::string& a,
                                   const std::string& b) {
  std::optional<trace::Pair> whole;
  for (const trace::Pair& pair : frame.pairs) {
    const bool is_same = pair.a == a && pair.b == b;
    if (!is_same && !(pair.a == b && pair.b == a)) continue;
    trace::Pair turned = pair;
    if (!is_same) trace::mirror(turned);
    if (!whole) {
      whole = std::move(turned);
    } else {
      whole->manifolds.insert(whole->manifolds.end(), turned.manifolds.begin(),
                              turned.manifolds.end());
    }
  }
  return whole;
}

Score judge(const trace::Trace& request, const EngineRun& engine_run) {
  return Scorer(request, engine_run).score();
}

}  // namespace contactscope::versus
