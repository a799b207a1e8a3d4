// The free surface of a part, moved along its normals to give the part a volume. (P.21)

#pragma once

#include "process/scene/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace billet::process {

/// Directions in which nodes of the free surface may move: mean unit normals outward at nodes of
/// contact faces none of which touches a tool; zero in components that supports prescribe, on the
/// axis, and at all other nodes.
///
/// @param x         positions of the nodes, shape (n_dofs) [mm]
/// @param touching  whether a tool touches it, of each of the part's contact faces
/// @return shape (n_dofs)
[[nodiscard]] std::vector<double>
free_normals(const Part& part, std::span<const double> x, std::span<const char> touching);

/// Moves nodes along their directions until the part has a volume, by at most a distance.
///
/// @param x        positions of the nodes, shape (n_dofs) or more [mm]
/// @param normals  shape (n_dofs); all zero: nothing is done
/// @param volume   of the part with its nodes in places [mm^3]
/// @param wanted   the volume it should have [mm^3]
/// @param furthest that a node may go [mm]
void restore_volume(std::vector<double>& x,
                    std::span<const double> normals,
                    const std::function<double(std::span<const double>)>& volume,
                    double wanted,
                    double furthest);

} // namespace billet::process
