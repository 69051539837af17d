#include <atomic>
#include <cstdlib>
#include <iostream>
#include <string>

#include "core/workers.h"
#include "study/soak.h"

// soak CASES [SEED]: judges random pairs on all processors, and prints what it found. Exits with 1
// if a result is wrong. Not a test: a hundred million cases take an hour of one core.
int main(int count, char** arguments) {
  using namespace contactscope;
  const std::int64_t cases = count > 1 ? std::atoll(arguments[1]) : 0;
  if (cases < 1 || count > 3) {
    std::cerr << "usage: soak CASES [SEED]\n";
    return 2;
  }
  const std::uint64_t seed = count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 1;
  constexpr int kParts = 100;
  std::vector<Soak> parts(kParts);
  std::atomic<int> done = 0;
  Workers workers(hardware_threads());
  workers.for_each(kParts, [&](int i, int) {
    parts[static_cast<std::size_t>(i)] =
        soak_pairs(seed, cases * i / kParts, cases * (i + 1) / kParts);
    std::cerr << "\r" + std::to_string(++done) + " %";
  });
  std::cerr << '\n';
  Soak whole = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) add(whole, parts[i]);
  return report(whole, std::cout) ? 0 : 1;
}
