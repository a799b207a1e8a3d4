#include "mechanics/linear/helper_signals.h"

#include <oneapi/tbb/task_scheduler_observer.h>
#include <signal.h>

#include <initializer_list>

namespace billet::mechanics {

namespace {

thread_local sigset_t signals_before; ///< of a helper

} // namespace

class HelpersLeaveSignals::Observer final : public oneapi::tbb::task_scheduler_observer {
public:
  Observer() { observe(true); }
  ~Observer() override { observe(false); }
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  void on_scheduler_entry(bool is_helper) override {
    if (!is_helper)
      return;
    sigset_t left;
    sigemptyset(&left);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
      sigaddset(&left, number);
    pthread_sigmask(SIG_BLOCK, &left, &signals_before);
  }
  void on_scheduler_exit(bool is_helper) override {
    if (is_helper)
      pthread_sigmask(SIG_SETMASK, &signals_before, nullptr);
  }
};

HelpersLeaveSignals::HelpersLeaveSignals() : observer_(std::make_unique<Observer>()) {}
HelpersLeaveSignals::~HelpersLeaveSignals() = default;

} // namespace billet::mechanics
