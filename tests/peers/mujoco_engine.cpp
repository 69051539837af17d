// contactscope-engine-mujoco: MuJoCo as a program that `contactscope versus` runs
// (src/versus/README.md). Each shape is a free body, and mj_forward() finds the contacts.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "core/input_error.h"
#include "peers/add_point.h"
#include "peers/mujoco_model.h"
#include "peers/rollout.h"
#include "trace/find.h"
#include "trace/json.h"
#include "versus/request.h"

namespace contactscope {
namespace {

constexpr double kAway = 1e6;  // metres: place of a shape that is not in the frame

void left_out(const std::string& name, const std::string& why) {
  std::cerr << "'" << name << "' is left out: " << why << '\n';
}

/// Whether vertices lie in one plane, within rounding: MuJoCo cannot make a hull of them.
bool is_flat(const std::vector<Vec3d>& vertices) {
  const Vec3d& origin = vertices.front();
  const auto farthest = [&](const auto& distance) {
    return *std::ranges::max_element(vertices, {}, distance);
  };
  const Vec3d along = farthest([&](const Vec3d& v) { return (v - origin).norm(); }) - origin;
  const Vec3d across = farthest([&](const Vec3d& v) { return along.cross(v - origin).norm(); });
  const Vec3d normal = along.cross(across - origin).normalized();
  const Vec3d above =
      farthest([&](const Vec3d& v) { return std::abs(normal.dot(v - origin)); }) - origin;
  return !(std::abs(normal.dot(above)) > 1e-6 * along.norm());
}

/// The geom of a shape in MuJoCo's XML, after the mesh that it needs; empty if unsupported. MuJoCo
/// replaces every mesh by its convex hull.
struct Geom {
  std::string mesh, geom;
};

std::optional<Geom> geom_of(const trace::Shape& shape, int index) {
  const std::string name = "name=\"g" + std::to_string(index) + "\" ";
  std::ostringstream text;
  text.precision(17);
  if (shape.half_space) {
    const Vec3d& normal = shape.half_space->normal;
    const Quatd turn = Quatd::FromTwoVectors(Vec3d::UnitZ(), normal);
    text << "<geom " << name << "type=\"plane\" size=\"1 1 1\" pos=\""
         << peers::spelled(shape.half_space->offset * normal) << "\" quat=\"" << turn.w() << ' '
         << peers::spelled(turn.vec()) << "\"/>";
    return Geom{"", text.str()};
  }
  if (shape.type == "mesh" || shape.type == "sdf") return std::nullopt;
  if (shape.radius > 0 && shape.vertices.size() <= 2) {
    const Vec3d from = shape.vertices.front(), to = shape.vertices.back();
    if ((to - from).norm() == 0)
      text << "<geom " << name << "type=\"sphere\" size=\"" << shape.radius << "\" pos=\""
           << peers::spelled(from) << "\"/>";
    else
      text << "<geom " << name << "type=\"capsule\" size=\"" << shape.radius << "\" fromto=\""
           << peers::spelled(from) << ' ' << peers::spelled(to) << "\"/>";
    return Geom{"", text.str()};
  }
  if (shape.radius > 0 || shape.vertices.size() < 4 || is_flat(shape.vertices)) return std::nullopt;
  if (shape.type == "box" && shape.vertices.size() == 8) {
    Vec3d lower = shape.vertices.front(), upper = lower;
    for (const Vec3d& vertex : shape.vertices) {
      lower = lower.cwiseMin(vertex);
      upper = upper.cwiseMax(vertex);
    }
    text << "<geom " << name << "type=\"box\" size=\"" << peers::spelled((upper - lower) / 2)
         << "\" pos=\"" << peers::spelled((upper + lower) / 2) << "\"/>";
    return Geom{"", text.str()};
  }
  std::string vertices;
  for (const Vec3d& vertex : shape.vertices) vertices += peers::spelled(vertex) + " ";
  const std::string mesh = "m" + std::to_string(index);
  text << "<geom " << name << "type=\"mesh\" mesh=\"" << mesh << "\"/>";
  return Geom{"<mesh name=\"" + mesh + "\" vertex=\"" + vertices + "\"/>", text.str()};
}

/// All shapes of a request as free bodies.
class World {
 public:
  explicit World(const std::vector<trace::Shape>& shapes) {
    std::string assets, bodies;
    for (int i = 0; i < count_of(shapes); ++i) {
      const trace::Shape& shape = at(shapes, i);
      names_.push_back(shape.name);
      const std::optional<Geom> geom = geom_of(shape, i);
      if (!geom) {
        left_out(shape.name, "MuJoCo has no " + shape.type + " like it");
        continue;
      }
      assets += geom->mesh;
      // A plane must belong to the world or to a mocap body.
      bodies += "<body name=\"b" + std::to_string(i) + "\"" +
                (shape.half_space ? " mocap=\"true\">" : "><freejoint/>") + geom->geom + "</body>";
    }
    const std::string xml = "<mujoco><option gravity=\"0 0 0\"/><asset>" + assets +
                            "</asset><worldbody>" + bodies + "</worldbody></mujoco>";
    model_ = peers::mujoco_model(xml);
    data_ = mj_makeData(model_);
  }
  ~World() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// The contacts of a frame, by the names of each pair.
  std::map<std::pair<std::string, std::string>, std::vector<trace::Manifold>> contacts(
      const trace::Frame& frame) {
    for (int i = 0; i < count_of(names_); ++i) place(i, frame);
    mj_forward(model_, data_);
    std::map<std::pair<std::string, std::string>, std::vector<trace::Manifold>> found;
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      const Vec3d normal(contact.frame[0], contact.frame[1], contact.frame[2]);
      const Vec3d position(contact.pos[0], contact.pos[1], contact.pos[2]);
      peers::add_point(found[{name_of(contact.geom1), name_of(contact.geom2)}], normal, position,
                       contact.dist);
    }
    return found;
  }

