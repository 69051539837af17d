#include <sys/ioctl.h>

#include <iostream>

#include "app/check/check_run.h"
#include "image/png.h"
#include "snapshot/report_folder.h"

namespace contactscope::app {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

int columns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const int record = std::atoi(variable("COLUMNS").c_str());
  return record > 0 ? record : 80;
}

std::string drawn(const std::string& path, TerminalPictures how) {
  const Image image = read_png(path);
  if (how == TerminalPictures::HalfBlocks) return to_half_blocks(image, columns());
  constexpr int kPixels = 900;  // width that fits into a terminal
  const std::vector<std::uint8_t> png = encode_png(shrunk(image, kPixels));
  return to_kitty({reinterpret_cast<const char*>(png.data()), png.size()});
}

ExitCode run_show(const Options& options) {
  snapshot::Outcome outcome = snapshot::read_outcome(report_folder(options));
  TerminalPictures how = terminal_pictures();
  if (options.pictures == "none") how = TerminalPictures::None;
  if (options.pictures == "blocks") how = TerminalPictures::HalfBlocks;
  if (options.pictures == "kitty") how = TerminalPictures::Kitty;
  for (const snapshot::Finding* finding : findings_named(outcome, options.scenarios))
    show(*finding, report_folder(options).string(), how, std::cout);
  return ExitCode::Same;
}

}  // namespace

TerminalPictures terminal_pictures() {
  if (isatty(STDOUT_FILENO) != 1) return TerminalPictures::None;
  const std::string term = variable("TERM"), program = variable("TERM_PROGRAM");
  if (!variable("KITTY_WINDOW_ID").empty() || term == "xterm-kitty" || program == "WezTerm" ||
      program == "ghostty")
    return TerminalPictures::Kitty;
  return term == "dumb" ? TerminalPictures::None : TerminalPictures::HalfBlocks;
}

void show(const snapshot::Finding& finding, const std::string& folder, TerminalPictures how,
          std::ostream& out) {
  out << finding.key() << ", " << snapshot::name_of(finding.kind) << '\n';
  out << finding.sentence << '\n';
  for (const std::string& detail : finding.details)
    if (detail != finding.sentence) out << "  " << detail << '\n';
  const auto one = [&](const char* what, const std::string& file) {
    if (file.empty()) return;
    const std::string path = (std::filesystem::path(folder) / file).generic_string();
    out << what << path << '\n';
    if (how != TerminalPictures::None && path.ends_with(".png")) out << drawn(path, how);
  };
  one("expected    ", finding.expected);
  one("actual      ", finding.candidate);
  one("difference  ", finding.difference);
}

Verb show_verb() {
  return {"show", "Show findings of the last check in the terminal, with pictures", &run_show};
}

}  // namespace contactscope::app
