// What a file calls the nodes and elements of a mesh, for messages.
//
// A mesh numbers both from 0. Files of Gmsh, Abaqus and CalculiX give them labels of their own,
// which a user finds again in the file. Meshes without labels are named by their numbers, with a
// word that these count from 0.

#pragma once

#include "mechanics/mesh/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace billet::mechanics {

struct MeshLabels {
  std::vector<std::int64_t> nodes;    ///< shape (n_points); empty: there are none
  std::vector<std::int64_t> elements; ///< shape (n_elements); empty: there are none

  /// "node 5004", or "node number 4 (counted from 0)".
  [[nodiscard]] std::string node(Index i) const { return text("node ", nodes, i); }
  /// "element 1005", or "element number 4 (counted from 0)".
  [[nodiscard]] std::string element(Index i) const { return text("element ", elements, i); }
  /// "elements 1005 and 1007", or "elements number 4 and 6 (counted from 0)".
  [[nodiscard]] std::string pair(Index i, Index j) const {
    return elements.empty() ? "elements number " + std::to_string(i) + " and " + std::to_string(j) +
                                  " (counted from 0)"
                            : "elements " + std::to_string(elements[idx(i)]) + " and " +
                                  std::to_string(elements[idx(j)]);
  }

private:
  static std::string text(const char* what, const std::vector<std::int64_t>& labels, Index i) {
    return labels.empty() ? what + ("number " + std::to_string(i)) + " (counted from 0)"
                          : what + std::to_string(labels[idx(i)]);
  }
};

} // namespace billet::mechanics
