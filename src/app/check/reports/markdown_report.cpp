#include <sstream>

#include "app/check/reports/report.h"
#include "image/encoding.h"
#include "image/png.h"
#include "image/terminal.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

using snapshot::Cause;
using snapshot::Finding;

// $GITHUB_STEP_SUMMARY is limited to one MiB.
constexpr std::size_t kMaxBytes = 900000;

/// A small picture embedded in the text.
std::string inline_picture(const ReportInput& input, const char* what, const std::string& file) {
  if (file.empty() || !file.ends_with(".png")) return "| ";
  constexpr int kWidth = 320;
  const std::vector<std::uint8_t> png =
      encode_png(shrunk(read_png((input.folder / file).string()), kWidth), 9);
  return "| ![" + std::string(what) + "](data:image/png;base64," +
         base64({reinterpret_cast<const char*>(png.data()), png.size()}) + ") ";
}

/// Escapes Markdown characters.
std::string plain(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>#|!").find(c) != std::string_view::npos) all += '\\';
    all += c == '\n' ? ' ' : c;
  }
  return all;
}

/// A name as code, fenced by more backticks than it contains.
std::string code(const std::string& text) {
  std::string fence = "`";
  while (text.find(fence) != std::string::npos) fence += '`';
  const std::string pad = fence.size() > 1 ? " " : "";
  return fence + pad + text + pad + fence;
}

void report_markdown(const ReportInput& input) {
  std::ostringstream out;
  const std::vector<Cause> causes = snapshot::causes(input.outcome);
  out << "## contactscope check\n\n" << snapshot::summary(snapshot::tally(input.outcome)) << "\n";
  std::size_t bytes = 0;
  for (const Cause& cause : causes) {
    const Finding& first = *cause.findings.front();
    out << "\n### " << plain(first.key()) << "\n\n" << plain(first.sentence) << "\n\n";
    if (cause.scenarios.size() > 1) {
      out << "One cause in " << cause.scenarios.size() << " scenarios:";
      for (const std::string& scenario : cause.scenarios) out << " " << code(scenario);
      out << "\n\n";
    }
    for (const Finding* finding : cause.findings) {
      if (!finding->is_picture() || finding->candidate.empty()) continue;
      const std::string row = inline_picture(input, "expected", finding->expected) +
                              inline_picture(input, "actual", finding->candidate) +
                              inline_picture(input, "difference", finding->difference) + "|\n\n";
      if (bytes + row.size() > kMaxBytes) break;
      bytes += row.size();
      out << "| expected | actual | difference |\n|---|---|---|\n" << row;
      break;  // only the largest difference of each cause
    }
    out << (first.is_acceptable() ? "    " + remedy(input, cause) : plain(remedy(input, cause)))
        << "\n";
  }
  snapshot::write_text(input.options.markdown, out.str());
}

}  // namespace

const Report kMarkdownReport{
    [](const ReportInput& input) { return !input.options.markdown.empty(); }, &report_markdown};

}  // namespace contactscope::app
