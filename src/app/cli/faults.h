#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/cli/catalogue.h"
#include "lint/linter.h"

/// Findings of `lint` in the contacts of scenarios and traces.
namespace contactscope::app {

/// Text of a finding: two or three lines, without the last line break.
std::string record(const std::string& file, const lint::Finding& finding);

nlohmann::ordered_json to_json(const lint::Finding& finding);

inline constexpr const char* kLintSchema = "contactscope.lint/1";

/// The findings in the file of --known. With --strict each of their pairs counts.
class KnownFindings {
 public:
  /// Throws InputError.
  explicit KnownFindings(const Options& options);

  /// Whether a finding of a trace is known. One below its threshold that is clearly more frequent is
  /// made a reported one, and one in a pair that is not known is placed there.
  bool knows(const std::string& file, lint::Finding& finding) const;

 private:
  /// How often a finding occurs, and how gross it is.
  struct Known {
    double share = 0, gross = 0;
    std::map<std::pair<std::string, std::string>, int> pairs{};
  };
  std::string path_;
  std::map<std::pair<std::string, std::string>, Known> known_;  // by file and cause
  bool is_strict_ = false;
  bool have_below_ = false, have_pairs_ = false;  // not in files of earlier versions
};

/// The options of `lint`. Throws UsageError.
lint::LintOptions linter_options(const Options& options);

/// Findings about the pipeline's results for a scenario, with their lines in the frames + 1 lines
/// of `contactscope trace`.
std::vector<lint::Finding> lint_scenario(const Scenario& scenario, const std::vector<int>& frames,
                                         const lint::LintOptions& options);

/// Findings about a trace, hints and those below a threshold included, for these frames (all
/// without), and the line where it breaks off. `look` is called with every frame. Throws InputError
/// and UsageError.
std::vector<lint::Finding> lint_trace(TraceFile& file, const lint::LintOptions& options,
                                      const std::optional<FrameRange>& frames = {},
                                      const std::function<void(const trace::Frame&)>& look = {});

/// Findings about all frames of an input. Throws InputError and UsageError.
std::vector<lint::Finding> lint_input(const Input& input, const lint::LintOptions& options);

/// If a view has the panel `lint` or the focus `worst`, adds the findings of lint_input(), with their
/// places in the frames that are drawn, to such views: first the place that `lint` names; with
/// --pair only those of this pair. Returns what the first of them says.
std::string add_faults(const Input& input, const std::vector<int>& drawn, const Options& options,
                       std::vector<View>& views);

}  // namespace contactscope::app
