// The linear-algebra kernels beneath the factorizations, and two faults of them to be mended.
//
// OpenBLAS 0.3.21 does not know new processors and then silently uses kernels up to several times
// slower (docs/decisions); and it starts threads, which spin for a tenth of a second, before
// anybody can tell it that none are wanted. Both are settled when it is loaded, so the only cure is
// to start the program anew with its variables set.

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace billet::mechanics {

/// Kernels in use, e.g. "SkylakeX".
[[nodiscard]] std::string blas_core();

/// Variables of the environment OpenBLAS should have found, with their values; none when it found
/// them, or when the choice it made is right. What the user has set is left alone.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> better_blas_environment();

/// Sets the number of threads of the kernels. One makes results repeat to the bit.
void set_blas_threads(int threads);

/// Numbers too small to be normal count as zero from now on, in this thread and those it starts:
/// processors work on them many times slower, and they carry no digits that matter.
void flush_subnormal_numbers();

} // namespace billet::mechanics
