#include "mechanics/linear/blas.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

extern "C" {
char* openblas_get_corename(void);
void openblas_set_num_threads(int);
}

namespace billet::mechanics {

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
