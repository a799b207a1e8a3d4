// What meshing a part anew needs to know of it, in the plane and in space.

#pragma once

#include "contact/term/contact_term.h"
#include "mechanics/mesh/mesh.h"
#include "process/lap.h"
#include "process/part_boundary.h"
#include "process/state.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace billet::process {

/// What a remeshing may change of a tool's force (RM-01).
constexpr double force_budget = 1e-2;

/// The part on a new mesh, and how its contact finds what the old one knew.
struct NewPart {
  RemeshedPart part;
  /// For every contact point of the new surface those of the old one that it lies between.
  ///
  /// @param x  positions of the new nodes
  std::function<std::vector<contact::PointSource>(const contact::ContactSurface&,
                                                  std::span<const double> x)>
      sources;
  std::vector<Lap> laps = {}; ///< of the old boundary that were welded
};

/// A tool that comes to touch on sides too long for what it touches.
struct FirstTouch {
  std::string cause;                   ///< empty: there is none
  std::vector<geometry::SizeAt> sizes; ///< that it needs there
};

/// A side in contact that is too long for how the tool's surface turns beneath it.
struct OutgrownSide {
  double excess = 0.0;  ///< its length over the longest that a new mesh would have there [-]
  double turn = 0.0;    ///< of the tool's normal along it [rad]
  std::size_t tool = 0; ///< that it touches
};

/// A tool that presses with its corners. (C.46)
struct CornerLoad {
  double share = 0.0; ///< of its pressure that they bear [-]
  std::size_t tool = 0;
};

/// Sums over the fields of a part.
struct Stock {
  double volume = 0.0;       ///< [mm^3]
  double plastic_work = 0.0; ///< that the plastic strain stands for [N mm]
  double mean_strain = 0.0;  ///< plastic, over the volume [-]
  double largest_strain = 0.0;
};

/// A state on a new mesh; its contact is still that of the old one.
struct CarriedState {
  Snapshot state;
  Stock before;     ///< on the old mesh
  int returned = 0; ///< points put back onto the yield surface
};

/// Where the run is, on a new mesh, and where it was some increments ago.
struct CarriedOver {
  CarriedState now;
  /// Those where the new elements had a shape, the earliest first; may be empty.
  std::vector<CarriedState> begun;
  std::vector<contact::PointSource> sources; ///< of the new contact points
  std::vector<double> origins;               ///< of the material at the nodes [mm]
};

/// Positions of nodes as points in space [mm].
///
/// @param x  shape (n_points, dim) [mm]
[[nodiscard]] std::vector<Vec3> as_points(std::span<const double> x, int dim);

/// Scaled Jacobian of the worst element.
///
/// @param x  positions of the nodes, shape (n_points, dim) [mm]
[[nodiscard]] double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x);

/// Scaled Jacobian below which an element of a kind is too bad.
[[nodiscard]] double least_quality(const RemeshSettings& settings, mechanics::ElementKind kind);

/// Side of an equilateral triangle, of a regular tetrahedron, of a square or of a cube of the mean
/// size of the elements [mm].
[[nodiscard]] double mean_side(const mechanics::Mesh& mesh);

} // namespace billet::process
