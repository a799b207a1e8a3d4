// Our errors as those of the public headers. Not installed.

#pragma once

#include "geometry/base/error.h"

#include <new>

#include "billet/case.h"

namespace billet {

/// Calls a function; what is wrong with a case or with the machine becomes a RunError.
template <class Function> auto translated(Function&& function) {
  try {
    return function();
  } catch (const Error& error) {
    throw RunError(error.what());
  } catch (const std::bad_alloc&) {
    throw RunError("too little memory");
  }
}

} // namespace billet
