#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

class DynamicTree : public BroadPhasePeer {
 public:
  const char* name() const override { return "FCL tree"; }

  void place(std::span<const Aabb<float>> boxes) override {
    const bool first = objects_.empty();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Vec3<float> sides = boxes[i].extent();
      if (first) {
        objects_.push_back(std::make_unique<fcl::CollisionObject<float>>(
            std::make_shared<fcl::Box<float>>(sides.x(), sides.y(), sides.z())));
        objects_[i]->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
      }
      objects_[i]->setTranslation(boxes[i].center());
      objects_[i]->computeAABB();
    }
    if (first) {
      std::vector<fcl::CollisionObject<float>*> all;
      for (const auto& object : objects_) all.push_back(object.get());
      manager_.registerObjects(all);
      manager_.setup();
    } else {
      manager_.update();
    }
  }

  std::vector<std::pair<int, int>> pairs() override {
    std::vector<std::pair<int, int>> found;
    manager_.collide(
        &found, [](fcl::CollisionObject<float>* a, fcl::CollisionObject<float>* b, void* data) {
          const auto index = [](const fcl::CollisionObject<float>* object) {
            return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
          };
          if (a->getAABB().overlap(b->getAABB()))
            static_cast<std::vector<std::pair<int, int>>*>(data)->emplace_back(index(a), index(b));
          return false;
        });
    return found;
  }

 private:
  std::vector<std::unique_ptr<fcl::CollisionObject<float>>> objects_;
  fcl::DynamicAABBTreeCollisionManager<float> manager_;
};

}  // namespace

std::vector<std::unique_ptr<BroadPhasePeer>> fcl_broad_phases() {
  std::vector<std::unique_ptr<BroadPhasePeer>> all;
  all.push_back(std::make_unique<DynamicTree>());
  return all;
}

std::vector<std::unique_ptr<BroadPhasePeer>> broad_phase_peers() {
  std::vector<std::unique_ptr<BroadPhasePeer>> all = bullet_broad_phases();
  for (auto* const make : {&fcl_broad_phases, &ode_broad_phases}) {
    for (std::unique_ptr<BroadPhasePeer>& peer : (*make)()) all.push_back(std::move(peer));
  }
  return all;
}

}  // namespace contactscope::peers
