#include "mechanics/linear/solver_estimate.h"

#include <fmt/format.h>

namespace billet::mechanics {

SystemCost cost_by_factorization(const SystemSize& size) {
  constexpr double per_operation = 1.0 / 60e9, systems = 12.0; // that a factorization serves
  constexpr double per_entry = 2.0 / 3e9, substitutions = 5.0; // of a system
  constexpr double working_front = 1.5; // of the factors, with what waits for its parent
  return {size.operations * per_operation / systems +
              size.factor_entries * per_entry * substitutions,
          sizeof(float) * size.factor_entries * working_front};
}

SystemCost cost_by_multigrid(const SystemSize& size) {
  constexpr double set_up = 0.18e-6, systems = 12.0; // an entry of the matrix
  constexpr double cycle = 3.5e-9, cycles = 7.0;
  constexpr double levels = 12.0, directions = 60.0 / 75.0; // numbers, an entry of the matrix
  return {size.entries * (set_up / systems + cycle * cycles),
          sizeof(double) * size.entries * (levels / sizeof(double) + directions)};
}

bool may_pay(const SystemSize& size) {
  constexpr double fewest_entries = 5e6;
  return size.dim == 3 && size.entries >= fewest_entries;
}

bool prefers_multigrid(const SystemSize& size, double memory) {
  constexpr double far = 4.0;
  constexpr double most = 0.8; // of the memory that is left
  if (!may_pay(size))
    return false;
  const SystemCost factorization = cost_by_factorization(size);
  const SystemCost multigrid = cost_by_multigrid(size);
  return factorization.seconds > far * multigrid.seconds ||
         (factorization.memory > most * memory && multigrid.memory < factorization.memory);
}

std::string costs_in_words(const SystemSize& size) {
  constexpr double megabyte = 1e6;
  const SystemCost factorization = cost_by_factorization(size);
  const SystemCost multigrid = cost_by_multigrid(size);
  return fmt::format("a system takes about {:.2g} s and {:.0f} MB by factorization, {:.2g} s and "
                     "{:.0f} MB by multigrid",
                     factorization.seconds, factorization.memory / megabyte, multigrid.seconds,
                     multigrid.memory / megabyte);
}

} // namespace billet::mechanics
