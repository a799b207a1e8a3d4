// Progress of a run on standard error: a bar on a terminal, one plain line an increment otherwise.

#pragma once

#include "io/case/case.h"
#include "process/loop/process.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace billet::app {

/// Prints increments, keeps the log, ends the run after a signal.
class Progress final : public process::Observer {
public:
  /// @param quiet  no progress on standard error; warnings and what went wrong stay
  Progress(bool quiet, io::UnitSystem units);

  void incremented(const process::Run& run, const process::IncrementReport& report) override;
  void failed(const process::Run& run, const process::PostMortem& post) override;
  void remeshed(const process::Run& run, const process::RemeshReport& report) override;
  void finished(const process::Run& run) override;
  [[nodiscard]] bool stop_requested() const override;

  /// Adds a line to the log and, unless quiet, to standard error.
  void say(const std::string& line);
  /// Prints a line to standard error, unless quiet, but not to the log.
  void say_aside(const std::string& line) const;
  /// Adds a line to the log and to standard error, quiet or not: what went wrong.
  void insist(const std::string& line);
  /// Puts everything said so far into a file and adds every line to it from now on, so that a run
  /// that is killed leaves its log too. From then on a signal ends the run after an increment.
  ///
  /// @param goes_on  length of the file that a resumed run goes on with, in place of what has been
  ///                 said so far [byte]
  /// @throws Error(Fault::input_output), here or when a line cannot be written
  void write_to(std::filesystem::path file, std::optional<std::uintmax_t> goes_on = std::nullopt);

private:
  bool quiet_;
  io::UnitSystem units_;
  bool terminal_;
  void log(const std::string& text);

  std::string log_; ///< until there is a file
  std::filesystem::path path_;
  std::ofstream file_;
};

} // namespace billet::app
