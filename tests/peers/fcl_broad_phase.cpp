#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

class DynamicTree : public PairFinder {
 public:
  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    const bool first = objects_.empty();
    std::vector<fcl::CollisionObject<float>*> changed;
    for (const int index : moved) {
      const auto i = static_cast<std::size_t>(index);
      const Vec3<float> sides = boxes[i].extent();
      if (first) {
        objects_.push_back(std::make_unique<fcl::CollisionObject<float>>(
            std::make_shared<fcl::Box<float>>(sides.x(), sides.y(), sides.z())));
        objects_[i]->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
      }
      objects_[i]->setTranslation(boxes[i].center());
      objects_[i]->computeAABB();
      changed.push_back(objects_[i].get());
    }
    if (first) {
      manager_.registerObjects(changed);
      manager_.setup();
    } else if (changed.size() < objects_.size()) {
      manager_.update(changed);
    } else {
      manager_.update();
    }
  }

  void find(std::vector<BoxPair>& found) override {
    manager_.collide(
        &found, [](fcl::CollisionObject<float>* a, fcl::CollisionObject<float>* b, void* data) {
          const auto index = [](const fcl::CollisionObject<float>* object) {
            return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
          };
          if (a->getAABB().overlap(b->getAABB()))
            static_cast<std::vector<BoxPair>*>(data)->push_back({index(a), index(b)});
          return false;
        });
  }

 private:
  std::vector<std::unique_ptr<fcl::CollisionObject<float>>> objects_;
  fcl::DynamicAABBTreeCollisionManager<float> manager_;
};

}  // namespace

std::vector<PairFinderInfo> fcl_broad_phases() {
  return {{"FCL, tree", 100'000, 10'000, [] { return std::make_unique<DynamicTree>(); }}};
}

std::vector<PairFinderInfo> broad_phase_peers() {
  std::vector<PairFinderInfo> all = bullet_broad_phases();
  for (auto* const list : {&fcl_broad_phases, &ode_broad_phases, &embree_broad_phases})
    for (const PairFinderInfo& info : list()) all.push_back(info);
  return all;
}

}  // namespace contactscope::peers
