// Materials by name: `library = "ofhc-copper"` in [material.NAME], own keys override.
//
// Each entry is the text of a [material] section, with units, so that it is read like a case and in
// the units of any case. Sources and ranges: docs/guide/materials.md.

#pragma once

#include "io/case/document.h"

#include <optional>
#include <span>
#include <string_view>

namespace billet::io {

/// What the data behind a flow law cover.
struct MaterialRange {
  double strain;  ///< largest plastic strain [-]
  double coldest; ///< [degC]
  double hottest; ///< [degC]
};

/// A material with its source.
struct LibraryMaterial {
  std::string_view name;   ///< in case files
  std::string_view text;   ///< TOML: keys of [material.NAME]
  std::string_view source; ///< where the flow law comes from, and where it holds
  MaterialRange range;     ///< as the source says
};

/// All materials.
[[nodiscard]] std::span<const LibraryMaterial> material_library();

/// A material of the library; null: there is none of that name.
[[nodiscard]] const LibraryMaterial* find_library_material(std::string_view name);

/// A material's section completed by what its `library` gives. Keys of the section stand, also
/// within `elastic` and `flow`; a `flow` that names its `law` replaces the library's as a whole.
///
/// @return none where the node names no material of the library
[[nodiscard]] std::optional<Node> with_library(const Node& section);

} // namespace billet::io
