// A plane of symmetry, or the axis of revolution, as a wall for metal that folds onto it. (P.48)

#pragma once

#include "geometry/base/box.h"
#include "mechanics/mesh/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace billet::process {

using mechanics::Index;

/// Where metal has come to a wall, and since when.
struct MetWall {
  double since = 0.0; ///< [s]
  Box box;            ///< of the places where it came there

  template <class Archive> void fields(Archive& archive) { archive(since, box.low, box.high); }
};

struct Wall {
  int component = 0;
  double at = 0.0;          ///< its coordinate [mm]
  double sense = 1.0;       ///< +1: the part lies above it, -1: below
  bool axis = false;        ///< of revolution
  std::vector<Index> off;   ///< nodes of the surface that may come to it, sorted
  std::vector<double> near; ///< how near to it each of these counts as on it [mm]
  std::vector<Index> held;  ///< those that have, and stay there, sorted
  std::optional<MetWall> met;

  template <class Archive> void fields(Archive& archive) {
    archive(component, at, sense, axis, off, near, held, met);
  }
};

/// How messages call it.
[[nodiscard]] std::string name_of_wall(const Wall& wall);

} // namespace billet::process
