#include "core/feature_id.h"

#include <set>

#include <gtest/gtest.h>

namespace contactscope {
namespace {

TEST(FeatureId, TheSameCrossingHasOneIdInEitherOrder) {
  const FeatureRef a3{Owner::A, 3};
  const FeatureRef b7{Owner::B, 7};
  EXPECT_EQ(FeatureId::of(a3, b7), FeatureId::of(b7, a3));
  EXPECT_EQ(FeatureId::of(b7, a3).first, a3);
  EXPECT_EQ(FeatureId::of({Owner::A, 9}, {Owner::A, 2}).first, (FeatureRef{Owner::A, 2}));
}

TEST(FeatureId, FlippingSwapsTheOwnersAndStaysSorted) {
  const FeatureId id = FeatureId::of({Owner::A, 3}, {Owner::B, 7});
  EXPECT_EQ(id.flipped(), FeatureId::of({Owner::A, 7}, {Owner::B, 3}));
  EXPECT_EQ(id.flipped().flipped(), id);
  EXPECT_EQ(id.flipped().first.owner, Owner::A);
  const FeatureId corner = FeatureId::of({Owner::B, 4}, {Owner::B, 1});
  EXPECT_EQ(corner.flipped(), FeatureId::of({Owner::A, 1}, {Owner::A, 4}));
}

TEST(FeatureId, AllCrossingsOfTwoSmallHullsDiffer) {
  std::set<FeatureId> ids;
  for (std::uint32_t i = 0; i < 6; ++i)
    for (std::uint32_t j = 0; j < 6; ++j) ids.insert(FeatureId::of({Owner::A, i}, {Owner::B, j}));
  EXPECT_EQ(ids.size(), 36u);
}

TEST(FeatureId, IsSpelledAsTracesDo) {
  EXPECT_EQ(to_string(FeatureId::of({Owner::B, 7}, {Owner::A, 3})), "a:e3 b:e7");
  EXPECT_EQ(to_string(FeatureId::of({Owner::B, 12}, {Owner::B, 4})), "b:e4 b:e12");
}

}  // namespace
}  // namespace contactscope
