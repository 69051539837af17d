#include "snapshot/report_folder.h"

#include "core/input_error.h"
#include "image/png.h"
#include "trace/listed_json.h"

namespace contactscope::snapshot {

namespace fs = std::filesystem;
namespace {

constexpr std::string_view kFindings = "findings.json";
constexpr std::string_view kWords[] = {".actual", ".expected", ".difference", ".layers"};

/// True for files of an older report, which are replaced.
bool is_ours(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name == kFindings || name == "report.html" || name == "times.json" ||
      name == "known_same.json")
    return true;
  return std::ranges::any_of(
      kWords, [&](std::string_view word) { return file.stem().extension().string() == word; });
}

void remove_old_report(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> files, folders;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) folders.push_back(entry.path());
    if (is_ours(entry.path())) files.push_back(entry.path());
  }
  for (const fs::path& file : files) fs::remove(file);
  // Remove empty folders too, deepest first.
  std::sort(folders.rbegin(), folders.rend());
  for (const fs::path& empty : folders) {
    std::error_code not_empty;
    fs::remove(empty, not_empty);
  }
}

/// Removes temporary folders of killed runs.
void remove_abandoned(const fs::path& out, const std::string& prefix) {
  for (const fs::directory_entry& entry : fs::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    const std::string process = name.substr(prefix.size());
    if (process.empty() || process.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code unknown;
    if (!fs::exists("/proc/" + process, unknown) && !unknown) fs::remove_all(entry.path(), unknown);
  }
}

}  // namespace

ReportFolder::ReportFolder(const fs::path& out, const std::string& name)
    : out_(out), folder_(out / name) {
  fs::create_directories(out_);
  const std::string prefix = "." + name + ".";
  remove_abandoned(out_, prefix);
  aside_ = out_ / (prefix + std::to_string(::getpid()));
}

ReportFolder::~ReportFolder() {
  std::error_code gone;
  fs::remove_all(aside_, gone);
}

void ReportFolder::add_picture(Finding& finding, const CheckedPicture& checked,
                               const Image& actual) {
  if (!finding.fails()) return;
  const fs::path stem = fs::path(finding.file).replace_extension();
  fs::create_directories((aside_ / stem).parent_path());
  const auto path = [&](const char* ending) { return stem.generic_string() + ending; };
  finding.candidate = path(".actual.png");
  write_png((aside_ / finding.candidate).string(), actual);
  finding.candidate_sha256 = sha256_of_file(aside_ / finding.candidate);
  if (!checked.expected) return;
  finding.expected = path(".expected.png");
  fs::copy_file(checked.nearest, aside_ / finding.expected, fs::copy_options::overwrite_existing);
  finding.difference = path(".difference.png");
  write_png((aside_ / finding.difference).string(), difference_image(*checked.expected, actual));
}

void ReportFolder::add_layers(Finding& finding, const std::string& svg) {
  if (!finding.fails() || svg.empty()) return;
  finding.layers_picture =
      fs::path(finding.file).replace_extension().generic_string() + ".layers.svg";
  add_file(finding.layers_picture, svg);
}

void ReportFolder::add_text(Finding& finding, const std::string& actual) {
  if (!finding.fails()) return;
  const fs::path file(finding.file);
  finding.candidate =
      fs::path(file).replace_extension().generic_string() + ".actual" + file.extension().string();
  add_file(finding.candidate, actual);
  finding.candidate_sha256 = sha256_of_file(aside_ / finding.candidate);
}

void ReportFolder::add_file(const std::string& path, const std::string& text) {
  write_text(aside_ / path, text);
}

fs::path ReportFolder::publish(const Outcome& outcome) {
  add_file(std::string(kFindings), to_json(outcome));
  fs::create_directories(folder_);
  const FolderLock lock(out_);
  remove_old_report(folder_);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(aside_)) {
    if (!entry.is_regular_file()) continue;
    const fs::path target = folder_ / entry.path().lexically_relative(aside_);
    fs::create_directories(target.parent_path());
    fs::rename(entry.path(), target);
  }
  return folder_ / kFindings;
}

Outcome read_outcome(const fs::path& folder) {
  const fs::path path = folder / kFindings;
  const std::optional<std::string> text = read_text_file(path);
  if (!text)
    throw InputError(path.string(), 0, 0,
                     "there is no report of a check here; run contactscope check, or name its "
                     "--out DIR");
  return parse_outcome(*text, path.string());
}

void write_outcome(const fs::path& folder, const Outcome& outcome) {
  write_text(folder / kFindings, to_json(outcome));
}

std::string to_json(const Outcome& outcome) {
  const Tally counts = tally(outcome);
  trace::Json json = trace::written("findings", outcome, {{"schema", kFindingsSchema}});
  json["same"] = counts.failing == 0;
  json["summary"] = summary(counts);
  json["counts"] = {{"scenarios", counts.scenarios}, {"same", counts.same},
                    {"failing", counts.failing},     {"frames", counts.frames},
                    {"pictures", counts.pictures},   {"written", counts.written}};
  for (std::size_t kind = 0; kind < kFindingKinds.size(); ++kind)
    json["counts"][std::string(kFindingKinds[kind])] = counts.kinds[kind];
  json["scenarios"] = trace::Json::array();
  for (const ScenarioOutcome& scenario : outcome.scenarios)
    json["scenarios"].push_back(trace::written("findings", scenario));
  // File names may be any bytes; invalid UTF-8 is replaced.
  return json.dump(1, ' ', false, trace::Json::error_handler_t::replace) + "\n";
}

Outcome parse_outcome(const std::string& text, const std::string& name) {
  try {
    const trace::Json json = trace::Json::parse(text);
    if (json.at("schema") != kFindingsSchema)
      throw std::runtime_error("its schema is not " + std::string(kFindingsSchema));
    Outcome outcome;
    trace::read_json(json, outcome);
    trace::read_json(json.at("scenarios"), outcome.scenarios);
    for (ScenarioOutcome& scenario : outcome.scenarios)
      for (Finding& finding : scenario.findings) finding.scenario = scenario.scenario;
    return outcome;
  } catch (const std::exception& error) {
    throw InputError(name, 0, 0, std::string("not the findings of a check: ") + error.what());
  }
}

}  // namespace contactscope::snapshot
