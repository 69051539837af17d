// contactscope-engine-bullet, -ode and -fcl: one of the peers as a program that `contactscope
// versus` runs, for contacts or, with the argument "rollout", to step a scene. src/versus/README.md
// documents its input and output.
#include <iostream>
#include <map>
#include <set>

#include "core/input_error.h"
#include "lint/claims.h"
#include "peers/add_point.h"
#include "peers/peer.h"
#include "peers/rollout.h"
#include "trace/json.h"
#include "versus/request.h"

namespace contactscope::peers {
namespace {

std::unique_ptr<Peer> make_peer(const std::string& name) {
  if (name == "bullet") return make_bullet();
  return name == "ode" ? make_ode() : make_fcl();
}

class Program {
 public:
  explicit Program(const std::string& name) : peer_(make_peer(name)) {}

  void answer(std::istream& in, std::ostream& out) {
    trace::Trace request = trace::read_trace(in, "standard input");
    request.header.engine = peer_->name();
    request.header.version = peer_->version();
    out << trace::to_json_line(request.header) << '\n';
    for (const trace::Shape& shape : request.header.shapes) solids_.add(shape);
    for (trace::Frame& frame : request.frames) {
      for (const trace::Shape& shape : frame.shapes) solids_.add(shape);
      for (trace::Pair& pair : frame.pairs) collide(frame, pair);
      frame.deformed.clear();
      out << trace::to_json_line(frame) << '\n';
    }
  }

 private:
  void collide(const trace::Frame& frame, trace::Pair& pair) {
    const auto a = lint::place(solids_, &frame, pair.a, {});
    const auto b = lint::place(solids_, &frame, pair.b, {});
    if (!a || !b) return;
    auto [made, is_new] = pairs_.try_emplace({pair.a, pair.b});
    if (is_new)
      made->second = peer_->pair(shape_of(a->solid->shape()), shape_of(b->solid->shape()));
    if (made->second == nullptr) {
      if (refused_.insert(pair.kind).second)
        std::cerr << peer_->name() << " has nothing for " << pair.kind << '\n';
      return;
    }
    made->second->place(a->pose, b->pose);
    const PeerContact contact = made->second->collide();
    if (contact.failed)
      std::cerr << peer_->name() << " gave up on " << pair.a << "-" << pair.b << " in frame "
                << frame.frame << '\n';
    pair.manifolds.clear();
    for (const PeerPoint& point : contact.points)
      add_point(pair.manifolds, point.normal, point.position, point.separation);
    pair.state = pair.manifolds.empty() ? "separated" : "touching";
    if (const PeerPoint* deepest = contact.deepest()) pair.separation = deepest->separation;
  }

  std::unique_ptr<Peer> peer_;
  lint::Solids solids_;
  std::map<std::pair<std::string, std::string>, std::unique_ptr<PeerPair>> pairs_;
  std::set<std::string> refused_;
};

}  // namespace
}  // namespace contactscope::peers

int main(int count, char** arguments) {
  using namespace contactscope::peers;
  const std::string name = CONTACTSCOPE_PEER;
  try {
    if (count < 2 || std::string(arguments[1]) != "rollout") {
      Program(name).answer(std::cin, std::cout);
    } else if (name == "fcl") {
      throw NotStepped("FCL finds contacts, and steps nothing");
    } else {
      roll_out(name == "bullet" ? bullet_rollout() : ode_rollout(), std::cin, std::cout);
    }
  } catch (const NotStepped& reason) {
    std::cerr << reason.what() << '\n';
    return contactscope::versus::kNoRollout;
  } catch (const contactscope::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
