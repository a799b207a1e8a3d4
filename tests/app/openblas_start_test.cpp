#include "mechanics/linear/blas.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace billet::app::openblas_start_test {
namespace {

TEST(OpenBlasStart, tells_its_threads_before_any_start) {
  // Set before `main` by the function that OpenBLAS calls, unless the user has.
  EXPECT_NE(std::getenv("OPENBLAS_NUM_THREADS"), nullptr);
  EXPECT_FALSE(mechanics::blas_core().empty());
}

} // namespace
} // namespace billet::app::openblas_start_test
