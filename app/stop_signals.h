// Signals that end a run: SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is closed).
//
// The first asks for the end: the run stops after a whole increment and writes its results. A later
// SIGINT or SIGTERM ends the program at once. In several processes SIGUSR1 asks for the end as
// well: mpiexec hands it on, and gives them a second only when it is ended itself.

#pragma once

namespace billet::app {

/// From now on signals are noticed; before, they end the program as any. A SIGHUP that is ignored
/// (nohup) stays so.
void notice_stop_signals();

/// The signal that asked for the end; 0: none.
[[nodiscard]] int stop_signal();

} // namespace billet::app
