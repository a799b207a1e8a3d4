// Which reduction of space a scene is computed in.

#pragma once

namespace billet::mechanics {

/// Reduction of the scene to the unknowns it needs.
enum class Analysis { plane_strain, axisymmetric, solid };

} // namespace billet::mechanics
