#include "peers/broad_phase_peer.h"

namespace contactscope::peers {

std::vector<PairFinderInfo> embree_broad_phases() { return {}; }

}  // namespace contactscope::peers
