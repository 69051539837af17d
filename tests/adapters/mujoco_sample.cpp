// A stack of crates in MuJoCo, recorded: mujoco_sample stack.jsonl
#define CONTACTSCOPE_IMPLEMENTATION
#include "adapters/mujoco.h"

#include <fstream>

int main(int count, char** arguments) {
  const std::string path = count > 1 ? arguments[1] : "stack.jsonl";
  std::ofstream(path + ".xml") << R"(<mujoco><worldbody>
    <geom name="ground" type="plane" size="5 5 1"/>
    <body name="lower" pos="0 0 0.5"><freejoint/><geom type="box" size="0.5 0.5 0.5"/></body>
    <body name="upper" pos="0.1 0 1.5"><freejoint/><geom type="box" size="0.5 0.5 0.5"/></body>
    <body name="ball" pos="2 0 0.4"><freejoint/><geom type="sphere" size="0.4"/></body>
  </worldbody></mujoco>)";
  char error[256] = "";
  mjModel* model = mj_loadXML((path + ".xml").c_str(), nullptr, error, sizeof error);
  if (!model) return std::fprintf(stderr, "%s\n", error), 1;
  mjData* data = mj_makeData(model);
  {
    contactscope::MujocoRecorder recorder(model, path.c_str());
    for (int i = 0; i < 60; ++i) {
      mj_step(model, data);
      recorder.record(data);
    }
  }
  mj_deleteData(data);
  mj_deleteModel(model);
}
