#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/catalogue.h"
#include "app/figure_canvas.h"
#include "app/progress.h"
#include "app/studio.h"
#include "app/verbs.h"
#include "core/at.h"
#include "draw/staging.h"
#include "scenario/run.h"
#include "snapshot/check.h"
#include "snapshot/report.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

/// What the check found of one scenario.
struct Outcome {
  std::string scenario;
  bool fails = false;
  std::vector<std::string> sentences{};
  int pictures = 0;
  int changed = 0;  // files written, rewritten or removed
};

class Checker {
 public:
  explicit Checker(const Options& options)
      : options_(options),
        studio_(options.backend, ledger_),
        report_(options.out),
        policy_{snapshot::is_ci(std::getenv("CI")), options.update} {}

  /// A scenario is run first; of a trace, which expects nothing, its first, middle and last frame are stored.
  Outcome check(Input& input) {
    const Scenario& scenario = input.scenario;
    Outcome outcome{scenario.name};
    Sequence sequence;
    if (input.trace) {
      sequence = std::move(*input.trace);
    } else {
      sequence = run_sequence(scenario, {}, false, ledger_);
      if (const auto unmet = unmet_expectations(scenario, sequence.frames); !unmet.empty()) {
        outcome.fails = true;
        outcome.sentences = unmet;
        report_.add(scenario.name, unmet);
      }
    }
    trace::Trace stored{sequence.header, {}};
    sequence.each(scenario.snapshots.frames,
                  [&](std::size_t index) { stored.frames.push_back(sequence.frames[index]); });
    take(snapshot::check_trace(options_.snapshot_root, stored, policy_), outcome);
    for (const View& view : selected_views(scenario, options_))
      check_pictures(scenario, view, sequence, outcome);
    if (!options_.view.empty()) return outcome;
    std::vector<std::string> views;
    if (scenario.views.size() > 1) views = mapped(scenario.views, &View::name);
    for (const snapshot::Checked& file : snapshot::check_stale(
             options_.snapshot_root, scenario.name, views, scenario.snapshots.frames, policy_))
      take(file, outcome);
    return outcome;
  }

  /// Stored scenarios that no file describes any more. What was stored of another engine's trace has no
  /// such file.
  std::vector<Outcome> check_orphans(const std::vector<Input>& inputs) {
    std::vector<std::string> names =
        mapped(inputs, [](const Input& input) { return input.scenario.name; });
    for (const std::string& name : snapshot::stored_of_engines(options_.snapshot_root))
      names.push_back(name);
    std::vector<Outcome> outcomes;
    for (const snapshot::Checked& file :
         snapshot::check_stale_scenarios(options_.snapshot_root, names, policy_))
      take(file, outcomes.emplace_back(Outcome{file.scenario}));
    return outcomes;
  }

  std::optional<std::filesystem::path> finish() { return report_.finish(); }
  const Ledger& ledger() const { return ledger_; }

 private:
  /// `image`: what a picture is now.
  template <class Checked, class... OfPicture>
  void take(const Checked& checked, Outcome& outcome, const OfPicture&... image) {
    outcome.fails = outcome.fails || checked.fails;
    outcome.sentences.insert(outcome.sentences.end(), checked.sentences.begin(),
                             checked.sentences.end());
    outcome.changed += checked.verdict >= snapshot::Verdict::Written;
    report_.add(checked, image...);
  }

  void check_pictures(const Scenario& scenario, const View& view, Sequence& sequence,
                      Outcome& outcome) {
    draw::FigureStyle style;
    style.words = words_of(scenario);
    const draw::Staging staging =
        draw::stage(sequence.header, sequence.frames, view, scenario.snapshots.width,
                    scenario.snapshots.height, style);
    studio_.render(
        staging, sequence, scenario.snapshots.frames, [&](const trace::Frame& shown, Image image) {
          const int frame = shown.frame;
          const Timed timed(ledger_, "compare");
          // A view chosen on the command line stays where it would be among the others.
          const snapshot::PictureKey key{
              scenario.name, scenario.views.size() > 1 ? std::optional(view.name) : std::nullopt,
              frame};
          snapshot::CheckedPicture checked =
              snapshot::check_picture(options_.snapshot_root, key, image, policy_);
          const std::string own_frame = " frame " + std::to_string(frame) + ", ";
          const bool is_explained =
              std::ranges::any_of(outcome.sentences, [&](const std::string& sentence) {
                return sentence.find(own_frame) != std::string::npos;
              });
          if (checked.expected && !is_explained) {
            checked.sentences.push_back(
                snapshot::to_string(key) +
                ": its trace is the same; the camera, fitted to the whole sequence, or the drawing "
                "changed");
          }
          ++outcome.pictures;
          take(checked, outcome, image);
        });
  }

  const Options& options_;
  Ledger ledger_;
  Studio studio_;
  snapshot::Report report_;
  snapshot::Policy policy_;
};

void print_outcome(const Outcome& outcome, const Options& options) {
  if (options.json) {
    const nlohmann::ordered_json json{{"scenario", outcome.scenario},
                                      {"same", !outcome.fails},
                                      {"pictures", outcome.pictures},
                                      {"changed_files", outcome.changed},
                                      {"differences", outcome.sentences}};
    std::cout << json.dump() << '\n';
    return;
  }
  if (outcome.fails || !options.quiet) {
    std::cout << (outcome.fails         ? "FAILED  "
                  : outcome.changed > 0 ? "updated "
                                        : "same    ")
              << outcome.scenario;
    if (outcome.changed > 0) {
      std::cout << ", " << outcome.changed << (outcome.changed == 1 ? " file" : " files")
                << " written or removed";
    }
    std::cout << '\n';
  }
  for (const std::string& sentence : outcome.sentences) {
    if (outcome.fails || options.verbose) std::cout << "        " << sentence << '\n';
  }
}

ExitCode run_check(const Options& options) {
  note_interrupts();
  std::vector<Input> inputs = load_inputs(options, Hold::Sample);
  Checker checker(options);
  if (options.update != snapshot::Update::None && snapshot::is_ci(std::getenv("CI")))
    std::cerr << "CI=true: nothing is updated; unset CI to accept what changed\n";
  int failed = 0;
  {
    Progress progress(count_of(inputs), options.quiet);
    for (Input& input : inputs) {
      const Outcome outcome = checker.check(input);
      progress.advance(input.scenario.name);
      progress.clear();
      failed += outcome.fails;
      print_outcome(outcome, options);
    }
  }
  if (options.scenarios.empty() && options.view.empty()) {
    for (const Outcome& outcome : checker.check_orphans(inputs)) {
      failed += outcome.fails;
      print_outcome(outcome, options);
    }
  }
  const std::optional<std::filesystem::path> page = checker.finish();
  if (options.verbose) checker.ledger().print(std::cerr, "check");
  if (!options.quiet) {
    std::cerr << inputs.size() << (inputs.size() == 1 ? " scenario, " : " scenarios, ") << failed
              << " failed";
    if (page) std::cerr << "; see " << page->string();
    std::cerr << '\n';
  }
  return failed == 0 ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb check_verb() {
  return {"check",
          "Compare with the stored snapshots",
          &run_check,
          "[SCENARIO...] --snapshots --update --json --out --backend --view --jobs",
          {{"SCENARIO", "Scenarios, or traces of any engine; default: all scenarios"},
           {"--json", "Print the verdicts as JSON"}}};
}

}  // namespace contactscope::app
