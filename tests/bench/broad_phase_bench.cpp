// The study `broad_phase` in one run, compared with the other libraries that are installed:
// milliseconds to find all pairs of many boxes, bytes, comparisons.
//
//   broad_phase_bench [steps [boxes ...]]
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "app/cli/table.h"
#include "study/broad_phase_study.h"
#ifdef CONTACTSCOPE_PEERS
#include "peers/broad_phase_peer.h"
#endif

int main(int argc, char** argv) {
  using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own
  StudyOptions options;
  options.cases = argc > 1 ? std::atoi(argv[1]) : 5;
  std::vector<int> boxes;
  for (int i = 2; i < argc; ++i) boxes.push_back(std::atoi(argv[i]));
  if (boxes.empty()) boxes = {1000, 10'000, 100'000};
  if (*options.cases < 1 || boxes.front() < 1) {
    std::fprintf(stderr, "usage: broad_phase_bench [steps [boxes ...]]\n");
    return 2;
  }
  std::vector<PairFinderInfo> finders = own_pair_finders();
#ifdef CONTACTSCOPE_PEERS
  for (const PairFinderInfo& peer : peers::broad_phase_peers()) finders.push_back(peer);
#endif
  const auto say = [](int done, int total, const std::string& what) {
    std::fprintf(stderr, "%d of %d: %s\n", done, total, what.c_str());
  };
  app::print_tables(study_pair_finders(finders, boxes, options, say), std::cout);
  return 0;
}
