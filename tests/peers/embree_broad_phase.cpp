#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "peers/broad_phase_peer.h"

namespace contactscope::peers {
namespace {

/// A ray tracer's tree, rebuilt in Morton order at each step and queried against itself.
class MortonTree : public PairFinder {
 public:
  MortonTree() {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(
        geometry_,
        [](const RTCBoundsFunctionArguments* of) {
          const auto& self = *static_cast<const MortonTree*>(of->geometryUserPtr);
          const Aabb<float>& box = self.boxes_[of->primID];
          RTCBounds& bounds = *of->bounds_o;
          bounds.lower_x = box.lower.x();
          bounds.lower_y = box.lower.y();
          bounds.lower_z = box.lower.z();
          bounds.upper_x = box.upper.x();
          bounds.upper_y = box.upper.y();
          bounds.upper_z = box.upper.z();
        },
        nullptr);
    rtcAttachGeometry(scene_, geometry_);
  }
  ~MortonTree() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  MortonTree(const MortonTree&) = delete;
  MortonTree& operator=(const MortonTree&) = delete;

  void place(std::span<const Aabb<float>> boxes, std::span<const int> /*moved*/) override {
    boxes_ = boxes;
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(boxes.size()));
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  void find(std::vector<BoxPair>& found) override {
    found_ = &found;
    // Embree reports both orders of a pair, and pairs in a leaf even without overlap.
    rtcCollide(
        scene_, scene_,
        [](void* pointer, RTCCollision* collisions, unsigned count) {
          auto& self = *static_cast<MortonTree*>(pointer);
          for (unsigned i = 0; i < count; ++i) {
            const unsigned a = collisions[i].primID0, b = collisions[i].primID1;
            if (a < b && overlaps(self.boxes_[a], self.boxes_[b]))
              self.found_->push_back({static_cast<int>(a), static_cast<int>(b)});
          }
        },
        this);
  }

 private:
  RTCDevice device_ = rtcNewDevice("threads=1,set_affinity=0");
  RTCScene scene_ = rtcNewScene(device_);
  RTCGeometry geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  std::span<const Aabb<float>> boxes_;
  std::vector<BoxPair>* found_ = nullptr;
};

}  // namespace

std::vector<PairFinderInfo> embree_broad_phases() {
  return {
      {"Embree, Morton tree", 1'000'000, 1'000'000, [] { return std::make_unique<MortonTree>(); }}};
}

}  // namespace contactscope::peers
