#include "geometry/base/late_library.h"

#include "geometry/base/error.h"

#include <dlfcn.h>

#include <string>

namespace billet {

void* late_symbol(const char* library, const char* name) {
  void* const handle = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL); // stays until the program ends
  void* const symbol = handle == nullptr ? nullptr : ::dlsym(handle, name);
  if (symbol == nullptr)
    throw Error(Fault::input_output, library,
                "a part of the program cannot be loaded: " + std::string(::dlerror()),
                "it is built with the program and belongs beside it; if it is there, a package "
                "that it needs is missing: ./dev build installs all of them");
  return symbol;
}

} // namespace billet
