// The linear-algebra kernels beneath the factorizations, and a fault of them to be mended.
//
// OpenBLAS 0.3.21 does not know new processors and then silently uses kernels several times slower
// (docs/decisions). It chooses when it is loaded, so the only cure is to start the program anew
// with OPENBLAS_CORETYPE set.

#pragma once

#include <string>

namespace billet::mechanics {

/// Kernels in use, e.g. "SkylakeX".
[[nodiscard]] std::string blas_core();

/// Value OPENBLAS_CORETYPE should have for this processor; empty when the choice made is right or
/// the user has set the variable.
[[nodiscard]] std::string better_blas_core();

/// Sets the number of threads of the kernels. One makes results repeat to the bit.
void set_blas_threads(int threads);

/// Numbers too small to be normal count as zero from now on, in this thread and those it starts:
/// processors work on them many times slower, and they carry no digits that matter.
void flush_subnormal_numbers();

} // namespace billet::mechanics
