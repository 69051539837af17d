#include "reduce/choices.h"

#include <algorithm>

#include "reduce/steps.h"

namespace contactscope {

double Choices::signed_area(int q, int a, int b) const {
  return 0.5 * steps::doubled_area(at(q), at(a), at(b), normal_);
}

trace::Choice& Choices::add(const char* rule) {
  trace::Choice& choice = made_.emplace_back();
  choice.rule = rule;
  return choice;
}

void Choices::support(const Vec3d& direction) {
  trace::Choice& choice = add("support");
  choice.direction = direction;
  for (int q = 0; q < count(); ++q) {
    const Vec3d arm = at(q) - at(0);
    choice.measures.push_back({q, trace::kNoEdge, direction.dot(arm)});
  }
}

void Choices::deepest() {
  trace::Choice& choice = add("deepest");
  for (int q = 0; q < count(); ++q)
    choice.measures.push_back(
        {q, trace::kNoEdge, -points_[static_cast<std::size_t>(q)].separation});
}

void Choices::farthest(int from) {
  trace::Choice& choice = add("farthest");
  for (int q = 0; q < count(); ++q)
    if (q != from) choice.measures.push_back({q, trace::kNoEdge, (at(q) - at(from)).norm()});
}

void Choices::triangle(int first, int second) {
  trace::Choice& choice = add("triangle");
  for (int q = 0; q < count(); ++q)
    if (q != first && q != second)
      choice.measures.push_back({q, {{first, second}}, signed_area(q, first, second)});
}

void Choices::outside(std::span<const int> ring, int first, int chosen, bool by_distance) {
  trace::Choice& choice = add(by_distance ? "distance" : "outside");
  const std::size_t start = static_cast<std::size_t>(std::ranges::find(ring, first) - ring.begin());
  for (int q = 0; q < count(); ++q) {
    if (std::ranges::find(ring, q) != ring.end()) continue;
    std::vector<trace::Measure> all;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[(start + k) % ring.size()];
      const int b = ring[(start + k + 1) % ring.size()];
      const double area = signed_area(q, a, b);
      all.push_back({q, {{a, b}}, by_distance ? 2 * area / (at(b) - at(a)).norm() : area});
    }
    if (q == chosen) {
      choice.measures.insert(choice.measures.end(), all.begin(), all.end());
    } else {
      choice.measures.push_back(*std::ranges::min_element(all, {}, &trace::Measure::value));
    }
  }
}

}  // namespace contactscope
