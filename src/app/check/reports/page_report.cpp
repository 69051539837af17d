#include <nlohmann/json.hpp>

#include "app/check/reports/report.h"
#include "snapshot/store.h"
#include "vector/svg.h"

namespace contactscope {

/// page.html, embedded by the build.
std::string_view check_page();

namespace app {
namespace {

using Json = nlohmann::ordered_json;
using snapshot::Finding;

/// Embeds pictures so that the page can be sent as one file, up to a size that browsers handle
/// well; the rest is linked.
class Pictures {
 public:
  explicit Pictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::string source(const std::string& file) {
    constexpr std::uintmax_t kMax = 64 << 20;
    const std::optional<std::string> png = snapshot::read_text_file(folder_ / file);
    if (!png || bytes_ + png->size() > kMax) return file;
    bytes_ += png->size();
    return "data:image/png;base64," + base64(*png);
  }

  /// Text of an embedded file; empty if it is too large to embed.
  std::string text(const std::string& file) {
    constexpr std::uintmax_t kMax = 32 << 20, kMaxEach = 1 << 20;
    const std::optional<std::string> all = snapshot::read_text_file(folder_ / file);
    if (!all || all->size() > kMaxEach || text_bytes_ + all->size() > kMax) return {};
    text_bytes_ += all->size();
    return *all;
  }

 private:
  std::filesystem::path folder_;
  std::uintmax_t bytes_ = 0, text_bytes_ = 0;
};

/// Differences of a scenario's trace in one frame.
std::vector<std::string> facts_of(const snapshot::Outcome& outcome, const Finding& picture) {
  const auto scenario =
      std::ranges::find(outcome.scenarios, picture.scenario, &snapshot::ScenarioOutcome::scenario);
  std::vector<std::string> facts;
  const std::string own = picture.scenario + " frame " + std::to_string(*picture.frame);
  for (const Finding& finding : scenario->findings) {
    if (finding.is_picture()) continue;
    for (const std::string& detail : finding.details) {
      if (!detail.starts_with(own + ",") && !detail.starts_with(own + ":")) continue;
      facts.push_back(detail.substr(own.size() + 2));
    }
  }
  return facts;
}

Json finding_json(const ReportInput& input, const Finding& finding, Pictures& pictures) {
  Json json{{"key", finding.key()},
            {"scenario", finding.scenario},
            {"kind", snapshot::name_of(finding.kind)},
            {"sentence", finding.sentence},
            {"details", finding.details},
            {"review", snapshot::kReviews[static_cast<std::size_t>(finding.review)]}};
  if (finding.is_acceptable())
    json["accept"] = accept_command(input, {finding.key()});
  else
    json["remedy"] = remedy(input, finding);
  for (const char* which : {"actual", "expected"}) {
    const std::string viewer = viewer_path(finding.candidate, which);
    if (!viewer.empty() && std::filesystem::exists(input.folder / viewer))
      json["viewers"].push_back({{"name", which}, {"file", viewer}});
  }
  if (!finding.is_picture()) return json;
  json["frame"] = *finding.frame;
  json["facts"] = facts_of(input.outcome, finding);
  json["layers"] = finding.layers;
  if (!finding.layers_picture.empty()) json["layers_svg"] = pictures.text(finding.layers_picture);
  if (!finding.candidate.empty()) json["candidate"] = pictures.source(finding.candidate);
  if (!finding.expected.empty()) json["expected"] = pictures.source(finding.expected);
  if (!finding.difference.empty()) json["difference"] = pictures.source(finding.difference);
  return json;
}

}  // namespace

void report_page(const ReportInput& input) {
  Pictures pictures(input.folder);
  Json json{{"summary", snapshot::summary(snapshot::tally(input.outcome))},
            {"out", out_argument(input)},
            {"causes", Json::array()}};
  for (const snapshot::Cause& cause : snapshot::causes(input.outcome)) {
    std::string kind(snapshot::name_of(cause.findings.front()->kind));
    std::ranges::replace(kind, '_', ' ');
    Json one{{"kind", kind},
             {"scenarios", cause.scenarios},
             {"pictures", std::ranges::count_if(cause.findings, &Finding::is_picture)},
             {"findings", Json::array()}};
    if (cause.scenarios.size() > 1 && cause.findings.front()->is_acceptable())
      one["accept"] = accept_command(input, cause.scenarios);
    // The first finding describes the cause; pictures follow for review.
    std::vector<const Finding*> shown = cause.findings;
    std::stable_partition(shown.begin() + 1, shown.end(),
                          [](const Finding* finding) { return finding->is_picture(); });
    for (const Finding* finding : shown)
      one["findings"].push_back(finding_json(input, *finding, pictures));
    json["causes"].push_back(std::move(one));
  }
  const std::string text =
      vector::in_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
  std::string page(check_page());
  const std::string_view mark = "@REPORT@";
  page.replace(page.find(mark), mark.size(), text);
  snapshot::write_text(input.folder / "report.html", page);
}

}  // namespace app
}  // namespace contactscope
