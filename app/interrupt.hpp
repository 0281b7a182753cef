#pragma once

namespace peritherm::app {

inline constexpr int exit_signal_base = 128;  ///< added to a signal in exit codes, as shells do: 130 for SIGINT

/// From now on the first SIGINT or SIGTERM only asks for the end; the second one ends the program at once.
void watch_interrupts();

/// The signal that asked for the end; 0: none yet.
int interrupt();

}  // namespace peritherm::app
