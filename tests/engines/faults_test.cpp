#include "lint/faults.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/program.h"
#include "support/temporary_folder.h"
#include "trace/read_trace.h"

/// Faults of engines in traces of engines from npm, as tests/lint has them in traces of others.
namespace contactscope::lint {
namespace {

constexpr const char* kEngines[] = {"jolt", "physx", "rapier"};

/// The last second of what an engine answers to a request of `versus` to step a scenario: a program in
/// front of the engine's writes its answer to a file as well.
Trace stepped(const std::string& engine, const std::string& scenario) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.jsonl";
  const std::string program =
      folder.write("contactscope-engine-recorded", "#!/bin/sh\n'" CONTACTSCOPE_SOURCE_DIR
                                                   "/tests/engines/contactscope-engine-" +
                                                       engine + "' \"$@\" | tee '" + file + "'\n");
  chmod(program.c_str(), 0700);
  const test::ProgramRun result =
      test::run("versus --rollout --table --engines recorded " + scenario,
                "PATH='" + program.substr(0, program.rfind('/')) + "':\"$PATH\"");
  std::ifstream in(file);
  Trace trace = trace::read_trace(in, file);
  constexpr std::ptrdiff_t kFrames = 60;
  if (trace.frames.size() > kFrames)
    trace.frames.erase(trace.frames.begin(), trace.frames.end() - kFrames);
  EXPECT_EQ(trace.frames.size(), 60u) << result.err;
  return trace;
}

std::string named_in(const std::vector<Finding>& findings) {
  std::string names;
  for (const Finding& finding : findings) names += finding.cause + " ";
  return names;
}

bool has_impulses(const Trace& trace) {
  const trace::Point& point = trace.frames.back().pairs.front().manifolds.front().points.front();
  return point.impulse.has_value();
}

TEST(EngineFaults, EachIsNamedFirstInAPyramid) {
  for (const char* engine : kEngines) {
    const Trace clean = stepped(engine, "solver/pyramid");
    EXPECT_EQ(named_in(lint(clean)), "") << engine;
    const std::vector<Target> chosen = targets(clean, 1);
    ASSERT_FALSE(chosen.empty()) << engine;
    int named = 0, all = 0;
    std::ostringstream misses;
    for (const Fault& fault : faults())
      for (const Often often : {Often::Always, Often::Rarely, Often::Once}) {
        if (!has_impulses(clean) && fault.causes.front() == "impulses_flicker") continue;
        Trace trace = clean;
        seed(trace, fault, chosen.front(), often);
        const std::vector<Finding> findings = lint(trace);
        const std::vector<std::string>& expected =
            often == Often::Always && !fault.always.empty() ? fault.always : fault.causes;
        const bool is_first = !findings.empty() &&
                              std::ranges::find(expected, findings.front().cause) != expected.end();
        ++all, named += is_first;
        if (!is_first) misses << fault.name << ": " << named_in(findings) << "\n";
      }
    EXPECT_GE(all, 80) << engine;
    EXPECT_GE(named, 0.95 * all) << engine << ": " << named << " of " << all << "\n"
                                 << misses.str();
  }
}

/// Jolt rounds edges. PhysX and Rapier keep points while bodies turn, and have some of them twice.
TEST(EngineFaults, AHeapHasWhatTheEnginesApproximate) {
  const std::vector<std::string> known = {"separation", "surface",   "normal",
                                          "deepest",    "ids_alike", "points_twice"};
  for (const char* engine : kEngines)
    for (const Finding& finding : lint(stepped(engine, "heap/twenty")))
      if (std::ranges::find(known, finding.cause) == known.end()) {
        EXPECT_LE(finding.count, 6) << engine << ", " << finding.cause;
        EXPECT_THAT(finding.cause, testing::AnyOf("normals_jump", "overlap_without_contact"))
            << engine << ", frame " << finding.frame << ", " << finding.a << "-" << finding.b
            << ": " << finding.said << "; " << finding.is;
      }
}

}  // namespace
}  // namespace contactscope::lint
