#include "mechanics/linear/blas.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

extern "C" {
char* openblas_get_corename(void);
int openblas_get_num_threads(void);
void openblas_set_num_threads(int);
}

namespace billet::mechanics {

namespace {

unsigned arithmetic_control() {
#if defined(__SSE2__)
  return _mm_getcsr();
#else
  return 0;
#endif
}

void set_arithmetic_control([[maybe_unused]] unsigned control) {
#if defined(__SSE2__)
  _mm_setcsr(control);
#endif
}

} // namespace

KernelSettings::KernelSettings()
    : threads_(openblas_get_num_threads()), control_(arithmetic_control()) {
  set_blas_threads(1);
  flush_subnormal_numbers();
}

KernelSettings::~KernelSettings() {
  set_arithmetic_control(control_);
  set_blas_threads(threads_);
}

std::string blas_core() { return openblas_get_corename(); }

void flush_subnormal_numbers() {
#if defined(__SSE2__)
  constexpr unsigned flush_results = 0x8000;
  constexpr unsigned flush_operands = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | flush_operands);
#endif
}

void set_blas_threads(int threads) { openblas_set_num_threads(threads); }

} // namespace billet::mechanics
