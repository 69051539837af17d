#include "app/interrupt.h"

#include <csignal>

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
  if (requested != 0) throw Interrupted();
}

}  // namespace contactscope::app
