// Progress of a run on standard error: a bar on a terminal, one plain line an increment otherwise.

#pragma once

#include "process/run.h"

#include <csignal>
#include <string>

namespace billet::app {

/// Prints increments, keeps the log text, ends the run after a signal.
class Progress final : public process::Observer {
public:
  /// @param quiet  nothing on standard error
  explicit Progress(bool quiet);

  void incremented(const process::Process& process,
                   const process::IncrementReport& report) override;
  void failed(const process::Process& process, const process::PostMortem& post) override;
  void finished(const process::Process& process) override;
  [[nodiscard]] bool stop_requested() const override;

  /// Adds a line to the log and, unless quiet, to standard error.
  void say(const std::string& line);
  /// Everything said and every increment, one a line.
  [[nodiscard]] const std::string& log() const { return log_; }
  /// Signal that asked for the end; 0: none.
  [[nodiscard]] static int signal();

private:
  bool quiet_;
  bool terminal_;
  std::string log_;
};

} // namespace billet::app
