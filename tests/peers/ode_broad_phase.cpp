#include <ode/ode.h>

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

class Space : public BroadPhasePeer {
 public:
  Space(const char* name, dSpaceID space) : name_(name), space_(space) {}
  ~Space() override { dSpaceDestroy(space_); }
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  const char* name() const override { return name_; }

  void place(std::span<const Aabb<float>> boxes) override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Aabb<double> box = boxes[i].cast<double>();
      const Vec3<double> sides = box.extent(), center = box.center();
      if (geoms_.size() == i) {
        geoms_.push_back(dCreateBox(space_, sides.x(), sides.y(), sides.z()));
        dGeomSetData(geoms_[i], reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
      }
      dGeomSetPosition(geoms_[i], center.x(), center.y(), center.z());
    }
  }

  std::vector<std::pair<int, int>> pairs() override {
    std::vector<std::pair<int, int>> found;
    dSpaceCollide(space_, &found, [](void* data, dGeomID a, dGeomID b) {
      const auto index = [](dGeomID geom) {
        return static_cast<int>(reinterpret_cast<std::intptr_t>(dGeomGetData(geom)));
      };
      static_cast<std::vector<std::pair<int, int>>*>(data)->emplace_back(index(a), index(b));
    });
    return found;
  }

 private:
  const char* name_;
  dSpaceID space_;
  std::vector<dGeomID> geoms_;
};

}  // namespace

std::vector<std::unique_ptr<BroadPhasePeer>> ode_broad_phases() {
  dInitODE2(0);
  std::vector<std::unique_ptr<BroadPhasePeer>> all;
  all.push_back(
      std::make_unique<Space>("ODE sweep", dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY)));
  all.push_back(std::make_unique<Space>("ODE hash", dHashSpaceCreate(nullptr)));
  return all;
}

}  // namespace contactscope::peers
