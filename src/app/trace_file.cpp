#include "app/trace_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/input_error.h"
#include "scenario/nearest_word.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlank = " \t\r\n";
// Of lengths that should be one: numbers written with three digits pass.
constexpr double kUnitTolerance = 2e-3;

std::string spelled_length(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", length);
  return text;
}

bool is_unit(double length) {
  return std::abs(length - 1) <= kUnitTolerance;  // false of nan
}

/// What is wrong, and what would be right; empty where nothing is.
using Wrong = std::optional<std::string>;

Wrong wrong_shape(const trace::Shape& shape) {
  const std::string name = "shape '" + shape.name + "'";
  if (shape.half_space) {
    if (!is_unit(shape.half_space->normal.norm()))
      return name + ": the 'normal' of 'half_space' must have length 1";
  } else if (shape.vertices.empty()) {
    return name +
           " has no 'vertices'; a sphere has its centre, a capsule the ends of its "
           "segment, a plane 'half_space' instead";
  }
  if (shape.radius < 0) return name + ": 'radius' is negative; give metres, or leave it out";
  for (const std::vector<int>& face : shape.faces) {
    if (face.size() < 3) return name + " has a face of fewer than three vertices; leave it out";
  }
  return std::nullopt;
}

Wrong wrong_header(const trace::Header& header) {
  try {
    snapshot::scenario_folder("", header.scenario);
  } catch (const std::invalid_argument&) {
    return "'scenario' is '" + header.scenario +
           "'; write it as GROUP/IDEA, which is where its pictures go";
  }
  if (header.up != "y" && header.up != "z")
    return "'up' is '" + header.up + "'; it may be 'y' or 'z'";
  if (header.shapes.empty()) return "'shapes' is empty; there is nothing to draw";
  for (const trace::Shape& shape : header.shapes) {
    if (Wrong wrong = wrong_shape(shape)) return wrong;
  }
  return std::nullopt;
}

/// Judges the frames of one trace.
class FrameJudge {
 public:
  explicit FrameJudge(const trace::Header& header) : header_(header) {
    for (const trace::Shape& shape : header.shapes) names_.push_back(shape.name);
  }

