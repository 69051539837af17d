#include "bench/overlap_pairs.h"

#include <limits>

#include "support/brute_force_boxes.h"
#include "support/random_geometry.h"

namespace contactscope::bench {

std::vector<BoxPair> overlap_pairs(int count) {
  test::Random random(1);
  std::vector<BoxPair> pairs;
  pairs.reserve(static_cast<std::size_t>(count));
  const auto box = [&](const Vec3d& center, const Quatd& rotation) {
    const Vec3d half(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
    return Obb<float>{center.cast<float>(), rotation.toRotationMatrix().cast<float>(),
                      half.cast<float>()};
  };
  for (int i = 0; i < count; ++i) {
    const Quatd turn = random.rotation();
    const Quatd other = i % 10 == 0 ? Quatd(turn * random.rotation_by(1e-7)) : random.rotation();
    const Vec3d at = 5 * random.unit_vector();
    const Vec3d offset = random.uniform(0, 2.2) * random.unit_vector();
    BoxPair pair{box(at, turn), box(at + offset, other), 0, 0};
    pair.gap = test::exact_gap(pair.a, pair.b);
    pair.rounding =
        32 * double(std::numeric_limits<float>::epsilon()) * test::size_of_pair(pair.a, pair.b);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace contactscope::bench
