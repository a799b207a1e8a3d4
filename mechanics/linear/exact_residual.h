// How exact a solution can be asked to be.

#pragma once

namespace billet::mechanics {

/// Relative residual that counts as exact: what a factorization and its refinement are held to.
inline constexpr double exact = 1e-10;

} // namespace billet::mechanics
