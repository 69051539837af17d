#include "study/study.h"
#include "versus/request.h"

#include <iostream>

#include "app/cli/catalogue.h"
#include "app/cli/table.h"
#include "app/render/renderer.h"
#include "draw/charts/plot.h"

namespace contactscope::app {
namespace {

/// Scenarios of a study; empty if it makes its own cases.
std::vector<Scenario> scenarios_of(const StudyInfo& info, const Options& options) {
  if (!info.of_scenarios && (!options.scenarios.empty() || options.frames))
    throw UsageError("study " + info.name +
                     " makes its own cases; leave out scenarios and --frames");
  if (!info.of_scenarios) return {};
  if (options.scenarios.empty())
    throw UsageError("study " + info.name + " needs a scenario; name one, as hull/face_contact");
  return load_scenarios(options);
}

std::vector<trace::Study> run_study(const StudyInfo& info, const Options& options, RunLog& log) {
  const Timed timed(log, "study");
  const std::vector<Scenario> scenarios = scenarios_of(info, options);
  StudyOptions study_options;
  study_options.scenarios = &scenarios;
  if (options.frames) study_options.only_frames = options.selected(options.frames->last + 1);
  study_options.seed = options.seed;
  study_options.cases = options.cases;
  study_options.peer_folders = versus::own_folders();
  std::optional<Progress> progress;
  return info.run(study_options, [&](int /*done*/, int total, const std::string& what) {
    stop_if_interrupted();
    if (!progress) progress.emplace(total, options.quiet);
    progress->advance(what);
  });
}

/// A panel with many methods needs a larger picture.
Size size_of(const trace::Study& result) {
  const bool one_panel =
      result.form == trace::StudyForm::WorkPrecision && !trace::has_panels(result);
  const auto is_loud = [](const trace::StudySeries& series) { return !series.quiet; };
  return one_panel
             ? roomy_size(static_cast<std::size_t>(std::ranges::count_if(result.series, is_loud)))
             : Size{};
}

// Computes everything before writing the first file, so that a failed study leaves the files of an
// earlier run intact.
ExitCode run_study(const Options& options) {
  note_interrupts();
  const StudyInfo& info = studies()[word_in("study", options.study, names_in(studies()))];
  RunLog log;
  const std::vector<trace::Study> results = run_study(info, options, log);
  if (info.of_scenarios && results.front().series.empty())
    throw UsageError("no pair touches in these frames, so there is nothing to study");

  const std::filesystem::path folder = std::filesystem::path(options.out) / "study" / info.name;
  std::map<std::filesystem::path, std::vector<std::uint8_t>> files;
  const auto keep = [&](const std::string& name, const auto& bytes) {
    files[folder / name] = {bytes.begin(), bytes.end()};
  };
  Renderer renderer(options.backend, log);
  for (const trace::Study& result : results) {
    // The main measure has no suffix.
    const std::string suffix = &result == &results.front() ? "" : "_" + result.measure;
    keep("results" + suffix + ".json", trace::to_json(result));
    keep("results" + suffix + ".csv", trace::to_csv(result));
    if (options.tables_only) continue;
    const trace::Study record = picture_of(result);
    const Size size = options.size.value_or(size_of(record));
    keep("plot" + suffix + ".png",
         encode_png(renderer.paint(draw::plot(record, size.width, size.height))));
  }
  if (options.tables_only) log.left_out("plots and OpenGL, because of --table");
  stop_if_interrupted();
  std::filesystem::create_directories(folder);
  for (const auto& [path, bytes] : files) write_whole_file(path.string(), bytes);
  if (options.json) {
    for (const trace::Study& result : results) std::cout << trace::to_json_line(result) << '\n';
  } else {
    print_tables(results, std::cout);
  }
  if (options.verbose) log.print(std::cerr, "study");
  if (!options.quiet) std::cerr << files.size() << " files in " << folder.string() << '\n';
  return ExitCode::Same;
}

}  // namespace

Verb study_verb() {
  return {"study", "Measure error against run time: plot, CSV and JSON", &run_study};
}

}  // namespace contactscope::app
