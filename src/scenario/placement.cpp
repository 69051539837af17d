#include "core/random.h"
#include "geometry/mesh_file.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

// Quaternions are written with at least three to four digits. A larger error of the length is a
// mistake, often another order of the components.
constexpr double kQuaternionTolerance = 1e-3;
// Matrices come from single-precision output of other programs, with six digits or more.
constexpr double kMatrixTolerance = 1e-4;

Quatd unit_quaternion(const Value& at, bool w_first) {
  const std::vector<double> q = at.numbers(4);
  const std::size_t i = w_first ? 1 : 0;
  const double w = q[w_first ? 0 : 3], x = q[i], y = q[i + 1], z = q[i + 2];
  const double length = std::hypot(std::hypot(w, x), std::hypot(y, z));
  if (!(std::abs(length - 1) <= kQuaternionTolerance))
    at.fail("'" + at.name() + "' has length " + std::to_string(length) +
            "; a rotation is a quaternion of length 1 (within 0.001)");
  return Quatd(w / length, x / length, y / length, z / length);
}

Quatd from_axis(const Value& table) {
  const Vec3d axis = read_direction(table.require("axis"));
  table.not_both("degrees", "radians");
  const auto degrees = table.find("degrees"), radians = table.find("radians");
  if (!degrees && !radians)
    table.fail("the rotation about 'axis' has no angle; add degrees = or radians =");
  const double angle = degrees ? degrees->number() / 180 * std::numbers::pi : radians->number();
  return Quatd(Eigen::AngleAxisd(angle, axis));
}

Quatd from_matrix(const Value& value) {
  const std::vector<Value> rows = value.array();
  if (rows.size() != 3) value.fail("'matrix' needs three rows of three numbers each");
  Mat3<double> matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = rows[static_cast<std::size_t>(i)].vector3();
  // Negated to also reject values too large to square, which give nan.
  const Mat3<double> gram = matrix * matrix.transpose();
  const double error = (gram - Mat3<double>::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kMatrixTolerance))
    value.fail(
        "'matrix' is not a rotation: its rows are not unit vectors at right angles (within "
        "0.0001)");
  if (matrix.determinant() < 0)
    value.fail(
        "'matrix' is not a rotation: it mirrors (determinant -1); change the sign of one row");
  Quatd rotation(matrix);
  rotation.normalize();
  return rotation;
}

/// A table with exactly one of axis and degrees or radians, quat_wxyz, quat_xyzw, matrix. Returns a
/// unit quaternion.
Quatd read_rotation(const Value& value) {
  if (value.is_array())
    value.fail(
        "'rotation' is a bare list, and engines differ in the order of a quaternion; write "
        "{ quat_wxyz = [w, x, y, z] } or { quat_xyzw = [x, y, z, w] }");
  const Value table = value.table({"rotation"});
  const bool about_axis = table.find("axis") || table.find("degrees") || table.find("radians");
  const auto wxyz = table.find("quat_wxyz");
  const auto xyzw = table.find("quat_xyzw");
  const auto matrix = table.find("matrix");
  const int forms = about_axis + wxyz.has_value() + xyzw.has_value() + matrix.has_value();
  if (forms != 1)
    value.fail(std::string(forms == 0 ? "the rotation is empty" : "the rotation is given twice") +
               "; give one of axis with degrees or radians, quat_wxyz, quat_xyzw, matrix");
  if (wxyz) return unit_quaternion(*wxyz, true);
  if (xyzw) return unit_quaternion(*xyzw, false);
  return matrix ? from_matrix(*matrix) : from_axis(table);
}

std::vector<Keyframe> read_keyframes(const Value& value, const Pose<double>& start) {
  std::vector<Keyframe> keyframes;
  Pose<double> pose = start;
  for (const Value& item : value.array_of_tables()) {
    const Value table = item.table({"keyframe"});
    const Value time = table.require("time");
    pose = read_pose(table, pose);
    Keyframe keyframe{time.number(), pose};
    if (!keyframes.empty() && keyframe.time <= keyframes.back().time)
      time.fail("keyframes must be in order of time, each later than the one before");
    keyframes.push_back(keyframe);
  }
  if (keyframes.empty())
    value.fail("'keyframes' is empty; add { time = 0.0, position = [0, 0, 0] } or leave it out");
  return keyframes;
}

TravellingWave read_wave(const Value& value) {
  const Value table = value.table({"wave"});
  TravellingWave wave;
  wave.axis = read_direction(table.require("axis"));
  wave.direction = read_direction(table.require("direction"));
  wave.amplitude = table.require("amplitude").number();
  wave.wavelength = table.require("wavelength").number();
  wave.speed = table.require("speed").number();
  return wave;
}

Twist read_twist(const Value& value) {
  const Value table = value.table({"twist"});
  table.not_both("degrees", "radians");
  Twist twist;
  twist.axis = read_direction(table.require("axis"));
  if (const auto radians = table.find("radians"))
    twist.rate = radians->number();
  else
    twist.rate = table.require("degrees").number() / 180 * std::numbers::pi;
  return twist;
}

