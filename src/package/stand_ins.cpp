#include "package/stand_ins.h"

#include <cmath>

#include "core/at.h"
#include "core/convex_polygon.h"

namespace contactscope::package {
namespace {

constexpr const char* kA = "a";
constexpr const char* kB = "b";
constexpr double kBall = 0.05;       // metres: the shapes of a single point have no known size
constexpr double kThickness = 0.05;  // of a capsule, relative to the distance of its ends

contactscope::trace::Shape plane_of(const contactscope::trace::Manifold* manifold) {
  contactscope::trace::Shape shape;
  shape.name = kA;
  shape.type = "plane";
  shape.half_space = contactscope::trace::HalfSpace{};
  if (manifold == nullptr || !(manifold->normal.norm() > 0)) return shape;
  Vec3d middle = Vec3d::Zero();
  for (const contactscope::trace::Point& point : manifold->points) middle += point.position;
  middle /= static_cast<double>(manifold->points.size());
  const Vec3d normal = manifold->normal.normalized();
  shape.half_space = contactscope::trace::HalfSpace{normal, normal.dot(middle)};
  return shape;
}

contactscope::trace::Shape outline_of(const std::vector<Vec3d>& places, const Vec3d& normal) {
  contactscope::trace::Shape shape;
  shape.name = kB;
  for (const int corner : convex_outline(project(places, normal)))
    shape.vertices.push_back(at(places, corner));
  for (const Vec3d& vertex : shape.vertices)
    shape.center_of_mass += vertex / static_cast<double>(shape.vertices.size());
  const int corners = count_of(shape.vertices);
  if (corners == 1) {
    shape.type = "sphere";
    shape.radius = kBall;
  } else if (corners == 2) {
    shape.type = "capsule";
    shape.radius = kThickness * (shape.vertices[1] - shape.vertices[0]).norm();
    shape.edges = {{0, 1}};
  } else {
    shape.type = "hull";
    shape.faces.resize(2);
    for (int i = 0; i < corners; ++i) {
      shape.faces[0].push_back(i);
      shape.faces[1].push_back(corners - 1 - i);
    }
    contactscope::trace::Shape::edges_from_faces(shape);
  }
  return shape;
}

}  // namespace

contactscope::trace::Trace with_stand_ins(const std::vector<Manifold>& manifolds, Scalar scalar) {
  contactscope::trace::Trace trace;
  contactscope::trace::Frame& frame = trace.frames.emplace_back();
  contactscope::trace::Pair& pair = frame.pairs.emplace_back();
  pair.a = kA;
  pair.b = kB;
  std::vector<Vec3d> places;
  for (const Manifold& manifold : manifolds) {
    if (manifold.points.empty()) continue;
    pair.manifolds.push_back(to_inside(manifold));
    for (const ContactPoint& point : manifold.points) places.push_back(to_inside(point.position));
  }
  contactscope::trace::Header& header = trace.header;
  header.scenario = TraceInfo{}.scenario;
  header.source = "Contacts alone; the shapes are stand-ins";
  header.scalar = name_of(scalar);
  header.up = "y";
  header.frames = 1;
  header.shapes.push_back(plane_of(pair.manifolds.empty() ? nullptr : &pair.manifolds.front()));
  if (places.empty()) places.push_back(Vec3d::Zero());
  header.shapes.push_back(outline_of(places, header.shapes.front().half_space->normal));
  frame.poses = {{kA, {}}, {kB, {}}};
  const std::string& type = header.shapes.back().type;
  pair.kind = "plane-" + type;
  pair.state = pair.manifolds.empty() ? "separated" : "touching";
  pair.separation = separation_of(manifolds);
  return trace;
}

}  // namespace contactscope::package
