#include <contactscope/collide.h>
#include <contactscope/gtest.h>

#include <cmath>
#include <limits>

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kQuarter = 0.70710678118654752;  // sine and cosine of 45 degrees

Pose at_height(double y) { return {{0, y, 0}, {}}; }

bool same_bits(const std::vector<Manifold>& one, const std::vector<Manifold>& other) {
  if (one.size() != other.size()) return false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].normal != other[i].normal || one[i].points.size() != other[i].points.size())
      return false;
    for (std::size_t k = 0; k < one[i].points.size(); ++k) {
      const ContactPoint &p = one[i].points[k], &q = other[i].points[k];
      if (p.position != q.position || p.separation != q.separation || p.id != q.id) return false;
    }
  }
  return true;
}

TEST(PackageCollide, BoxStandsOnItsCornersInEitherScalar) {
  for (const Scalar scalar : {Scalar::Float, Scalar::Double}) {
    CollideOptions options;
    options.scalar = scalar;
    const Contacts contacts =
        collide(Plane{}, {}, Box{{0.5, 0.25, 0.5}}, at_height(0.234375), options);
    EXPECT_EQ(contacts.status, ContactStatus::Touching);
    EXPECT_EQ(contacts.separation, -0.015625);
    ASSERT_EQ(contacts.manifolds.size(), 1u);
    EXPECT_THAT(
        contacts.manifolds[0],
        IsManifold({0, 1, 0}, 0.015625,
                   {{0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, 0.5}, {-0.5, 0, -0.5}}, 0.015625));
    EXPECT_EQ(contacts.manifolds[0].type, "face-face");
  }
}

TEST(PackageCollide, SpheresMeetAlongTheLineOfTheirCentres) {
  const Contacts contacts = collide(Sphere{1}, {}, Sphere{0.5}, {{0.84, 1.12, 0}, {}});
  ASSERT_EQ(contacts.manifolds.size(), 1u);
  ASSERT_EQ(contacts.manifolds[0].points.size(), 1u);
  EXPECT_NEAR(contacts.separation, 1.4 - 1.5, 1e-12);
  EXPECT_NEAR(contacts.manifolds[0].normal.x, 0.6, 1e-12);
  EXPECT_NEAR(contacts.manifolds[0].normal.y, 0.8, 1e-12);
}

TEST(PackageCollide, CapsuleLiesOnAMesh) {
  const Mesh floor{{{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}}, {{{0, 2, 1}}, {{0, 3, 2}}}};
  const Contacts contacts =
      collide(floor, {}, Capsule{{-0.5, 0, 0.1}, {0.5, 0, 0.1}, 0.2}, at_height(0.19));
  ASSERT_EQ(contacts.manifolds.size(), 1u);
  EXPECT_NEAR(contacts.separation, -0.01, 1e-12);
  EXPECT_EQ(contacts.manifolds[0].triangle, -1);
  EXPECT_EQ(contacts.manifolds[0].points.size(), 2u);
  EXPECT_NEAR(contacts.manifolds[0].normal.y, 1, 1e-12);
}

