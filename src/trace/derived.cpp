#include <algorithm>
#include <set>

#include "trace/frame.h"

namespace contactscope::trace {

void Shape::edges_from_faces(Shape& shape) {
  std::set<std::array<int, 2>> seen;
  for (const std::vector<int>& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[(i + 1) % face.size()];
      if (seen.insert({std::min(from, to), std::max(from, to)}).second)
        shape.edges.push_back({from, to});
    }
}

Totals totals_of(const Frame& frame) {
  Totals totals;
  for (const Pair& pair : frame.pairs) {
    std::set<std::pair<int, std::string>> ids;
    for (const Manifold& manifold : pair.manifolds) {
      for (const Point& point : manifold.points) {
        if (frame.solver && !point.impulse) continue;
        totals.penetration = std::max(totals.penetration, -point.separation);
        if (point.impulse) totals.normal_impulse += point.impulse->normal;
        ++totals.points;
        ids.emplace(manifold.triangle.value_or(-1), point.id);
      }
    }
    totals.ids += static_cast<int>(ids.size());
  }
  if (!frame.solver) return totals;
  for (const Body& b : frame.solver->bodies) {
    totals.kinetic_energy += b.kinetic_energy;
    totals.potential_energy += b.potential_energy;
  }
  return totals;
}

}  // namespace contactscope::trace
