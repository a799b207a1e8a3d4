// Points that fill a cube evenly.

#pragma once

#include <cstdint>
#include <vector>

namespace billet::study {

/// Latin hypercube: along every axis each of `count` equal intervals holds one point, at a random
/// place. (McKay, Beckman and Conover, Technometrics 21 (1979) 239)
/// @return shape (count, dimensions), in [0, 1)
[[nodiscard]] std::vector<std::vector<double>>
latin_hypercube(int count, int dimensions, std::uint32_t seed);

/// Sobol's sequence from its second point on, the first being a corner; shifted by a random vector
/// where the seed is not 1. (Sobol, USSR Comput. Maths Math. Phys. 7 (1967) 86)
/// @return shape (count, dimensions), in [0, 1)
[[nodiscard]] std::vector<std::vector<double>> sobol(int count, int dimensions, std::uint32_t seed);

} // namespace billet::study
