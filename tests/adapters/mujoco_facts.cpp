// Lets python_test.py compare contactscope.py with the C++ adapter on MuJoCo's own library:
//   mujoco_facts                        where the fields of mjModel, mjData and mjContact are
//   mujoco_facts MODEL.xml STEPS OUT    steps the model, recorded by the C++ adapter
#define CONTACTSCOPE_IMPLEMENTATION
#include "adapters/mujoco.h"

#include <cstddef>
#include <cstdlib>

namespace {

#define FIELD(type, name) std::printf(#type " " #name " %zu\n", offsetof(type, name))

void print_offsets() {
  std::printf("mjContact size %zu\n", sizeof(mjContact));
  FIELD(mjModel, nbody);
  FIELD(mjModel, ngeom);
  FIELD(mjModel, nmesh);
  FIELD(mjModel, nmeshvert);
  FIELD(mjModel, nmeshgraph);
  FIELD(mjModel, nhfield);
  FIELD(mjModel, nhfielddata);
  FIELD(mjModel, npair);
  FIELD(mjModel, nnames);
  FIELD(mjModel, opt.timestep);
  FIELD(mjModel, opt.gravity);
  FIELD(mjModel, opt.cone);
  FIELD(mjModel, opt.iterations);
  FIELD(mjModel, opt.disableflags);
  FIELD(mjModel, body_rootid);
  FIELD(mjModel, body_weldid);
  FIELD(mjModel, body_mass);
  FIELD(mjModel, geom_type);
  FIELD(mjModel, geom_contype);
  FIELD(mjModel, geom_conaffinity);
  FIELD(mjModel, geom_bodyid);
  FIELD(mjModel, geom_dataid);
  FIELD(mjModel, geom_size);
  FIELD(mjModel, mesh_vertadr);
  FIELD(mjModel, mesh_vertnum);
  FIELD(mjModel, mesh_graphadr);
  FIELD(mjModel, mesh_vert);
  FIELD(mjModel, mesh_graph);
  FIELD(mjModel, hfield_size);
  FIELD(mjModel, hfield_nrow);
  FIELD(mjModel, hfield_ncol);
  FIELD(mjModel, hfield_adr);
  FIELD(mjModel, hfield_data);
  FIELD(mjModel, pair_geom1);
  FIELD(mjModel, pair_geom2);
  FIELD(mjModel, name_bodyadr);
  FIELD(mjModel, name_geomadr);
  FIELD(mjModel, names);
  FIELD(mjData, nefc);
  FIELD(mjData, ncon);
  FIELD(mjData, time);
  FIELD(mjData, xipos);
  FIELD(mjData, geom_xpos);
  FIELD(mjData, geom_xmat);
  FIELD(mjData, subtree_com);
  FIELD(mjData, contact);
  FIELD(mjData, cvel);
  FIELD(mjData, efc_force);
  FIELD(mjContact, dist);
  FIELD(mjContact, pos);
  FIELD(mjContact, frame);
  FIELD(mjContact, friction);
  FIELD(mjContact, dim);
  FIELD(mjContact, geom1);
  FIELD(mjContact, geom2);
  FIELD(mjContact, efc_address);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) return print_offsets(), 0;
  char error[256] = "";
  mjModel* const model = mj_loadXML(arguments[1], nullptr, error, sizeof error);
  if (!model) return std::fprintf(stderr, "%s\n", error), 1;
  mjData* const data = mj_makeData(model);
  {
    contactscope::MujocoRecorder recorder(model, arguments[3]);
    for (int i = std::atoi(arguments[2]); i > 0; --i) {
      mj_step(model, data);
      recorder.record(data);
    }
  }
  mj_deleteData(data);
  mj_deleteModel(model);
}
