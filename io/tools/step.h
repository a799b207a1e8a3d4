// STEP files: exact surfaces out of CAD, cut into triangles for the search.
//
// The reader is OpenCASCADE's, which not every build has (CMake's BILLET_STEP, `./dev build
// --step`). What comes out is the same heap of facets that an STL holds and goes the same way from
// there (stl_tool.h); unlike an STL it knows its unit and how far the triangles are off.
//
// Units   mm, whatever the file is in.

#pragma once

#include "io/tools/facet_file.h"

#include <filesystem>
#include <optional>

namespace billet::io {

/// Whether this build reads STEP files.
[[nodiscard]] bool reads_step();

/// Every face of a file as triangles.
///
/// @param chord_error  how far they may be off the surface, at least 1e-5 of the part's size [mm];
///                     none: 1/5000 of it.
///                     Also, facets of a curved face turn by at most 6 degrees
/// @throws Error(Fault::geometry) naming what is wrong with the file, or the build;
///         Error(Fault::input_output) if it cannot be read
[[nodiscard]] FacetFile read_step(const std::filesystem::path& path,
                                  const std::optional<double>& chord_error = std::nullopt);

} // namespace billet::io
