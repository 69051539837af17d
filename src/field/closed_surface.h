#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A surface without holes. Its inside is where its winding number is not 0.
struct ClosedSurface {
  Mesh<double> mesh;      // the triangles as given, then the caps
  int own_triangles = 0;  // number of triangles that are not caps
  double cap_share = 0;   // area of the caps over that of the own triangles
};

/// Largest area of the caps over that of the surface that they close. A box without its lid has
/// 1/5; an open sheet, which its cap covers, has 1.
inline constexpr double kLargestCapShare = 0.5;

/// Closes the holes of a mesh: metres, frame of the mesh.
///
/// In any mesh, the directed edges without an opposite one form closed loops, because those of each
/// triangle do. Each connected part of them becomes the base of a cone whose tip is the mean of its
/// points. All edges are then matched, and the winding number is an integer everywhere. This also
/// turns back a flipped triangle: its cap covers it twice, with the opposite front.
///
/// The generalised winding number (Jacobson, Kavan and Sorkine-Hornung 2013, "Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers"; Barill et al. 2018) finds the same inside
/// except near holes. We use caps because bounds need a closed surface, whose signed distance
/// changes by at most the distance moved. Near holes, winding numbers flip off the surface.
///
/// Throws ShapeError if the caps exceed kLargestCapShare, or if nothing is inside.
ClosedSurface close_surface(const Mesh<double>& mesh);

/// The faces of a hull as triangles, fronts outside, in the order of the faces; its frame, metres.
/// Vertices keep their indices. Throws ShapeError if no face has an area.
Mesh<double> surface_of(const Hull<double>& hull);

}  // namespace contactscope
