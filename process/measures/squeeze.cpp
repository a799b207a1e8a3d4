#include "process/measures/squeeze.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace billet::process {

namespace {

double mean_pressure(std::span<const contact::ClosedPoint> points) {
  double force = 0.0, area = 0.0;
  for (const contact::ClosedPoint& point : points) {
    force += point.area * point.pressure;
    area += point.area;
  }
  return area > 0.0 ? force / area : 0.0;
}

/// The largest of the tools. On a new mesh without equilibrium no point has borne anything yet:
/// then of the last increment before it [MPa].
double largest_tool_pressure(const Run& run) {
  double largest = 0.0;
  for (const std::vector<contact::ClosedPoint>& points : run.contact()->closed())
    largest = std::max(largest, mean_pressure(points));
  const std::vector<RemeshReport>& meshes = run.state.record.remeshings;
  if (largest > 0.0 || meshes.empty() || meshes.back().balanced)
    return largest;
  for (std::size_t t = 0; t < run.tools().size(); ++t)
    largest = std::max(
        largest, run.state.record.window.tool(t)[contact::WindowQuantity::pressure].last_mean);
  return largest;
}

} // namespace

bool Squeeze::is_full() const {
  constexpr double wide_open = 10.0; // flow stresses
  return (volume_lost > 2.0 * little && is_nearly_full()) ||
         (volume_lost > little && pressure > wide_open * flow_stress);
}

bool Squeeze::is_nearly_full() const {
  constexpr double open = 5.0; // flow stresses: a sticking disc twenty times as wide as high
  return volume_lost > little_at_failure && pressure > open * flow_stress;
}

bool has_lost_volume(const Run& run, double volume, double share) {
  return volume < (1.0 - share) * run.model.bulk->reference_volume();
}

Squeeze squeeze_of(const Run& run, double volume) {
  const mechanics::Bulk& bulk = *run.model.bulk;
  const double whole = bulk.reference_volume();
  const double share = volume / whole;
  Squeeze squeeze{1.0 - share, -bulk.material().elasticity.bulk() * std::log(share), 0.0, 0.0};
  for (std::size_t k = 0; k < bulk.states().size(); ++k)
    squeeze.flow_stress +=
        bulk.volumes()[k] / whole *
        mechanics::yield_stress(
            bulk.material().flow,
            {bulk.states()[k].plastic_strain, run.state.plastic_rate[k], bulk.temperature(k)});
  if (run.contact() != nullptr)
    squeeze.tool_pressure = largest_tool_pressure(run);
  return squeeze;
}

} // namespace billet::process
