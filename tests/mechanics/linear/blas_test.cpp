// How OpenBLAS is started.

#include "mechanics/linear/blas.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace billet::mechanics::blas_test {
namespace {

TEST(Blas, IsToldItsThreadsBeforeItStartsAny) {
  // Set before `main` by the function that OpenBLAS calls, unless the user has.
  EXPECT_NE(std::getenv("OPENBLAS_NUM_THREADS"), nullptr);
  EXPECT_FALSE(blas_core().empty());
}

} // namespace
} // namespace billet::mechanics::blas_test
