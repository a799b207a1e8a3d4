// Calls of the program to the system that fail, or are written down: loaded in front of the C
// library (LD_PRELOAD), chosen by two variables.
//
// BILLET_FAIL=write:7    the seventh write fails; write:7+ and all that follow. The same for
//                        rename, close, fsync, flock (as on a file system without locks) and malloc
// BILLET_CALLS=FILE      each of these, but malloc, is a line "write PATH"; FILE grows
//
// Writes and closes count where they are of regular files other than the standard streams.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t n, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

struct Plan {
  std::array<char, 16> function{}; ///< empty: none
  long first = 0;
  bool all = false;
  int calls = -1; ///< file they are written to
};
Plan plan;
std::atomic<long> n_calls = 0;

/// Before `main`; what is called earlier still does not fail.
__attribute__((constructor)) void read_plan() {
  Plan made;
  if (const char* file = std::getenv("BILLET_CALLS"))
    made.calls = ::open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const char* text = std::getenv("BILLET_FAIL");
  const char* colon = text != nullptr ? std::strchr(text, ':') : nullptr;
  if (colon != nullptr && static_cast<std::size_t>(colon - text) < made.function.size()) {
    std::memcpy(made.function.data(), text, static_cast<std::size_t>(colon - text));
    made.first = std::strtol(colon + 1, nullptr, 10);
    made.all = std::strchr(colon, '+') != nullptr;
  }
  plan = made;
}

/// Counts a call of that function.
bool fails(const char* function, int reason) {
  if (std::strcmp(plan.function.data(), function) != 0)
    return false;
  const long number = ++n_calls;
  if (number != plan.first && !(plan.all && number > plan.first))
    return false;
  errno = reason;
  return true;
}

template <class Function> Function* own(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void note(const char* function, const char* path) {
  if (plan.calls < 0)
    return;
  std::array<char, 4096> line{};
  const int length = std::snprintf(line.data(), line.size(), "%s %s\n", function, path);
  static auto* const write_line = own<decltype(::write)>("write");
  [[maybe_unused]] const auto written =
      write_line(plan.calls, line.data(), static_cast<std::size_t>(length));
}

void note(const char* function, int file) {
  if (plan.calls < 0)
    return;
  std::array<char, 64> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
  std::array<char, 2048> path{};
  if (::readlink(link.data(), path.data(), path.size() - 1) > 0)
    note(function, path.data());
}

bool is_of_results(int file) {
  struct ::stat status {};
  return file > STDERR_FILENO && file != plan.calls && ::fstat(file, &status) == 0 &&
         S_ISREG(status.st_mode);
}

} // namespace

extern "C" {

void* malloc(std::size_t size) { return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_calloc(n, size);
}
void* realloc(void* block, std::size_t size) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return fails("malloc", ENOMEM) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  void* const made = memalign(alignment, size);
  if (made == nullptr)
    return ENOMEM;
  *block = made;
  return 0;
}

ssize_t write(int file, const void* bytes, std::size_t n) {
  static auto* const call = own<decltype(write)>("write");
  if (!is_of_results(file))
    return call(file, bytes, n);
  note("write", file);
  return fails("write", EIO) ? -1 : call(file, bytes, n);
}

int close(int file) {
  static auto* const call = own<decltype(close)>("close");
  if (!is_of_results(file))
    return call(file);
  note("close", file);
  const bool failed = fails("close", EIO);
  const int result = call(file);
  return failed ? (errno = EIO, -1) : result;
}

/// The disk itself is not asked: a test has nothing to keep, and would wait for it long.
int fsync(int file) {
  note("fsync", file);
  return fails("fsync", EIO) ? -1 : 0;
}

int flock(int file, int operation) noexcept {
  static auto* const call = own<decltype(flock)>("flock");
  note("flock", file);
  return fails("flock", ENOLCK) ? -1 : call(file, operation);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const call = own<decltype(rename)>("rename");
  note("rename", to);
  return fails("rename", EIO) ? -1 : call(from, to);
}

} // extern "C"
