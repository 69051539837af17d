#include <map>
#include <memory>

#include "bench/step_counter.h"
#include "bench/variant.h"
#include "peers/peer.h"

namespace contactscope::bench {
namespace {

using peers::Peer;
using peers::PeerPair;
using peers::PeerShape;

/// Converts a shape for the libraries. A mesh stays shared.
PeerShape in_peers(const std::shared_ptr<const Shape<double>>& shape) {
  if (const auto* mesh = std::get_if<Mesh<double>>(shape.get())) {
    return std::shared_ptr<const Mesh<double>>(shape, mesh);
  }
  return peers::shape_of(*shape);
}

struct Prepared {
  std::vector<std::unique_ptr<PeerPair>> pairs;  // empty if the library lacks the shapes
  std::vector<std::vector<Placement>> steps;
  StepCounter counter;
};

/// A library with the objects that it made for each workload.
class EngineRun {
 public:
  explicit EngineRun(std::unique_ptr<Peer> peer) : peer_(std::move(peer)) {}

  const char* name() const { return peer_->name(); }

  bool runs(int workload) { return !prepared(workload).pairs.empty(); }

  double pass(int workload) {
    Prepared& made = prepared(workload);
    const bool moving = is_moving(static_cast<Workload>(workload));
    const std::size_t step = made.counter.next(made.steps.front().size());
    double sum = 0;
    for (std::size_t i = 0; i < made.pairs.size(); ++i) {
      PeerPair& pair = *made.pairs[i];
      // Moving pairs keep what the library remembers; the others start without memory each time.
      if (moving) {
        pair.place(made.steps[i][step].a, made.steps[i][step].b);
      } else {
        pair.forget();
      }
      sum += pair.run();
    }
    return sum;
  }

 private:
  Prepared& prepared(int workload) {
    const auto [found, inserted] = prepared_.try_emplace(workload);
    if (inserted) prepare(static_cast<Workload>(workload), found->second);
    return found->second;
  }

  void prepare(Workload workload, Prepared& made) {
    const std::vector<WorkloadPair> pairs = make_workload(workload);
    for (const WorkloadPair& pair : pairs) {
      std::unique_ptr<PeerPair> prepared = peer_->pair(in_peers(pair.a), in_peers(pair.b));
      if (!prepared) return;
      prepared->place(pair.steps.front().a, pair.steps.front().b);
      made.pairs.push_back(std::move(prepared));
      made.steps.push_back(pair.steps);
    }
  }

  std::unique_ptr<Peer> peer_;
  std::map<int, Prepared> prepared_;
};

}  // namespace

std::vector<Variant> peer_variants() {
  std::vector<Variant> result;
  for (std::unique_ptr<Peer>& peer : peers::make_peers()) {
    const auto engine_run = std::make_shared<EngineRun>(std::move(peer));
    result.push_back({engine_run->name(), [engine_run](int w) { return engine_run->pass(w); },
                      [engine_run](int w) { return engine_run->runs(w); }});
  }
  return result;
}

}  // namespace contactscope::bench
