// Bullet 3.24 (the boxes of GImpact's trees) and FCL 0.7, as Debian builds them.
#include <BulletCollision/Gimpact/btBoxCollision.h>
#include <fcl/math/bv/OBB.h>

#include <memory>

#include "bench/overlap_pairs.h"

namespace contactscope::bench {
namespace {

btVector3 vector_of(const Vec3f& v) { return btVector3(v.x(), v.y(), v.z()); }

struct BulletBox {
  btTransform pose;
  btAABB box;
};

BulletBox bullet_box(const Obb<float>& box) {
  const Mat3<float>& m = box.axes;
  BulletBox result;
  result.pose.setBasis(
      btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)));
  result.pose.setOrigin(vector_of(box.center));
  result.box.m_max = vector_of(box.half_extents);
  result.box.m_min = -result.box.m_max;
  return result;
}

using BulletPairs = std::vector<std::pair<BulletBox, BulletBox>>;
using FclPairs = std::vector<std::pair<fcl::OBBf, fcl::OBBf>>;

}  // namespace

std::vector<std::pair<std::string, OverlapPass>> peer_passes(const std::vector<BoxPair>& pairs) {
  const auto bullet = std::make_shared<BulletPairs>();
  const auto fcl_pairs = std::make_shared<FclPairs>();
  for (const BoxPair& pair : pairs) {
    bullet->emplace_back(bullet_box(pair.a), bullet_box(pair.b));
    fcl_pairs->emplace_back(fcl::OBBf(pair.a.axes, pair.a.center, pair.a.half_extents),
                            fcl::OBBf(pair.b.axes, pair.b.center, pair.b.half_extents));
  }
  return {{"Bullet, GImpact's boxes",
           [bullet](const std::vector<BoxPair>&, std::vector<char>& answers) {
             for (std::size_t i = 0; i < bullet->size(); ++i) {
               const auto& [a, b] = (*bullet)[i];
               BT_BOX_BOX_TRANSFORM_CACHE between;
               between.calc_from_homogenic(a.pose, b.pose);
               answers[i] = a.box.overlapping_trans_cache(b.box, between, true) ? 1 : 0;
             }
           }},
          {"FCL, OBB", [fcl_pairs](const std::vector<BoxPair>&, std::vector<char>& answers) {
             for (std::size_t i = 0; i < fcl_pairs->size(); ++i)
               answers[i] = (*fcl_pairs)[i].first.overlap((*fcl_pairs)[i].second) ? 1 : 0;
           }}};
}

}  // namespace contactscope::bench
