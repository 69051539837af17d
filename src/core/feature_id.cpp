#include "core/feature_id.h"

namespace contactscope {

std::string to_string(const FeatureId& id) {
  const auto spell = [](const EdgeRef& ref) {
    return std::string(ref.owner == Owner::A ? "a" : "b") + ":e" + std::to_string(ref.edge);
  };
  return spell(id.first) + " " + spell(id.second);
}

}  // namespace contactscope
