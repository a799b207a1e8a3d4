#include "process/remeshing/laps.h"

#include "process/remeshing/part_boundary.h"
#include "process/remeshing/parted_walls.h"
#include "process/remeshing/solid_part.h"
#include "process/reports/lap.h"
#include "process/state/mesh_quality.h"
#include "process/state/run.h"

#include <vector>

namespace billet::process {

std::vector<Lap> laps(const Run& run) {
  constexpr double noticed = 0.25; // of an element: in a hollow corner of a die sides touch
  const std::vector<int> none(run.part().contact_faces.size(), -1);
  const double element = mean_side(run.mesh());
  // Walls that contact holds lie in each other by what its penalty needs, and by more between its
  // points: that is no crossing.
  constexpr double held = 0.02; // of an element
  const std::vector<double> x = positions_with_parted_walls(run, held * element);
  std::vector<Lap> found;
  if (run.mesh().dimension() == 2) {
    PartBoundary boundary = part_boundary(run.part(), x, none, {});
    for (const geometry::ClosedFold& fold : weld_folds(boundary, 0.0, 0.0))
      found.push_back(lap(fold));
  } else {
    SolidPart part = solid_part(run.part(), x, none, {});
    for (const geometry::ClosedCrease& crease :
         geometry::flatten_creases(part.boundary, 0.0, noticed * element))
      found.push_back(lap(crease));
    if (const auto crease = geometry::cut_at(part.boundary.mesh)) // too deep to be drawn flat
      found.push_back(lap(*crease));
  }
  std::erase_if(found, [&](const Lap& each) { return each.depth < noticed * element; });
  return found;
}

} // namespace billet::process
