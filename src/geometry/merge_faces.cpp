#include "geometry/quickhull.h"

#include <algorithm>

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

}  // namespace contactscope::quickhull
