#include "geometry/horizon.h"

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <utility>

namespace contactscope::quickhull {
namespace {

class Search {
 public:
  explicit Search(const Mesh& mesh) : mesh_(mesh) {}

  void flood(int face, int eye, double tolerance) {
    see(face);
    for (std::size_t i = 0; i < horizon_.visible.size(); ++i) {
      for_each_edge(horizon_.visible[i], [&](int e) {
        const int next = mesh_.neighbour(e);
        if (!seen_.contains(next) && mesh_.distance(next, eye) > tolerance) see(next);
      });
    }
  }

  /// Finds the boundary; where it is not one simple loop, sees more faces and returns false.
  bool trace_boundary() {
    int boundary_count = 0;
    std::vector<std::vector<int>> loops;
    std::unordered_set<int> walked;
    std::unordered_set<int> vertices;
    for (const int face : horizon_.visible) {
      for_each_edge(face, [&](int e) {
        if (seen_.contains(mesh_.neighbour(e))) return;
        ++boundary_count;
        if (!walked.contains(e)) loops.push_back(walk(e, walked));
      });
    }
    if (loops.empty()) return true;
    const auto longest = std::max_element(
        loops.begin(), loops.end(),
        [](const auto& one, const auto& other) { return one.size() < other.size(); });
    horizon_.edges = *longest;

    std::vector<int> in_the_way;
    for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
      for (const int e : *loop) {
        const bool touches_itself = !vertices.insert(mesh_.edge(e).origin).second;
        if (loop != longest || touches_itself) in_the_way.push_back(mesh_.neighbour(e));
      }
    }
    for (const int face : in_the_way) {
      if (!seen_.contains(face)) see(face);
    }
    return in_the_way.empty();
  }

  Horizon take() { return std::move(horizon_); }

 private:
  template <class Visit>
  void for_each_edge(int face, const Visit& visit) const {
    const int first = mesh_.face(face).edge;
    int e = first;
    do {
      visit(e);
      e = mesh_.edge(e).next;
    } while (e != first);
  }

  void see(int face) {
    seen_.insert(face);
    horizon_.visible.push_back(face);
  }

  /// The loop of boundary edges from `first`: at each target, turn through the visible faces until
  /// the next edge that has none across.
  std::vector<int> walk(int first, std::unordered_set<int>& walked) const {
    std::vector<int> loop;
    int e = first;
    do {
      loop.push_back(e);
      walked.insert(e);
      e = mesh_.edge(e).next;
      while (seen_.contains(mesh_.neighbour(e))) e = mesh_.edge(mesh_.edge(e).twin).next;
    } while (e != first);
    return loop;
  }

  const Mesh& mesh_;
  std::unordered_set<int> seen_;
  Horizon horizon_;
};

}  // namespace

Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance) {
  Search search(mesh);
  search.flood(face, eye, tolerance);
  while (!search.trace_boundary()) {
  }
  return search.take();
}

}  // namespace contactscope::quickhull
