#include "study/depth_peer.h"

#include <sstream>

#include "versus/request.h"

namespace contactscope {
namespace {

constexpr double kMaxPeerMinutes = 10;

void write_vertices(std::ostream& out, const std::vector<Vec3d>& vertices, const Pose<double>& pose,
                    double size) {
  out << vertices.size() << '\n';
  for (const Vec3d& vertex : vertices) {
    const Vec3d at = pose.transform(vertex) / size;
    out << at.x() << ' ' << at.y() << ' ' << at.z() << '\n';
  }
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
    write_vertices(request, pair.a.vertices, Pose<double>(), pair.size);
    write_vertices(request, pair.b.vertices, pair.b_in_a, pair.size);
  }
  const versus::Answer answer =
      versus::run_program(*program, {}, request.str(), 60 * kMaxPeerMinutes);
  if (!answer.failure.empty()) throw std::runtime_error(*program + ": " + answer.failure);
  std::istringstream in(answer.out);
  std::vector<DepthPeer> peers;
  for (std::string word; in >> word;) {
    DepthPeer& peer = peers.emplace_back();
    std::getline(in >> std::ws, peer.name);
    std::size_t times = 0;
    in >> word >> times;
    for (std::size_t i = 0; in && i < times; ++i) in >> peer.nanoseconds.emplace_back();
    for (const OverlappingHulls& pair : pairs) {
      PeerDepth& found = peer.found.emplace_back();
      in >> found.depth >> found.normal.x() >> found.normal.y() >> found.normal.z();
      found.depth *= pair.size;
    }
    if (!in || times == 0)
      throw std::runtime_error(*program + ": its answer is incomplete or not a number");
  }
  return peers;
}

}  // namespace contactscope
