#include "app/cli/progress.h"

#include <unistd.h>

#include <csignal>
#include <iomanip>

namespace contactscope::app {
namespace {

volatile std::sig_atomic_t requested = 0;

void note(int signal) { requested = signal; }

}  // namespace

void note_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, note);
}

void stop_if_interrupted() {
  if (requested != 0) throw Interrupted(requested);
}

Progress::Progress(int total, bool quiet)
    : total_(total), shown_(!quiet && total > 1 && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::advance(const std::string& what) {
  ++done_;
  if (!shown_) return;
  constexpr int kWidth = 32;
  const int filled = kWidth * done_ / total_;
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K[%s] %d/%d %s", bar.c_str(), done_, total_, what.c_str());
}

void RunLog::add(const std::string& stage, std::chrono::nanoseconds time, int count) {
  auto found = std::ranges::find(entries_, stage, &Entry::stage);
  if (found == entries_.end()) found = entries_.insert(entries_.end(), Entry{stage, {}, 0});
  found->time += time;
  found->count += count;
}

void RunLog::left_out(const std::string& what) {
  if (std::ranges::find(left_out_, what) == left_out_.end()) left_out_.push_back(what);
}

void RunLog::note(const std::string& text) { notes_.push_back(text); }

void RunLog::print(std::ostream& out, const std::string& heading) const {
  out << heading << '\n';
  for (const std::string& text : notes_) out << "  " << text << '\n';
  for (const Entry& entry : entries_) {
    const double milliseconds = std::chrono::duration<double, std::milli>(entry.time).count();
    out << "  " << std::left << std::setw(24) << entry.stage << std::right << std::fixed
        << std::setprecision(2) << std::setw(10) << milliseconds << " ms";
    if (entry.count > 1) {
      out << std::setw(6) << entry.count << " times" << std::setprecision(3) << std::setw(10)
          << milliseconds / entry.count << " ms each";
    }
    out << '\n';
  }
  for (const std::string& what : left_out_) out << "  left out: " << what << '\n';
}

}  // namespace contactscope::app