/// The vertices of a file that must have the same triangles as `mesh`.
std::vector<Vec3d> read_vertices(const Value& file, const Mesh<double>& mesh,
                                 const std::filesystem::path& folder) {
  FileMesh obj = load_file(file, folder, load_mesh);
  const auto differs = [&](const char* what, std::size_t of_file, std::size_t of_mesh) {
    if (of_file != of_mesh)
      file.fail(
          std::string("the number of ") + what + " is " + std::to_string(of_file) + " in '" +
          file.string() + "', and " + std::to_string(of_mesh) +
          " in the mesh that it deforms; give a file with the same triangles and moved vertices");
  };
  differs("vertices", obj.vertices.size(), mesh.vertices.size());
  differs("triangles", obj.triangles.size(), mesh.triangles.size());
  for (int i = 0; i < mesh.triangle_count(); ++i)
    if (at(obj.triangles, i) != at(mesh.triangles, i))
      file.fail(
          "triangle " + std::to_string(i) + " of '" + file.string() +
          "' has other vertices than in the mesh that it deforms; write the file with the same "
          "faces in the same order");
  check_reach(obj.vertices, file);
  return std::move(obj.vertices);
}

std::vector<VertexKeyframe> read_vertex_keyframes(const Value& value, const Mesh<double>& mesh,
                                                  const std::filesystem::path& folder) {
  std::vector<VertexKeyframe> keyframes;
  for (const Value& item : value.array_of_tables()) {
    const Value table = item.table({"keyframe of deform"});
    const Value time = table.require("time");
    const double seconds = time.number();
    if (!keyframes.empty() && seconds <= keyframes.back().time)
      time.fail("keyframes must be in order of time, each later than the one before");
    const Value file = table.require("file");
    keyframes.push_back({seconds, read_vertices(file, mesh, folder)});
  }
  if (keyframes.empty())
    value.fail("'keyframes' is empty; add { time = 0.0, file = \"NAME.obj\" } or leave it out");
  return keyframes;
}

constexpr int kMaxCopies = 20000;  // per shape

struct Scatter {
  Vec3d lower, upper;          // metres, bounds of the copies' origins
  std::array<int, 3> cells{};  // of a grid between them, one copy per cell; all 0: no grid
  int count = 0;               // copies
  int seed = 1;
  std::array<double, 2> scale = {1, 1};  // smallest and largest size
  bool turned = true;                    // each has a random rotation
};

std::array<int, 3> read_cells(const Value& value) {
  const std::vector<Value> numbers = value.array();
  if (numbers.size() != 3)
    value.fail("'cells' are three numbers, along x, y and z; write cells = [4, 1, 4]");
  std::array<int, 3> cells{};
  for (std::size_t i = 0; i < 3; ++i) cells[i] = numbers[i].integer();
  if (std::int64_t{cells[0]} * cells[1] * cells[2] > kMaxCopies)
    value.fail("'cells' make more than " + std::to_string(kMaxCopies) + " copies; lower them");
  return cells;
}

Scatter read_scatter(const Value& value) {
  const Value table = value.table({"scatter"});
  Scatter scatter;
  const auto count = table.find("count"), cells = table.find("cells");
  table.not_both("count", "cells");
  if (!count && !cells)
    table.fail("'scatter' has no number of copies; add count = 100, or cells = [10, 1, 10]");
  if (count) scatter.count = count->integer();
  if (cells) scatter.cells = read_cells(*cells);
  if (cells) scatter.count = scatter.cells[0] * scatter.cells[1] * scatter.cells[2];
  scatter.lower = table.require("lower").vector3();
  const Value upper = table.require("upper");
  scatter.upper = upper.vector3();
  if (!(scatter.lower.array() <= scatter.upper.array()).all())
    upper.fail("'upper' is below 'lower'; no coordinate of it may be smaller");
  table.read("seed", scatter.seed);
  if (const auto scale = table.find("scale")) {
    const std::vector<double> range = scale->numbers(2);
    if (range[0] > range[1])
      scale->fail("'scale' is the smallest and the largest factor; write scale = [0.5, 2]");
    scatter.scale = {range[0], range[1]};
  }
  table.read("turned", scatter.turned);
  return scatter;
}

/// Uniform over all rotations: a normalised point of the ball in four dimensions, on every machine.
Quatd random_rotation(std::mt19937_64& engine) {
  for (;;) {
    const double w = uniform(engine, -1, 1), x = uniform(engine, -1, 1);
    const double y = uniform(engine, -1, 1), z = uniform(engine, -1, 1);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    if (length > 0.1 && length <= 1) return Quatd(w / length, x / length, y / length, z / length);
  }
}

/// As many between 1 and 2 as between 2 and infinity. Rational, for portable rounding.
double random_size(std::mt19937_64& engine, const std::array<double, 2>& scale) {
  const auto [low, high] = scale;
  return low * high / uniform(engine, low, high);
}

/// Size, in metres, of a shape that can be scattered.
double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) return capsule->radius;
  return std::get<Hull<double>>(shape).radius;
}

}  // namespace

