// What a run's models hold between increments, as bytes; and a run put back to where it was on the
// same mesh.

#pragma once

#include "geometry/base/archive.h"
#include "process/state/run.h"

#include <string>
#include <string_view>

namespace billet::process {

/// Refuses bytes of a run of another scene.
/// @throws Error (Fault::input_output)
[[noreturn]] void another_scene(const std::string& what);

/// What the models on the part, and the tools, hold.
void store_models(const Run& run, ArchiveWriter& archive);

/// Gives the models, which are those that were stored, what they held.
/// @throws Error (Fault::input_output) if the bytes are of a run with other models
void restore_models(Run& run, ArchiveReader& archive);

/// What an increment changes, in bytes.
[[nodiscard]] std::string present(const Run& run);

/// Undoes every increment since then. The mesh must be the same.
void put_back(Run& run, std::string_view present);

} // namespace billet::process
