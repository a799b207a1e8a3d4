// What holds and loads the workpiece, as 'billet check' prints it.

#pragma once

#include "io/case/case.h"
#include "process/scene/scene.h"

namespace billet::app {

/// A line for every support and load of the case: where it is, how many nodes or faces that means,
/// and what it amounts to.
void print_conditions(const process::Scene& scene, const io::Case& content);

} // namespace billet::app
