// MuJoCo steps a scene with mj_step, its Euler integrator and its default soft contacts.
#include <iostream>

#include "peers/mujoco_model.h"

namespace contactscope::peers {
namespace {

/// The geom of a piece in MuJoCo's XML, after the mesh that it needs.
struct GeomXml {
  const std::string name;
  std::string mesh{}, geom{};

  void operator()(const Sphere<double>& sphere) {
    geom = "type=\"sphere\" size=\"" + spelled(Vec3d(sphere.radius, 0, 0)) + "\"";
  }
  void operator()(const Capsule<double>& capsule) {
    geom = "type=\"capsule\" size=\"" +
           spelled(Vec3d(capsule.radius, capsule_length(capsule) / 2, 0)) + "\"";
  }
  void operator()(const Box& box) {
    geom = "type=\"box\" size=\"" + spelled(box.half_extents) + "\"";
  }
  void operator()(const Hull<double>& hull) {
    std::string vertices;
    for (const Vec3d& vertex : hull.vertices) vertices += spelled(vertex) + " ";
    mesh = "<mesh name=\"m" + name + "\" vertex=\"" + vertices + "\"/>";
    geom = "type=\"mesh\" mesh=\"m" + name + "\"";
  }
  void operator()(const HalfSpace<double>& half_space) {
    const Plane<double>& plane = half_space.plane;
    geom = "type=\"plane\" size=\"1 1 1\" pos=\"" + spelled(Vec3d(plane.offset * plane.normal)) +
           "\" quat=\"" + spelled(Quatd::FromTwoVectors(Vec3d::UnitZ(), plane.normal)) + "\"";
  }
  void operator()(const std::shared_ptr<const Mesh<double>>&) {
    throw NotStepped("MuJoCo takes a mesh for its convex hull, as which it would be another scene");
  }
};

std::string model_of(const std::vector<Piece>& pieces, const Vec3d& gravity, double step) {
  std::string assets, bodies;
  for (int i = 0; i < count_of(pieces); ++i) {
    const Piece& piece = at(pieces, i);
    GeomXml xml{std::to_string(i)};
    std::visit(xml, piece.shape);
    assets += xml.mesh;
    const Pose<double>& pose = piece.start.pose;
    bodies += "<body name=\"b" + xml.name + "\" pos=\"" + spelled(pose.position) + "\" quat=\"" +
              spelled(pose.rotation) + "\"" +
              (piece.is_scripted && !piece.is_dynamic ? " mocap=\"true\">" : ">");
    if (piece.is_dynamic)
      bodies += "<freejoint/><inertial pos=\"0 0 0\" mass=\"" + std::to_string(piece.mass) +
                "\" diaginertia=\"" + spelled(piece.moments) + "\"/>";
    bodies += "<geom name=\"g" + xml.name + "\" " + xml.geom + " friction=\"" +
              std::to_string(piece.friction) + " 0.005 0.0001\"/></body>";
  }
  std::ostringstream option;
  option.precision(17);
  option << "<option timestep=\"" << step << "\" gravity=\"" << spelled(gravity) << "\"/>";
  return "<mujoco><compiler boundmass=\"0\" boundinertia=\"0\" balanceinertia=\"true\"/>" +
         option.str() + "<size njmax=\"8000\" nconmax=\"2000\"/><asset>" + assets +
         "</asset><worldbody>" + bodies + "</worldbody></mujoco>";
}

/// Warns of settings that MuJoCo does not support.
void report_differences(const std::vector<Piece>& pieces) {
  bool bounces = false, differ = false;
  for (const Piece& piece : pieces) {
    bounces = bounces || piece.restitution > 0;
    differ = differ || piece.friction != pieces.front().friction;
  }
  if (bounces) std::cerr << "MuJoCo has no restitution\n";
  if (differ) std::cerr << "MuJoCo takes the larger friction of two, not the geometric mean\n";
}

class MujocoWorld : public RolloutWorld {
 public:
  MujocoWorld(const std::vector<Piece>& pieces, const Vec3d& gravity, double step)
      : model_(mujoco_model(model_of(pieces, gravity, step))), data_(mj_makeData(model_)) {
    report_differences(pieces);
    for (int i = 0; i < count_of(pieces); ++i) {
      const Piece& piece = at(pieces, i);
      bodies_.push_back(mj_name2id(model_, mjOBJ_BODY, ("b" + std::to_string(i)).c_str()));
      if (!piece.is_dynamic) continue;
      // A free joint's linear velocity is in the world's frame, its angular velocity in the body's.
      const Vec3d spin = piece.start.pose.inverse_rotate(piece.start.angular_velocity);
      double* const velocity = data_->qvel + model_->body_dofadr[bodies_.back()];
      for (int k = 0; k < 3; ++k) velocity[k] = piece.start.velocity[k];
      for (int k = 0; k < 3; ++k) velocity[3 + k] = spin[k];
    }
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  BodyMotion motion(int piece) override {
    const int body = at(bodies_, piece);
    const double* const q = data_->qpos + model_->jnt_qposadr[model_->body_jntadr[body]];
    const double* const v = data_->qvel + model_->body_dofadr[body];
    const Pose<double> pose{Quatd(q[3], q[4], q[5], q[6]).normalized(), {q[0], q[1], q[2]}};
    return {pose, {v[0], v[1], v[2]}, pose.rotate({v[3], v[4], v[5]})};
  }

  void drive(int piece, const BodyMotion& motion) override {
    const int mocap = model_->body_mocapid[at(bodies_, piece)];
    const Quatd& q = motion.pose.rotation;
    const double rotation[] = {q.w(), q.x(), q.y(), q.z()};
    for (int k = 0; k < 3; ++k) data_->mocap_pos[3 * mocap + k] = motion.pose.position[k];
    for (int k = 0; k < 4; ++k) data_->mocap_quat[4 * mocap + k] = rotation[k];
  }

  /// After a step, mjData holds the contacts of the poses before it.
  std::vector<Touch> step(double seconds) override {
    mj_step(model_, data_);
    std::vector<Touch> touches;
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      const mjtNum* const f = contact.frame;
      mjtNum force[6] = {0, 0, 0,
                         0, 0, 0};  // newtons on geom2, in the contact's frame; then moments
      const bool is_active = contact.efc_address >= 0;
      if (is_active) mj_contactForce(model_, data_, c, force);
      const Vec3d friction =
          force[1] * Vec3d(f[3], f[4], f[5]) + force[2] * Vec3d(f[6], f[7], f[8]);
      touches.push_back({piece_of(contact.geom1),
                         piece_of(contact.geom2),
                         {Vec3d(contact.pos[0], contact.pos[1], contact.pos[2]), contact.dist,
                          Vec3d(f[0], f[1], f[2])},
                         trace::Impulse{seconds * force[0], seconds * friction},
                         is_active});
    }
    return touches;
  }

  int iterations() const override { return model_->opt.iterations; }

 private:
  int piece_of(int geom) const { return std::atoi(mj_id2name(model_, mjOBJ_GEOM, geom) + 1); }

  mjModel* model_;
  mjData* data_;
  std::vector<int> bodies_;  // one per piece
};

}  // namespace

RolloutEngine mujoco_rollout() {
  return {"MuJoCo", mj_versionString(), Vec3d::UnitZ(),
          [](const std::vector<Piece>& pieces, const Vec3d& gravity, double step) {
            return std::make_unique<MujocoWorld>(pieces, gravity, step);
          }};
}

}  // namespace contactscope::peers
