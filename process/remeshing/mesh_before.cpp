#include "process/remeshing/mesh_before.h"

#include "process/increment/force_floor.h"
#include "process/stages/unloading.h"
#include "process/state/state.h"
#include "process/state/stored_models.h"

#include <utility>
#include <vector>

namespace billet::process {

void take_part(Run& run, Part part) {
  run.state.origins = mechanics::node_positions(part.mesh);
  std::vector<double> x = run.state.origins;
  x.resize(x.size() + contact::drive_unknowns(run.model.tools).size(), 0.0);
  rebuild(run, std::move(part), std::move(x));
  run.model.newton->set_force_floor(force_floor(run, run.state.time));
  if (run.model.wear)
    run.model.wear->change_surface(*run.model.surface, {});
}

MeshBefore::MeshBefore(const Run& run) : part_(run.state.part), present_(present(run)) {}

void MeshBefore::put_back(Run& run) const {
  take_part(run, *part_);
  process::put_back(run, present_);
}

} // namespace billet::process
