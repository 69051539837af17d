#include "bench/variant.h"

// Replaces peer_variants.cpp if Bullet, ODE or FCL is not installed.
namespace contactscope::bench {

std::vector<Variant> peer_variants() { return {}; }

}  // namespace contactscope::bench
