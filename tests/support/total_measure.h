// Size of a whole mesh, from the sizes of its elements.

#pragma once

#include "mechanics/elements/mesh_check.h"

#include <cstddef>
#include <vector>

namespace billet::support {

/// Area of a plane mesh [mm^2], volume of a solid one [mm^3].
inline double total_measure(const mechanics::Mesh& mesh) {
  double sum = 0.0;
  for (mechanics::Index e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Vec3> nodes;
    for (const mechanics::Index a : mesh.cell(e))
      nodes.push_back(mesh.points[static_cast<std::size_t>(a)]);
    sum += mechanics::element_measure(mesh.kind, nodes);
  }
  return sum;
}

} // namespace billet::support
