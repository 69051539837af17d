/// Records Bullet's collision shapes for bullet.h, and finds the shape that a point is on.
///
/// MIT License; the text is in recorder/contactscope.h.
#pragma once

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../recorder/contactscope.h"

namespace contactscope {
namespace bullet {

typedef std::array<double, 3> Vector;
typedef std::array<double, 4> Quaternion;

inline Vector vector_of(const btVector3& v) {
  return {{double(v.x()), double(v.y()), double(v.z())}};
}
inline Quaternion quaternion_of(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {{double(q.w()), double(q.x()), double(q.y()), double(q.z())}};
}

struct Triangle {
  std::array<btVector3, 3> corners;  // in the shape's frame
  int number;                        // in the recorded mesh
};

/// A shape that is not a compound, as a part of a body.
struct Leaf {
  const btCollisionShape* form;
  btTransform in_body;
  int child;  // its index in the parent compound, or -1
  int shape;  // its id in the recorder
  std::map<std::pair<int, int>, std::vector<Triangle>> triangles;  // by Bullet's part and index
};

/// Writes the shapes of bodies. Shapes that cannot be recorded are left out with a note.
class ShapeWriter {
 public:
  explicit ShapeWriter(cs_recorder* recorder) : recorder_(recorder) {}

  /// Writes a shape with its children and returns the recorded leaves. `shape` becomes the only
  /// leaf, or a compound. The default name is the shape's kind and a number.
  std::vector<Leaf> write(const btCollisionShape* form, const std::string& name, int& shape) {
    std::vector<Leaf> leaves;
    if (!form->isCompound()) {
      add(form, btTransform::getIdentity(), -1, name, leaves);
      shape = leaves.empty() ? -1 : leaves[0].shape;
      return leaves;
    }
    const std::string whole = called(name, "compound");
    shape = cs_compound(recorder_, whole.c_str());
    add_children(form, btTransform::getIdentity(), whole, leaves);
    for (const Leaf& leaf : leaves)
      cs_part(recorder_, shape, leaf.shape, vector_of(leaf.in_body.getOrigin()).data(),
              quaternion_of(leaf.in_body).data());
    return leaves;
  }

 private:
  std::string called(const std::string& name, const char* word) {
    return name.empty() ? word + (" " + std::to_string(++count_)) : name;
  }
  void note(const btCollisionShape& form, const std::string& what) {
    cs_note(recorder_, (std::string("Bullet: ") + form.getName() + " is " + what).c_str());
  }

  void add_children(const btCollisionShape* form, const btTransform& in_body,
                    const std::string& name, std::vector<Leaf>& leaves) {
    const btCompoundShape* compound = static_cast<const btCompoundShape*>(form);
    for (int i = 0; i < compound->getNumChildShapes(); ++i) {
      const btCollisionShape* child = compound->getChildShape(i);
      const btTransform place = in_body * compound->getChildTransform(i);
      const std::string part = name + "/" + std::to_string(i);
      if (child->isCompound())
        add_children(child, place, part, leaves);
      else
        add(child, place, i, part, leaves);
    }
  }

  void add(const btCollisionShape* form, const btTransform& in_body, int child,
           const std::string& name, std::vector<Leaf>& leaves) {
    Leaf leaf = {form, in_body, child, -1, {}};
    if (form->isConvex()) {
      leaf.shape = add_convex(*static_cast<const btConvexShape*>(form), name);
    } else if (form->getShapeType() == STATIC_PLANE_PROXYTYPE) {
      const btStaticPlaneShape* plane = static_cast<const btStaticPlaneShape*>(form);
      leaf.shape =
          cs_plane(recorder_, called(name, "plane").c_str(),
                   vector_of(plane->getPlaneNormal()).data(), double(plane->getPlaneConstant()));
    } else if (form->isConcave() && form->getShapeType() != SDF_SHAPE_PROXYTYPE) {
      leaf.shape = add_mesh(*static_cast<const btConcaveShape*>(form), name, leaf);
    } else if (form->getShapeType() != EMPTY_SHAPE_PROXYTYPE) {
      note(*form, "left out");
    }
    if (leaf.shape >= 0) leaves.push_back(leaf);
  }

