#include "app/check/check_run.h"

#include <iostream>

#include "app/check/reports/report.h"
#include "app/cli/faults.h"
#include "app/render/figure_canvas.h"
#include "app/render/renderer.h"
#include "scenario/run.h"
#include "snapshot/report_folder.h"
#include "viewer/viewer.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;
using snapshot::Finding;
using snapshot::FindingKind;
using snapshot::ScenarioOutcome;

/// How a scenario's facts explain differences of its pictures.
struct Explanation {
  const snapshot::TraceDifferences* trace = nullptr;
  const snapshot::CheckedFrames* frames = nullptr;  // null if every frame is stored
  std::string cause;                                // of the trace
};

bool contains(const std::vector<int>& numbers, int number) {
  return std::ranges::find(numbers, number) != numbers.end();
}

/// Explains a changed picture by its facts, and sets its cause.
void explain(Finding& picture, const Explanation& facts) {
  if (picture.kind != FindingKind::Changed) return;
  const auto follow = [&](const std::string& why) {
    if (!facts.cause.empty()) picture.cause = facts.cause;
    picture.sentence += "; " + why;
  };
  if (contains(facts.trace->frames, *picture.frame)) {
    const std::string layers = separated(picture.layers, ", ");
    return follow("its facts changed" + (layers.empty() ? "" : ", and with them " + layers));
  }
  if (facts.trace->is_setup || facts.trace->is_words)
    return follow(facts.trace->is_setup ? "the shapes or settings changed" : "its texts changed");
  std::vector<int> others = facts.trace->frames;
  if (facts.frames)
    others.insert(others.end(), facts.frames->changed.begin(), facts.frames->changed.end());
  std::ranges::sort(others);
  if (!others.empty())
    return follow("its own facts are the same, but those of " +
                  std::string(others.size() > 1 ? "frames " : "frame ") +
                  snapshot::spell_numbers(others) +
                  " changed, and the camera is fitted to all frames");
  picture.cause = "drawing";
  picture.sentence +=
      facts.frames && !facts.frames->is_compared
          ? "; its own facts are the same; frames that are not stored were not compared"
          : "; all facts of the sequence are as stored, so the drawing changed, or the picture is "
            "older than the trace";
}

PixelLimits limits_of(const SnapshotSettings& settings, const std::string& view) {
  PixelLimits limits;
  const auto take = [&](const PictureLimits& own) {
    limits.channel = own.channel.value_or(limits.channel);
    limits.cluster = own.cluster.value_or(limits.cluster);
    limits.total = own.total.value_or(limits.total);
  };
  take(settings.limits);
  if (const auto own = settings.view_limits.find(view); own != settings.view_limits.end())
    take(own->second);
  return limits;
}

draw::FigureStyle style_of(const Scenario& scenario) {
  draw::FigureStyle style;
  style.words = words_of(scenario);
  return style;
}

std::string viewer_of(const Scenario& scenario, const trace::Header& header,
                      const std::vector<trace::Frame>& frames) {
  const draw::Staging staging = draw::stage(
      header, frames, scenario.views.front(), scenario.snapshots.width, scenario.snapshots.height,
      style_of(scenario), draw::kLayers, mapped(frames, &trace::Frame::frame));
  PictureOrigin origin;
  origin.scenario = scenario.name;
  origin.title = plain_title(scenario.title);
  viewer::Viewer page(staging, origin);
  for (const trace::Frame& frame : frames) page.add(frame);
  return page.html();
}

/// Pages in 3D of changed scenarios for the report of a check: of all frames of the run, and of the
/// stored ones. Only for the first scenarios, because each page contains three.js.
class Viewers {
 public:
  /// `candidate`: path of the run's trace in the report; empty if it has been accepted. Does nothing
  /// then, and without three.js.
  void add(const Scenario& scenario, const snapshot::StoredScenario& archive,
           const Sequence& sequence, const std::string& candidate, snapshot::ReportFolder& report) {
    constexpr int kMax = 20;
    if (candidate.empty() || viewer::three_script().empty() || scenarios_++ >= kMax) return;
    std::istringstream text(*snapshot::read_stored_trace(archive.root, archive.scenario));
    const trace::Trace stored = trace::read_trace(text, "stored");
    const auto add_page = [&](const trace::Header& header, const std::vector<trace::Frame>& frames,
                              const char* which) {
      report.add_file(viewer_path(candidate, which), viewer_of(scenario, header, frames));
    };
    add_page(sequence.header, sequence.frames, "actual");
    add_page(stored.header, stored.frames, "expected");
  }

