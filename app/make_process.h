// From a case as read to a process ready to run: mesh, tools, checks of the whole scene.

#pragma once

#include "app/cost.h"
#include "io/case/case.h"
#include "io/scene/solid_meshing.h"
#include "process/loop/process.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace billet::app {

struct ReadyProcess {
  std::unique_ptr<process::Process> process;
  std::vector<std::string> notes;                  ///< what the user should know about the inputs
  std::optional<CostEstimate> cost = std::nullopt; ///< of large scenes
};

/// @param file  of the case: the place of complaints that have none of their own
/// @param say   called before each step that takes a while, with what it is; may be empty
/// @throws Error
[[nodiscard]] ReadyProcess
make_process(const io::Case& content, const std::string& file, const io::Say& say = {});

} // namespace billet::app
