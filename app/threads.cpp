#include "app/threads.h"

#include "mechanics/linear/helper_signals.h"

#include <oneapi/tbb/global_control.h>

#include <cstddef>

namespace billet::app {

void limit_threads(int threads) {
  using oneapi::tbb::global_control;
  // Never given up: to do so would start a thread.
  static const auto* const limit = new global_control(global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
  static_cast<void>(limit);
  if (threads == 1)
    return;                                                            // without help
  static const auto* const alone = new mechanics::HelpersLeaveSignals; // not given up either
  static_cast<void>(alone);
}

} // namespace billet::app
