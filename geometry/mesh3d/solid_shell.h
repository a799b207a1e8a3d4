// The boundary of a new mesh on the surface of the old one: where its nodes lie, what they enclose.
// Internal to geometry/.
//
// Nodes are numbered as the mesh's points first, then as the middles of the boundary's edges.
//
// Units   mm. Theory: docs/theory/geometry.md (G.46)-(G.48).

#pragma once

#include "geometry/curved/boundary_surface.h"
#include "geometry/mesh3d/patch_mesher.h"
#include "geometry/mesh3d/solid_remesher.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace billet::geometry {

class SolidShell {
public:
  /// Puts the nodes of the boundary onto the smooth surface.
  SolidShell(const BoundarySurface& surface, PatchedSolid solid);

  /// Where the boundary touches itself or is open: middles of edges that have not two faces, nodes
  /// at which faces meet that are not one fan. If there is any, nothing else may be asked.
  [[nodiscard]] const std::vector<Vec3>& flaws() const { return flaws_; }

  /// Moves nodes inside and, along the surface, those of patches until the tetrahedra have the
  /// quality `wanted`, as far as that is possible.
  void slide(double wanted);
  /// The same inside alone.
  void smooth(double wanted);
  void snap(const SnapSolid& snap);
  /// Shifts free nodes along their normals until the volume is `wanted`; none free: does nothing.
  /// (G.48)
  void restore_volume(double wanted);
  /// Draws middles of edges half way to the chord where a tetrahedron would be bent too far, or has
  /// less than the quality `wanted` by its bends.
  /// @return whether there was one
  bool straighten(double wanted);

  /// Of the quadratic tetrahedra [mm^3].
  [[nodiscard]] double volume() const;
  /// Of the worst tetrahedron, straight or bent.
  [[nodiscard]] double quality() const;
  /// Smallest angle between two faces of a straight tetrahedron [rad].
  [[nodiscard]] double smallest_angle() const;
  /// Centres of tetrahedra that have less than that angle [rad] or quality, or are bent inside out;
  /// the worst first.
  [[nodiscard]] std::vector<Vec3> poor_places(double angle, double quality) const;
  /// Smallest determinant of Jacobians over the straight ones [-].
  [[nodiscard]] double smallest_jacobian() const;

  [[nodiscard]] RemeshedSolid result() &&;

private:
  /// What a node of the boundary lies on.
  struct Seat {
    std::int32_t point = -1; ///< of the old boundary, if it is that
    std::int32_t line = -1;  ///< else
    std::int32_t patch = -1; ///< else; -1: inside
  };

  struct Enclosed {
    double volume;
    std::vector<Vec3> slope; ///< by the nodes' positions
  };

  void find_edges();
  void find_edges_of_tetrahedra();
  void find_pinches();
  void find_seats();
  void place_corners();
  void place_middles();
  [[nodiscard]] std::int32_t edge_between(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] Vec3 chord_middle(std::size_t edge) const;
  /// Onto the surface, by where x is on the straight triangles.
  [[nodiscard]] Vec3 seated(const Seat& seat, const Vec3& x) const;
  [[nodiscard]] SurfacePlace place(const Seat& seat, const Vec3& x) const;
  [[nodiscard]] Vec3& position(std::size_t node);
  [[nodiscard]] const Vec3& position(std::size_t node) const;
  [[nodiscard]] Enclosed enclosed() const;
  [[nodiscard]] std::array<std::size_t, 6> nodes_of(const PatchedSolid::Facet& facet) const;
  /// From 0 at held nodes and one half next to them to 1; 0 for nodes inside.
  [[nodiscard]] std::vector<double> freedom() const;
  [[nodiscard]] std::vector<Vec3> normals() const;
  [[nodiscard]] std::array<Vec3, 4> corners_of(std::size_t tetrahedron) const;
  [[nodiscard]] std::array<Vec3, 6> middles_of(std::size_t tetrahedron) const;
  [[nodiscard]] double bend(std::size_t tetrahedron) const;
  [[nodiscard]] double bent_quality(std::size_t tetrahedron) const;
  void improve_nodes(const std::vector<char>& movable, double wanted);

  const BoundarySurface& surface_;
  PatchedSolid solid_;
  std::vector<RemeshedSolid::Edge> edges_;
  std::vector<std::array<std::int32_t, 3>> facet_edges_; ///< from corner i to the next
  std::vector<std::array<std::int32_t, 6>> tetra_edges_; ///< numbers in `edges_`; -1: inside
  std::vector<Seat> seats_;                              ///< of all nodes
  std::vector<SurfacePlace> places_;                     ///< of all nodes; without meaning inside
  std::vector<std::int32_t> old_line_piece_;             ///< of the edges, of those on lines
  std::vector<Vec3> flaws_;
};

} // namespace billet::geometry
