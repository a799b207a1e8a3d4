#include "study/sampling.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>

namespace billet::study {

namespace {

/// In [0, 1), the same on every machine: the standard's distributions differ between libraries.
double uniform(std::mt19937& generator) { return static_cast<double>(generator()) / 4294967296.0; }

} // namespace

std::vector<std::vector<double>> latin_hypercube(int count, int dimensions, std::uint32_t seed) {
  std::mt19937 generator(seed);
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::vector<double>> points(
      n, std::vector<double>(static_cast<std::size_t>(dimensions)));
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d) {
    std::vector<std::size_t> interval(n);
    std::iota(interval.begin(), interval.end(), std::size_t{0});
    for (std::size_t i = n; i-- > 1;)
      std::swap(
          interval[i],
          interval[static_cast<std::size_t>(uniform(generator) * static_cast<double>(i + 1))]);
    for (std::size_t i = 0; i < n; ++i)
      points[i][d] = (static_cast<double>(interval[i]) + uniform(generator)) / count;
  }
  return points;
}

std::vector<std::vector<double>> sobol(int count, int dimensions, std::uint32_t seed) {
  boost::random::sobol engine(static_cast<std::size_t>(dimensions));
  std::mt19937 generator(seed);
  std::vector<double> shift(static_cast<std::size_t>(dimensions), 0.0);
  if (seed != 1)
    for (double& each : shift)
      each = uniform(generator);
  std::vector<std::vector<double>> points(static_cast<std::size_t>(count));
  for (std::vector<double>& point : points)
    for (const double by : shift) {
      double whole = 0.0;
      const double value = std::ldexp(static_cast<double>(engine()), -64);
      point.push_back(std::modf(value + by, &whole));
    }
  return points;
}

} // namespace billet::study