 private:
  int scenarios_ = 0;
};

class Checker {
 public:
  Checker(const Options& options, snapshot::ReportFolder& report)
      : options_(options),
        renderer_(options.backend, log_),
        report_(report),
        policy_{snapshot::is_ci(std::getenv("CI")), options.update} {}

  ScenarioOutcome check(Input& input) {
    const Scenario& scenario = input.scenario;
    ScenarioOutcome outcome{scenario.name, scenario.path};
    const snapshot::StoredScenario archive =
        snapshot::archive_of(options_.snapshot_root, scenario.name);
    snapshot::Margins margins;
    Sequence sequence = facts_of(input, outcome, margins);
    snapshot::CheckedFrames frames;
    const bool has_hashes = !input.trace;
    if (has_hashes) frames = check_frames(archive, scenario, sequence, outcome);

    trace::Trace stored{sequence.header, {}};
    sequence.each(scenario.snapshots.frames,
                  [&](std::size_t index) { stored.frames.push_back(sequence.frames[index]); });
    // Runs while the pictures are drawn.
    std::future<snapshot::CheckedTrace> pending = std::async(std::launch::async, [&] {
      return snapshot::check_trace(archive, stored, policy_, margins);
    });
    std::vector<Finding> pictures;
    if (!options_.facts_only) {
      add_faults(input, scenario.snapshots.frames, options_, input.scenario.views);
      for (const View& view : selected_views(scenario, options_))
        check_pictures(archive, scenario, view, sequence, outcome, pictures);
    }
    snapshot::CheckedTrace trace = pending.get();
    const snapshot::TraceDifferences differences = trace.differences;
    if (trace.finding) report_.add_text(*trace.finding, snapshot::to_json_lines(stored));
    if (trace.finding && trace.finding->kind == FindingKind::Changed)
      viewers_.add(scenario, archive, sequence, trace.finding->candidate, report_);
    Explanation facts{&differences, has_hashes && has_unstored(scenario) ? &frames : nullptr, {}};
    if (trace.finding && trace.finding->kind == FindingKind::Changed)
      facts.cause = trace.finding->cause;
    else if (frames.finding && frames.finding->kind == FindingKind::Changed)
      facts.cause = frames.finding->cause;
    if (frames.finding && frames.finding->kind == FindingKind::Changed)
      frames.finding->cause = facts.cause;
    if (trace.finding && !frames.changed.empty() && !differences.frames.empty() &&
        frames.changed.front() < differences.frames.front())
      trace.finding->sentence += "; its facts changed from frame " +
                                 std::to_string(frames.changed.front()) +
                                 " on, which has no snapshot";
    take(std::move(trace), outcome);
    take(std::move(frames), outcome);
    if (!pictures.empty() && !differences.frames.empty())
      name_layers(archive, scenario, sequence, differences, pictures);
    for (Finding& picture : pictures) {
      explain(picture, facts);
      outcome.findings.push_back(std::move(picture));
    }
    if (options_.view.empty()) check_stale(archive, scenario, outcome);
    return outcome;
  }

  /// Stored scenarios that have no file any more.
  std::vector<ScenarioOutcome> check_orphans(const std::vector<std::string>& names) {
    std::vector<ScenarioOutcome> outcomes;
    std::vector<snapshot::Checked> files =
        snapshot::check_stale_scenarios(options_.snapshot_root, names, policy_);
    std::ranges::move(snapshot::check_stale_meshes(options_.snapshot_root, policy_),
                      std::back_inserter(files));
    for (snapshot::Checked& file : files) {
      const std::string& name = file.finding->scenario;
      if (outcomes.empty() || outcomes.back().scenario != name)
        outcomes.push_back(ScenarioOutcome{name});
      take(std::move(file), outcomes.back());
    }
    return outcomes;
  }

  const RunLog& log() const { return log_; }

 private:
  static bool has_unstored(const Scenario& scenario) {
    return count_of(scenario.snapshots.frames) < scenario.frames;
  }

  static void take(snapshot::Checked checked, ScenarioOutcome& outcome) {
    outcome.written += checked.is_written;
    if (checked.finding) outcome.findings.push_back(std::move(*checked.finding));
  }

