/// Records the contacts of FCL 0.6 or later (float or double) for contactscope:
///
///     contactscope::FclRecorder<double> recorder("pairs.jsonl");
///     recorder.begin_frame(time);
///     fcl::collide(&a, &b, request, result);
///     recorder.pair(a, b, result);             // for each pair, after fcl::collide
///
/// C++11. Define CONTACTSCOPE_IMPLEMENTATION before this include in one source file. README.md
/// explains the conversions. FCL has no solver, so there are no impulses.
///
/// MIT License; the text is in recorder/contactscope.h.
#pragma once

#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_result.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "../recorder/contactscope.h"

namespace contactscope {

template <class S> class FclRecorder {
 public:
  /// `scenario` is GROUP/IDEA, the folder of the pictures.
  explicit FclRecorder(const char* path, const char* scenario = "fcl/run", bool z_up = true) {
    cs_settings settings = cs_settings();
    settings.doubles = sizeof(S) == sizeof(double);
    settings.z_up = z_up;
    recorder_ = cs_start(path, scenario, "FCL", FCL_VERSION, &settings);
    if (!recorder_) std::fprintf(stderr, "contactscope: %s cannot be written\n", path);
  }
  ~FclRecorder() { cs_stop(recorder_); }
  FclRecorder(const FclRecorder&) = delete;
  FclRecorder& operator=(const FclRecorder&) = delete;

  /// Call it before the first frame with the object. The default is the shape's kind and a number.
  void name(const fcl::CollisionObject<S>& object, const std::string& name) {
    names_[&object] = name;
  }

  /// Ends the previous frame.
  void begin_frame(double time) { cs_begin_frame(recorder_, time); }

  /// Records an object that may have no contacts.
  void object(const fcl::CollisionObject<S>& object) { placed(object); }

  /// `result` is that of fcl::collide(&a, &b, request, result), with enable_contact in the request.
  void pair(const fcl::CollisionObject<S>& a, const fcl::CollisionObject<S>& b,
            const fcl::CollisionResult<S>& result) {
    const int shape_a = placed(a), shape_b = placed(b);
    if (shape_a < 0 || shape_b < 0) return;
    std::map<std::array<double, 4>, std::vector<cs_point>> found;  // by triangle and normal
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const fcl::Contact<S>& contact = result.getContact(i);
      // FCL swaps pairs that it implements in one order only; o1 and o2 show it.
      const bool is_swapped =
          contact.o1 != a.collisionGeometry().get() && contact.o1 == b.collisionGeometry().get();
      const double sign = is_swapped ? -1 : 1;
      const fcl::Vector3<S>& n = contact.normal;  // from o1 to o2
      const int triangle = triangle_of(contact.o1, contact.b1) >= 0
                               ? triangle_of(contact.o1, contact.b1)
                               : triangle_of(contact.o2, contact.b2);
      cs_point point = cs_point();
      for (int k = 0; k < 3; ++k) point.position[k] = double(contact.pos[k]);
      point.separation = -double(contact.penetration_depth);
      found[{{double(triangle), sign * double(n[0]), sign * double(n[1]), sign * double(n[2])}}]
          .push_back(point);
    }
    for (const auto& entry : found)
      cs_manifold(recorder_, shape_a, shape_b, &entry.first[1], int(entry.first[0]),
                  entry.second.data(), int(entry.second.size()));
  }

  /// Null if the file cannot be created.
  cs_recorder* recorder() const { return recorder_; }

 private:
  struct Known {
    const fcl::CollisionGeometry<S>* geometry;
    fcl::Vector3<S> low, high;  // corners of its local box, which change with its size
    int shape;                  // -1: not recorded
  };

  int placed(const fcl::CollisionObject<S>& object) {
    if (!recorder_) return -1;
    const fcl::CollisionGeometry<S>* geometry = object.collisionGeometry().get();
    auto known = known_.find(&object);
    if (known == known_.end() || known->second.geometry != geometry ||
        known->second.low != geometry->aabb_local.min_ ||
        known->second.high != geometry->aabb_local.max_) {
      if (known != known_.end()) known_.erase(known);
      const Known made = {geometry, geometry->aabb_local.min_, geometry->aabb_local.max_,
                          add(object, *geometry)};
      known = known_.insert({&object, made}).first;
    }
    const fcl::Vector3<S> place = object.getTranslation();
    const fcl::Quaternion<S> turn(object.getRotation());
    const double position[3] = {double(place[0]), double(place[1]), double(place[2])};
    const double quat_wxyz[4] = {double(turn.w()), double(turn.x()), double(turn.y()),
                                 double(turn.z())};
    cs_pose(recorder_, known->second.shape, position, quat_wxyz);
    return known->second.shape;
  }

  static bool is_mesh(const fcl::CollisionGeometry<S>* geometry) {
    return geometry->getObjectType() == fcl::OT_BVH;
  }
  static int triangle_of(const fcl::CollisionGeometry<S>* geometry, long long index) {
    return is_mesh(geometry) ? int(index) : -1;
  }

  template <class Shape> static const Shape& as(const fcl::CollisionGeometry<S>& geometry) {
    return static_cast<const Shape&>(geometry);
  }

