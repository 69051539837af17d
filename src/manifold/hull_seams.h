#pragma once

#include "manifold/collide_pairs.h"

namespace contactscope {

/// Replaces a contact with an edge or a face that the surface of `hull` lacks, because a shape next
/// to it covers the face or continues the surface beyond the edge (Hull::seams), by one with the
/// face that the other shape is in front of. That contact has no points where the other shape is
/// not over the face: it then touches the neighbour. As belongs_to_surface() for meshes.
///
/// The contact is in A's frame; `owner` says which shape the hull with seams is. The record gets the
/// contact that was replaced.
template <class S, class A>
void respect_seams(const A& a, const Hull<S>& b, const Pose<S>& b_in_a, Owner owner,
                   const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

}  // namespace contactscope
