// How OpenBLAS starts in the program: with kernels that suit the processor, and no threads.
//
// OpenBLAS 0.3.21 does not know new processors and then silently uses kernels up to several times
// slower (docs/decisions/0012-cost-of-small-runs.md); and it starts threads, which spin for a tenth
// of a second, before anybody can tell it that none are wanted. Both are settled when it is loaded,
// before `main`. It asks the environment for both in a function that this program, and nothing that
// others link, replaces by one that sets them first.

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

extern "C" {
#if defined(__x86_64__)
char* openblas_get_corename(void);
void gotoblas_dynamic_init(void);
void gotoblas_dynamic_quit(void);
#endif
}

namespace {

/// Kernels this processor can run better than those that OpenBLAS would choose; null: none.
const char* better_core() {
#if defined(__x86_64__)
  gotoblas_dynamic_init();
  const std::string_view core = openblas_get_corename();
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") != 0;
  const bool avx512 =
      __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  const bool without_avx512 = core == "Prescott" || core == "Haswell" || core == "Zen";
  const bool unknown = core == "Prescott";
  gotoblas_dynamic_quit();
  if (avx512 && without_avx512)
    return "SkylakeX";
  if (avx2 && unknown)
    return "Haswell";
#endif
  return nullptr;
}

} // namespace

/// OpenBLAS calls this when it is loaded, before it chooses kernels and starts threads; ours takes
/// the place of its own, so that it finds the variables that make it choose well.
extern "C" void openblas_read_env(void) { // NOLINT(readability-identifier-naming)
  constexpr int keep = 0;                 // what the user has set
  setenv("OPENBLAS_NUM_THREADS", "1", keep);
  if (std::getenv("OPENBLAS_CORETYPE") == nullptr)
    if (const char* core = better_core())
      setenv("OPENBLAS_CORETYPE", core, keep);
  using Read = void (*)();
  if (const auto own = reinterpret_cast<Read>(dlsym(RTLD_NEXT, "openblas_read_env")))
    own();
}
