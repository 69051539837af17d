#include "bench/variant.h"

// In place of peer_variants.cpp where Bullet, ODE or FCL is not installed.
namespace contactscope::bench {

std::vector<Variant> peer_variants() {
  return {};
}

}  // namespace contactscope::bench