  Wrong wrong(const trace::Frame& frame) const {
    for (const auto& [name, pose] : frame.poses) {
      if (Wrong unknown = wrong_name("poses", name)) return unknown;
      if (!is_unit(pose.rotation.norm()))
        return "poses." + name + ": 'quat_wxyz' has length " +
               spelled_length(pose.rotation.norm()) + "; it must be 1";
    }
    for (const trace::Shape& shape : header_.shapes) {
      const auto is_its = [&](const auto& named) { return named.first == shape.name; };
      if (std::ranges::none_of(frame.poses, is_its))
        return "'poses' has no '" + shape.name +
               "'; each frame gives the 'position' and 'quat_wxyz' of each shape";
    }
    for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
      const std::string place = "pairs[" + std::to_string(i) + "]";
      if (Wrong found = wrong_pair(place, frame.pairs[i])) return found;
    }
    return std::nullopt;
  }

 private:
  const trace::Shape* find(const std::string& name) const {
    const auto found = std::ranges::find(header_.shapes, name, &trace::Shape::name);
    return found == header_.shapes.end() ? nullptr : &*found;
  }

  Wrong wrong_name(const std::string& place, const std::string& name) const {
    if (find(name) != nullptr) return std::nullopt;
    const std::string near = nearest(name, names_);
    return place + ": the header has no shape '" + name + "'" +
           (near.empty() ? "; add it there" : "; did you mean '" + near + "'?");
  }

  /// Of a clip -1 stands for none.
  Wrong wrong_face(const std::string& place, const std::string& shape, int face,
                   int least = 0) const {
    const trace::Shape* const owner = find(shape);
    if (owner == nullptr) return wrong_name(place, shape);
    const auto count = static_cast<int>(owner->faces.size());
    if (face >= least && face < count) return std::nullopt;
    return place + " is " + std::to_string(face) + ", but '" + shape + "' has " +
           std::to_string(count) + " faces; the first is 0";
  }

  Wrong wrong_edge(const std::string& place, const std::string& shape, int edge) const {
    const trace::Shape* const owner = find(shape);
    if (owner == nullptr) return wrong_name(place, shape);
    const auto count = static_cast<int>(owner->edges.size());
    if (edge >= 0 && edge < count) return std::nullopt;
    return place + " is " + std::to_string(edge) + ", but '" + shape + "' has " +
           std::to_string(count) + " edges; the first is 0";
  }

  Wrong wrong_manifold(const std::string& place, const trace::Manifold& manifold) const {
    if (!is_unit(manifold.normal.norm()))
      return place + ".normal has length " + spelled_length(manifold.normal.norm()) +
             "; it must be 1, and point from a to b";
    if (manifold.points.empty())
      return place + " has no points; leave out manifolds that have none";
    return std::nullopt;
  }

  Wrong wrong_pair(const std::string& place, const trace::Pair& pair) const {
    if (Wrong wrong = wrong_name(place + ".a", pair.a)) return wrong;
    if (Wrong wrong = wrong_name(place + ".b", pair.b)) return wrong;
    if (pair.a == pair.b) return place + ": 'a' and 'b' are the same shape; a pair needs two";
    if (pair.state != "touching" && pair.state != "separated")
      return place + ".state is '" + pair.state + "'; it may be 'touching' or 'separated'";
    for (std::size_t i = 0; i < pair.manifolds.size(); ++i) {
      const std::string one = place + ".manifolds[" + std::to_string(i) + "]";
      if (Wrong wrong = wrong_manifold(one, pair.manifolds[i])) return wrong;
    }
    if (pair.clip) {
      for (const auto& [key, face] : {std::pair{".clip.reference", &pair.clip->reference},
                                      {".clip.incident", &pair.clip->incident}}) {
        if (Wrong wrong = wrong_face(place + key + ".face", face->shape, face->face, -1))
          return wrong;
      }
    }
    if (pair.sat && pair.sat->face_a) {
      if (Wrong wrong = wrong_face(place + ".sat.face_a.face", pair.a, pair.sat->face_a->face))
        return wrong;
    }
    if (pair.sat && pair.sat->face_b) {
      if (Wrong wrong = wrong_face(place + ".sat.face_b.face", pair.b, pair.sat->face_b->face))
        return wrong;
    }
    if (pair.sat && pair.sat->edge) {
      if (Wrong wrong = wrong_edge(place + ".sat.edge.a", pair.a, pair.sat->edge->a)) return wrong;
      if (Wrong wrong = wrong_edge(place + ".sat.edge.b", pair.b, pair.sat->edge->b)) return wrong;
    }
    if (pair.tree) return wrong_tree(place + ".tree", *pair.tree);
    return std::nullopt;
  }

  Wrong wrong_tree(const std::string& place, const trace::Tree& tree) const {
    for (const int candidate : tree.candidates) {
      if (Wrong wrong = wrong_face(place + ".candidates", tree.shape, candidate)) return wrong;
    }
    return wrong_name(place + ".shape", tree.shape);
  }

  const trace::Header& header_;
  std::vector<std::string_view> names_;
};

/// Number of the line that holds the header, for 0, or frame `index` - 1: blank lines count.
int line_of(const std::string& path, std::size_t index) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::size_t seen = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(kBlank) == std::string::npos) continue;
    if (seen++ == index) return number;
  }
  return 1;
}

}  // namespace

bool is_trace_file(const std::string& path) {
  if (!fs::is_regular_file(path)) return false;
  if (fs::path(path).extension() == ".jsonl") return true;
  std::ifstream in(path, std::ios::binary);
  char first = ' ';
  while (std::string_view(kBlank).find(first) != std::string_view::npos && in.get(first)) continue;
  return in && first == '{';
}

trace::Trace load_trace(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, 0, 0, "this file cannot be read; check its permissions");
  trace::Trace trace = trace::read_trace(in, path);
  if (const Wrong wrong = wrong_header(trace.header))
    throw InputError(path, line_of(path, 0), 1, *wrong);
  if (trace.frames.empty())
    throw InputError(path, line_of(path, 0), 1,
                     "the header is all there is; each frame is a line after it");
  const FrameJudge judge(trace.header);
  for (std::size_t i = 0; i < trace.frames.size(); ++i) {
    Wrong wrong = judge.wrong(trace.frames[i]);
    const int number = trace.frames[i].frame;
    if (number < 0 || (i > 0 && number <= trace.frames[i - 1].frame))
      wrong = "'frame' is " + std::to_string(number) +
              "; frames count from 0, in rising order, each once";
    if (wrong) throw InputError(path, line_of(path, i + 1), 1, *wrong);
  }
  return trace;
}

}  // namespace contactscope::app
