#include <ode/ode.h>

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

class Space : public PairFinder {
 public:
  explicit Space(dSpaceID space) : space_(space) {}
  ~Space() override { dSpaceDestroy(space_); }
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    for (const int index : moved) {
      const auto i = static_cast<std::size_t>(index);
      const Aabb<double> box = boxes[i].cast<double>();
      const Vec3<double> sides = box.extent(), center = box.center();
      if (geoms_.size() == i) {
        geoms_.push_back(dCreateBox(space_, sides.x(), sides.y(), sides.z()));
        dGeomSetData(geoms_[i], reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
      }
      dGeomSetPosition(geoms_[i], center.x(), center.y(), center.z());
    }
  }

  void find(std::vector<BoxPair>& found) override {
    dSpaceCollide(space_, &found, [](void* data, dGeomID a, dGeomID b) {
      const auto index = [](dGeomID geom) {
        return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom)));
      };
      static_cast<std::vector<BoxPair>*>(data)->push_back({index(a), index(b)});
    });
  }

 private:
  dSpaceID space_;
  std::vector<dGeomID> geoms_;
};

}  // namespace

std::vector<PairFinderInfo> ode_broad_phases() {
  dInitODE2(0);
  return {
      {"ODE, sweep", 10'000, 10'000,
       [] { return std::make_unique<Space>(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY)); }},
      {"ODE, hash", 10'000, 10'000,
       [] { return std::make_unique<Space>(dHashSpaceCreate(nullptr)); }}};
}

}  // namespace contactscope::peers
