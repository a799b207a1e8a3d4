// Signals are left to the thread that runs a computation, not to those that help it.
//
// METIS takes SIGTERM for its own while it orders unknowns, in whatever thread it arrives, and
// there it would end the program in one that has not called METIS.

#pragma once

#include <memory>

namespace billet::mechanics {

/// As long as this lives, threads that help in the calling one's task arena get none of SIGINT,
/// SIGTERM, SIGHUP and SIGUSR1.
class HelpersLeaveSignals {
public:
  HelpersLeaveSignals();
  ~HelpersLeaveSignals();
  HelpersLeaveSignals(const HelpersLeaveSignals&) = delete;
  HelpersLeaveSignals& operator=(const HelpersLeaveSignals&) = delete;

private:
  class Observer;
  std::unique_ptr<Observer> observer_;
};

} // namespace billet::mechanics