  /// Runs the scenario and checks its expectations. Sets `margins` to those of stored frames.
  Sequence facts_of(Input& input, ScenarioOutcome& outcome, snapshot::Margins& margins) {
    if (input.trace) {
      outcome.file = input.file;
      return std::move(*input.trace);
    }
    const Scenario& scenario = input.scenario;
    trace::Stages stages;
    stages.decisions = true;
    Sequence sequence = run_sequence(scenario, stages, false, log_);
    snapshot::TakenDecisions decisions = snapshot::take_decisions(
        scenario.snapshots.frames, scenario.views, sequence.header, sequence.frames);
    outcome.brittle = std::move(decisions.brittle);
    margins = std::move(decisions.margins);
    const std::vector<std::string> unmet = unmet_expectations(scenario, sequence.frames);
    if (!unmet.empty()) {
      Finding finding{FindingKind::UnmetExpectation, scenario.name};
      finding.sentence = unmet.front();
      finding.details = unmet;
      finding.cause = "expectations of " + scenario.name;
      outcome.findings.push_back(std::move(finding));
    }
    return sequence;
  }

  snapshot::CheckedFrames check_frames(const snapshot::StoredScenario& archive,
                                       const Scenario& scenario, const Sequence& sequence,
                                       ScenarioOutcome& outcome) {
    const Timed timed(log_, "hash frames");
    snapshot::FrameHashes hashes{snapshot::rounding(), {}};
    for (const trace::Frame& frame : sequence.frames) {
      if (!contains(scenario.snapshots.frames, frame.frame))
        hashes.hashes[frame.frame] = snapshot::hash_of(frame);
    }
    snapshot::CheckedFrames checked = snapshot::check_frames(archive, hashes, policy_);
    const bool is_stored = !checked.finding || checked.finding->kind == FindingKind::Changed;
    if (!hashes.hashes.empty() && is_stored && !checked.is_compared)
      outcome.notes.push_back(
          "frames that are not stored were not compared, because this machine rounds differently "
          "from the one that wrote " +
          snapshot::hashes_path(archive.root, archive.scenario).generic_string());
    outcome.frames =
        count_of(scenario.snapshots.frames) + (checked.is_compared ? count_of(hashes.hashes) : 0);
    if (checked.finding) report_.add_text(*checked.finding, to_text(hashes));
    return checked;
  }

  void check_pictures(const snapshot::StoredScenario& archive, const Scenario& scenario,
                      const View& view, Sequence& sequence, ScenarioOutcome& outcome,
                      std::vector<Finding>& findings) {
    const std::vector<int>& drawn = scenario.snapshots.frames;
    const std::optional<draw::FittedFrames> fitted = fitted_frames(sequence, drawn);
    const draw::Staging staging = draw::stage(
        sequence.header, sequence.frames, view, scenario.snapshots.width, scenario.snapshots.height,
        style_of(scenario), draw::kLayers, drawn, fitted ? &*fitted : nullptr);
    renderer_.render(
        staging, sequence, scenario.snapshots.frames, [&](const trace::Frame& shown, Image image) {
          const Timed timed(log_, "compare");
          // With --view the path still has the view's folder if there are several.
          const snapshot::PictureKey key{
              scenario.name, scenario.views.size() > 1 ? std::optional(view.name) : std::nullopt,
              shown.frame};
          snapshot::CheckedPicture checked = snapshot::check_picture(
              archive, key, image, policy_, limits_of(scenario.snapshots, view.name));
          ++outcome.pictures;
          outcome.written += checked.is_written;
          if (!checked.finding) return;
          Finding finding = std::move(*checked.finding);
          report_.add_picture(finding, checked, image);
          findings.push_back(std::move(finding));
        });
  }

  /// Finds the layers of pictures that the stored facts draw differently.
  void name_layers(const snapshot::StoredScenario& archive, const Scenario& scenario,
                   const Sequence& sequence, const snapshot::TraceDifferences& differences,
                   std::vector<Finding>& pictures) {
    constexpr int kMax = 4;  // each takes as long as drawing the picture twice
    const Timed timed(log_, "compare layers");
    std::istringstream text(*snapshot::read_stored_trace(archive.root, archive.scenario));
    const trace::Trace stored = trace::read_trace(text, "stored");
    int named = 0;
    for (Finding& picture : pictures) {
      if (picture.kind != FindingKind::Changed || !contains(differences.frames, *picture.frame) ||
          named++ >= kMax)
        continue;
      const auto find = [&](const std::vector<trace::Frame>& frames) {
        return std::ranges::find(frames, *picture.frame, &trace::Frame::frame);
      };
      const auto expected = find(stored.frames), actual = find(sequence.frames);
      if (expected == stored.frames.end() || actual == sequence.frames.end()) continue;
      const View& view = picture.view.empty()
                             ? scenario.views.front()
                             : *std::ranges::find(scenario.views, picture.view, &View::name);
      const draw::Staging staging = draw::stage(
          sequence.header, sequence.frames, view, scenario.snapshots.width,
          scenario.snapshots.height, style_of(scenario), draw::kLayers, scenario.snapshots.frames);
      try {
        MovedLayers moved = moved_layers(staging, *expected, *actual);
        picture.layers = std::move(moved.names);
        report_.add_layers(picture, moved.svg);
      } catch (const std::exception& error) {
        log_.note(picture.key() + ": layers were not compared: " + error.what());
      }
    }
  }

