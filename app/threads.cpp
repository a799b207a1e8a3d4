#include "app/threads.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_scheduler_observer.h>
#include <signal.h>

#include <cstddef>
#include <initializer_list>

namespace billet::app {

namespace {

/// Threads that help the first one leave signals to it: METIS, which takes SIGTERM for its own
/// while it orders unknowns, would end the program in one that has not called it.
class HelpersLeaveSignals final : public oneapi::tbb::task_scheduler_observer {
public:
  HelpersLeaveSignals() { observe(true); }

  void on_scheduler_entry(bool is_helper) override {
    if (!is_helper)
      return;
    sigset_t all;
    sigemptyset(&all);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
      sigaddset(&all, number);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
  }
};

} // namespace

void limit_threads(int threads) {
  using oneapi::tbb::global_control;
  // Never given up: to do so would start a thread.
  static const auto* const limit = new global_control(global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
  static_cast<void>(limit);
  if (threads == 1)
    return;                                                    // without help
  static const auto* const observer = new HelpersLeaveSignals; // not given up either
  static_cast<void>(observer);
}

} // namespace billet::app