  /// Boxes and cylinders include their margin; other shapes extend beyond their points by it.
  int add_convex(const btConvexShape& form, const std::string& name) {
    switch (form.getShapeType()) {
      case BOX_SHAPE_PROXYTYPE: {
        const btVector3 half = static_cast<const btBoxShape&>(form).getHalfExtentsWithMargin();
        return cs_box(recorder_, called(name, "box").c_str(), double(half.x()), double(half.y()),
                      double(half.z()));
      }
      case SPHERE_SHAPE_PROXYTYPE:
        return cs_sphere(recorder_, called(name, "sphere").c_str(),
                         double(static_cast<const btSphereShape&>(form).getRadius()));
      case CAPSULE_SHAPE_PROXYTYPE: {
        const btCapsuleShape& capsule = static_cast<const btCapsuleShape&>(form);
        Vector from = {{0, 0, 0}}, to = from;
        to[std::size_t(capsule.getUpAxis())] = double(capsule.getHalfHeight());
        from[std::size_t(capsule.getUpAxis())] = -double(capsule.getHalfHeight());
        return cs_capsule(recorder_, called(name, "capsule").c_str(), from.data(), to.data(),
                          double(capsule.getRadius()));
      }
      case CYLINDER_SHAPE_PROXYTYPE: {
        const btCylinderShape& cylinder = static_cast<const btCylinderShape&>(form);
        const int axis = cylinder.getUpAxis();
        return cs_cylinder(recorder_, called(name, "cylinder").c_str(), axis,
                           double(cylinder.getHalfExtentsWithMargin()[axis]),
                           double(cylinder.getRadius()));
      }
      case CONE_SHAPE_PROXYTYPE: {
        const btConeShape& cone = static_cast<const btConeShape&>(form);
        return with_margin(cs_cone(recorder_, called(name, "cone").c_str(), cone.getConeUpIndex(),
                                   double(cone.getHeight()) / 2, double(cone.getRadius())),
                           form);
      }
      default: {
        const std::vector<double> points = hull_points(form);
        const int count = int(points.size() / 3);
        return with_margin(cs_hull(recorder_, called(name, "hull").c_str(), points.data(), count),
                           form);
      }
    }
  }
  int with_margin(int shape, const btConvexShape& form) {
    cs_margin(recorder_, shape, double(form.getMargin()));
    return shape;
  }

  struct AllCorners : btInternalTriangleIndexCallback {
    void internalProcessTriangleIndex(btVector3* corners, int, int) override {
      for (int k = 0; k < 3; ++k) points.insert(vector_of(corners[k]));
    }
    std::set<Vector> points;
  };

  /// Points without the margin: vertices, or for curved shapes support points in many directions.
  std::vector<double> hull_points(const btConvexShape& form) {
    AllCorners all;
    const btVector3 far = everywhere();
    if (form.getShapeType() == CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE) {
      const_cast<btStridingMeshInterface*>(
          static_cast<const btConvexTriangleMeshShape&>(form).getMeshInterface())
          ->InternalProcessAllTriangles(&all, -far, far);
    } else if (form.isPolyhedral()) {
      const btPolyhedralConvexShape& hull = static_cast<const btPolyhedralConvexShape&>(form);
      for (int i = 0; i < hull.getNumVertices(); ++i) {
        btVector3 vertex;
        hull.getVertex(i, vertex);
        all.points.insert(vector_of(vertex));
      }
    } else {
      const int count = 1000;
      for (int i = 0; i < count; ++i) {  // a spiral that covers the sphere evenly
        const double height = 1 - (2 * i + 1) / double(count), turn = 2.39996322972865332 * i;
        const double across = std::sqrt(1 - height * height);
        const btVector3 direction(btScalar(across * std::cos(turn)), btScalar(height),
                                  btScalar(across * std::sin(turn)));
        all.points.insert(vector_of(form.localGetSupportingVertexWithoutMargin(direction)));
      }
      note(form, "recorded as the hull of 1000 of its support points");
    }
    std::vector<double> flat;
    for (const Vector& point : all.points) flat.insert(flat.end(), point.begin(), point.end());
    return flat;
  }

