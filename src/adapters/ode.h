/// Records the contacts and forces of ODE (0.13 or later) for contactscope:
///
///     contactscope::OdeRecorder recorder(world, space, "stack.jsonl");
///     recorder.contact(joint, contact.geom);   // in the near callback, for each contact joint
///     recorder.step(dWorldQuickStep, 0.01);    // instead of dWorldQuickStep(world, 0.01)
///
/// C++11. Define CONTACTSCOPE_IMPLEMENTATION before this include in one source file. README.md
/// explains the conversions. Poses are those of the contacts, from before the step.
///
/// MIT License; the text is in recorder/contactscope.h.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "../recorder/contactscope.h"

namespace contactscope {

class OdeRecorder {
 public:
  /// `scenario` is GROUP/IDEA, the folder of the pictures. Records the geoms of the space and of
  /// spaces in it. World and space must exist during the steps, but may die before the recorder.
  OdeRecorder(dWorldID world, dSpaceID space, const char* path, const char* scenario = "ode/run")
      : world_(world), space_(space) {
    dVector3 down;
    dWorldGetGravity(world, down);
    cs_settings settings = cs_settings();
    settings.doubles = sizeof(dReal) == sizeof(double);
    settings.z_up = std::fabs(down[2]) > std::fabs(down[1]);
    settings.poses_at = 1;
    recorder_ = cs_start(path, scenario, "ODE", dODE_VERSION, &settings);
    if (!recorder_) std::fprintf(stderr, "contactscope: %s cannot be written\n", path);
  }
  ~OdeRecorder() { cs_stop(recorder_); }
  OdeRecorder(const OdeRecorder&) = delete;
  OdeRecorder& operator=(const OdeRecorder&) = delete;

  /// Call it before the first step with the geom or body. The default is its kind and a number. A
  /// body with several geoms has a name, and each of its geoms has one.
  void name(dGeomID geom, const std::string& name) { geom_names_[geom] = name; }
  void name(dBodyID body, const std::string& name) { body_names_[body] = name; }

  /// Surface, in the geom's frame, of a geom that ODE cannot export: a height field or user class.
  /// Three numbers per vertex; three indices per triangle, counter-clockwise seen from outside.
  void form(dGeomID geom, const std::vector<double>& vertices, const std::vector<int>& triangles) {
    forms_[geom] = {vertices, triangles};
  }

  /// Adds a contact of the next step. `joint` is its contact joint, or 0 if it has none. The joint
  /// must exist until the step is over.
  void contact(dJointID joint, const dContactGeom& geom) {
    if (!recorder_) return;
    contacts_.push_back({geom, joint, dJointFeedback(), nullptr});
    Contact& added = contacts_.back();
    if (!joint) return;
    added.feedback = dJointGetFeedback(joint);
    if (added.feedback) return;
    added.feedback = &added.own;
    dJointSetFeedback(joint, added.feedback);
  }

  /// Steps by dWorldQuickStep, dWorldStep or a function like them, and records it.
  int step(int (*solve)(dWorldID, dReal), dReal size) {
    begin(solve == &dWorldQuickStep ? dWorldGetQuickStepNumIterations(world_) : 0);
    const int result = solve(world_, size);
    end(size);
    return result;
  }

  /// Null if the file cannot be created.
  cs_recorder* recorder() const { return recorder_; }

 private:
  typedef std::array<double, 3> Vector;
  struct Contact {
    dContactGeom geom;
    dJointID joint;
    dJointFeedback own;
    dJointFeedback* feedback;  // the program's, or `own`
  };
  struct Form {
    std::vector<double> vertices;
    std::vector<int> triangles;
  };
  /// Changes if the memory holds another geom, or if the geom's form changed.
  struct Signature {
    int type, count, siblings;
    dBodyID body;
    const void* data;
    std::array<dReal, 4> numbers;
    bool operator==(const Signature& other) const {
      return type == other.type && count == other.count && siblings == other.siblings &&
             body == other.body && data == other.data && numbers == other.numbers;
    }
  };
  struct Geom {
    Signature signature;
    int shape;  // -1: not recorded
    bool is_there;
  };
  struct Body {
    int geoms, shape;  // shape: a compound, or of its only geom
    bool is_there;
  };

