#include "study/solver_stack.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace contactscope {
namespace {

constexpr PositionCorrection kEveryCorrection[] = {
    PositionCorrection::Baumgarte, PositionCorrection::Projection, PositionCorrection::Soft};

// `study solver` also has 16 and 32 sub-steps.
TEST(SlowSolverEnergy, NoSceneGainsMoreThanAHundredthOfItsEnergy) {
  const std::vector<EnergyScene> scenes = energy_scenes();
  ASSERT_EQ(scenes.size(), 20u);
  for (const EnergyScene& scene : scenes) {
    for (const PositionCorrection correction : kEveryCorrection) {
      for (const int substeps : {1, 2, 4, 8}) {
        SolverSettings settings;
        settings.position_correction = correction;
        settings.substeps = substeps;
        EXPECT_LE(energy_gained(scene, settings), 0.01)
            << scene.name << ", " << to_string(correction) << ", " << substeps;
      }
    }
  }
}

// The table can fail: Baumgarte with its whole push throws bodies that start deep.
TEST(SolverEnergy, BaumgarteWithAllOfItsPushGainsMore) {
  SolverSettings settings;
  settings.substeps = 8;
  settings.push_speed = 1e6;
  const std::vector<EnergyScene> scenes = energy_scenes();
  const auto deep = std::ranges::find(scenes, "deep box", &EnergyScene::name);
  ASSERT_NE(deep, scenes.end());
  EXPECT_GT(energy_gained(*deep, settings), 1);
}

}  // namespace
}  // namespace contactscope
