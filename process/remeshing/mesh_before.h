// A run put back to where it was on the mesh before.

#pragma once

#include "process/state/run.h"

#include <memory>
#include <string>

namespace billet::process {

/// Puts a part in the place of the present one, as where it was made: nothing has moved on it yet,
/// and the models know nothing.
void take_part(Run& run, Part part);

/// What a run was, until a new mesh has served.
class MeshBefore {
public:
  explicit MeshBefore(const Run& run);

  /// The run is as it was, but for the time it has taken.
  void put_back(Run& run) const;

private:
  std::shared_ptr<const Part> part_;
  std::string present_;
};

} // namespace billet::process