  static Vector vector_of(const dReal* v) { return {{double(v[0]), double(v[1]), double(v[2])}}; }
  static int geoms_of(dBodyID body) {
    int count = 0;
    for (dGeomID geom = body ? dBodyGetFirstGeom(body) : nullptr; geom;
         geom = dBodyGetNextGeom(geom))
      ++count;
    return count;
  }

  static Signature signature_of(dGeomID geom) {
    Signature is = {dGeomGetClass(geom), 0, 0, dGeomGetBody(geom), nullptr, {{0, 0, 0, 0}}};
    is.siblings = geoms_of(is.body);
    dVector3 lengths;
    dVector4 plane;
    switch (is.type) {
      case dSphereClass:
        is.numbers[0] = dGeomSphereGetRadius(geom);
        break;
      case dBoxClass:
        dGeomBoxGetLengths(geom, lengths);
        is.numbers = {{lengths[0], lengths[1], lengths[2], 0}};
        break;
      case dCapsuleClass:
        dGeomCapsuleGetParams(geom, &is.numbers[0], &is.numbers[1]);
        break;
      case dCylinderClass:
        dGeomCylinderGetParams(geom, &is.numbers[0], &is.numbers[1]);
        break;
      case dPlaneClass:
        dGeomPlaneGetParams(geom, plane);
        is.numbers = {{plane[0], plane[1], plane[2], plane[3]}};
        break;
      case dTriMeshClass:
        is.data = dGeomTriMeshGetData(geom);
        is.count = dGeomTriMeshGetTriangleCount(geom);
        break;
      default:
        break;
    }
    return is;
  }

  std::string called(dGeomID geom, const char* word) {
    const auto name = geom_names_.find(geom);
    if (name != geom_names_.end()) return name->second;
    const auto body = body_names_.find(dGeomGetBody(geom));
    if (body != body_names_.end() && geoms_of(body->first) == 1) return body->second;
    return word + (" " + std::to_string(++count_));
  }

  int add(dGeomID geom, const Signature& is) {
    const auto record = forms_.find(geom);
    if (record != forms_.end())
      return cs_mesh(recorder_, called(geom, "mesh").c_str(), record->second.vertices.data(),
                     int(record->second.vertices.size() / 3), record->second.triangles.data(),
                     int(record->second.triangles.size() / 3));
    const double x = double(is.numbers[0]), y = double(is.numbers[1]), z = double(is.numbers[2]);
    const Vector half = {{0, 0, y / 2}}, other = {{0, 0, -y / 2}}, normal = {{x, y, z}};
    switch (is.type) {
      case dSphereClass:
        return cs_sphere(recorder_, called(geom, "sphere").c_str(), x);
      case dBoxClass:
        return cs_box(recorder_, called(geom, "box").c_str(), x / 2, y / 2, z / 2);
      case dCapsuleClass:
        return cs_capsule(recorder_, called(geom, "capsule").c_str(), other.data(), half.data(), x);
      case dCylinderClass:
        return cs_cylinder(recorder_, called(geom, "cylinder").c_str(), 2, y / 2, x);
      case dPlaneClass:
        return cs_plane(recorder_, called(geom, "plane").c_str(), normal.data(),
                        double(is.numbers[3]));
      case dConvexClass: {
        const std::vector<double> vertices = vertices_of(geom);
        return cs_hull(recorder_, called(geom, "hull").c_str(), vertices.data(),
                       int(vertices.size() / 3));
      }
      case dTriMeshClass:
        return add_mesh(geom, is.count);
      case dHeightfieldClass:
        cs_note(recorder_,
                "ODE: a height field is left out, ODE hides its heights; give them with form()");
        return -1;
      case dRayClass:
        return -1;
      default:
        cs_note(recorder_, "ODE: a geom of unknown class is left out; give its form with form()");
        return -1;
    }
  }

