#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// Where the bodies of a sequence stay together. A fitted camera frames this region, so bodies that
/// fly off do not shrink the rest.
///
/// The middle is the median of all bodies that touch something in some frame. Three quarters of
/// them are within some distance of it. A body belongs to the region up to three times that
/// distance if it touches something, otherwise up to one and a half times. A uniform line, disc or
/// ball of bodies needs at most 1.33. Shapes much larger than the median body, such as floors, are
/// no bodies: only their part around the region counts.
struct HomeRegion {
  Eigen::AlignedBox3d box;     // around the bodies in it, metres
  Eigen::AlignedBox3d around;  // the same, a little larger
  Vec3d middle = Vec3d::Zero();
  double reach = 0;  // metres from the middle: of bodies that touch nothing
  double reach_in_contact = 0;
  std::vector<bool> is_large{};  // for each shape of the header
  bool fly_off = false;          // some body is far outside in some frame
  bool cuts_off = false;         // some body is outside, or some large shape reaches out

  bool holds(const Vec3d& center, bool touches) const {
    return (center - middle).norm() <= (touches ? reach_in_contact : reach);
  }
};

/// Nothing if no frame has a body. `only`: for each shape of the header whether it counts; empty:
/// all do.
std::optional<HomeRegion> home_region(const ShapeMeshes& meshes,
                                      const std::vector<trace::Frame>& frames,
                                      const std::vector<bool>& only = {});

/// Shapes that have contact points in a frame, by their places in the header.
std::vector<bool> shapes_in_contact(const ShapeMeshes& meshes, const trace::Frame& frame);

/// Removes the shapes outside the region, and limits large ones to the box around it.
void keep_home(const HomeRegion& home, const std::vector<bool>& in_contact,
               std::vector<PlacedShape>& shapes);

}  // namespace contactscope::draw
