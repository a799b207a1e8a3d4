// What has been written and found of a run so far: what a run that is resumed goes on with.

#pragma once

#include "io/results/largest_force.h"
#include "io/results/pvd.h"
#include "process/reports/run_reports.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace billet::io {

/// Of a tool that no contact point has met so far.
struct UnmetTool {
  bool acts = false; ///< it has, at some time
  bool met = false;
  double depth = 0.0; ///< of the deepest point of a face found in it [mm]
  double time = 0.0;  ///< when one was found first [s]

  template <class Archive> void fields(Archive& archive) { archive(acts, met, depth, time); }
};

struct RunRecord {
  std::string scene;            ///< its fingerprint at the start
  std::uintmax_t log_size = 0;  ///< of run.log when the run was stored [byte]
  std::size_t history_rows = 0; ///< in history.csv
  std::size_t iteration_rows = 0;
  std::vector<PvdEntry> entries; ///< of the list of frames
  int frames = 0;
  double last_frame = 0.0;                      ///< time of it [s]
  std::optional<process::IncrementReport> last; ///< increment
  std::string ledger;                           ///< what remesh.csv holds
  std::vector<std::string> complaints;          ///< about remeshings
  std::vector<LargestForce> largest_forces;     ///< shape (n_tools)
  double largest_penetration = 0.0;             ///< [mm]
  double largest_share = 0.0;                   ///< of it, of the parent element [-]
  std::vector<UnmetTool> unmet;                 ///< shape (n_tools)
  double most_missed = 0.0;    ///< by the balance of energy in one increment [N mm]
  double most_missed_at = 0.0; ///< end of that increment [s]
  std::optional<process::IncrementReport> worn; ///< the first with a bad mesh that nothing replaces
  std::optional<double> squeezed_at; ///< time at which the metal had first no way out [s]

  template <class Archive> void fields(Archive& archive) {
    archive(scene, log_size, history_rows, iteration_rows, entries, frames, last_frame, last,
            ledger, complaints, largest_forces, largest_penetration, largest_share, unmet,
            most_missed, most_missed_at, worn, squeezed_at);
  }
};

} // namespace billet::io