  /// ODE hides the vertices of convex geoms, but a plane collides with every vertex below it.
  static std::vector<double> vertices_of(dGeomID convex) {
    dReal box[6];
    dGeomGetAABB(convex, box);
    std::set<Vector> found;
    std::vector<dContactGeom> contacts(64);
    for (int side = -1; side <= 1; side += 2) {
      const dGeomID plane = dCreatePlane(nullptr, side, 0, 0, side * (box[0] + box[1]) / 2);
      int count = 0;
      while ((count = dCollide(convex, plane, int(contacts.size()), contacts.data(),
                               sizeof(dContactGeom))) == int(contacts.size()) &&
             contacts.size() < 0x8000)
        contacts.resize(2 * contacts.size());
      for (int i = 0; i < count; ++i) {
        const dReal* p = contacts[std::size_t(i)].pos;
        dVector3 local;
        dGeomGetPosRelPoint(convex, p[0], p[1], p[2], local);
        found.insert(vector_of(local));
      }
      dGeomDestroy(plane);
    }
    std::vector<double> flat;
    for (const Vector& point : found) flat.insert(flat.end(), point.begin(), point.end());
    return flat;
  }

  int add_mesh(dGeomID geom, int count) {
    std::map<Vector, int> known;
    Form form;
    for (int i = 0; i < count; ++i) {
      dVector3 corners[3];
      dGeomTriMeshGetTriangle(geom, i, &corners[0], &corners[1], &corners[2]);
      for (const dVector3& corner : corners) {
        dVector3 local;
        dGeomGetPosRelPoint(geom, corner[0], corner[1], corner[2], local);
        const Vector place = vector_of(local);
        const auto added = known.insert({place, int(known.size())});
        if (added.second) form.vertices.insert(form.vertices.end(), place.begin(), place.end());
        form.triangles.push_back(added.first->second);
      }
    }
    return cs_mesh(recorder_, called(geom, "mesh").c_str(), form.vertices.data(),
                   int(form.vertices.size() / 3), form.triangles.data(), count);
  }

  void find_geoms(dSpaceID space) {
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) {
      const dGeomID geom = dSpaceGetGeom(space, i);
      if (dGeomIsSpace(geom)) {
        find_geoms(reinterpret_cast<dSpaceID>(geom));
      } else if (dGeomIsEnabled(geom)) {
        const Signature is = signature_of(geom);
        const auto known = geoms_.find(geom);
        if (known != geoms_.end() && known->second.signature == is)
          known->second.is_there = true;
        else
          join(geom, geoms_[geom] = {is, add(geom, is), true});
        if (is.body) bodies_[is.body].is_there = true;
      }
    }
  }

  /// Adds a geom to its body: as the body's shape if it is the only geom, else as a part.
  void join(dGeomID geom, const Geom& made) {
    const dBodyID body = made.signature.body;
    if (!body) return;
    Body& whole = bodies_[body];
    if (made.signature.siblings == 1) {
      whole = {1, made.shape, true};
      return;
    }
    if (whole.geoms != made.signature.siblings) {
      const auto name = body_names_.find(body);
      const std::string word =
          name != body_names_.end() ? name->second : "body " + std::to_string(++count_);
      whole = {made.signature.siblings, cs_compound(recorder_, word.c_str()), true};
    }
    // Geoms have their own poses.
    const Vector place = vector_of(dGeomGetOffsetPosition(geom));
    const double unturned[4] = {1, 0, 0, 0};
    cs_part(recorder_, whole.shape, made.shape, place.data(), unturned);
  }

  template <class Map> static void forget_what_left(Map& map) {
    for (auto entry = map.begin(); entry != map.end();)
      entry = entry->second.is_there ? std::next(entry) : map.erase(entry);
  }

  void begin(int iterations) {
    if (!recorder_) return;
    for (auto& entry : geoms_) entry.second.is_there = false;
    for (auto& entry : bodies_) entry.second.is_there = false;
    find_geoms(space_);
    forget_what_left(geoms_);
    forget_what_left(bodies_);
    cs_begin_frame(recorder_, time_);
    cs_solver(recorder_, iterations, 1, 0);
    for (const auto& entry : geoms_) {
      if (entry.second.shape < 0) continue;
      const bool is_plane = dGeomGetClass(entry.first) == dPlaneClass;
      dQuaternion q = {1, 0, 0, 0};
      if (!is_plane) dGeomGetQuaternion(entry.first, q);
      const double turn[4] = {double(q[0]), double(q[1]), double(q[2]), double(q[3])};
      const Vector place = is_plane ? Vector{{0, 0, 0}} : vector_of(dGeomGetPosition(entry.first));
      cs_pose(recorder_, entry.second.shape, place.data(), turn);
    }
    for (const auto& entry : bodies_) {
      if (dBodyIsKinematic(entry.first)) continue;
      dMass mass;
      dBodyGetMass(entry.first, &mass);
      cs_body(recorder_, entry.second.shape, double(mass.mass),
              vector_of(dBodyGetPosition(entry.first)).data(),
              vector_of(dBodyGetLinearVel(entry.first)).data(),
              vector_of(dBodyGetAngularVel(entry.first)).data());
    }
  }

