// A stack of crates in ODE, recorded: ode_sample stack.jsonl
#define CONTACTSCOPE_IMPLEMENTATION
#include "adapters/ode.h"

struct Scene {
  dWorldID world;
  dJointGroupID contacts;
  contactscope::OdeRecorder* recorder;
};

void near_callback(void* data, dGeomID a, dGeomID b) {
  Scene* scene = static_cast<Scene*>(data);
  dContact found[8];
  const int count = dCollide(a, b, 8, &found[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    found[i].surface = dSurfaceParameters();
    found[i].surface.mu = dReal(0.6);
    const dJointID joint = dJointCreateContact(scene->world, scene->contacts, &found[i]);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    scene->recorder->contact(joint, found[i].geom);
  }
}

int main(int count, char** arguments) {
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dJointGroupID contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, dReal(-9.81));

  contactscope::OdeRecorder recorder(world, space, count > 1 ? arguments[1] : "stack.jsonl");
  Scene scene = {world, contacts, &recorder};

  recorder.name(dCreatePlane(space, 0, 0, 1, 0), "ground");
  for (int i = 0; i < 4; ++i) {
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, 10, 1, 1, 1);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, dReal(0.05) * i, 0, dReal(0.5) + i);
    dGeomSetBody(dCreateBox(space, 1, 1, 1), body);
  }
  for (int i = 0; i < 60; ++i) {
    dSpaceCollide(space, &scene, &near_callback);
    recorder.step(&dWorldQuickStep, dReal(0.01));
    dJointGroupEmpty(contacts);
  }
  dJointGroupDestroy(contacts);
  dSpaceDestroy(space);
  dWorldDestroy(world);
  dCloseODE();
}