  static btVector3 everywhere() {
    const btScalar far = btScalar(1e18);
    return btVector3(far, far, far);
  }

  struct AllTriangles : btTriangleCallback {
    void processTriangle(btVector3* corners, int part, int index) override {
      std::array<btVector3, 3> v = {{corners[0], corners[1], corners[2]}};
      // Turn height field triangles upwards, whatever their order in Bullet.
      if (up_axis >= 0 && (v[1] - v[0]).cross(v[2] - v[0])[up_axis] < 0) std::swap(v[1], v[2]);
      for (const btVector3& corner : v) {
        const Vector place = vector_of(corner);
        const auto added = known.insert({place, int(known.size())});
        if (added.second) vertices.insert(vertices.end(), place.begin(), place.end());
        indices.push_back(added.first->second);
      }
      (*triangles)[{part, index}].push_back({v, number++});
    }
    std::map<std::pair<int, int>, std::vector<Triangle>>* triangles = nullptr;
    int up_axis = -1, number = 0;
    std::map<Vector, int> known;
    std::vector<double> vertices;
    std::vector<int> indices;
  };

  int add_mesh(const btConcaveShape& form, const std::string& name, Leaf& leaf) {
    AllTriangles all;
    all.triangles = &leaf.triangles;
    const bool is_field = form.getShapeType() == TERRAIN_SHAPE_PROXYTYPE;
    if (is_field) all.up_axis = static_cast<const btHeightfieldTerrainShape&>(form).getUpAxis();
    form.processAllTriangles(&all, -everywhere(), everywhere());
    if (form.getMargin() > 0)
      note(form, "recorded without its margin, so its contacts begin farther out");
    return cs_mesh(recorder_, called(name, is_field ? "height field" : "mesh").c_str(),
                   all.vertices.data(), int(all.vertices.size() / 3), all.indices.data(),
                   int(all.indices.size() / 3));
  }

  cs_recorder* recorder_;
  int count_ = 0;
};

/// The leaf under a point of a manifold: the one with the point's index, else the nearest one. Null
/// if the body has no leaves. `pose` is the body's.
inline const Leaf* leaf_at(const std::vector<Leaf>& leaves, const btTransform& pose, int part,
                           int index, const btVector3& point) {
  if (leaves.size() < 2) return leaves.empty() ? nullptr : &leaves[0];
  const auto is_named = [&](const Leaf& leaf) {
    return leaf.triangles.empty() ? leaf.child == index : leaf.triangles.count({part, index}) > 0;
  };
  const Leaf* nearest = nullptr;
  bool nearest_is_named = false;
  btScalar least = 0;
  for (const Leaf& leaf : leaves) {
    const bool named = is_named(leaf);
    btVector3 low, high;
    leaf.form->getAabb(pose * leaf.in_body, low, high);
    btVector3 inside = point;
    inside.setMax(low);
    inside.setMin(high);
    const btScalar away = inside.distance2(point);
    if (nearest && (named != nearest_is_named ? nearest_is_named : !(away < least))) continue;
    nearest = &leaf;
    nearest_is_named = named;
    least = away;
  }
  return nearest;
}

/// Triangle of the recorded mesh under a point; -1 for shapes without triangles. Bullet uses one
/// index for both triangles of a height field's cell.
inline int triangle_at(const Leaf& leaf, const btTransform& pose, int part, int index,
                       const btVector3& point) {
  const auto found = leaf.triangles.find({part, index});
  if (found == leaf.triangles.end()) return -1;
  const btVector3 local = (pose * leaf.in_body).inverse() * point;
  int best = -1;
  btScalar most = 0;
  for (const Triangle& triangle : found->second) {
    const std::array<btVector3, 3>& v = triangle.corners;
    const btVector3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
    btScalar inside = std::numeric_limits<btScalar>::max();
    for (std::size_t k = 0; k < 3; ++k) {
      const btVector3 side = normal.cross(v[(k + 1) % 3] - v[k]);
      inside = btMin(inside, side.dot(local - v[k]) / btMax(side.length(), SIMD_EPSILON));
    }
    if (best >= 0 && !(inside > most)) continue;
    best = triangle.number;
    most = inside;
  }
  return best;
}

}  // namespace bullet
}  // namespace contactscope
