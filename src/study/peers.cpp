#include "study/peers.h"

#include "versus/request.h"

namespace contactscope {
namespace {

constexpr double kMaxPeerMinutes = 10;

/// Output of the program. Throws std::runtime_error if it fails.
std::istringstream output_of(const std::string& program, const std::ostringstream& request) {
  const versus::Answer answer =
      versus::run_program(program, {}, request.str(), 60 * kMaxPeerMinutes);
  if (!answer.failure.empty()) throw std::runtime_error(program + ": " + answer.failure);
  return std::istringstream(answer.out);
}

[[noreturn]] void refuse_output(const std::string& program) {
  throw std::runtime_error(program + ": its answer is incomplete or not a number");
}

template <class List> void write_list(std::ostream& out, const List& list) {
  out << list.size() << '\n';
  for (const auto& entry : list) out << entry[0] << ' ' << entry[1] << ' ' << entry[2] << '\n';
}

/// Reads a word, a count and that many times; returns the count.
std::size_t read_times(std::istream& in, std::vector<double>& nanoseconds) {
  std::string word;
  std::size_t count = 0;
  in >> word >> count;
  for (std::size_t i = 0; in && i < count; ++i) in >> nanoseconds.emplace_back();
  return count;
}

}  // namespace

std::vector<DepthPeer> run_depth_peers(const std::vector<std::string>& folders,
                                       const std::vector<OverlappingHulls>& pairs,
                                       int repetitions) {
  const auto program = versus::find_program("contactscope-depth-peers", folders);
  if (!program) return {};
  std::ostringstream request;
  request.precision(std::numeric_limits<double>::max_digits10);
  request << "repetitions " << repetitions << " pairs " << pairs.size() << '\n';
  for (const OverlappingHulls& pair : pairs) {
    const auto placed = [&](const Hull<double>& hull, const Pose<double>& pose) {
      return mapped(hull.vertices, [&](const Vec3d& vertex) -> Vec3d {
        return pose.transform(vertex) / pair.size;
      });
    };
    write_list(request, placed(pair.a, Pose<double>()));
    write_list(request, placed(pair.b, pair.b_in_a));
  }
  std::istringstream in = output_of(*program, request);
  std::vector<DepthPeer> peers;
  for (std::string word; in >> word;) {
    DepthPeer& peer = peers.emplace_back();
    std::getline(in >> std::ws, peer.name);
    const std::size_t times = read_times(in, peer.nanoseconds);
    for (const OverlappingHulls& pair : pairs) {
      PeerDepth& found = peer.found.emplace_back();
      in >> found.depth >> found.normal.x() >> found.normal.y() >> found.normal.z();
      found.depth *= pair.size;
    }
    if (!in || times == 0) refuse_output(*program);
  }
  return peers;
}

std::optional<PeerField> run_field_peer(const std::vector<std::string>& folders,
                                        const std::string& name, const Mesh<double>& mesh,
                                        int cells, int band, int repetitions,
                                        const std::vector<Vec3d>& points) {
  const auto program = versus::find_program("contactscope-field-" + name, folders);
  if (!program) return std::nullopt;
  std::ostringstream request;
  request.precision(std::numeric_limits<double>::max_digits10);
  request << "cells " << cells << " band " << band << " repetitions " << repetitions << '\n';
  write_list(request << "vertices ", mesh.vertices);
  write_list(request << "triangles ", mesh.triangles);
  write_list(request << "points ", points);
  std::istringstream in = output_of(*program, request);
  PeerField field;
  std::string word;
  in >> word;
  std::getline(in >> std::ws, field.name);
  in >> word >> field.build >> word >> field.bytes;
  read_times(in, field.nanoseconds);
  for (std::size_t i = 0; in && i < points.size(); ++i) {
    Vec3d gradient;
    in >> field.distances.emplace_back() >> gradient.x() >> gradient.y() >> gradient.z();
    field.gradients.push_back(gradient);
  }
  if (!in) refuse_output(*program);
  return field;
}

}  // namespace contactscope
