// From a case as read to a process ready to run: mesh, tools, checks of the whole scene.

#pragma once

#include "io/case/case.h"
#include "io/solid_meshing.h"
#include "process/run.h"

#include <memory>
#include <string>
#include <vector>

namespace billet::app {

struct ReadyProcess {
  std::unique_ptr<process::Process> process;
  std::vector<std::string> notes; ///< what the user should know about the inputs
};

/// @param file  of the case: the place of complaints that have none of their own
/// @param say   is told what takes a while, before it begins; may be empty
/// @throws Error
[[nodiscard]] ReadyProcess make_process(const io::Case& content,
                                        const std::string& file,
                                        int threads = 1,
                                        const io::Say& say = {});

} // namespace billet::app
