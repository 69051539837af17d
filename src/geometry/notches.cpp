#include "geometry/quickhull.h"

// If three faces differ by about the tolerance, two of them can merge while the third is convex
// towards both and stays in a notch of their common outline. Planes do not reveal this, but such a
// face is useless as a clip polygon: its side planes cut through it.
//
//      o-------o       Filling the notch with the third face would bend the plane further,
//      |  /\   |       and could spread from face to face on a finely rounded shape. Cutting at the
//      | /  \  |       notch leaves two faces that are coplanar within the tolerance: harmless.
//      o     o-o       Steps: find the deepest notch; try a cut from it to each other corner; keep
//                      the one that leaves the shallowest notches on both sides; repeat.

#include <algorithm>
#include <limits>

namespace contactscope::quickhull {
namespace {

/// The edges of a face, starting with `first`.
std::vector<int> loop_from(const Mesh& mesh, int first) {
  std::vector<int> edges;
  for (const int e : mesh.ring_from(first)) edges.push_back(e);
  return edges;
}

/// Deepest notch of the polygon whose corners are the origins of `edges`, counter-clockwise seen
/// from the tip of `normal`.
Notch deepest(const Mesh& mesh, const std::vector<int>& edges, const Vec3d& normal) {
  const std::size_t count = edges.size();
  const auto corner = [&](std::size_t i) -> const Vec3d& {
    return mesh.point(mesh.edge(edges[i % count]).origin);
  };
  Notch notch{-1, -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d& before = corner(i + count - 1);
    const Vec3d chord = corner(i + 1) - before;
    const Vec3d arm = corner(i) - before;
    const Vec3d left = normal.cross(chord);
    const double depth = left.dot(arm) / chord.norm();
    if (depth > notch.depth) notch = {edges[i], depth};
  }
  return notch;
}

/// The corner to cut to from the origin of edges[0], as an index into `edges`; 0 if every cut
/// leaves an equally deep notch.
std::size_t best_cut(const Mesh& mesh, const std::vector<int>& edges, const Vec3d& normal) {
  std::size_t best = 0;
  double best_depth = deepest(mesh, edges, normal).depth;
  for (std::size_t i = 2; i + 1 < edges.size(); ++i) {
    const auto cut = edges.begin() + static_cast<std::ptrdiff_t>(i);
    const std::vector<int> ahead(edges.begin(), cut + 1);
    std::vector<int> behind(cut, edges.end());
    behind.push_back(edges.front());
    const double depth =
        std::max(deepest(mesh, ahead, normal).depth, deepest(mesh, behind, normal).depth);
    if (depth < best_depth) {
      best = i;
      best_depth = depth;
    }
  }
  return best;
}

}  // namespace

Notch deepest_notch(const Mesh& mesh, int face) {
  return deepest(mesh, loop_from(mesh, mesh.face(face).edge), mesh.face(face).plane.normal);
}

void split_notched_faces(Mesh& mesh, double tolerance) {
  // Splitting appends faces, so the loop visits both parts.
  for (int face = 0; face < mesh.face_count(); ++face) {
    if (mesh.face(face).gone) continue;
    for (;;) {
      const Notch notch = deepest_notch(mesh, face);
      if (notch.depth <= tolerance) break;
      const std::vector<int> edges = loop_from(mesh, notch.edge);
      const std::size_t cut = best_cut(mesh, edges, mesh.face(face).plane.normal);
      if (cut == 0) break;
      mesh.split(notch.edge, edges[cut]);
    }
  }
}

}  // namespace contactscope::quickhull
