#include "lint/wrong_pairs.h"

#include "lint/watch.h"

namespace contactscope::lint {
namespace {

/// Pairs kept individually. With the distinct later ones they take some megabytes.
constexpr std::size_t kWhole = 4000;
constexpr std::size_t kMax = 2 * kWhole;
constexpr int kSteadyFrames = 8;
/// Depths and scales within this factor are the same.
constexpr double kSame = 1.05;

std::string rounded(double value) {
  return std::to_string(std::lround(std::log(std::abs(value)) / std::log(kSame)));
}

/// Key of everything that is reported of a pair, except its position in the trace.
std::string signature_of(const WrongPair& pair) {
  std::string signature = pair.explained_by.to_string();
  signature += pair.severe ? '#' : pair.gross ? '!' : '.';
  signature += pair.grossly_beyond ? '^' : pair.beyond ? '-' : '_';
  signature += std::to_string(static_cast<int>(pair.problem.kind));
  if (pair.deeper != 0) signature += (pair.deeper > 0 ? '+' : '-') + rounded(pair.deeper);
  for (std::size_t i = 0; i < pair.scales.size(); ++i)
    if (pair.scales[i] > 0)
      signature += pair.scaled(i) + (WrongPair::is_margin(i) ? '~' : '*') + rounded(pair.scales[i]);
  return signature;
}

std::string point_name(const Problem& problem) {
  return "point " + std::to_string(problem.point) +
         (problem.manifold > 0 ? " of manifold " + std::to_string(problem.manifold) : "");
}

}  // namespace

void put_in_words(const trace::Pair& pair, WrongPair& wrong) {
  const Problem& problem = wrong.problem;
  const trace::Manifold& manifold = at(pair.manifolds, problem.manifold);
  const trace::Point& point = at(manifold.points, problem.point);
  wrong.at = point.position;
  wrong.normal = problem.best.isZero() ? Vec3d(-manifold.normal) : problem.best;
  switch (problem.kind) {
    case Wrong::Separation:
      wrong.said = point_name(problem) + ": separation " + metres(point.separation) + ", normal " +
                   spelled(manifold.normal);
      wrong.is = "the separation there along the normal is " + metres(problem.is);
      break;
    case Wrong::Surface:
      wrong.said = point_name(problem) + ": position " + spelled(point.position) + ", separation " +
                   metres(point.separation);
      wrong.is = "it is " + metres(problem.is) + " off the surface of '" + problem.shape + "'";
      break;
    case Wrong::Side:
      wrong.said = point_name(problem) + ": on the surface of '" + problem.shape + "'";
      wrong.is = "it is " + metres(problem.is) + " off that surface";
      break;
    case Wrong::Normal:
      wrong.said = "normal " + spelled(manifold.normal);
      wrong.is = std::isfinite(problem.said) ? "along it the separation is " + metres(problem.said)
                                             : "the plane is infinite in that direction";
      if (!problem.best.isZero())
        wrong.is += "; along " + spelled(problem.best) + " the separation is " +
                    metres(problem.is) + " (negative: overlap)";
      break;
    case Wrong::Deepest:
      wrong.said = "deepest point: " + metres(problem.said);
      wrong.is = "the separation of the shapes along the normal is " + metres(problem.is);
      break;
  }
}

void SteadyErrors::see(WrongPair& wrong) {
  auto& [first, last, times] = runs_[{wrong.a, wrong.b}];
  const bool is_same = std::abs(wrong.deeper - first.deeper) <= 0.1 * std::abs(first.deeper);
  if (times == 0 || !is_same || wrong.frame > last + 2) first = wrong, times = 0;
  last = wrong.frame;
  if (++times != kSteadyFrames) return;
  const Mark own = wrong.mark();
  wrong = first;
  wrong.others.push_back(own);
  wrong.is_copy = true;
  wrong.gross = wrong.severe = true;
  wrong.grossly_beyond = wrong.beyond;
}

void WrongPairs::add(WrongPair pair, bool is_marked) {
  ++count_;
  std::string signature;
  if (kept_.size() >= kWhole) {
    if (places_.empty())
      for (std::size_t i = 0; i < kept_.size(); ++i) places_.emplace(signature_of(kept_[i]), i);
    signature = signature_of(pair);
    const auto known = places_.find(signature);
    // With thousands of distinct errors their exact frequencies do not matter.
    if (known != places_.end() || kept_.size() >= (pair.gross ? 2 * kMax : kMax)) {
      WrongPair& as = kept_[known != places_.end() ? known->second : kept_.size() - 1];
      if (is_marked) as.others.push_back(pair.mark());
      return void(++as.times);
    }
    places_.emplace(std::move(signature), kept_.size());
  }
  kept_.push_back(std::move(pair));
}

int WrongPairs::untold() const {
  int count = 0;
  for (const WrongPair& pair : kept_) count += pair.record ? 0 : pair.times;
  return count;
}

double WrongPairs::common_depth() const {
  std::optional<double> least, most;
  for (const WrongPair& pair : kept_) {
    if (pair.record || pair.problem.kind != Wrong::Separation) continue;
    least = std::min(least.value_or(pair.deeper), pair.deeper);
    most = std::max(most.value_or(pair.deeper), pair.deeper);
  }
  constexpr double kAlike = 0.1;
  if (!least || *least * *most <= 0 || *most - *least > kAlike * std::abs(*most)) return 0;
  return (*least + *most) / 2;
}

}  // namespace contactscope::lint
