// Runs programs side by side on this machine.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace billet::study {

/// A program to run and where what it prints goes.
struct Job {
  std::vector<std::string> command;
  std::filesystem::path output;
};

/// Starts jobs in their order, at most `processes` at once, and waits for all of them. They end
/// with this program, however that ends.
///
/// @param ended    called with the number of a job and its status: that of its program, 128 + the
///                 signal that ended it, 127 where it could not be started
/// @param stopped  once true no more are started, and those that run are asked to stop
void run_jobs(const std::vector<Job>& jobs,
              int processes,
              const std::function<bool()>& stopped,
              const std::function<void(std::size_t job, int status)>& ended);

} // namespace billet::study
