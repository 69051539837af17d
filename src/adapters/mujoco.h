/// Records the contacts and forces of MuJoCo (2.2 or later) for contactscope:
///
///     contactscope::MujocoRecorder recorder(model, "stack.jsonl");
///     recorder.record(data);   // after each mj_step
///
/// C++11. Define CONTACTSCOPE_IMPLEMENTATION before this include in one source file. README.md
/// explains the conversions. Poses are those of the contacts: mj_step computes both before it
/// integrates, and keeps them in mjData.
///
/// MIT License; the text is in recorder/contactscope.h.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "../recorder/contactscope.h"

namespace contactscope {

class MujocoRecorder {
 public:
  /// `scenario` is GROUP/IDEA, the folder of the pictures. The model must outlive the recorder.
  MujocoRecorder(const mjModel* model, const char* path, const char* scenario = "mujoco/run")
      : model_(model) {
    cs_settings settings = cs_settings();
    settings.doubles = sizeof(mjtNum) == sizeof(double);
    settings.z_up = std::fabs(model->opt.gravity[1]) <= std::fabs(model->opt.gravity[2]);
    settings.poses_at = 1;
    recorder_ = cs_start(path, scenario, "MuJoCo", mj_versionString(), &settings);
    if (!recorder_) std::fprintf(stderr, "contactscope: %s cannot be written\n", path);
    add_geoms();
  }
  ~MujocoRecorder() { cs_stop(recorder_); }
  MujocoRecorder(const MujocoRecorder&) = delete;
  MujocoRecorder& operator=(const MujocoRecorder&) = delete;

  /// Records the last mj_step as a frame, or the last mj_forward if `integrated` is false. Do not
  /// call it after mj_step1, which solves nothing.
  void record(const mjData* data, bool integrated = true) {
    if (!recorder_) return;
    cs_begin_frame(recorder_, double(data->time - (integrated ? model_->opt.timestep : 0)));
    cs_solver(recorder_, model_->opt.iterations, 1, !(model_->opt.disableflags & mjDSBL_WARMSTART));
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      if (shapes_[std::size_t(geom)] < 0) continue;
      const mjtNum* place = data->geom_xpos + 3 * geom;
      mjtNum q[4];
      mju_mat2Quat(q, data->geom_xmat + 9 * geom);
      const double turn[4] = {double(q[0]), double(q[1]), double(q[2]), double(q[3])};
      cs_pose(recorder_, shapes_[std::size_t(geom)], vector_of(place).data(), turn);
    }
    record_bodies(data);
    record_contacts(data);
    cs_end_frame(recorder_);
  }

  /// Null if the file cannot be created.
  cs_recorder* recorder() const { return recorder_; }

 private:
  typedef std::array<double, 3> Vector;

  template <class Number> static Vector vector_of(const Number* v) {
    return {{double(v[0]), double(v[1]), double(v[2])}};
  }

  bool collides(int geom) const {
    if (model_->geom_contype[geom] || model_->geom_conaffinity[geom]) return true;
    for (int i = 0; i < model_->npair; ++i)
      if (model_->pair_geom1[i] == geom || model_->pair_geom2[i] == geom) return true;
    return false;
  }

  std::string name_of(mjtObj type, int id, const std::string& otherwise) const {
    const char* name = mj_id2name(model_, type, id);
    return name && *name ? name : otherwise + " " + std::to_string(id);
  }

