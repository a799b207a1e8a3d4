// How a run ended and its final figures: summary.json.

#pragma once

#include "io/results/largest_force.h"
#include "process/loop/process.h"
#include "process/loop/run_checks.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// Facts about the program and the machine for the summary.
struct RunFacts {
  std::string version;   ///< of billet
  std::string blas_core; ///< kernels OpenBLAS chose
  int threads = 1;
  std::vector<std::string> warnings; ///< about the inputs
};

/// How a run ended, for the summary.
struct RunEnd {
  std::string status; ///< "done", "failed-checks", "not-converged", "stopped"
  int exit_status = 0;
  std::vector<process::FailedCheck> failed; ///< checks
};

/// What the summary says in addition to what the process knows.
struct SummaryFacts {
  const std::string& title;
  const std::string& units; ///< name of their system
  const std::string& analysis;
  const RunFacts& facts;
  const RunEnd& end;
  const std::optional<process::IncrementReport>& last; ///< none: there has been no increment
  double largest_penetration;                          ///< of the run [mm]
  double largest_share;                                ///< of the parent element, of the run [-]
  std::span<const LargestForce> largest_forces;        ///< on each tool, shape (n_tools) or none
  std::vector<std::string> warnings;                   ///< about inputs and result
  const std::optional<process::PostMortem>& post;      ///< none: every increment was solved
};

/// Why a run has ended, "end of time" say.
[[nodiscard]] std::string_view words_of(process::EndedBy reason);

/// The text of summary.json.
[[nodiscard]] std::string summary_text(const process::Run& run, const SummaryFacts& about);

} // namespace billet::io
