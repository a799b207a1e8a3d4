// A package holds the program twice: for any processor of its kind, and for those of level
// x86-64-v3 (AVX2, FMA; since 2013), where it takes half to nine tenths of the time.

#pragma once

#include <filesystem>

namespace billet::app {

/// Makes this process the program for the processor's level, with the same arguments, if there is
/// one where a package has it: `../lib/billet/x86-64-v3` as seen from this one. Returns if not.
///
/// @param argv  as `main` has it; the last is null
void go_on_for_this_processor(char** argv);

/// The program as users start it: of one that was gone on to, the one it came from.
[[nodiscard]] std::filesystem::path started_program(const std::filesystem::path& file);

} // namespace billet::app
