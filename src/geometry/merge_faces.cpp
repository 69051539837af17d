#include "geometry/quickhull.h"

// Face merging after Gregorius, "Implementing Quickhull", GDC 2014.
//
// Two neighbours are convex if the centroid of each lies below the plane of the other by more than
// the tolerance. Otherwise they are coplanar or concave and become one face. Steps:
//   1. merge each new face wherever the larger face of a pair finds the smaller one's centroid not
//      below it. The larger plane is more reliable, so slivers disappear into it;
//   2. pairs that only the smaller face's plane finds concave are postponed, and judged by both
//      planes once the slivers are gone.
// A merge changes planes, so each face is examined again after each of its merges.

namespace contactscope::quickhull {
namespace {

enum class Judge { LargerFace, BothFaces };

/// True if all edges of both faces lie in the plane of their union, up to sines of `steepest`.
bool lies_flat(const Mesh& mesh, int one, int other, double steepest) {
  const Face &first = mesh.face(one), &second = mesh.face(other);
  const Vec3d area = first.area * first.plane.normal + second.area * second.plane.normal;
  const Vec3d normal = area.normalized();
  const auto fits = [&](int e) { return mesh.slope(e, normal) <= steepest; };
  return std::ranges::all_of(mesh.around(one), fits) &&
         std::ranges::all_of(mesh.around(other), fits);
}

/// Merges one pair along the loop of `face`; returns false if no pair is left.
bool merge_once(Mesh& mesh, int face, Judge judge, double tolerance, double steepest,
                std::vector<int>& touched) {
  for (const int e : mesh.around(face)) {
    const Face& here = mesh.face(face);
    const Face& across = mesh.face(mesh.neighbour(e));
    const bool across_is_concave = here.plane.distance(across.centroid) > -tolerance;
    const bool here_is_concave = across.plane.distance(here.centroid) > -tolerance;
    const bool here_is_larger = here.area > across.area;
    const bool larger_says_so = here_is_larger ? across_is_concave : here_is_concave;
    const bool either_says_so = across_is_concave || here_is_concave;
    if (judge == Judge::BothFaces ? either_says_so : larger_says_so) {
      if (steepest < 1 && !lies_flat(mesh, face, mesh.neighbour(e), steepest)) continue;
      if (mesh.merge_across(e, touched)) return true;
    } else if (either_says_so) {
      mesh.face(face).suspect = true;
    }
  }
  return false;
}

bool merge_face(Mesh& mesh, int face, Judge judge, double tolerance, double steepest,
                std::vector<int>& touched) {
  bool any = false;
  while (!mesh.broken() && !mesh.face(face).gone &&
         merge_once(mesh, face, judge, tolerance, steepest, touched)) {
    any = true;
  }
  return any;
}

/// The edges of a face, starting with `first`.
std::vector<int> loop_from(const Mesh& mesh, int first) {
  std::vector<int> edges;
  for (const int e : mesh.ring_from(first)) edges.push_back(e);
  return edges;
}

/// Deepest notch of the polygon of `edges`' origins, counter-clockwise from the tip of `normal`.
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

/// The corner to cut to from edges[0]'s origin, as an index; 0: every cut leaves as deep a notch.
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

void merge_cone(Mesh& mesh, const std::vector<int>& fresh, double tolerance,
                std::vector<int>& touched) {
  for (const int face : fresh) merge_face(mesh, face, Judge::LargerFace, tolerance, 1, touched);
  for (const int face : fresh) {
    if (mesh.face(face).gone || !mesh.face(face).suspect) continue;
    mesh.face(face).suspect = false;
    merge_face(mesh, face, Judge::BothFaces, tolerance, 1, touched);
  }
}

void merge_all(Mesh& mesh, double tolerance, double steepest) {
  std::vector<int> touched;
  bool any = true;
  while (any && !mesh.broken()) {
    any = false;
    for (int face = 0; face < mesh.face_count(); ++face) {
      touched.clear();
      if (merge_face(mesh, face, Judge::BothFaces, tolerance, steepest, touched)) any = true;
    }
  }
}

// If three faces differ by about the tolerance, two of them can merge while the third is convex
// towards both and stays in a notch of their common outline. Planes do not reveal this, but such a
// face is useless as a clip polygon: its side planes cut through it.
//
//      o-------o       Filling the notch with the third face would bend the plane further,
//      |  /\   |       and could spread from face to face on a finely rounded shape. Cutting at the
//      | /  \  |       notch leaves two faces that are coplanar within the tolerance: harmless.
//      o     o-o       Steps: find the deepest notch; try a cut from it to each other corner; keep
//                      the one that leaves the shallowest notches on both sides; repeat.

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
