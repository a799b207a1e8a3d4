#include "geometry/base/late_library.h"

#include "geometry/base/error.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace billet {

namespace {

/// Opens a library that stands beside the program, or where the program's own libraries are looked
/// for: sanitizers stand between and do not know of those places.
void* opened(const char* library) {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  void* const beside = ::dlopen((program.parent_path() / library).c_str(), RTLD_LAZY | RTLD_LOCAL);
  return beside != nullptr ? beside : ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
}

} // namespace

void* late_symbol(const char* library, const char* name) {
  void* const handle = opened(library); // stays until the program ends
  void* const symbol = handle == nullptr ? nullptr : ::dlsym(handle, name);
  if (symbol == nullptr)
    throw Error(Fault::input_output, library,
                "a part of the program cannot be loaded: " + std::string(::dlerror()),
                "it is built with the program and belongs beside it; if it is there, a package "
                "that it needs is missing: ./dev build installs all of them");
  return symbol;
}

} // namespace billet
