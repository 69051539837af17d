#include "draw/scene/support.h"

#include "draw/scene/swatches.h"

namespace contactscope::draw {

void explain_support(const trace::Stability& stability, bool turns, Legend& legend) {
  if (stability.support.size() > 2)
    legend.explain(kSupportSwatch, "support: hull of the contact points");
  if (stability.support.size() == 2)
    legend.explain(kSupportSwatch, "support: a line between two points");
  if (turns) legend.explain(kFreeAxisSwatch, "axis about which the body turns");
}

}  // namespace contactscope::draw
