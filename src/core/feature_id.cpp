#include "core/feature_id.h"

namespace contactscope {

std::string to_string(const FeatureId& id) {
  const auto spell = [](const FeatureRef& ref) {
    const char kind = "vef"[static_cast<int>(ref.kind)];
    return std::string(ref.owner == Owner::A ? "a:" : "b:") + kind + std::to_string(ref.index);
  };
  return spell(id.first) + " " + spell(id.second);
}

}  // namespace contactscope
