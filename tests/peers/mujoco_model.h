#pragma once

#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/vec3.h"
#include "peers/rollout.h"

/// Common code for MuJoCo's contacts and its steps: its models are texts in XML.
namespace contactscope::peers {

inline std::string spelled(const Vec3d& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

inline std::string spelled(const Quatd& q) {
  std::ostringstream text;
  text.precision(17);
  text << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  return text.str();
}

/// Throws std::runtime_error with MuJoCo's own message if the model is invalid.
inline mjModel* mujoco_model(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(xml.size())) != 0)
    throw std::runtime_error("MuJoCo takes no model of " + std::to_string(xml.size()) + " bytes");
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), "model.xml")], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* const model = mj_loadXML("model.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

RolloutEngine mujoco_rollout();

}  // namespace contactscope::peers
