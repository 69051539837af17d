#include "app/progress.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace contactscope::app {
namespace {

volatile std::sig_atomic_t requested = 0;

void note(int) {
  requested = 1;
}

}  // namespace

void note_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, note);
}

void stop_if_interrupted() {
  if (requested != 0) throw std::runtime_error("interrupted; what was written is whole");
}

Progress::Progress(int total, bool quiet)
    : total_(total), shown_(!quiet && total > 1 && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  clear();
}

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

}  // namespace contactscope::app
