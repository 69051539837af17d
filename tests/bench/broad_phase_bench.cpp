// Milliseconds to find all pairs of many boxes, in one run beside other libraries where they are
// installed. B1: boxes of about unit size, each meets seven others; from the start. B2: the same,
// each moves by 1 % of its size a step; least, median and longest step. B3: sizes over three
// decades, clustered; from the start. Contenders take turns, so that what else the machine does
// falls on all of them.
//
//   broad_phase_bench [boxes [repetitions]]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "broadphase/broad_phase.h"
#include "broadphase/random_boxes.h"
#ifdef CONTACTSCOPE_PEERS
#include "peers/broad_phase_peer.h"
#endif

namespace {

using contactscope::Aabb;
using contactscope::BroadPhase;
using contactscope::Vec3;
using contactscope::testing::RandomBoxes;
using contactscope::testing::Spread;
using Boxes = std::vector<Aabb<float>>;

constexpr int kSteps = 8;
constexpr int kMostForBruteForce = 20000;

/// Places all boxes and returns how many pairs there are.
using Step = std::function<std::size_t(const Boxes&)>;

struct Contender {
  std::string name;
  std::function<Step()> make;
};

std::vector<Contender> contenders(int boxes) {
  std::vector<Contender> all;
  for (const contactscope::BroadPhaseInfo& info : contactscope::broad_phases()) {
    if (info.name == "brute_force" && boxes > kMostForBruteForce) continue;
    all.push_back({info.name, [&info]() -> Step {
                     return [phase = std::shared_ptr<BroadPhase>(info.make())](const Boxes& boxes) {
                       for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
                         const Aabb<float>& box = boxes[static_cast<std::size_t>(i)];
                         i < phase->handles() ? phase->move(i, box) : void(phase->add(box));
                       }
                       return phase->pairs().size();
                     };
                   }});
  }
#ifdef CONTACTSCOPE_PEERS
  const std::size_t peers = contactscope::peers::broad_phase_peers().size();
  for (std::size_t i = 0; i < peers; ++i) {
    all.push_back({contactscope::peers::broad_phase_peers()[i]->name(), [i]() -> Step {
                     return
                         [peer = std::shared_ptr<contactscope::peers::BroadPhasePeer>(std::move(
                              contactscope::peers::broad_phase_peers()[i]))](const Boxes& boxes) {
                           peer->place(boxes);
                           return peer->pairs().size();
                         };
                   }});
  }
#endif
  return all;
}

Boxes scene(Spread spread, int count) {
  // Sides by which each box meets about seven others.
  const float volume = spread == Spread::Uniform ? 0.48f : 30.0f;
  RandomBoxes random(spread, std::cbrt(volume * static_cast<float>(count)), 3);
  Boxes boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(random.box());
  return boxes;
}

double milliseconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

struct Row {
  std::vector<double> times;
  std::size_t pairs = 0;
};

void print(const char* title, int boxes, const std::vector<Contender>& all,
           std::vector<Row>& rows) {
  std::printf("\n%s, %d boxes, ms\n%-18s%10s%10s%10s%12s\n", title, boxes, "", "least", "median",
              "longest", "pairs");
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<double>& times = rows[i].times;
    std::ranges::sort(times);
    std::printf("%-18s%10.2f%10.2f%10.2f%12zu\n", all[i].name.c_str(), times.front(),
                times[times.size() / 2], times.back(), rows[i].pairs);
  }
  std::fflush(stdout);
}

void from_the_start(const char* title, Spread spread, int boxes, int repetitions) {
  const Boxes made = scene(spread, boxes);
  const std::vector<Contender> all = contenders(boxes);
  std::vector<Row> rows(all.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      rows[i].times.push_back(milliseconds([&] { rows[i].pairs = all[i].make()(made); }));
    }
  }
  print(title, boxes, all, rows);
}

void moving(const char* title, int boxes, int repetitions) {
  Boxes now = scene(Spread::Uniform, boxes);
  const std::vector<Contender> all = contenders(boxes);
  std::vector<Row> rows(all.size());
  std::vector<Step> steps;
  for (const Contender& contender : all) {
    steps.push_back(contender.make());
    steps.back()(now);
  }
  RandomBoxes random(Spread::Uniform, 1, 5);
  for (int step = 0; step < kSteps * repetitions; ++step) {
    for (Aabb<float>& box : now) {
      const Vec3<float> by = random.vector(-0.01f, 0.01f).cwiseProduct(box.extent());
      box.lower += by;
      box.upper += by;
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      rows[i].times.push_back(milliseconds([&] { rows[i].pairs = steps[i](now); }));
  }
  print(title, boxes, all, rows);
}

}  // namespace

int main(int argc, char** argv) {
  const int boxes = argc > 1 ? std::atoi(argv[1]) : 10000;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  if (boxes < 1 || repetitions < 1) {
    std::fprintf(stderr, "usage: broad_phase_bench [boxes [repetitions]]\n");
    return 2;
  }
  from_the_start("B1: from the start", Spread::Uniform, boxes, repetitions);
  moving("B2: a step, each box moves by 1 %", boxes, repetitions);
  from_the_start("B3: sizes over three decades, clustered", Spread::Clustered, boxes, repetitions);
  return 0;
}
