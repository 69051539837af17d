#include "app/check/check_run.h"

#include <poll.h>
#include <termios.h>

#include <cerrno>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/check/reports/report.h"
#include "app/cli/progress.h"
#include "snapshot/report_folder.h"

namespace contactscope::app {
namespace {

using snapshot::Finding;
using snapshot::Review;

/// All findings of a run, in order.
std::vector<Finding*> findings_of(snapshot::Outcome& outcome) {
  std::vector<Finding*> all;
  for (snapshot::ScenarioOutcome& scenario : outcome.scenarios)
    for (Finding& finding : scenario.findings) all.push_back(&finding);
  return all;
}

void refuse_in_ci() {
  if (snapshot::is_ci(std::getenv("CI")))
    throw UsageError("CI=true: nothing is accepted; unset CI to accept findings");
}

/// Reads single keys from the terminal without echo.
class Keys {
 public:
  Keys() {
    if (isatty(STDIN_FILENO) != 1 || tcgetattr(STDIN_FILENO, &before_) != 0)
      throw UsageError(
          "review needs a terminal, and there is none; review --list prints the findings, and "
          "check --accept KEY accepts one");
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~Keys() { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }
  Keys& operator=(Keys&&) = delete;

  /// Also 'q' if the terminal is closed.
  char next() const {
    // A blocking read() resumes after Ctrl-C, and an endless poll() would miss one just before it.
    constexpr int kMilliseconds = 50;
    pollfd terminal{STDIN_FILENO, POLLIN, 0};
    int ready = 0;
    while (ready == 0 || (ready < 0 && errno == EINTR)) {
      stop_if_interrupted();
      ready = poll(&terminal, 1, kMilliseconds);
    }
    char key = 'q';
    return ready == 1 && ::read(STDIN_FILENO, &key, 1) == 1 ? key : 'q';
  }

 private:
  termios before_{};
};

/// Steps through failing findings by cause.
class ReviewSession {
 public:
  ReviewSession(const Options& options, snapshot::Outcome& outcome)
      : options_(options), outcome_(outcome) {
    for (const snapshot::Cause& cause : snapshot::causes(outcome)) {
      ++causes_;
      for (const Finding* finding : cause.findings) {
        if (finding->review == Review::Open)
          open_.push_back({const_cast<Finding*>(finding), causes_});
      }
    }
  }

  void run() {
    if (open_.empty()) {
      std::cout << "there is nothing to review\n";
      return;
    }
    note_interrupts();  // so that the terminal is restored
    const Keys keys;
    std::cout << "a accept, c accept all of its cause, r reject, s skip, w show, q quit\n";
    for (std::size_t i = 0; i < open_.size(); ++i) {
      Finding& finding = *open_[i].finding;
      if (finding.review != Review::Open) continue;  // reviewed with its cause
      std::cout << "\n[" << i + 1 << "/" << open_.size() << "] " << finding.key() << "  "
                << snapshot::name_of(finding.kind) << '\n'
                << finding.sentence << '\n';
      if (!decide(open_[i], keys)) break;
    }
  }

 private:
  struct Waiting {
    Finding* finding;
    int cause;
  };

  /// False to quit.
  bool decide(const Waiting& requested, const Keys& keys) {
    Finding& finding = *requested.finding;
    while (true) {
      std::cout << "a c r s w q? " << std::flush;
      const char key = keys.next();
      std::cout << key << '\n';
      if (key == 'q') return false;
      if (key == 's') return true;
      if (key == 'w')
        show(finding, report_folder(options_).string(), terminal_pictures(), std::cout);
      if (key == 'a' && accept(finding)) return true;
      if (key == 'c') {
        for (const Waiting& other : open_)
          if (other.cause == requested.cause && other.finding->review == Review::Open)
            accept(*other.finding);
        return true;
      }
      if (key == 'r') {
        finding.review = Review::Rejected;
        keep();
        std::cout << "rejected: it fails until a check finds no difference\n";
        return true;
      }
    }
  }

  bool accept(Finding& finding) {
    const std::string why = snapshot::accept(report_folder(options_), outcome_.snapshots, finding);
    if (!why.empty()) {
      std::cout << why << '\n';
      return false;
    }
    keep();
    std::cout << "accepted " << finding.file << '\n';
    return true;
  }

  /// Saves after each key, so that a lost terminal loses nothing.
  void keep() const { snapshot::write_outcome(report_folder(options_), outcome_); }

