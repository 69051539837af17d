#include "reduce/choices.h"

namespace contactscope {

template <class Value>
trace::Choice& Choices::add(const char* rule, std::initializer_list<int> taken,
                            const std::array<int, 2>& edge, const Value& value) {
  trace::Choice& choice = made.emplace_back();
  choice.rule = rule;
  for (int q = 0; q < points.count(); ++q)
    if (std::ranges::find(taken, q) == taken.end()) choice.measures.push_back({q, edge, value(q)});
  return choice;
}

void Choices::support(const Vec3d& direction) {
  const auto along = [&](int q) { return direction.dot(Vec3d(points[q] - points[0])); };
  add("support", {}, trace::kNoEdge, along).direction = direction;
}

void Choices::deepest() {
  add("deepest", {}, trace::kNoEdge, [&](int q) { return -points.separation(q); });
}

void Choices::equally_deep(std::span<const int> ties, std::span<const double> areas) {
  trace::Choice& choice = made.emplace_back();
  choice.rule = "equally_deep";
  for (std::size_t i = 0; i < ties.size(); ++i)
    choice.measures.push_back({ties[i], trace::kNoEdge, areas[i]});
}

void Choices::farthest(int from) {
  add("farthest", {from}, trace::kNoEdge, [&](int q) { return (points[q] - points[from]).norm(); });
}

void Choices::triangle(int first, int second) {
  add("triangle", {first, second}, {{first, second}},
      [&](int q) { return 0.5 * points.doubled_area(q, first, second); });
}

void Choices::outside(std::span<const int> ring, int first, int chosen, bool by_distance) {
  trace::Choice& choice = made.emplace_back();
  choice.rule = by_distance ? "distance" : "outside";
  const std::size_t start = static_cast<std::size_t>(std::ranges::find(ring, first) - ring.begin());
  for (int q = 0; q < points.count(); ++q) {
    if (std::ranges::find(ring, q) != ring.end()) continue;
    std::vector<trace::Measure> all;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[(start + k) % ring.size()];
      const int b = ring[(start + k + 1) % ring.size()];
      const double area = 0.5 * points.doubled_area(q, a, b);
      const double distance = 2 * area / (points[b] - points[a]).norm();
      all.push_back({q, {{a, b}}, by_distance ? distance : area});
    }
    if (q == chosen)
      choice.measures.insert(choice.measures.end(), all.begin(), all.end());
    else
      choice.measures.push_back(*std::ranges::min_element(all, {}, &trace::Measure::value));
  }
}

}  // namespace contactscope