TEST(PackageCollide, HullIsBuiltOrTakenFromItsFaces) {
  const std::vector<Vec3> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const Hull listed{corners, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  for (const Hull& hull : {Hull{corners}, listed})
    EXPECT_NEAR(collide(Plane{}, {}, hull, at_height(0.9)).separation, -0.1, 1e-12);
}

TEST(PackageCollide, RecordingChangesNoBitAndHasTheStages) {
  const Collider one = Box{{0.5, 0.5, 0.5}}, other = Box{{0.4, 0.3, 0.2}};
  const Pose tilted{{0.2, 0.75, 0.1}, {kQuarter, 0.1, kQuarter, 0.05}};
  CollideOptions options;
  const Contacts alone = collide(one, {}, other, tilted, options);
  EXPECT_EQ(alone.trace.frame_count(), 0);
  options.record = true;
  const Contacts recorded = collide(one, {}, other, tilted, options);
  ASSERT_FALSE(recorded.manifolds.empty());
  EXPECT_TRUE(same_bits(alone.manifolds, recorded.manifolds));
  EXPECT_THAT(recorded.trace.shapes(), ElementsAre("a", "b"));
  EXPECT_THAT(to_json_lines(recorded.trace), HasSubstr("\"sat\":"));
  const Frame frame = recorded.trace.frame(0);
  ASSERT_EQ(frame.pairs.size(), 1u);
  EXPECT_TRUE(same_bits(frame.pairs[0].manifolds, recorded.manifolds));
}

TEST(PackageCollide, FloatResultsAreFloats) {
  CollideOptions options;
  options.scalar = Scalar::Float;
  const Contacts contacts = collide(Sphere{0.3}, {}, Sphere{0.4}, {{0.1, 0.6, 0.2}, {}}, options);
  ASSERT_EQ(contacts.manifolds.size(), 1u);
  for (const double value :
       {contacts.separation, contacts.manifolds[0].normal.x, contacts.manifolds[0].normal.y})
    EXPECT_EQ(value, static_cast<double>(static_cast<float>(value)));
}

TEST(PackageCollide, QuaternionIsMadeUnit) {
  const Box box{{1, 0.1, 0.1}};
  const Contacts turned = collide(Plane{}, {}, box, {{0, 0.95, 0}, {5, 0, 0, 5}});
  EXPECT_NEAR(turned.separation, -0.05, 1e-12);
}

TEST(PackageCollide, GeometryWithoutAnAnswerHasAStatus) {
  EXPECT_EQ(collide(Plane{}, {}, Plane{}, {}).status, ContactStatus::NoSuchPair);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(collide(Sphere{1}, {}, Sphere{1}, at_height(nan)).status, ContactStatus::NotFinite);
  EXPECT_EQ(collide(Sphere{1}, {}, Sphere{1}, {{}, {0, 0, 0, 0}}).status, ContactStatus::NotFinite);
  const Contacts centred = collide(Sphere{1}, {}, Sphere{1}, {});
  EXPECT_EQ(centred.status, ContactStatus::Touching);
  EXPECT_NEAR(centred.separation, -2, 1e-12);
}

TEST(PackageCollide, RecordHasTheSeparation) {
  CollideOptions options;
  options.record = true;
  const Contacts gap = collide(Sphere{1}, {}, Sphere{1}, at_height(2.5), options);
  EXPECT_EQ(gap.status, ContactStatus::Separated);
  EXPECT_THAT(gap.manifolds, IsEmpty());
  EXPECT_NEAR(gap.separation, 0.5, 1e-12);
}

std::string refusal(const Shape& shape) {
  try {
    const Collider made(shape);
  } catch (const ShapeError& error) {
    return error.what();
  }
  return "taken";
}

TEST(PackageCollide, ShapesThatAreNoneAreRefused) {
  EXPECT_THAT(refusal(Sphere{0}), HasSubstr("radius"));
  EXPECT_THAT(refusal(Box{{1, -1, 1}}), testing::Not("taken"));
  EXPECT_THAT(refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), testing::Not("taken"));
  EXPECT_THAT(refusal(Hull{{{0, 0, 0}}, {{0, 1, 2}}}), HasSubstr("vertex 1 of 1"));
  EXPECT_THAT(refusal(Mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{{0, 1, 2}}}}),
              testing::Not("taken"));
  EXPECT_THAT(refusal(Mesh{{{0, 0, 0}}, {{{0, 1, 7}}}}), HasSubstr("indices start at 0"));
  EXPECT_THAT(refusal(Plane{{0, 0, 0}, 1}), HasSubstr("normal"));
}

TEST(PackageCollide, UnknownWordsAreRefusedWithTheKnownOnes) {
  const auto said = [](CollideOptions options) -> std::string {
    try {
      collide(Sphere{1}, {}, Sphere{1}, {}, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "taken";
  };
  CollideOptions reducer, penetration, points, names;
  reducer.reducer = "optimal_depest";
  penetration.penetration = "gjk";
  points.max_points = 0;
  names.name_b = "a";
  EXPECT_THAT(said(reducer), HasSubstr("did you mean 'optimal_deepest'?"));
  EXPECT_THAT(said(penetration), HasSubstr("'sat', 'epa', 'mpr' and 'sampling'"));
  EXPECT_THAT(said(points), HasSubstr("max_points"));
  EXPECT_THAT(said(names), HasSubstr("two different names"));
}

}  // namespace
}  // namespace contactscope
