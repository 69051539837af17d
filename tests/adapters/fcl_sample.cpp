// A crate in the ground and a ball on it, collided by FCL and recorded: fcl_sample pairs.jsonl
#define CONTACTSCOPE_IMPLEMENTATION
#include "adapters/fcl.h"

#include <fcl/narrowphase/collision.h>

#include <memory>

int main(int count, char** arguments) {
  contactscope::FclRecorder<double> recorder(count > 1 ? arguments[1] : "pairs.jsonl");
  fcl::CollisionObjectd ground(std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, 0, 1), 0.0)),
      crate(std::make_shared<fcl::Boxd>(1, 1, 1)), ball(std::make_shared<fcl::Sphered>(0.3));
  recorder.name(ground, "ground");
  for (int i = 0; i < 10; ++i) {
    crate.setTranslation(fcl::Vector3d(0, 0, 0.5 - 0.002 * i));
    ball.setTranslation(fcl::Vector3d(0.1, 0, 1.29 - 0.002 * i));
    recorder.begin_frame(0.01 * i);
    const fcl::CollisionObjectd* pairs[][2] = {{&ground, &crate}, {&crate, &ball}};
    for (const auto& pair : pairs) {
      fcl::CollisionResultd result;
      fcl::collide(pair[0], pair[1], fcl::CollisionRequestd(16, true), result);
      recorder.pair(*pair[0], *pair[1], result);
    }
  }
}
