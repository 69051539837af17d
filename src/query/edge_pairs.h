#pragma once

#include <vector>

#include "query/sat.h"

namespace contactscope {

/// Every pair of edges whose arcs cross on the Gauss map, and so make a face of the Minkowski
/// difference: all that the edge query could measure, where query_edges() leaves out what cannot win.
/// For pictures. `faces_a` is what query_faces found for A. In the order of A's edges; nearly
/// parallel pairs, which have no axis, are left out.
template <class S>
std::vector<EdgeQuery<S>> crossing_edge_pairs(const HullPair<S>& pair,
                                              const FaceSeparations<S>& faces_a);

}  // namespace contactscope
