#include "geometry/base/pieces.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

namespace billet {

void share(std::size_t count, void (*call)(const void* work, std::size_t k), const void* work) {
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, count),
      [&](const oneapi::tbb::blocked_range<std::size_t>& some) {
        for (std::size_t k = some.begin(); k < some.end(); ++k)
          call(work, k);
      },
      oneapi::tbb::simple_partitioner());
}

} // namespace billet