  /// Leaves out geoms that are only visual.
  void add_geoms() {
    std::vector<int> parts(std::size_t(model_->nbody), 0);
    for (int geom = 0; geom < model_->ngeom; ++geom)
      parts[std::size_t(model_->geom_bodyid[geom])] += collides(geom);
    bodies_.assign(std::size_t(model_->nbody), -1);
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      const int body = model_->geom_bodyid[geom];
      const bool is_whole = body > 0 && parts[std::size_t(body)] == 1;
      // The only geom of a body takes the body's name if it has none.
      const std::string own = name_of(mjOBJ_GEOM, geom, "geom");
      const bool has_own = mj_id2name(model_, mjOBJ_GEOM, geom) != nullptr;
      const int shape =
          collides(geom) ? add(geom, is_whole && !has_own ? name_of(mjOBJ_BODY, body, "body") : own)
                         : -1;
      shapes_.push_back(shape);
      if (shape < 0 || body == 0) continue;
      int& whole = bodies_[std::size_t(body)];
      if (is_whole) {
        whole = shape;
        continue;
      }
      if (whole < 0) whole = cs_compound(recorder_, name_of(mjOBJ_BODY, body, "body").c_str());
      const double place[3] = {0, 0, 0}, unturned[4] = {1, 0, 0, 0};  // geoms have their own poses
      cs_part(recorder_, whole, shape, place, unturned);
    }
  }

  int add(int geom, const std::string& name) {
    const mjtNum* size = model_->geom_size + 3 * geom;
    const Vector up = {{0, 0, 1}}, end = {{0, 0, double(size[1])}},
                 other = {{0, 0, -double(size[1])}};
    switch (model_->geom_type[geom]) {
      case mjGEOM_PLANE:
        return cs_plane(recorder_, name.c_str(), up.data(), 0);
      case mjGEOM_SPHERE:
        return cs_sphere(recorder_, name.c_str(), double(size[0]));
      case mjGEOM_CAPSULE:
        return cs_capsule(recorder_, name.c_str(), other.data(), end.data(), double(size[0]));
      case mjGEOM_CYLINDER:
        return cs_cylinder(recorder_, name.c_str(), 2, double(size[1]), double(size[0]));
      case mjGEOM_BOX:
        return cs_box(recorder_, name.c_str(), double(size[0]), double(size[1]), double(size[2]));
      case mjGEOM_ELLIPSOID:
        return add_ellipsoid(name, vector_of(size));
      case mjGEOM_MESH:
        return add_hull(name, model_->geom_dataid[geom]);
      case mjGEOM_HFIELD:
        return add_height_field(name, model_->geom_dataid[geom]);
      default:
        cs_note(recorder_, "MuJoCo: a geom of unknown type is left out");
        return -1;
    }
  }

  int add_ellipsoid(const std::string& name, const Vector& radii) {
    std::vector<double> points;
    const int count = 1000;
    for (int i = 0; i < count; ++i) {  // a spiral that covers the sphere evenly
      const double height = 1 - (2 * i + 1) / double(count), turn = 2.39996322972865332 * i;
      const double across = std::sqrt(1 - height * height);
      points.insert(points.end(), {radii[0] * across * std::cos(turn),
                                   radii[1] * across * std::sin(turn), radii[2] * height});
    }
    cs_note(recorder_, "MuJoCo: an ellipsoid is recorded as the hull of 1000 of its points");
    return cs_hull(recorder_, name.c_str(), points.data(), count);
  }

  /// MuJoCo collides meshes as convex hulls. The mesh's graph lists the vertices of its hull.
  int add_hull(const std::string& name, int mesh) {
    const float* vertices = model_->mesh_vert + 3 * model_->mesh_vertadr[mesh];
    std::vector<double> points;
    const auto add = [&](int vertex) {
      for (int k = 0; k < 3; ++k) points.push_back(double(vertices[3 * vertex + k]));
    };
    if (model_->mesh_graphadr[mesh] >= 0) {
      // The graph: counts of vertices and faces, an address per vertex, a mesh index per vertex.
      const int* graph = model_->mesh_graph + model_->mesh_graphadr[mesh];
      for (int i = 0; i < graph[0]; ++i) add(graph[2 + graph[0] + i]);
    } else {
      for (int i = 0; i < model_->mesh_vertnum[mesh]; ++i) add(i);
    }
    return cs_hull(recorder_, name.c_str(), points.data(), int(points.size() / 3));
  }

  /// The upper surface. The diagonal of each cell goes from its least x and y to its greatest.
  int add_height_field(const std::string& name, int field) {
    const int rows = model_->hfield_nrow[field], columns = model_->hfield_ncol[field];
    const mjtNum* size = model_->hfield_size + 4 * field;
    const float* heights = model_->hfield_data + model_->hfield_adr[field];
    std::vector<double> vertices;
    std::vector<int> triangles;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        vertices.push_back(double(size[0]) * (2.0 * column / (columns - 1) - 1));
        vertices.push_back(double(size[1]) * (2.0 * row / (rows - 1) - 1));
        vertices.push_back(double(size[2]) * double(heights[row * columns + column]));
        if (row + 1 == rows || column + 1 == columns) continue;
        const int i = row * columns + column;
        triangles.insert(triangles.end(),
                         {i, i + 1, i + columns + 1, i, i + columns + 1, i + columns});
      }
    return cs_mesh(recorder_, name.c_str(), vertices.data(), rows * columns, triangles.data(),
                   int(triangles.size() / 3));
  }

  void record_bodies(const mjData* data) {
    for (int body = 1; body < model_->nbody; ++body) {
      if (bodies_[std::size_t(body)] < 0 || model_->body_weldid[body] == 0) continue;
      mjtNum velocity[6];  // angular, then linear; of the centre of mass, world frame
      mj_objectVelocity(model_, data, mjOBJ_BODY, body, velocity, 0);
      cs_body(recorder_, bodies_[std::size_t(body)], double(model_->body_mass[body]),
              vector_of(data->xipos + 3 * body).data(), vector_of(velocity + 3).data(),
              vector_of(velocity).data());
    }
  }

  void record_contacts(const mjData* data) {
    std::map<std::array<double, 5>, std::vector<cs_point>> found;  // by shapes and normal
    for (int i = 0; i < data->ncon; ++i) {
      const mjContact& contact = data->contact[i];
      if (contact.geom1 < 0 || contact.geom2 < 0) continue;
      const int a = shapes_[std::size_t(contact.geom1)], b = shapes_[std::size_t(contact.geom2)];
      const mjtNum* n = contact.frame;  // from geom1 to geom2
      if (a >= 0 && b >= 0)
        found[{{double(a), double(b), double(n[0]), double(n[1]), double(n[2])}}].push_back(
            point_of(data, i));
    }
    for (const auto& entry : found)
      cs_manifold(recorder_, int(entry.first[0]), int(entry.first[1]), &entry.first[2], -1,
                  entry.second.data(), int(entry.second.size()));
  }

  /// MuJoCo documents every point as halfway between the surfaces. Only its analytic cases are:
  /// points of two boxes and of libccd are anywhere in the overlap.
  static bool is_halfway(int one, int other) {
    const auto is_round = [](int type) { return type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE; };
    if (one == mjGEOM_PLANE) return true;  // geom1 has the lower type
    return is_round(one) && (is_round(other) || other == mjGEOM_BOX);
  }

  cs_point point_of(const mjData* data, int i) const {
    const mjContact& contact = data->contact[i];
    cs_point point = cs_point();
    point.separation = double(contact.dist);
    point.has_impulse = contact.efc_address >= 0;
    point.idle = !point.has_impulse;
    mjtNum force[6] = {0, 0, 0, 0, 0, 0};  // newtons on geom2, contact frame; then moments
    if (point.has_impulse) mj_contactForce(model_, data, i, force);
    const double step = double(model_->opt.timestep);
    point.impulse = double(force[0]) * step;
    point.has_sides =
        is_halfway(model_->geom_type[contact.geom1], model_->geom_type[contact.geom2]);
    for (int k = 0; k < 3; ++k) {
      const double half = double(contact.frame[k]) * point.separation / 2;
      point.position[k] = double(contact.pos[k]);
      point.on_a[k] = point.position[k] - half;
      point.on_b[k] = point.position[k] + half;
      point.friction[k] = step * (double(force[1]) * double(contact.frame[3 + k]) +
                                  double(force[2]) * double(contact.frame[6 + k]));
    }
    return point;
  }

  const mjModel* model_;
  cs_recorder* recorder_;
  std::vector<int> shapes_;  // by geom; -1: not recorded
  std::vector<int> bodies_;  // by body: a compound or its only geom; -1: not recorded
};

}  // namespace contactscope
