#include "io/results/history_row.h"

#include "io/case/history_columns.h"
#include "process/measures/shape_measures.h"
#include "process/measures/support_forces.h"

#include <algorithm>

namespace billet::io {

namespace {

void add_trapped(const contact::TrappedState& state, std::vector<double>& row) {
  double volume = 0.0, highest = 0.0;
  for (const contact::Pocket& pocket : state.pockets) {
    volume += pocket.volume;
    highest = std::max(highest, pocket.pressure);
  }
  row.insert(row.end(), {static_cast<double>(state.pockets.size()), volume, highest});
}

} // namespace

std::vector<std::string> history_columns(const process::Scene& scene) {
  NamesOfHistory names{{}, {}, {}, scene.contact.trapped.has_value()};
  for (const contact::Tool& tool : scene.tools)
    names.tools.push_back(tool.name);
  for (const process::Support& support : scene.part.supports)
    if (!support.name.empty() &&
        (names.supports.empty() || names.supports.back() != support.name)) // one a component
      names.supports.push_back(support.name);
  for (const process::Measure& measure : scene.measures)
    names.measures.push_back(measure.name);
  return history_columns(names);
}

std::vector<double> history_row(const process::Run& run, const process::IncrementReport& r) {
  std::vector<double> row{static_cast<double>(r.increment),
                          r.time,
                          r.dt,
                          static_cast<double>(r.iterations),
                          r.residual,
                          static_cast<double>(r.cutbacks),
                          r.volume,
                          r.max_penetration,
                          r.contact_area,
                          r.energy.plastic,
                          r.energy.external,
                          r.energy.friction,
                          r.energy.elastic,
                          r.max_plastic_strain,
                          r.min_quality,
                          static_cast<double>(run.state.record.remeshings.size()),
                          r.wall_time};
  for (std::size_t t = 0; t < run.tools().size(); ++t) {
    const contact::ToolLoad& load = run.contact()->loads()[t];
    const Vec3 way = run.tools()[t].motion.translation(r.time, run.driven(t));
    for (const Vec3& v : {load.force, load.torque, way})
      row.insert(row.end(), v.data(), v.data() + 3);
  }
  for (const process::SupportForce& support : process::support_forces(run))
    row.insert(row.end(), support.force.data(), support.force.data() + 3);
  if (run.model.trapped)
    add_trapped(run.model.trapped->state(), row);
  const std::vector<double> measures = process::measured(run);
  row.insert(row.end(), measures.begin(), measures.end());
  return row;
}

} // namespace billet::io
