// The linear-algebra kernels beneath the factorizations, and two faults of them to be repaired.
//
// OpenBLAS 0.3.21 does not know new processors and then silently uses kernels up to several times
// slower (docs/decisions); and it starts threads, which spin for a tenth of a second, before
// anybody can tell it that none are wanted. Both are settled when it is loaded, before `main`. It
// asks the environment for both in a function that this program replaces by one that sets them
// first: linking against this library is enough.

#pragma once

#include <string>

namespace billet::mechanics {

/// Kernels in use, e.g. "SkylakeX".
[[nodiscard]] std::string blas_core();

/// Sets the number of threads of the kernels. One makes results repeat to the bit.
void set_blas_threads(int threads);

/// Numbers too small to be normal count as zero from now on, in this thread and those it starts:
/// processors work on them many times slower, and they carry no digits that matter.
void flush_subnormal_numbers();

} // namespace billet::mechanics