Vec3d read_direction(const Value& value) {
  const Vec3d direction = value.vector3();
  const double largest = direction.cwiseAbs().maxCoeff();
  if (largest == 0)
    value.fail("'" + value.name() + "' is zero; give a direction, such as [0, 1, 0]");
  // Scaled before normalising: squares of tiny or huge components would under- or overflow.
  return Vec3d(direction / largest).normalized();
}

Pose<double> read_pose(const Value& table, const Pose<double>& otherwise) {
  Pose<double> pose = otherwise;
  table.read("position", pose.position);
  table.read("rotation", pose.rotation, read_rotation);
  return pose;
}

Motion read_motion(const Value& value, const Pose<double>& start, double end_time) {
  const Value table = value.table({"motion"});
  Motion motion;
  const auto keyframes = table.find("keyframes");
  if (keyframes) motion.keyframes = read_keyframes(*keyframes, start);
  for (const char* key : {"velocity", "angular_velocity"})
    if (const auto velocity = table.find(key); velocity && keyframes)
      velocity->fail(std::string("'") + key +
                     "' and 'keyframes' both move the shape; leave one of them out");
  table.read("velocity", motion.velocity);
  table.read("angular_velocity", motion.angular_velocity);
  const Vec3d end = start.position + end_time * motion.velocity;
  if (end.cwiseAbs().maxCoeff() > kLargestLength)
    table.require("velocity")
        .fail(
            "'velocity' carries the shape farther than 1e9 metres by the last frame; lower it, "
            "or 'frames' or 'dt' in [time]");
  if (const auto dynamic = table.find("dynamic")) dynamic->boolean();
  for (const char* key : {"mass", "density"})
    if (const auto value_of = table.find(key)) {
      value_of->number();
      value_of->fail(std::string("'") + key +
                     "' applies to dynamic shapes only; add dynamic = true, or remove it");
    }
  return motion;
}

Deformation read_deformation(const Value& value, const ScenarioShape& shape,
                             const std::filesystem::path& folder) {
  const auto* const mesh = std::get_if<Mesh<double>>(shape.geometry.get());
  if (mesh == nullptr)
    value.fail("'" + shape.name + "' is a " + shape.type +
               ", and only a mesh deforms; give it type = \"mesh\", or leave out 'deform'");
  const Value table = value.table({"deform"});
  const auto wave = table.find("wave"), twist = table.find("twist");
  const auto keyframes = table.find("keyframes");
  if (wave.has_value() + twist.has_value() + keyframes.has_value() != 1)
    table.fail("'deform' needs exactly one of 'wave', 'twist' and 'keyframes'");
  if (wave) return read_wave(*wave);
  if (twist) return read_twist(*twist);
  return read_vertex_keyframes(*keyframes, *mesh, folder);
}

std::vector<ScenarioShape> scattered(const ScenarioShape& model, const Value& value,
                                     const Value& table) {
  const Scatter scatter = read_scatter(value);
  if (const auto position = table.find("position"))
    position->fail("'scatter' places the copies; remove 'position'");
  if (const auto rotation = table.find("rotation"); rotation && scatter.turned)
    rotation->fail(
        "'scatter' rotates each copy; remove 'rotation', or add turned = false to 'scatter'");
  if (const auto motion = table.find("motion"); motion && motion->find("keyframes"))
    motion->fail("keyframes would move every copy of '" + model.name +
                 "' to the same places; give a velocity, or dynamic = true");
  if (kind_of(*model.geometry) == ShapeKind::Plane || kind_of(*model.geometry) == ShapeKind::Mesh)
    value.fail("spheres, capsules and hulls can be scattered, and '" + model.name + "' is a " +
               model.type + "; write each copy as its own shape");

  std::mt19937_64 engine(static_cast<std::uint64_t>(scatter.seed));
  std::vector<ScenarioShape> copies;
  for (int i = 0; i < scatter.count; ++i) {
    ScenarioShape copy = model;
    copy.name = model.name + "_" + std::to_string(i + 1);
    Vec3d share;  // fraction from `lower` to `upper`
    for (int axis = 0, rest = i; axis < 3; ++axis) {
      const int cells = scatter.cells[static_cast<std::size_t>(axis)];
      // In a grid a copy stays in the middle half of its cell.
      share[axis] =
          cells == 0 ? uniform(engine, 0, 1) : (rest % cells + uniform(engine, 0.25, 0.75)) / cells;
      if (cells > 0) rest /= cells;
    }
    copy.pose.position = scatter.lower + share.cwiseProduct(scatter.upper - scatter.lower);
    if (scatter.turned) copy.pose.rotation = random_rotation(engine);
    if (scatter.scale != std::array<double, 2>{1, 1}) {
      copy.geometry = std::make_shared<const Shape<double>>(
          scaled(*model.geometry, random_size(engine, scatter.scale)));
      const double radius = radius_of(*copy.geometry);
      if (!(radius >= kSmallestLength && radius <= kLargestLength))
        value.fail("'scale' makes a copy of '" + model.name +
                   "' smaller than 1e-9 metres or larger than 1e9; lower its range");
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

}  // namespace contactscope::scenario_file
