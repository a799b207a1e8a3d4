#include "study/verify/figure.h"

#include <cmath>
#include <limits>
#include <utility>

namespace billet::study {

Figure
relative(std::string name, std::string unit, double value, double reference, double tolerance) {
  return {std::move(name), std::move(unit), value, reference, tolerance, Criterion::relative, {}};
}

Figure
absolute(std::string name, std::string unit, double value, double reference, double tolerance) {
  return {std::move(name), std::move(unit), value, reference, tolerance, Criterion::absolute, {}};
}

Figure at_most(std::string name, std::string unit, double value, double bound, double tolerance) {
  return {std::move(name), std::move(unit), value, bound, tolerance, Criterion::at_most, {}};
}

Figure at_least(std::string name, std::string unit, double value, double bound, double tolerance) {
  return {std::move(name), std::move(unit), value, bound, tolerance, Criterion::at_least, {}};
}

double deviation(const Figure& figure) {
  const double difference = figure.value - figure.reference;
  if (figure.criterion == Criterion::absolute)
    return difference;
  if (figure.reference != 0.0)
    return difference / std::abs(figure.reference);
  return difference == 0.0 ? 0.0
                           : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

bool within_tolerance(const Figure& figure) {
  const double off = deviation(figure);
  switch (figure.criterion) {
  case Criterion::relative:
  case Criterion::absolute:
    return std::abs(off) <= figure.tolerance;
  case Criterion::at_most:
    return off <= figure.tolerance;
  case Criterion::at_least:
    return off >= -figure.tolerance;
  }
  return false;
}

} // namespace billet::study