 private:
  void place(int shape, const trace::Frame& frame) {
    const int body = mj_name2id(model_, mjOBJ_BODY, ("b" + std::to_string(shape)).c_str());
    if (body < 0) return;
    const Pose<double>* const record = trace::find_pose(frame, at(names_, shape));
    const Pose<double> away{Quatd::Identity(), {kAway * shape, kAway, kAway}};
    const Pose<double>& pose = record == nullptr ? away : *record;
    const int mocap = model_->body_mocapid[body];
    double* const position = mocap >= 0
                                 ? data_->mocap_pos + 3 * mocap
                                 : data_->qpos + model_->jnt_qposadr[model_->body_jntadr[body]];
    double* const rotation = mocap >= 0 ? data_->mocap_quat + 4 * mocap : position + 3;
    for (int k = 0; k < 3; ++k) position[k] = pose.position[k];
    rotation[0] = pose.rotation.w();
    for (int k = 0; k < 3; ++k) rotation[1 + k] = pose.rotation.vec()[k];
  }

  const std::string& name_of(int geom) const {
    return at(names_, std::atoi(mj_id2name(model_, mjOBJ_GEOM, geom) + 1));
  }

  std::vector<std::string> names_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

void answer(std::istream& in, std::ostream& out) {
  trace::Trace request = trace::read_trace(in, "standard input");
  request.header.engine = "MuJoCo";
  request.header.version = mj_versionString();
  out << trace::to_json_line(request.header) << '\n';
  std::vector<trace::Shape> shapes = request.header.shapes;
  for (const trace::Frame& frame : request.frames)
    shapes.insert(shapes.end(), frame.shapes.begin(), frame.shapes.end());
  World world(shapes);
  for (trace::Frame& frame : request.frames) {
    auto found = world.contacts(frame);
    for (trace::Pair& pair : frame.pairs) {
      auto contacts = found.find({pair.a, pair.b});
      if (contacts == found.end()) {
        contacts = found.find({pair.b, pair.a});
        if (contacts == found.end()) continue;
        for (trace::Manifold& manifold : contacts->second) manifold.normal = -manifold.normal;
      }
      pair.manifolds = std::move(contacts->second);
      pair.state = "touching";
      pair.separation = pair.manifolds.front().points.front().separation;
    }
    frame.deformed.clear();
    out << trace::to_json_line(frame) << '\n';
  }
}

}  // namespace
}  // namespace contactscope

int main(int count, char** arguments) {
  try {
    if (count > 1 && std::string(arguments[1]) == "rollout")
      contactscope::peers::roll_out(contactscope::peers::mujoco_rollout(), std::cin, std::cout);
    else
      contactscope::answer(std::cin, std::cout);
  } catch (const contactscope::peers::NotStepped& reason) {
    std::cerr << reason.what() << '\n';
    return contactscope::versus::kNoRollout;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
