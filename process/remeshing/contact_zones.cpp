#include "process/remeshing/contact_zones.h"

#include "process/remeshing/part_boundary.h"
#include "process/state/run.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace billet::process {

std::vector<int> touching_tools(const Run& run) {
  std::vector<int> touching(run.part().contact_faces.size(), -1);
  for (std::size_t t = 0; run.model.contact && t < run.tools().size(); ++t) {
    for (const contact::ClosedPoint& at : run.model.contact->closed()[t])
      touching[at.point / idx(run.model.surface->points())] = static_cast<int>(t);
    for (const contact::CornerState& corner : contact::corners(*run.model.contact, t))
      if (const auto& foot = corner.press.foot)
        touching[idx(foot->face)] = static_cast<int>(t);
  }
  return touching;
}

std::vector<ContactZone> zones_of_contact(const Run& run) {
  if (!run.model.contact || run.mesh().dimension() != 2)
    return {};
  return contact_zones(part_boundary(run.part(), run.positions(), touching_tools(run), {}));
}

// A strip that is bent touches its tools along lines, whatever the mesh; its force is that of the
// bend. With the half width of elastic contact in the plane, 2 F' / E deep to within a logarithm.
bool indents(const Run& run, const ContactZone& zone) {
  constexpr double of_flow_stress = 0.5, of_work = 0.01;
  double force = 0.0, area = 0.0, weakest = std::numeric_limits<double>::infinity();
  for (const contact::ClosedPoint& at : run.model.contact->closed()[idx(zone.tool)]) {
    force += at.area * at.pressure;
    area += at.area;
    weakest = std::min(weakest,
                       run.model.bulk->trial_flow_stress(run.model.surface->bulk_point(at.point)));
  }
  for (const contact::CornerState& corner : contact::corners(*run.model.contact, idx(zone.tool)))
    force += corner.press.area * corner.history.pressure;
  if (!(area > 0.0))
    return force > 0.0;
  const double pressure = force / area;
  const double work = force * pressure * zone.length / run.scene.material.elasticity.young;
  return pressure > of_flow_stress * weakest ||
         work > of_work * (run.state.energy.elastic + run.state.energy.plastic);
}

std::vector<ContactZone> poorly_resolved_tools(const Run& run) {
  std::map<int, ContactZone> longest;
  for (const ContactZone& zone : zones_of_contact(run))
    if (const auto [known, is_new] = longest.try_emplace(zone.tool, zone);
        !is_new && known->second.too_short())
      known->second = zone;
  std::vector<ContactZone> poor;
  for (const auto& [tool, zone] : longest)
    if (zone.too_short() && indents(run, zone))
      poor.push_back(zone);
  return poor;
}

} // namespace billet::process
