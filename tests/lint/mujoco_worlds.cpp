#include <fstream>
#include <sstream>
#include <stdexcept>

#include "adapters/mujoco.h"
#include "lint/worlds.h"

namespace contactscope::test {
namespace {

/// An octahedron, as a mesh of its own.
std::string hull_of(int n) {
  std::ostringstream mesh;
  mesh << "<mesh name='hull " << n << "' vertex='";
  for (int i = 0; i < 6; ++i)
    for (int axis = 0; axis < 3; ++axis)
      mesh << (i / 2 == axis ? (i % 2 == 0 ? 1 : -1) * half_extent(n, axis) : 0.0) << " ";
  mesh << "'/>";
  return mesh.str();
}

std::string geom_of(World world, int n) {
  std::ostringstream geom;
  const double x = half_extent(n, 0), y = half_extent(n, 1), z = half_extent(n, 2);
  if (world == World::Stack || n % 4 == 0)
    geom << "type='box' size='" << x << " " << y << " " << z << "'";
  else if (n % 4 == 1)
    geom << "type='sphere' size='" << x << "'";
  else if (n % 4 == 2)
    geom << "type='capsule' size='" << x / 2 << " " << y / 2 << "'";
  else
    geom << "type='mesh' mesh='hull " << n << "'";
  return geom.str();
}

}  // namespace

void record_in_mujoco(const Recording& recording) {
  const bool is_heap = recording.world == World::Heap;
  std::ostringstream meshes, bodies;
  bodies << "<geom name='plane' type='plane' size='10 10 1'/>";
  for (int side = 0; is_heap && side < 4; ++side) {
    const int x = side == 0 ? 1 : side == 1 ? -1 : 0, y = side == 2 ? 1 : side == 3 ? -1 : 0;
    bodies << "<geom name='wall " << side << "' type='box' size='" << (x != 0 ? 0.5 : 3) << " "
           << (y != 0 ? 0.5 : 3) << " 1' pos='" << 2 * x << " " << 2 * y << " 1'/>";
  }
  double top = 0;
  for (int n = 0; n < recording.bodies; ++n) {
    const double half = half_extent(n, 2), spread = is_heap ? 1 : 0.03;
    if (is_heap && n % 4 == 3) meshes << hull_of(n);
    bodies << "<body name='body " << n << "' pos='" << spread * scattered(n, 0) << " "
           << spread * scattered(n, 1) << " " << (is_heap ? 0.6 + 0.7 * n : top + half)
           << "'><freejoint/><geom mass='" << 2 + n % 3 << "' " << geom_of(recording.world, n)
           << "/></body>";
    top += 2 * half;
  }
  const std::string file = recording.path + ".xml";
  std::ofstream(file) << "<mujoco><size nconmax='1000' njmax='4000'/><asset>" << meshes.str()
                      << "</asset><worldbody>" << bodies.str() << "</worldbody></mujoco>";
  char error[1000] = "";
  mjModel* const model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
  if (model == nullptr) throw std::runtime_error(error);
  mjData* const data = mj_makeData(model);
  constexpr int kSteps = 8;  // in a sixtieth of a second
  for (int i = 0; i < kSteps * recording.unrecorded; ++i) mj_step(model, data);
  {
    MujocoRecorder recorder(model, recording.path.c_str());
    for (int i = 0; i < recording.frames; ++i) {
      mj_step(model, data);
      recorder.record(data);
    }
  }
  mj_deleteData(data);
  mj_deleteModel(model);
}

}  // namespace contactscope::test
