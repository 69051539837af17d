#include "adapters/ode.h"
#include "lint/worlds.h"

namespace contactscope::test {
namespace {

struct OdeWorld {
  dWorldID world;
  dJointGroupID contacts;
  OdeRecorder* recorder = nullptr;  // null: not recorded
};

void near_callback(void* data, dGeomID a, dGeomID b) {
  OdeWorld& of = *static_cast<OdeWorld*>(data);
  if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
  dContact found[8];
  const int count = dCollide(a, b, 8, &found[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    found[i].surface = dSurfaceParameters();
    found[i].surface.mu = dReal(0.6);
    const dJointID joint = dJointCreateContact(of.world, of.contacts, &found[i]);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    if (of.recorder != nullptr) of.recorder->contact(joint, found[i].geom);
  }
}

}  // namespace

void record_in_ode(const Recording& recording) {
  dInitODE2(0);
  dRandSetSeed(0);  // dWorldQuickStep shuffles its rows
  OdeWorld of{dWorldCreate(), dJointGroupCreate(0)};
  const dSpaceID space = dHashSpaceCreate(nullptr);
  dWorldSetGravity(of.world, 0, 0, dReal(-9.81));
  const bool is_heap = recording.world == World::Heap;
  dCreatePlane(space, 0, 0, 1, 0);
  if (is_heap)
    for (int side = 0; side < 4; ++side) {
      const double x = side == 0 ? 1 : side == 1 ? -1 : 0, y = side == 2 ? 1 : side == 3 ? -1 : 0;
      dGeomSetPosition(dCreateBox(space, x != 0 ? 1 : 6, x != 0 ? 6 : 1, 2), dReal(2 * x),
                       dReal(2 * y), 1);
    }
  double top = 0;
  for (int n = 0; n < recording.bodies; ++n) {
    const double x = 2 * half_extent(n, 0), y = 2 * half_extent(n, 1), z = 2 * half_extent(n, 2);
    const dBodyID body = dBodyCreate(of.world);
    dMass mass;
    dMassSetBoxTotal(&mass, 2 + n % 3, x, y, z);
    dBodySetMass(body, &mass);
    const double spread = is_heap ? 1 : 0.03;
    dBodySetPosition(body, spread * scattered(n, 0), spread * scattered(n, 1),
                     is_heap ? 0.6 + 0.35 * n : top + z / 2);
    top += z;
    const int kind = is_heap ? n % 3 : 0;
    dGeomSetBody(kind == 0   ? dCreateBox(space, x, y, z)
                 : kind == 1 ? dCreateSphere(space, x / 2)
                             : dCreateCapsule(space, x / 4, y),
                 body);
  }
  const auto step = [&] {
    constexpr double kStep = 0.01;
    dSpaceCollide(space, &of, &near_callback);
    if (of.recorder != nullptr)
      of.recorder->step(&dWorldQuickStep, dReal(kStep));
    else
      dWorldQuickStep(of.world, dReal(kStep));
    dJointGroupEmpty(of.contacts);
  };
  for (int i = 0; i < recording.unrecorded; ++i) step();
  {
    OdeRecorder recorder(of.world, space, recording.path.c_str());
    of.recorder = &recorder;
    for (int i = 0; i < recording.frames; ++i) step();
  }
  dJointGroupDestroy(of.contacts);
  dSpaceDestroy(space);
  dWorldDestroy(of.world);
  dCloseODE();
}

}  // namespace contactscope::test
