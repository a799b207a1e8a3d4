// From the closed surface in an STL or STEP file to a workpiece of tetrahedra.
//
// Guide: docs/guide/stl-tools.md.

#pragma once

#include "geometry/mesh3d/solid_estimate.h"
#include "io/case/case_common.h"
#include "io/tools/facet_file.h"
#include "mechanics/mesh/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace billet::io {

/// Takes a line that the user should see at once: before something that takes a while.
using Say = std::function<void(const std::string&)>;

/// A body that is to be meshed.
struct BodyFile {
  const InputFile& file;
  const FacetFile& facets;
  double scale; ///< from the file's numbers to the case's lengths
};

/// Meshes it; what is to be known of the surface and the mesh is added to the notes.
///
/// @param say  called, before it is meshed, with how many tetrahedra it will take and why
/// @throws Error at the file: what is wrong with its surface, several bodies, too many tetrahedra
[[nodiscard]] mechanics::Mesh solid_mesh(const BodyFile& body,
                                         const geometry::SolidRefinement& wanted,
                                         const Say& say,
                                         std::vector<std::string>& notes);

} // namespace billet::io
