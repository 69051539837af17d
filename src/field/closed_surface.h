#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A surface without holes, which has an inside: where its winding number is not 0.
struct ClosedSurface {
  Mesh<double> mesh;      // the triangles as given, then the caps
  int own_triangles = 0;  // how many of them are no caps
  double cap_share = 0;   // area of the caps over that of the own triangles
};

/// Caps may have so much of the area of the surface that they close. A box without its lid has 1/5; an
/// open sheet, whose cap lies along all of it, has 1.
inline constexpr double kLargestCapShare = 0.5;

/// Closes the holes of a mesh: metres, frame of the mesh.
///
/// The directed edges that no other triangle runs the other way form closed loops, whatever the mesh is,
/// because those of each triangle do. Each connected part of them is the base of a cone whose tip is the
/// mean of its points, so that all edges are matched and the winding number is whole everywhere. A
/// triangle that is turned over is turned back that way: its cap lies on it, twice, the other way round.
///
/// The generalised winding number (Jacobson, Kavan and Sorkine-Hornung 2013, "Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers"; Barill et al. 2018) finds the same inside but for
/// what is near a hole. Caps are taken in its place because the distance to a closed surface, with its
/// sign, changes by no more than the way that one goes, and bounds need that: beside a hole the sign of
/// a winding number turns where the distance to the surface is not 0.
///
/// Throws ShapeError where the caps are larger than kLargestCapShare, and where nothing is inside.
ClosedSurface close_surface(const Mesh<double>& mesh);

}  // namespace contactscope
