#include "interrupt.hpp"

#include <csignal>

namespace peritherm::app {
namespace {

// A signal handler can reach nothing but a global.
volatile std::sig_atomic_t received = 0;

extern "C" void note_interrupt(int signal) {
  if (received != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  received = signal;
}

}  // namespace

void watch_interrupts() {
  received = 0;
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
}

int interrupt() { return received; }

}  // namespace peritherm::app
