#include "app/stop_signals.h"

#include "mechanics/linear/distributed/processes.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <initializer_list>

namespace billet::app {

namespace {

volatile std::sig_atomic_t caught = 0;
timespec caught_at{}; ///< touched by the handler alone

double seconds_between(const timespec& from, const timespec& to) {
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(to.tv_sec - from.tv_sec) +
         nanosecond * static_cast<double>(to.tv_nsec - from.tv_nsec);
}

/// Calls nothing but what a handler may call.
void on_signal(int number) {
  // What is sent to a process and to its group, as timeout(1) does, comes twice at the same time,
  // and from a terminal that is closed there are two SIGHUP.
  constexpr double same_time = 0.2; // [s]
  const int error = errno;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (caught == 0) {
    caught = number;
    caught_at = now;
  } else if (number != SIGHUP && seconds_between(caught_at, now) > same_time) {
    ::_exit(128 + number); // without a word, which might have to wait for its reader
  }
  errno = error;
}

} // namespace

void notice_stop_signals() {
  struct sigaction action {};
  action.sa_handler = &on_signal;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    sigaddset(&action.sa_mask, number);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (number != SIGHUP || before.sa_handler != SIG_IGN)
      sigaction(number, &action, nullptr);
  if (mechanics::number_of_processes() > 1)
    sigaction(SIGUSR1, &action, nullptr);
}

int stop_signal() { return caught; }

} // namespace billet::app
