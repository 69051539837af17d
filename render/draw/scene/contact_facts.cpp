#include "draw/scene/contact_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

namespace contactscope::draw {
namespace {

constexpr std::size_t kManyManifolds = 30;
constexpr std::size_t kManyPairs = 12;  // fewer, as with a mesh, are not a heap

using PairKey = std::tuple<std::string_view, std::string_view, std::string_view>;

PairKey key_of(const trace::Pair& pair) { return {pair.a, pair.b, pair.label}; }

}  // namespace

double smaller_radius(const trace::Pair& pair, const ShapeMeshes& meshes) {
  double smaller = std::numeric_limits<double>::infinity();
  for (const std::string* name : {&pair.a, &pair.b})
    if (const auto place = meshes.find(*name); place && meshes[*place].radius > 0)
      smaller = std::min(smaller, meshes[*place].radius);
  return smaller;
}

std::optional<double> separation_of(const trace::Pair& pair) {
  if (pair.query) return pair.query->gap;
  if (pair.separation != 0) return pair.separation;
  const trace::Point* const deepest = trace::deepest_point(pair);
  return deepest != nullptr ? std::optional(deepest->separation) : std::nullopt;
}

std::optional<PairPoint> deepest_contact(const trace::Pair& pair) {
  std::optional<PairPoint> deepest;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points)
      if (!deepest || point.separation < deepest->point->separation)
        deepest = PairPoint{&manifold, &point};
  return deepest;
}

ContactCounts count_contacts(const trace::Frame& frame) {
  ContactCounts counts;
  for (const trace::Pair& pair : frame.pairs) {
    const std::size_t before = counts.points;
    for (const trace::Manifold& manifold : pair.manifolds) {
      counts.manifolds += !manifold.points.empty();
      counts.points += manifold.points.size();
    }
    counts.pairs += counts.points > before;
  }
  return counts;
}

bool is_heap(const trace::Frame& frame) {
  const ContactCounts counts = count_contacts(frame);
  return counts.manifolds > kManyManifolds && counts.pairs > kManyPairs;
}

std::vector<RankedPair> ranked_pairs(const trace::Frame& frame, Rank by, std::size_t most,
                                     const ShapeMeshes& meshes, const trace::Frame* before) {
  std::map<PairKey, double> last;
  if (by == Rank::Change) {
    if (before == nullptr) return {};
    for (const trace::Pair& pair : before->pairs) last.emplace(key_of(pair), overlap_of(pair));
  }
  std::vector<RankedPair> ranked;
  for (const trace::Pair& pair : frame.pairs) {
    double value = by == Rank::Impulse ? impulse_of(pair) : overlap_of(pair);
    if (by == Rank::Worst) value /= smaller_radius(pair, meshes);
    if (by == Rank::Change) {
      const auto known = last.find(key_of(pair));
      value = std::abs(value - (known == last.end() ? 0 : known->second));
    }
    if (value > 0) ranked.push_back({&pair, value});
  }
  most = std::min(most, ranked.size());
  // Stable: equal values keep the order of the file.
  std::ranges::stable_sort(ranked, std::ranges::greater(), &RankedPair::value);
  ranked.resize(most);
  return ranked;
}

}  // namespace contactscope::draw
