#include "study/study.h"

#include <ctime>

namespace contactscope {
namespace {

// As named by the kernel; an unknown processor is not an error.
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

}  // namespace

trace::StudyContext study_context(const std::string& scalar) {
  const std::string build_type = CONTACTSCOPE_BUILD_TYPE;
  return {processor(), compiler(), build_type.empty() ? "no build type" : build_type, now(),
          scalar};
}

const std::vector<StudyInfo>& studies() {
  static const std::vector<StudyInfo> list = {
      {"reducers", "contact area that each reducer loses, against its run time", &study_reducers},
      {"hull_precision", "float against double: the depth of hulls by the separating axis test",
       &study_hull_precision},
      {"penetration", "depth and normal by EPA, MPR, sampling and SAT, by effort",
       &study_penetration},
      {"stability", "limits of float and double: tilt, scale, distance, aspect, angle, overlap",
       &study_limits},
      {"manifold_stability",
       "one-shot against incremental manifolds: boxes that drop, tilt and slide",
       &study_manifold_stability},
      {"solver", "stacks by position method, warm starting, iterations and sub-steps",
       &study_solver},
      {"overlap", "false positives of bounding volumes, and what a threshold on edge axes costs",
       &study_overlap},
      {"broad_phase",
       "pairs of boxes that overlap: time, memory and comparisons by number of boxes",
       &study_broad_phase},
      {"mesh_mesh", "two meshes: time by size, and trees that are refitted, rebuilt or both",
       &study_meshes},
      {"triangle_triangle", "wrong answers of triangle tests, down to one unit off one plane",
       &study_triangles},
      {"time_of_impact", "error and time of continuous collision, by speed and far from the origin",
       &study_time_of_impact},
      {"tunnelling", "share of bullets that pass a wall, by speed and thickness",
       &study_tunnelling},
      {"ghost", "how far flat floors of meshes and boxes throw and slow what slides over them",
       &study_ghosts},
      {"distance_field",
       "distance fields: error against time and memory, what sampling misses, thin plates",
       &study_distance_field},
      {"phase", "which features make the contact of two cubes, by offset and tilt", &study_phase},
      {"box_path", "time of a contact of two boxes, by their own path and as any hulls",
       &study_box_path},
      {"bounding_trees", "trees of boxes, oriented boxes and polytopes over two meshes",
       &study_bounding_trees},
      {"distance",
       "steps to the distance of hulls by V-Clip, GJK and all pairs; GJK without tolerances",
       &study_distance},
      {"flip_distance", "smallest change of a pose after which the pair has other points",
       &study_flip_distance, true},
  };
  return list;
}

std::vector<double> PassTimes::sorted() const {
  std::vector<double> times = times_;
  std::ranges::sort(times);
  return times;
}

trace::Nanoseconds PassTimes::summary() const {
  const std::vector<double> times = sorted();
  const double median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
  return {median, times.front(), times.back()};
}

trace::StudyPoint Measurement::point(double parameter, std::size_t measure) const {
  trace::StudyPoint result{parameter, {}, {}, times.summary(), failed, of};
  const Errors& found = errors[measure];
  if (found.count > 0) {
    result.error = found.sum / found.count;
    result.error_worst = found.worst;
  }
  return result;
}

std::vector<trace::Study> results_of(const std::string& study, const std::string& scalar,
                                     const std::string& parameter, const std::string& reference,
                                     const std::vector<StudyMeasure>& measures,
                                     trace::StudyForm form) {
  return mapped(measures, [&](const StudyMeasure& measure) {
    trace::Study result;
    result.study = study;
    result.measure = measure.name;
    result.title = measure.title;
    result.context = study_context(scalar);
    result.reference = reference;
    result.error = measure.error;
    result.unit = measure.unit;
    result.resolution = measure.resolution;
    result.parameter = parameter;
    result.form = form;
    return result;
  });
}

void finish_share(trace::Study& study, double least) {
  record::each_point(study, [&](trace::StudyPoint& point) {
    point.error = point.error_worst = std::max(*point.error, least);
  });
}

}  // namespace contactscope
