#include "study/study.h"

#include <array>
#include <ctime>
#include <fstream>

namespace contactscope {
namespace {

// As the kernel names it; an unknown processor is no reason to fail.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name") && !line.starts_with("Model")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__);
#elif defined(__GNUC__)
  return "GCC " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__);
#else
  return "unknown compiler";
#endif
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string build_type() {
  const std::string type = CONTACTSCOPE_BUILD_TYPE;
  return type.empty() ? "no build type" : type;
}

}  // namespace

trace::StudyContext study_context(const std::string& scalar) {
  return {processor(), compiler(), build_type(), now(), scalar};
}

const std::vector<StudyInfo>& studies() {
  static const std::vector<StudyInfo> list = {
      {"reducers", "what each reducer loses of the contact, against its run time", &study_reducers},
      {"hull_precision", "float against double, and what the Gauss map saves of the edge pairs",
       &study_hull_precision},
      {"penetration", "depth and normal by EPA, MPR, sampling and SAT, over what each may take",
       &study_penetration},
      {"stability", "where float and double run out: tilt, scale, distance, aspect, angle, overlap",
       &study_limits},
      {"manifold_stability",
       "one-shot against incremental manifolds: boxes that drop, tilt and slide",
       &study_manifold_stability},
      {"solver", "stacks by position method, warm starting, iterations and sub-steps",
       &study_solver},
  };
  return list;
}

}  // namespace contactscope
