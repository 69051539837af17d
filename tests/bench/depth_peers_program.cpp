// contactscope-depth-peers: Bullet and libccd as peers of the studies `penetration` and
// `hull_precision`. src/study/peers.h documents its input and output.
#include <BulletCollision/CollisionShapes/btConvexPolyhedron.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>
#include <btBulletCollisionCommon.h>
#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace {

struct Vector {
  double x = 0, y = 0, z = 0;
};
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Found {
  double depth = -1;
  Vector normal;  // from A to B
};

/// A hull for both libraries, about its own middle.
struct Hull {
  std::vector<Vector> vertices;
  Vector middle;
  std::unique_ptr<btConvexHullShape> shape = std::make_unique<btConvexHullShape>();

  explicit Hull(std::istream& in) {
    std::size_t count = 0;
    in >> count;
    for (std::size_t i = 0; in && i < count; ++i) {
      Vector& vertex = vertices.emplace_back();
      in >> vertex.x >> vertex.y >> vertex.z;
      middle.x += vertex.x / static_cast<double>(count);
      middle.y += vertex.y / static_cast<double>(count);
      middle.z += vertex.z / static_cast<double>(count);
    }
    shape->setMargin(0);  // otherwise the hull would be larger by it
    for (const Vector& vertex : vertices)
      shape->addPoint(btVector3(btScalar(vertex.x - middle.x), btScalar(vertex.y - middle.y),
                                btScalar(vertex.z - middle.z)),
                      false);
    shape->recalcLocalAabb();
    shape->initializePolyhedralFeatures();
  }
  btTransform pose() const {
    return btTransform(btQuaternion::getIdentity(),
                       btVector3(btScalar(middle.x), btScalar(middle.y), btScalar(middle.z)));
  }
};

struct Pair {
  Hull a, b;
  explicit Pair(std::istream& in) : a(in), b(in) {}
};

Vector vector_of(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

/// How far B must move along a direction until the hulls are separated.
double depth_along(const Pair& pair, const Vector& direction) {
  double farthest_of_a = -1e300, nearest_of_b = 1e300;
  for (const Vector& vertex : pair.a.vertices)
    farthest_of_a = std::max(farthest_of_a, dot(direction, vertex));
  for (const Vector& vertex : pair.b.vertices)
    nearest_of_b = std::min(nearest_of_b, dot(direction, vertex));
  return farthest_of_a - nearest_of_b;
}

/// With the normal's sign for which the depth is nearer to the depth along it: from A to B.
Found oriented(const Pair& pair, double depth, const Vector& normal) {
  const Vector reversed{-normal.x, -normal.y, -normal.z};
  const double along = std::abs(depth_along(pair, normal) - depth),
               against = std::abs(depth_along(pair, reversed) - depth);
  return {depth, along <= against ? normal : reversed};
}

Found bullet_epa(const Pair& pair) {
  const btTransform a = pair.a.pose(), b = pair.b.pose();
  btGjkEpaSolver2::sResults result;
  const bool found = btGjkEpaSolver2::Penetration(pair.a.shape.get(), a, pair.b.shape.get(), b,
                                                  b.getOrigin() - a.getOrigin(), result, false);
  if (!found) return {};
  return oriented(pair, -double(result.distance), vector_of(result.normal));
}

Found bullet_sat(const Pair& pair) {
  const btConvexPolyhedron &a = *pair.a.shape->getConvexPolyhedron(),
                           &b = *pair.b.shape->getConvexPolyhedron();
  const btTransform pose_a = pair.a.pose(), pose_b = pair.b.pose();
  btVector3 axis;
  struct NoResult : btDiscreteCollisionDetectorInterface::Result {
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3&, const btVector3&, btScalar) override {}
  } none;
  if (!btPolyhedralContactClipping::findSeparatingAxis(a, b, pose_a, pose_b, axis, none)) return {};
  btScalar low_a = 0, high_a = 0, low_b = 0, high_b = 0;
  btVector3 end, other;
  a.project(pose_a, axis, low_a, high_a, end, other);
  b.project(pose_b, axis, low_b, high_b, end, other);
  return oriented(pair, std::min(double(high_a - low_b), double(high_b - low_a)), vector_of(axis));
}

void farthest(const void* hull, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Vector along{direction->v[0], direction->v[1], direction->v[2]};
  const std::vector<Vector>& vertices = static_cast<const Hull*>(hull)->vertices;
  const Vector& most = *std::max_element(
      vertices.begin(), vertices.end(),
      [&](const Vector& one, const Vector& other) { return dot(one, along) < dot(other, along); });
  ccdVec3Set(point, most.x, most.y, most.z);
}

void middle_of(const void* hull, ccd_vec3_t* point) {
  const Vector& middle = static_cast<const Hull*>(hull)->middle;
  ccdVec3Set(point, middle.x, middle.y, middle.z);
}

ccd_t settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = farthest;
  ccd.center1 = ccd.center2 = middle_of;
  ccd.max_iterations = 1000;
  ccd.epa_tolerance = ccd.mpr_tolerance = 1e-6;
  return ccd;
}

Found ccd_of(const Pair& pair, decltype(&ccdGJKPenetration) method) {
  const ccd_t ccd = settings();
  ccd_real_t depth = 0;
  ccd_vec3_t direction, place;
  if (method(&pair.a, &pair.b, &ccd, &depth, &direction, &place) != 0) return {};
  return oriented(pair, depth, {direction.v[0], direction.v[1], direction.v[2]});
}

/// Of the processor, not of the clock: a pass may be long, and other programs may interrupt it.
double nanoseconds_used() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

}  // namespace

int main() {
  std::string word;
  std::size_t repetitions = 0, count = 0;
  std::cin >> word >> repetitions >> word >> count;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; std::cin && i < count; ++i) pairs.push_back(Pair(std::cin));
  if (!std::cin || pairs.empty() || repetitions == 0) {
    std::cerr << "the request is torn\n";
    return 2;
  }
  const std::vector<std::pair<std::string, std::function<Found(const Pair&)>>> methods = {
      {"Bullet, EPA", bullet_epa},
      {"Bullet, SAT", bullet_sat},
      {"libccd, EPA", [](const Pair& pair) { return ccd_of(pair, &ccdGJKPenetration); }},
      {"libccd, MPR", [](const Pair& pair) { return ccd_of(pair, &ccdMPRPenetration); }}};
  std::cout.precision(17);
  double sum = 0;
  for (const auto& [name, find] : methods) {
    std::cout << "name " << name << "\nnanoseconds " << repetitions << '\n';
    for (std::size_t i = 0; i < repetitions; ++i) {
      const double start = nanoseconds_used();
      for (const Pair& pair : pairs) sum += find(pair).depth;
      std::cout << (nanoseconds_used() - start) / static_cast<double>(pairs.size()) << '\n';
    }
    for (const Pair& pair : pairs) {
      const Found found = find(pair);
      std::cout << found.depth << ' ' << found.normal.x << ' ' << found.normal.y << ' '
                << found.normal.z << '\n';
    }
  }
  if (sum == 0.123) std::cerr << sum;  // keeps the compiler from removing the sums
  return 0;
}
