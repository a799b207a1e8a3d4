#include "geometry/base/late_library.h"

#include "geometry/base/error.h"

#include <dlfcn.h>

#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace billet {

namespace {

/// Folder of the program, or of the library that this is part of.
std::filesystem::path folder_of_this() {
  ::Dl_info info{};
  std::error_code none;
  if (::dladdr(reinterpret_cast<void*>(&late_symbol), &info) != 0 && info.dli_fname != nullptr)
    return std::filesystem::absolute(info.dli_fname, none).parent_path();
  return {};
}

/// Opens a library that stands next to the program, or next to the library that this is part of, or
/// where the program's own libraries are looked
/// for: sanitizers stand between and do not know of those places.
void* opened(const char* library) {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  void* const beside = ::dlopen((program.parent_path() / library).c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (beside != nullptr)
    return beside;
  void* const beside_this = ::dlopen((folder_of_this() / library).c_str(), RTLD_LAZY | RTLD_LOCAL);
  return beside_this != nullptr ? beside_this : ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
}

/// The loader tells reasons in words alone.
bool tells_of_memory(std::string_view reason) {
  for (const std::string_view words : {"llocate memory", "out of memory", "failed to map segment"})
    if (reason.find(words) != std::string_view::npos)
      return true;
  return false;
}

} // namespace

void* late_symbol(const char* library, const char* name) {
  void* const handle = opened(library); // stays until the program ends
  void* const symbol = handle == nullptr ? nullptr : ::dlsym(handle, name);
  if (symbol != nullptr)
    return symbol;
  const char* const reason = ::dlerror();
  if (tells_of_memory(reason))
    throw std::bad_alloc();
  throw Error(Fault::input_output, library,
              "a part of the program cannot be loaded: " + std::string(reason),
              "it is built with the program and belongs beside it; if it is there, a package "
              "that it needs is missing: ./dev build installs all of them");
}

} // namespace billet
