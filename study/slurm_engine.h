// Runs made by Slurm, as one job array.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "study/study.h"

namespace billet::study {

/// Submits an array job whose tasks are the lines of a list, and waits for its end. A task notes
/// its own status; one that fails does not stop the others.
/// @param stopped  once true the job is taken out of the queue
/// @throws Error (Fault::input_output) if sbatch is not there or refuses the job
void run_by_slurm(const std::filesystem::path& list,
                  std::size_t n_lines,
                  const Engine& engine,
                  const std::function<bool()>& stopped);

/// The script of the array: task i runs the lines i, i + n_tasks, ... of the list.
[[nodiscard]] std::string slurm_script(const std::filesystem::path& list, std::size_t n_tasks);

} // namespace billet::study
