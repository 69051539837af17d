#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

btVector3 vector_of(const Vec3<float>& v) { return {v.x(), v.y(), v.z()}; }

void* name_of(int index) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(index)); }
int index_of(void* name) { return static_cast<int>(reinterpret_cast<std::intptr_t>(name)); }

/// The broad phase of a Bullet world: two trees, with pairs kept from step to step.
class Broadphase : public PairFinder {
 public:
  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    for (const int index : moved) {
      const auto i = static_cast<std::size_t>(index);
      const btVector3 lower = vector_of(boxes[i].lower), upper = vector_of(boxes[i].upper);
      if (proxies_.size() == i) {
        proxies_.push_back(phase_.createProxy(lower, upper, 0, name_of(index), 1, 1, &dispatcher_));
      } else {
        phase_.setAabb(proxies_[i], lower, upper, &dispatcher_);
      }
    }
  }

  void find(std::vector<BoxPair>& found) override {
    phase_.calculateOverlappingPairs(&dispatcher_);
    btBroadphasePairArray& pairs = phase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      found.push_back({index_of(pairs[i].m_pProxy0->m_clientObject),
                       index_of(pairs[i].m_pProxy1->m_clientObject)});
    }
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase phase_;
  std::vector<btBroadphaseProxy*> proxies_;
};

/// The tree alone, which searches for each pair again.
class TreeAgainstItself : public PairFinder {
 public:
  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    for (const int index : moved) {
      const auto i = static_cast<std::size_t>(index);
      btDbvtVolume volume =
          btDbvtVolume::FromMM(vector_of(boxes[i].lower), vector_of(boxes[i].upper));
      if (leaves_.size() == i) {
        leaves_.push_back(tree_.insert(volume, name_of(index)));
      } else {
        tree_.update(leaves_[i], volume);
      }
    }
    tree_.optimizeIncremental(1 + static_cast<int>(moved.size()) / 100);
  }

  void find(std::vector<BoxPair>& found) override {
    struct Collect : btDbvt::ICollide {
      std::vector<BoxPair>& found;
      explicit Collect(std::vector<BoxPair>& pairs) : found(pairs) {}
      void Process(const btDbvtNode* a, const btDbvtNode* b) override {
        if (a != b) found.push_back({index_of(a->data), index_of(b->data)});
      }
    } collect(found);
    tree_.collideTT(tree_.m_root, tree_.m_root, collect);
  }

 private:
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
};

}  // namespace

std::vector<PairFinderInfo> bullet_broad_phases() {
  return {
      {"Bullet, dbvt", 100'000, 10'000, [] { return std::make_unique<Broadphase>(); }},
      {"Bullet, collideTT", 100'000, 10'000, [] { return std::make_unique<TreeAgainstItself>(); }}};
}

}  // namespace contactscope::peers
