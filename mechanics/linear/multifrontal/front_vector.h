// A vector of the processor, of numbers in single precision.

#pragma once

#include "mechanics/linear/multifrontal/front_kernels.h"

#include <cstring>
#include <type_traits>

namespace billet::mechanics {

using FrontVector [[gnu::vector_size(front_lanes * sizeof(float))]] = float;

/// Two numbers: the unknowns of a node in the plane.
using FrontPair [[gnu::vector_size(2 * sizeof(float))]] = float;

// By reference: what returns a vector is called otherwise where the processor has none so long.
inline void load(const float* from, FrontVector& v) { std::memcpy(&v, from, sizeof v); }

inline void store(const FrontVector& v, float* to) { std::memcpy(to, &v, sizeof v); }

inline void load(const float* from, FrontPair& v) { std::memcpy(&v, from, sizeof v); }

inline void store(const FrontPair& v, float* to) { std::memcpy(to, &v, sizeof v); }

/// Adds two numbers to two others.
inline void add_pair(const float* from, float* to) {
  FrontPair sum;
  FrontPair more;
  load(to, sum);
  load(from, more);
  store(sum + more, to);
}

/// Calls `visit` with a number of columns, 1 to `most`, as a constant.
template <std::size_t most = front_lanes, class Visit>
void visit_columns(std::size_t columns, Visit visit) {
  if constexpr (most > 1)
    if (columns < most)
      return visit_columns<most - 1>(columns, visit);
  visit(std::integral_constant<std::size_t, most>{});
}

} // namespace billet::mechanics
