// Tetrahedra that share nodes are joined otherwise where the worst of them gets better by it.
// Internal to geometry/.
//
// Theory: docs/theory/geometry.md (G.52).

#pragma once

#include "geometry/mesh3d/mesher_3d.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace billet::geometry {

/// The tetrahedra of a mesh by their nodes, while they are replaced.
class SolidStars {
public:
  using Tetrahedron = std::array<std::int32_t, 4>;

  explicit SolidStars(SolidMesh& mesh);

  [[nodiscard]] const SolidMesh& mesh() const { return mesh_; }
  /// Also those that are gone, see `is_there`.
  [[nodiscard]] std::size_t size() const { return mesh_.tetrahedra.size(); }
  [[nodiscard]] bool is_there(std::size_t e) const { return mesh_.tetrahedra[e][0] >= 0; }
  [[nodiscard]] const Tetrahedron& operator[](std::size_t e) const { return mesh_.tetrahedra[e]; }
  /// Of tetrahedron `e` (`shape_quality`).
  [[nodiscard]] double quality(std::size_t e) const;
  [[nodiscard]] double quality(const Tetrahedron& corners) const;
  /// Numbers of the tetrahedra at a node; their order may be changed.
  [[nodiscard]] std::vector<std::size_t>& around(std::int32_t node) {
    return around_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] const std::vector<std::size_t>& around(std::int32_t node) const {
    return around_[static_cast<std::size_t>(node)];
  }

  /// Puts tetrahedra in the place of others that fill the same space.
  void replace(const std::vector<std::size_t>& old, const std::vector<Tetrahedron>& fresh);
  /// Forgets the tetrahedra that are gone; nothing else may be asked after it.
  void close();

private:
  SolidMesh& mesh_;
  std::vector<std::vector<std::size_t>> around_;
};

/// Tetrahedra that fill the space of others with a better worst one.
struct Reconnection {
  std::vector<std::size_t> old;
  std::vector<SolidStars::Tetrahedron> fresh;
  double worst; ///< quality of the worst one in `fresh`
};

/// The best way to do without one of the edges or faces of a tetrahedron, if one is better than
/// what is there. Faces of the boundary stay.
[[nodiscard]] std::optional<Reconnection> reconnection(const SolidStars& stars, std::size_t e);

} // namespace billet::geometry
