#include "mechanics/blas.h"

#include <cstdlib>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

extern "C" {
char* openblas_get_corename(void);
void openblas_set_num_threads(int);
}

namespace billet::mechanics {

std::string blas_core() { return openblas_get_corename(); }

namespace {

/// Kernels this processor can run better than those in use; empty: none.
std::string better_core() {
  [[maybe_unused]] const std::string core = blas_core();
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") != 0;
  const bool avx512 =
      __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  const bool without_avx512 = core == "Prescott" || core == "Haswell" || core == "Zen";
  if (avx512 && without_avx512)
    return "SkylakeX";
  if (avx2 && core == "Prescott")
    return "Haswell";
#endif
  return {};
}

} // namespace

std::vector<std::pair<std::string, std::string>> better_blas_environment() {
  std::vector<std::pair<std::string, std::string>> wanted;
  const std::string core = better_core();
  if (std::getenv("OPENBLAS_CORETYPE") == nullptr && !core.empty())
    wanted.emplace_back("OPENBLAS_CORETYPE", core);
  if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
    wanted.emplace_back("OPENBLAS_NUM_THREADS", "1");
  return wanted;
}

void flush_subnormal_numbers() {
#if defined(__SSE2__)
  constexpr unsigned flush_results = 0x8000;
  constexpr unsigned flush_operands = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | flush_operands);
#endif
}

void set_blas_threads(int threads) { openblas_set_num_threads(threads); }

} // namespace billet::mechanics
