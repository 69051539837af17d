#include <unordered_set>

#include "geometry/quickhull.h"

namespace contactscope::quickhull {

Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance) {
  Horizon horizon;
  horizon.visible.push_back(face);
  std::unordered_set<int> seen = {face};
  for (std::size_t i = 0; i < horizon.visible.size(); ++i) {
    mesh.for_each_edge(horizon.visible[i], [&](int e) {
      const int across = mesh.neighbour(e);
      if (seen.contains(across) || !(mesh.distance(across, eye) > tolerance)) return;
      seen.insert(across);
      horizon.visible.push_back(across);
    });
  }

  std::vector<int> boundary;  // in no order
  for (const int visible : horizon.visible) {
    mesh.for_each_edge(visible, [&](int e) {
      if (!seen.contains(mesh.neighbour(e))) boundary.push_back(e);
    });
  }
  if (boundary.empty()) return horizon;

  // Walk around: at each target, turn through the visible faces to the next edge on the boundary.
  std::unordered_set<int> vertices;
  int e = boundary.back();
  do {
    horizon.edges.push_back(e);
    vertices.insert(mesh.edge(e).origin);
    e = mesh.edge(e).next;
    while (seen.contains(mesh.neighbour(e))) e = mesh.edge(mesh.edge(e).twin).next;
  } while (e != boundary.back());
  const bool one_loop = horizon.edges.size() == boundary.size();
  const bool simple = vertices.size() == boundary.size();
  if (!one_loop || !simple) horizon.edges.clear();
  return horizon;
}

}  // namespace contactscope::quickhull
