// The linear-algebra kernels beneath the factorizations. How they start: app/openblas_start.cpp.

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

/// For as long as it lives: kernels in one thread, and numbers too small to be normal count as
/// zero. Then both are as before: a program that links the library, and may use the same kernels,
/// keeps its own ways.
class KernelSettings {
public:
  KernelSettings();
  ~KernelSettings();
  KernelSettings(const KernelSettings&) = delete;
  KernelSettings& operator=(const KernelSettings&) = delete;

private:
  int threads_;
  unsigned control_; ///< of the processor's arithmetic
};

} // namespace billet::mechanics
