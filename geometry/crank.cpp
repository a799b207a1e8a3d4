#include "geometry/crank.h"

#include <cmath>
#include <numbers>

namespace billet::geometry {

double Crank::way_from_top(double angle) const {
  const double aside = radius * std::sin(angle); // of the pin from the axis
  // Of the rod no more than aside^2 / 2 rod is lost; written so that nothing cancels.
  const double lost = aside * aside / (rod + std::sqrt(rod * rod - aside * aside));
  const double half = std::sin(0.5 * angle);
  return 2.0 * radius * half * half - lost;
}

double Crank::travel(double time) const { return way_from_top(angle(time)) - way_from_top(start); }

double Crank::slide_speed(double time) const {
  const double sine = std::sin(angle(time)), cosine = std::cos(angle(time));
  const double aside = radius * sine;
  return speed(time) * aside * (1.0 - radius * cosine / std::sqrt(rod * rod - aside * aside));
}

std::vector<double> Crank::bottom_dead_centres(double end) const {
  constexpr std::size_t most = 1000;
  constexpr int halvings = 60;
  constexpr double turn = 2.0 * std::numbers::pi;
  std::vector<double> times;
  double wanted = std::numbers::pi + turn * std::floor((start - std::numbers::pi) / turn + 1.0);
  for (; wanted <= angle(end) && times.size() < most; wanted += turn) {
    double before = 0.0, after = end;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (before + after);
      (angle(middle) < wanted ? before : after) = middle;
    }
    times.push_back(after);
  }
  return times;
}

} // namespace billet::geometry
