#include <cmath>
#include <numbers>

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

}  // namespace contactscope::scenario_file
