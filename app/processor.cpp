#include "app/processor.h"

#include <unistd.h>

#include <system_error>

namespace billet::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* programs = "bin";
constexpr const char* faster_programs = "lib/billet/x86-64-v3";

/// Whether this program is not yet the one for it.
bool processor_has_more() {
#if defined(__x86_64__) && !defined(__AVX2__)
  __builtin_cpu_init(); // these stand for the level, whose name clang 14 does not know
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
         __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
#else
  return false;
#endif
}

} // namespace

void go_on_for_this_processor(char** argv) {
  if (!processor_has_more())
    return;
  std::error_code none;
  const fs::path own = fs::read_symlink("/proc/self/exe", none);
  const fs::path faster = own.parent_path().parent_path() / faster_programs / own.filename();
  if (!none && access(faster.c_str(), X_OK) == 0)
    execv(faster.c_str(), argv); // returns if it fails; then this one serves
}

fs::path started_program(const fs::path& file) {
  const fs::path folder = file.parent_path();
  const fs::path prefix = folder.parent_path().parent_path().parent_path();
  if (folder != prefix / faster_programs)
    return file;
  fs::path started = prefix / programs / file.filename();
  std::error_code none;
  return fs::exists(started, none) ? started : file;
}

} // namespace billet::app