  void check_stale(const snapshot::StoredScenario& archive, const Scenario& scenario,
                   ScenarioOutcome& outcome) {
    std::vector<std::string> views;
    if (scenario.views.size() > 1) views = mapped(scenario.views, &View::name);
    for (snapshot::Checked& file :
         snapshot::check_stale(archive, views, scenario.snapshots.frames, policy_))
      take(std::move(file), outcome);
  }

  const Options& options_;
  RunLog log_;
  Viewers viewers_;
  Renderer renderer_;
  snapshot::ReportFolder& report_;
  snapshot::Policy policy_;
};

/// Outcome of a scenario that could not be compared; each line of `why` starts with a place in its file.
ScenarioOutcome unreadable(const Input& input, const std::string& why) {
  ScenarioOutcome outcome{input.scenario.name,
                          input.file.empty() ? input.scenario.path : input.file};
  Finding finding{FindingKind::UnreadableScenario, input.scenario.name};
  std::istringstream lines(why);
  std::getline(lines, finding.sentence);
  for (std::string line; std::getline(lines, line);) finding.details.push_back(line);
  finding.cause = "unreadable scenario " + input.scenario.name;
  outcome.findings.push_back(std::move(finding));
  return outcome;
}

/// An error in one scenario, at load or run time, does not stop the others.
ScenarioOutcome checked(Checker& checker, Input& input) {
  if (!input.unreadable.empty()) return unreadable(input, input.unreadable);
  const std::string file = input.scenario.path;
  try {
    return checker.check(input);
  } catch (const InputError& error) {
    return unreadable(input, error.what());
  } catch (const ShapeError& error) {
    return unreadable(input, InputError(file, 0, 0, error.what()).what());
  } catch (const std::domain_error& error) {
    return unreadable(input, InputError(file, 0, 0, error.what()).what());
  }
}

}  // namespace

snapshot::Outcome run_check(std::vector<Input>& inputs, const Options& options) {
  if (!fs::is_directory(options.snapshot_root) && options.update == snapshot::Update::None)
    throw InputError(options.snapshot_root, 0, 0,
                     "there is no such folder of snapshots; change to its parent folder, give "
                     "another with --snapshots DIR, or create it with check --write-missing");
  snapshot::ReportFolder report(options.out, report_folder(options).filename().string());
  Checker checker(options, report);
  snapshot::Outcome outcome{options.snapshot_root, options.facts_only, options.shard};
  const std::vector<std::string> all =
      mapped(inputs, [](const Input& input) { return input.scenario.name; });
  // Default costs: a picture costs about as much as ten frames of facts.
  if (options.shard)
    keep_shard(inputs, *options.shard, [](const Input& input) {
      const SnapshotSettings& stored = input.scenario.snapshots;
      const int pictures = count_of(stored.frames) * count_of(input.scenario.views);
      return 1.0 + 0.1 * input.scenario.frames + pictures;
    });

  {
    Progress progress(count_of(inputs), options.quiet);
    for (Input& input : inputs) {
      stop_if_interrupted();
      progress.advance(input.scenario.name);
      outcome.scenarios.push_back(checked(checker, input));
    }
  }
  const bool is_first = !options.shard || options.shard->part == 1;
  if (options.scenarios.empty() && options.view.empty() && is_first) {
    for (ScenarioOutcome& orphan : checker.check_orphans(all))
      outcome.scenarios.push_back(std::move(orphan));
  }
  std::ranges::stable_sort(outcome.scenarios, {}, &ScenarioOutcome::scenario);
  rewrite_page(report.aside(), outcome, options);
  report.publish(outcome);
  if (options.verbose) checker.log().print(std::cerr, "check");
  return outcome;
}

}  // namespace contactscope::app
