#include "app/no_memory.h"

#include "geometry/base/error.h"

#include <dlfcn.h>
#include <gmp.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

namespace billet::app {

namespace {

/// Without the buffers of the standard library.
void say(std::string_view text) noexcept {
  // Nothing is left to be done if this fails; the status says enough.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

[[noreturn]] void end_without_memory() noexcept { ::_exit(report_no_memory()); }

[[noreturn]] void end_with_internal_error(const char* what) noexcept {
  constexpr int internal_error = 70;
  say("billet: internal error: ");
  say(what);
  say(" [exit-70]\n");
  ::_exit(internal_error);
}

/// An exception that nothing can catch. None at hand means that there was no memory for one.
[[noreturn]] void end_after_exception() noexcept {
  if (std::current_exception() != nullptr) {
    try {
      throw;
    } catch (const std::bad_alloc&) { // ends below
    } catch (const std::exception& error) {
      end_with_internal_error(error.what());
    } catch (...) {
      end_with_internal_error("an exception of no known type");
    }
  }
  end_without_memory();
}

using Initializer = void(int, char**, char**);

/// A block, if there was memory for it.
void* found(void* block) noexcept {
  if (block == nullptr)
    end_without_memory();
  return block;
}

/// What GMP, of CGAL's exact numbers, asks for; it aborts on its own where there is none.
void* allocated(std::size_t size) { return found(std::malloc(size)); }
void* reallocated(void* block, std::size_t, std::size_t size) {
  return found(std::realloc(block, size));
}

/// VTK uses what it could not allocate, and its destructors what was not made. Where there is
/// memory a fault ends the program as it would have without this.
void end_after_fault(int signal) noexcept {
  constexpr std::size_t little = 4096;
  std::free(found(std::malloc(little)));
  ::signal(signal, SIG_DFL); // and once more
}

void watch_faults() noexcept {
#ifndef __SANITIZE_ADDRESS__ // which tells more of them
  struct sigaction action {};
  action.sa_handler = &end_after_fault;
  ::sigaction(SIGSEGV, &action, nullptr);
#endif
}

void prepare(int, char**, char**) {
  watch_faults();
  std::set_terminate(&end_after_exception);
  mp_set_memory_functions(&allocated, &reallocated, nullptr);
}

/// Libraries may find no memory while they are initialized, before any other function of ours.
[[gnu::section(".preinit_array"), gnu::used]] Initializer* const before_libraries = &prepare;

/// The function of that name whose place one of ours has taken.
template <class Function> Function* replaced(const char* name) noexcept {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_of_openblas(const void* caller) noexcept {
  Dl_info info{};
  return ::dladdr(caller, &info) != 0 && info.dli_fname != nullptr &&
         std::strstr(info.dli_fname, "openblas") != nullptr;
}

} // namespace

int report_no_memory() noexcept {
  say("billet: not enough memory for this case [limit]\n");
  return static_cast<int>(Fault::limit);
}

} // namespace billet::app

/// In place of the C library's: OpenBLAS 0.3.21 repeats the call until there is memory.
extern "C" void* mmap(void* address,
                      std::size_t length,
                      int protection,
                      int flags,
                      int file,
                      off_t offset) noexcept {
  static auto* const own = billet::app::replaced<decltype(mmap)>("mmap");
  void* const mapped = own(address, length, protection, flags, file, offset);
  if (mapped == MAP_FAILED && billet::app::is_of_openblas(__builtin_return_address(0)))
    billet::app::end_without_memory();
  return mapped;
}

/// In place of the C library's: without its threads TBB aborts, and OpenBLAS waits for them.
extern "C" int pthread_create(pthread_t* thread,
                              const pthread_attr_t* attributes,
                              void* (*function)(void*),
                              void* argument) noexcept {
  static auto* const own = billet::app::replaced<decltype(pthread_create)>("pthread_create");
  const int error = own(thread, attributes, function, argument);
  if (error != 0)
    billet::app::end_without_memory();
  return error;
}