  int add(const fcl::CollisionObject<S>& object, const fcl::CollisionGeometry<S>& geometry) {
    const auto given = names_.find(&object);
    const auto called = [&](const char* word) {
      return given != names_.end() ? given->second : word + (" " + std::to_string(++count_));
    };
    switch (geometry.getNodeType()) {
      case fcl::GEOM_BOX: {
        const fcl::Vector3<S> half = as<fcl::Box<S>>(geometry).side / 2;
        return cs_box(recorder_, called("box").c_str(), double(half[0]), double(half[1]),
                      double(half[2]));
      }
      case fcl::GEOM_SPHERE:
        return cs_sphere(recorder_, called("sphere").c_str(),
                         double(as<fcl::Sphere<S>>(geometry).radius));
      case fcl::GEOM_CAPSULE: {
        const fcl::Capsule<S>& capsule = as<fcl::Capsule<S>>(geometry);
        const double from[3] = {0, 0, -double(capsule.lz) / 2},
                     to[3] = {0, 0, double(capsule.lz) / 2};
        return cs_capsule(recorder_, called("capsule").c_str(), from, to, double(capsule.radius));
      }
      case fcl::GEOM_CYLINDER: {
        const fcl::Cylinder<S>& cylinder = as<fcl::Cylinder<S>>(geometry);
        return cs_cylinder(recorder_, called("cylinder").c_str(), 2, double(cylinder.lz) / 2,
                           double(cylinder.radius));
      }
      case fcl::GEOM_CONE: {
        const fcl::Cone<S>& cone = as<fcl::Cone<S>>(geometry);
        return cs_cone(recorder_, called("cone").c_str(), 2, double(cone.lz) / 2,
                       double(cone.radius));
      }
      case fcl::GEOM_HALFSPACE: {
        const fcl::Halfspace<S>& half_space = as<fcl::Halfspace<S>>(geometry);
        const double normal[3] = {double(half_space.n[0]), double(half_space.n[1]),
                                  double(half_space.n[2])};
        return cs_plane(recorder_, called("plane").c_str(), normal, double(half_space.d));
      }
      case fcl::GEOM_CONVEX: {
        std::vector<double> points;
        for (const fcl::Vector3<S>& v : as<fcl::Convex<S>>(geometry).getVertices()) put(v, points);
        return add_hull(called("hull"), points);
      }
      case fcl::GEOM_ELLIPSOID:
        cs_note(recorder_, "FCL: an ellipsoid is recorded as the hull of 1000 of its points");
        return add_hull(called("ellipsoid"), points_of(as<fcl::Ellipsoid<S>>(geometry).radii));
      case fcl::GEOM_TRIANGLE: {
        const fcl::TriangleP<S>& triangle = as<fcl::TriangleP<S>>(geometry);
        std::vector<double> points;
        for (const fcl::Vector3<S>* v : {&triangle.a, &triangle.b, &triangle.c}) put(*v, points);
        const int corners[3] = {0, 1, 2};
        return cs_mesh(recorder_, called("triangle").c_str(), points.data(), 3, corners, 1);
      }
      case fcl::BV_AABB:
        return add_mesh<fcl::AABB<S>>(called("mesh"), geometry);
      case fcl::BV_OBB:
        return add_mesh<fcl::OBB<S>>(called("mesh"), geometry);
      case fcl::BV_RSS:
        return add_mesh<fcl::RSS<S>>(called("mesh"), geometry);
      case fcl::BV_kIOS:
        return add_mesh<fcl::kIOS<S>>(called("mesh"), geometry);
      case fcl::BV_OBBRSS:
        return add_mesh<fcl::OBBRSS<S>>(called("mesh"), geometry);
      case fcl::BV_KDOP16:
        return add_mesh<fcl::KDOP<S, 16>>(called("mesh"), geometry);
      case fcl::BV_KDOP18:
        return add_mesh<fcl::KDOP<S, 18>>(called("mesh"), geometry);
      case fcl::BV_KDOP24:
        return add_mesh<fcl::KDOP<S, 24>>(called("mesh"), geometry);
      case fcl::GEOM_PLANE:
        cs_note(recorder_, "FCL: a Plane is left out because it has two sides; use a Halfspace");
        return -1;
      default:
        cs_note(recorder_, "FCL: an octree or a geometry of unknown type is left out");
        return -1;
    }
  }

  template <class Vector> static void put(const Vector& v, std::vector<double>& to) {
    for (int k = 0; k < 3; ++k) to.push_back(double(v[k]));
  }

  int add_hull(const std::string& name, const std::vector<double>& points) {
    return cs_hull(recorder_, name.c_str(), points.data(), int(points.size() / 3));
  }

  static std::vector<double> points_of(const fcl::Vector3<S>& radii) {
    std::vector<double> points;
    const int count = 1000;
    for (int i = 0; i < count; ++i) {  // a spiral that covers the sphere evenly
      const double height = 1 - (2 * i + 1) / double(count), turn = 2.39996322972865332 * i;
      const double across = std::sqrt(1 - height * height);
      points.push_back(double(radii[0]) * across * std::cos(turn));
      points.push_back(double(radii[1]) * across * std::sin(turn));
      points.push_back(double(radii[2]) * height);
    }
    return points;
  }

  template <class Volume>
  int add_mesh(const std::string& name, const fcl::CollisionGeometry<S>& geometry) {
    const fcl::BVHModel<Volume>& model = as<fcl::BVHModel<Volume>>(geometry);
    std::vector<double> vertices;
    std::vector<int> triangles;
    for (int i = 0; i < model.num_vertices; ++i) put(model.vertices[i], vertices);
    for (int i = 0; i < model.num_tris; ++i)
      for (std::size_t k = 0; k < 3; ++k) triangles.push_back(int(model.tri_indices[i][k]));
    return cs_mesh(recorder_, name.c_str(), vertices.data(), model.num_vertices, triangles.data(),
                   model.num_tris);
  }

  cs_recorder* recorder_;
  int count_ = 0;
  std::map<const fcl::CollisionObject<S>*, std::string> names_;
  std::map<const fcl::CollisionObject<S>*, Known> known_;
};

}  // namespace contactscope
