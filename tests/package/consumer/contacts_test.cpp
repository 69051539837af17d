#include <contactscope/collide.h>
#include <contactscope/gtest.h>

using contactscope::IsManifold;
using contactscope::MatchesSnapshot;

contactscope::Contacts crate_on_ground(double height) {
  const contactscope::Collider ground = contactscope::Plane{};
  const contactscope::Collider crate = contactscope::Box{{0.5, 0.4, 0.5}};
  return collide(ground, {}, crate, {{0, height, 0}, {}});
}

TEST(Crate, StandsOnItsCorners) {
  const contactscope::Contacts contacts = crate_on_ground(0.38);
  ASSERT_EQ(contacts.manifolds.size(), 1u);
  EXPECT_THAT(contacts.manifolds[0],
              IsManifold({0, 1, 0}, 0.02,
                         {{0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, 0.5}, {-0.5, 0, -0.5}}, 1e-9));
}

TEST(Crate, StandsAsBefore) {
  EXPECT_THAT(crate_on_ground(0.38), MatchesSnapshot("crate/on_ground"));
}

TEST(Crate, StandsAsBeforeForAnyFramework) {
  const contactscope::Manifold manifold = crate_on_ground(0.38).manifolds[0];
  const auto same = contactscope::compare_with_snapshot(manifold, "crate/on_ground");
  EXPECT_TRUE(same.ok) << same.message;
}
