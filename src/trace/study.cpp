#include "trace/study.h"

#include "core/spell.h"

namespace contactscope::trace {
namespace {

double finite(double value, const char* key) {
  if (!std::isfinite(value))
    throw std::domain_error(std::string("study: '") + key +
                            "' is not a finite number, which a file cannot hold");
  return value;
}

std::string spelled(const std::optional<double>& value, const char* key) {
  return value ? shortest(finite(*value, key)) : std::string();
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char letter : text) {
    result += letter;
    if (letter == '"') result += '"';
  }
  return result + '"';
}

std::string row(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += quoted(cell) + ',';
  line.back() = '\n';
  return line;
}

}  // namespace

bool has_panels(const Study& study) {
  return study.form != StudyForm::WorkPrecision ||
         std::ranges::any_of(study.series,
                             [](const StudySeries& series) { return !series.panel.empty(); });
}

std::string to_csv(const Study& study) {
  const bool panels = has_panels(study);
  std::string text =
      "study,measure,method,parameter,error,error_worst,nanoseconds_median,nanoseconds_min,"
      "nanoseconds_max,failed,of,error_name,unit,parameter_name,reference,cpu,compiler,build_type,"
      "date,scalar";
  text += panels ? ",panel,row_name,row\n" : "\n";
  const StudyContext& context = study.context;
  for (const StudySeries& one : study.series) {
    for (const StudyPoint& p : one.points) {
      std::vector<std::string> cells = {study.study,
                                        study.measure,
                                        one.method,
                                        spelled(p.parameter, "parameter"),
                                        spelled(p.error, "error"),
                                        spelled(p.error_worst, "error_worst"),
                                        spelled(p.nanoseconds.median, "median"),
                                        spelled(p.nanoseconds.min, "min"),
                                        spelled(p.nanoseconds.max, "max"),
                                        std::to_string(p.failed),
                                        std::to_string(p.of),
                                        study.error,
                                        study.unit,
                                        one.parameter.empty() ? study.parameter : one.parameter,
                                        study.reference,
                                        context.cpu,
                                        context.compiler,
                                        context.build_type,
                                        context.date,
                                        context.scalar};
      if (panels) cells.insert(cells.end(), {one.panel, study.row, spelled(one.row, "row")});
      text += row(cells);
    }
  }
  return text;
}

}  // namespace contactscope::trace