  void end(dReal size) {
    time_ += double(size);
    if (!recorder_) return;
    std::map<std::array<double, 6>, std::vector<cs_point>> found;  // by shapes, triangle and normal
    for (Contact& contact : contacts_) {
      if (contact.feedback == &contact.own) dJointSetFeedback(contact.joint, nullptr);
      const auto a = geoms_.find(contact.geom.g1), b = geoms_.find(contact.geom.g2);
      if (a == geoms_.end() || b == geoms_.end()) continue;
      const int triangle = triangle_of(a->second, contact.geom.side1) >= 0
                               ? triangle_of(a->second, contact.geom.side1)
                               : triangle_of(b->second, contact.geom.side2);
      const dReal* n = contact.geom.normal;  // points into g1
      found[{{double(a->second.shape), double(b->second.shape), double(triangle), -double(n[0]),
              -double(n[1]), -double(n[2])}}]
          .push_back(point_of(contact, size));
    }
    for (const auto& entry : found)
      cs_manifold(recorder_, int(entry.first[0]), int(entry.first[1]), &entry.first[3],
                  int(entry.first[2]), entry.second.data(), int(entry.second.size()));
    cs_end_frame(recorder_);
    contacts_.clear();
  }

  static int triangle_of(const Geom& geom, int side) {
    return side >= 0 && side < geom.signature.count ? side : -1;
  }

  static cs_point point_of(const Contact& contact, dReal size) {
    cs_point point = cs_point();
    const dReal* n = contact.geom.normal;
    double force[3], along = 0;
    point.has_impulse = force_on_b(contact, force);
    for (int k = 0; k < 3; ++k) along -= force[k] * double(n[k]);
    for (int k = 0; k < 3; ++k) {
      point.position[k] = double(contact.geom.pos[k]);
      point.friction[k] = (force[k] + along * double(n[k])) * double(size);
    }
    point.separation = -double(contact.geom.depth);
    point.impulse = along * double(size);
    point.idle = !contact.joint;
    return point;
  }

  /// False if the step did not solve the contact: no joint, or both bodies are disabled.
  static bool force_on_b(const Contact& contact, double* force) {
    for (int k = 0; k < 3; ++k) force[k] = 0;
    if (!contact.joint) return false;
    // ODE swaps the bodies of a joint whose first body is the world; f1 acts on the only body.
    const dBodyID first = dJointGetBody(contact.joint, 0), second = dJointGetBody(contact.joint, 1);
    if (!(first && dBodyIsEnabled(first)) && !(second && dBodyIsEnabled(second))) return false;
    const dJointFeedback& record = *contact.feedback;
    const dBodyID a = dGeomGetBody(contact.geom.g1), b = dGeomGetBody(contact.geom.g2);
    const bool is_on_b = b && (b == first || b == second);
    const dBodyID subject = is_on_b ? b : a;
    const dReal* on_subject = subject == first || !first ? record.f1 : record.f2;
    for (int k = 0; k < 3; ++k) force[k] = double(on_subject[k]) * (is_on_b ? 1 : -1);
    return true;
  }

  dWorldID world_;
  dSpaceID space_;
  cs_recorder* recorder_;
  double time_ = 0;
  int count_ = 0;
  std::map<dGeomID, std::string> geom_names_;
  std::map<dBodyID, std::string> body_names_;
  std::map<dGeomID, Form> forms_;
  std::map<dGeomID, Geom> geoms_;
  std::map<dBodyID, Body> bodies_;
  std::deque<Contact> contacts_;  // a deque keeps their addresses valid
};

}  // namespace contactscope
