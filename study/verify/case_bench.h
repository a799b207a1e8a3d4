// Where the cases of a verification are written as a user would write them, read and run.
//
// A problem goes the whole way: text, reader, scene, solver. What is written stays in the folder,
// so a case can be run again by hand with `billet run`.

#pragma once

#include "process/loop/process.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace billet::study {

class CaseBench {
public:
  /// Called after each increment.
  using Look = std::function<void(const process::Run&, const process::IncrementReport&)>;

  /// @param folder  is made if it is not there
  /// @throws Error (Fault::input_output)
  explicit CaseBench(std::filesystem::path folder);

  /// Writes a file next to the cases, such as a mesh that one of them names.
  void write(const std::string& file, const std::string& text) const;

  /// Writes NAME.toml and makes it ready to run, on one thread.
  /// @throws Error
  [[nodiscard]] std::unique_ptr<process::Process> ready(const std::string& name,
                                                        const std::string& text) const;

  /// Writes NAME.toml and runs it to its end.
  /// @throws Error, also where the run does not converge or fails a check
  std::unique_ptr<process::Process>
  run(const std::string& name, const std::string& text, const Look& look = {}) const;

private:
  std::filesystem::path folder_;
};

/// Runs what is ready to its end.
/// @throws Error (Fault::not_converged, Fault::failed_check)
void run_to_end(process::Process& process,
                const std::string& name,
                const std::vector<process::Observer*>& observers);

} // namespace billet::study
