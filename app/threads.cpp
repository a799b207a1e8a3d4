#include "app/threads.h"

#include <oneapi/tbb/global_control.h>

#include <cstddef>

namespace billet::app {

void limit_threads(int threads) {
  using oneapi::tbb::global_control;
  // Never given up: to do so would start a thread.
  static const auto* const limit = new global_control(global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads));
  static_cast<void>(limit);
}

} // namespace billet::app
