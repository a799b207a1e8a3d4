// Clocks of the benchmark.

#pragma once

#include <chrono>
#include <ctime>
#include <functional>

namespace billet::bench {

/// [s]
inline double wall_time() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

/// Of this thread, whatever else the machine does. [s]
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// How long `work` takes by a clock. [s]
inline double seconds(double (*clock)(), const std::function<void()>& work) {
  const double start = clock();
  work();
  return clock() - start;
}

} // namespace billet::bench