  const Options& options_;
  snapshot::Outcome& outcome_;
  std::vector<Waiting> open_;
  int causes_ = 0;
};

/// One line per finding: state, key, sentence.
void print_list(snapshot::Outcome& outcome) {
  for (const Finding* finding : findings_of(outcome)) {
    const std::string state =
        finding->review == Review::Open && finding->fails()
            ? std::string(snapshot::name_of(finding->kind))
            : std::string(snapshot::kReviews[static_cast<std::size_t>(finding->review)]);
    std::cout << std::left << std::setw(18) << state << finding->key() << "  " << finding->sentence
              << '\n';
  }
}

/// Accepts a finding and prints the result; false if refused.
bool accept_one(const Options& options, const snapshot::Outcome& outcome, Finding& finding) {
  const std::string why = snapshot::accept(report_folder(options), outcome.snapshots, finding,
                                           {options.accept_as, options.note});
  if (!why.empty()) {
    std::cerr << why << '\n';
    return false;
  }
  if (options.quiet) return true;
  const bool is_bad = finding.review == Review::Rejected;
  std::cout << (is_bad ? "kept" : snapshot::kDone[static_cast<std::size_t>(finding.done)]) << " "
            << finding.key() << (options.accept_as.empty() ? "" : " as " + options.accept_as)
            << (is_bad ? ", so that check recognizes it; it still fails" : "") << '\n';
  return true;
}

/// Accepts the findings of these names that fail, and saves and prints the result. Returns the number that is refused.
int accept_all(const Options& options, snapshot::Outcome& outcome,
               const std::vector<std::string>& names, const std::string& others = "") {
  int refused = 0, accepted = 0;
  for (Finding* finding : findings_named(outcome, names))
    if (finding->fails()) ++(accept_one(options, outcome, *finding) ? accepted : refused);
  snapshot::write_outcome(report_folder(options), outcome);
  rewrite_page(report_folder(options), outcome, options);
  if (!options.quiet)
    std::cerr << counted(accepted, "finding") << " accepted, " << others << refused << " refused; "
              << snapshot::summary(snapshot::tally(outcome)) << '\n';
  return refused;
}

/// {"accept": [...], "reject": [...]}, as saved by report.html; "-" is standard input.
std::map<std::string, std::vector<std::string>> read_decisions(const std::string& file) {
  const auto refuse = [&](const std::string& what) -> InputError {
    return InputError(file == "-" ? "standard input" : file, 0, 0,
                      what + R"(; write {"accept": ["hull/face_contact"], "reject": []}, as )"
                             "report.html saves it");
  };
  std::string text;
  if (file == "-") {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    const std::optional<std::string> bytes = snapshot::read_text_file(file);
    if (!bytes) throw refuse("no such file");
    text = *bytes;
  }
  std::map<std::string, std::vector<std::string>> decisions;
  try {
    decisions = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw refuse(std::string("this file has no valid decisions: ") + error.what());
  }
  for (const auto& [word, keys] : decisions)
    if (word != "accept" && word != "reject") throw refuse("'" + word + "' is no decision");
  return decisions;
}

/// Applies the choices made on the page.
ExitCode run_decisions(const Options& options, snapshot::Outcome& outcome) {
  std::map<std::string, std::vector<std::string>> decisions = read_decisions(options.from);
  // Validate all names before anything is stored.
  const std::vector<Finding*> rejected = findings_named(outcome, decisions["reject"]);
  for (Finding* finding : findings_named(outcome, decisions["accept"])) {
    if (std::ranges::find(rejected, finding) != rejected.end())
      throw UsageError(finding->key() + " is both accepted and rejected");
  }
  int turned_down = 0;
  for (Finding* finding : rejected) {
    if (!finding->fails()) continue;
    finding->review = Review::Rejected;
    ++turned_down;
  }
  accept_all(options, outcome, decisions["accept"], std::to_string(turned_down) + " rejected, ");
  return exit_code(outcome);
}

ExitCode run_review(const Options& options) {
  snapshot::Outcome outcome = snapshot::read_outcome(report_folder(options));
  if (options.json) {
    std::cout << snapshot::to_json(outcome);
    return exit_code(outcome);
  }
  if (options.list_only) {
    print_list(outcome);
    return exit_code(outcome);
  }
  refuse_in_ci();
  if (!options.from.empty()) return run_decisions(options, outcome);
  ReviewSession(options, outcome).run();
  rewrite_page(report_folder(options), outcome, options);
  std::cout << snapshot::summary(snapshot::tally(outcome)) << '\n';
  return exit_code(outcome);
}

}  // namespace

std::filesystem::path report_folder(const Options& options) {
  return std::filesystem::path(options.out) / (options.shard ? folder_of(*options.shard) : "check");
}

std::vector<Finding*> findings_named(snapshot::Outcome& outcome,
                                     const std::vector<std::string>& patterns) {
  const std::vector<Finding*> all = findings_of(outcome);
  std::vector<Finding*> chosen;
  for (const std::string& pattern : patterns) {
    bool is_known = false;
    for (Finding* finding : all) {
      if (!snapshot::names(pattern, *finding)) continue;
      is_known = true;
      if (std::ranges::find(chosen, finding) == chosen.end()) chosen.push_back(finding);
    }
    if (is_known) continue;
    const std::vector<std::string> keys = mapped(all, &Finding::key);
    const std::string near =
        nearest(pattern, std::vector<std::string_view>(keys.begin(), keys.end()));
    throw UsageError("'" + pattern + "' is not in the last report; " +
                     (near.empty() ? "" : "did you mean " + near + "? ") +
                     "contactscope review --list prints the findings");
  }
  return chosen;
}

ExitCode run_accept(const Options& options) {
  refuse_in_ci();
  if (options.scenarios.empty())
    throw UsageError(
        "--accept needs names: contactscope check --accept hull/face_contact/frame_0012, "
        "a folder such as hull, or '*' for all; contactscope review --list prints the findings");
  snapshot::Outcome outcome = snapshot::read_outcome(report_folder(options));
  const bool is_done = accept_all(options, outcome, options.scenarios) == 0;
  return is_done ? ExitCode::Same : ExitCode::Different;
}

Verb review_verb() {
  return {"review",
          "Review the findings of the last check; one key each: accept, reject, skip, show",
          &run_review};
}

}  // namespace contactscope::app
