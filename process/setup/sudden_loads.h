// Loads that are there at once. Theory: docs/theory/process.md (P.26).

#pragma once

#include "process/scene/scene.h"

namespace billet::process {

/// Lets what is there at once where it begins to act grow from nothing over the first increment:
/// loads and displacements of supports that are not zero at time 0, forces and torques of tools
/// where these begin to act. At the end of that increment they are what they were before; a shorter
/// one bears a share. Where another tool leaves at that time they grow as its forces fade, so that
/// the part never bears both. Presses that strike keep their loads, which are those of free fall.
void grow_sudden_loads(Scene& scene);

} // namespace billet::process
