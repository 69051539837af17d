#pragma once

#include <span>

#include "peers/disagreement.h"

/// Reasons why Bullet, ODE and FCL answer differently. Each rule names a constant or a habit of
/// theirs and checks that it accounts for the numbers.
namespace contactscope::peers {

// Boxes. All three descend from ODE's dBoxBox2.
inline constexpr const char* kEdgeFactor = "edge axis must win by a factor 1.05";
inline constexpr const char* kCornerOutside = "deepest corner lies beside the reference face";
inline constexpr const char* kCosineFudge = "1e-5 added to cosines makes edges deeper";
inline constexpr const char* kMerged =
    "points nearer than the breaking threshold replace each other";
// Hulls in ODE and FCL.
inline constexpr const char* kExitDepth = "MPR: depth on the way out through the centres";
inline constexpr const char* kCapsuleAsBox = "a capsule whose axis meets a box counts as a box";
// Hulls in Bullet.
inline constexpr const char* kMinDistance = "GJK takes what is nearer than 0.1 mm for overlap";
inline constexpr const char* kGaveUp = "GJK stops at a degenerate simplex";
inline constexpr const char* kEpaAccuracy = "EPA stops early, 0.1 mm at a time";
inline constexpr const char* kFacePlane = "depth below a face plane of a coarse hull";
inline constexpr const char* kClamped =
    "depth below a face plane clamped by the breaking threshold";

// Meshes.
inline constexpr const char* kEdgeFactorOnMesh = "edge axis must win by a factor 1.5";
inline constexpr const char* kClippedPart = "depth of what clipping leaves of the triangle";
inline constexpr const char* kSphereSign = "depth of a sphere on a triangle has its sign reversed";
inline constexpr const char* kReplaced = "a neighbour's point within the breaking threshold stays";

/// Rules of a library by name: for two boxes if `boxes`, else for hulls.
std::span<const Rule> rules_of(const Peer& peer, bool boxes);

/// For a box (`box`) or another hull A, and B, the mesh's triangle at the deepest point, as a hull.
std::span<const Rule> mesh_rules_of(const Peer& peer, bool box);

/// For spheres and capsules, with each other or with hulls.
std::span<const Rule> round_rules_of(const Peer& peer);

/// The same for a sphere or a capsule on a mesh.
std::span<const Rule> round_mesh_rules_of(const Peer& peer);

/// btCollisionShape::getContactBreakingThreshold of the smaller shape: by default 0.02 of the
/// largest possible distance of a point of the shape from its origin, bounded by its box.
double breaking_threshold(const Hull<double>& hull);

/// Metres, for a pair of this extent. Answers within it agree.
double tolerance_of(const Peer& peer, double length_scale);

}  // namespace contactscope::peers
