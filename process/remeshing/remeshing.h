// What meshing a part anew needs to know of it, in the plane and in space.

#pragma once

#include "contact/term/contact_term.h"
#include "mechanics/mesh/mesh.h"
#include "process/remeshing/laps.h"
#include "process/remeshing/part_boundary.h"
#include "process/reports/lap.h"
#include "process/scene/scene.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace billet::process {

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

/// Of the elements of a new mesh, in addition to what the scene asks for.
struct AskedSizes {
  std::vector<geometry::SizeAt> at; ///< in the plane
  double share = 1.0;               ///< of what is asked for everywhere [-]
};

/// A tool that comes to touch on edges too long for what it touches.
struct FirstTouch {
  std::string cause;                   ///< to say
  std::vector<geometry::SizeAt> sizes; ///< that it needs there
};

/// An edge in contact that is too long for how the tool's surface turns under it.
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

/// Scaled Jacobian below which an element of a kind is too bad.
[[nodiscard]] double least_quality(const RemeshSettings& settings, mechanics::ElementKind kind);

} // namespace billet::process
