#include "geometry/primitives.h"
#include "manifold/collide_pairs.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr double kHalf = 0.5;   // metres, of both cubes
constexpr double kDeep = 0.03;  // metres, of the lower edge of B below the upper face of A
constexpr int kFirst = 520, kLast = 720, kStep = 2;  // millimetres, along A's face
constexpr double kTurn = 12;  // degrees about the vertical, so that edges cross

/// Cube B, tilted over its lower edge, whose middle is deep in A's upper face, `along` A's middle.
Pose<double> pose_of_b(double along, double degrees) {
  constexpr double kDegree = std::numbers::pi / 180;
  const Quatd tilted(Eigen::AngleAxisd(degrees * kDegree, Vec3d::UnitX()));
  const Quatd rotation = Quatd(Eigen::AngleAxisd(kTurn * kDegree, Vec3d::UnitY())) * tilted;
  return {rotation, Vec3d(0, kHalf - kDeep, along) - rotation * Vec3d(0, -kHalf, kHalf)};
}

double features_of(const Hull<double>& cube, double along, double degrees, Preference preference) {
  CollideOptions options;
  options.preference = preference;
  const Manifold<double> found =
      collide_hull_hull<double>(cube, {}, cube, pose_of_b(along, degrees), options);
  if (found.points.empty()) return 0;
  return found.axis == AxisKind::FaceA ? 1 : found.axis == AxisKind::FaceB ? 2 : 3;
}

}  // namespace

/// A phase diagram: which features make the contact of two cubes, over each offset and tilt of the
/// upper one, whose lower edge is near an edge of the lower one and crosses it. A pair that moves across a
/// border has another normal and other ids: "Feature Flip-Flop" (Catto 2007, Gregorius 2015). With
/// preference = "relative" faces keep what is nearly as deep; the border remains, elsewhere.
std::vector<trace::Study> study_phase(const StudyOptions&, const StudyProgress& progress) {
  std::vector<trace::Study> results =
      results_of("phase", "double", "millimetres from the middle of A's face", "",
                 {{"features", "Which features make the contact of two cubes", "features"}},
                 trace::StudyForm::Features);
  results[0].row = "degrees of tilt";
  const Hull<double> cube = make_box(Vec3d::Constant(kHalf));
  const StudyStep step = counted(progress, 2);
  for (const Preference preference : {Preference::None, Preference::Relative}) {
    const std::string panel = std::string("preference ") + to_string(preference);
    step(panel);
    for (int degrees = 0; degrees <= 90; ++degrees) {
      trace::StudySeries& row = results[0].series.emplace_back(
          trace::StudySeries{panel, {}, panel, results[0].parameter, double(degrees)});
      for (int along = kFirst; along <= kLast; along += kStep) {
        const double features = features_of(cube, 1e-3 * along, degrees, preference);
        row.points.push_back({double(along), features, {}, {}, 0, 1});
      }
    }
  }
  return results;
}

}  // namespace contactscope
