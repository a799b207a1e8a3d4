// Libraries that most runs never need, loaded when something is asked of them for the first time.
//
// Loading FCL and VTK takes longer than all else that a program does before its first increment.
// What needs them is compiled into libraries of our own, which stand beside the program
// (`billet_late_library` in cmake/BilletLibrary.cmake).

#pragma once

namespace billet {

/// Address of a function in one of these libraries.
///
/// @param library  its file's name
/// @throws Error   (Fault::input_output) where it cannot be loaded; std::bad_alloc for want of
///                 memory
[[nodiscard]] void* late_symbol(const char* library, const char* name);

/// The same as a function.
template <class Function>
[[nodiscard]] Function* late_function(const char* library, const char* name) {
  return reinterpret_cast<Function*>(late_symbol(library, name));
}

} // namespace billet
