// What a run tells of an increment, of a new mesh, and of where it could not go on.
//
// Plain values; units are those of the case.

#pragma once

#include "contact/term/contact_term.h"
#include "mechanics/equilibrium/newton.h"
#include "process/reports/energy_balance.h"
#include "process/reports/lap.h"
#include "process/tools/drives.h"

#include <array>
#include <string>
#include <vector>

namespace billet::process {

using mechanics::Index;

/// One accepted increment.
struct IncrementReport {
  int increment = 0; ///< from 1
  double time = 0.0; ///< at its end [s]
  double dt = 0.0;   ///< [s]
  int iterations = 0;
  double residual = 0.0;            ///< relative [-]
  int cutbacks = 0;                 ///< tries that failed before it
  double volume = 0.0;              ///< [mm^3]
  double max_penetration = 0.0;     ///< no point of any face is deeper in a tool [mm]
  double penetration_share = 0.0;   ///< nor deeper relative to the parent element [-]
  contact::Penetration penetration; ///< what these two were found with
  double contact_area = 0.0;        ///< [mm^2]
  double max_plastic_strain = 0.0;  ///< [-]
  double min_quality = 0.0;         ///< scaled Jacobian [-]
  double wall_time = 0.0;           ///< since the start of the run [s]
  EnergyBalance energy;
  std::vector<mechanics::IterationRecord> records;
  std::vector<std::string> events; ///< what happened at its end, a line each

  /// But for the records of its iterations, which are in iterations.csv.
  template <class Archive> void fields(Archive& archive) {
    archive(increment, time, dt, iterations, residual, cutbacks, volume, max_penetration,
            penetration_share, penetration, contact_area, max_plastic_strain, min_quality,
            wall_time, energy, events);
  }
};

/// Why an increment could not be solved, for the post-mortem.
struct PostMortem {
  double time = 0.0; ///< that could not be reached [s]
  double dt = 0.0;   ///< shortest increment tried [s]
  std::string reason;
  Index worst_node = -1;              ///< with the largest residual
  Vec3 worst_position = Vec3::Zero(); ///< of that node; without one: of the deepest point [mm]
  std::vector<std::string> tried;     ///< one line a try
  std::vector<DriveState> drives;     ///< tools that loads drive there
  /// Contact points that kept changing in the last tries, those that changed most first.
  std::vector<contact::ChatteringPoint> chattering;
  bool inside_out = false; ///< an element turned inside out in the last try
  bool moves_away = false; ///< nothing held the part in the last try
  bool too_deep = false;   ///< a face lay deeper in a tool than a limit allows
  std::vector<mechanics::IterationRecord> records; ///< of the last try
};

/// What a remeshing may change of a tool's force (RM-01).
constexpr double force_budget = 1e-2;

/// What a remeshing did: its page of the ledger.
struct RemeshReport {
  int number = 0;    ///< from 1
  double time = 0.0; ///< [s]
  int increment = 0; ///< after which it came
  std::string cause;
  /// Of the old mesh and of the new one.
  struct Pair {
    double before = 0.0;
    double after = 0.0;

    /// |after - before| over before [-]; 0 where both are.
    [[nodiscard]] double change() const;

    template <class Archive> void fields(Archive& archive) { archive(before, after); }
  };
  std::array<Index, 2> elements{}; ///< before and after
  std::array<Index, 2> nodes{};    ///< before and after
  Pair quality;                    ///< scaled Jacobian of the worst element [-]
  int again = 0; ///< increments of the past that were solved again on the new mesh
  // Of the state carried over: where these began, or now.
  Pair volume;              ///< [mm^3]
  Pair plastic_work;        ///< of the field of plastic strain [N mm]
  double work_of_run = 0.0; ///< plastic, until now [N mm]
  Pair mean_strain;         ///< plastic, over the volume [-]
  Pair largest_strain;      ///< plastic [-]
  std::vector<Pair> forces; ///< on each tool, now [N]
  double energy = 0.0;      ///< lost by carrying the state over [N mm]
  double residual = 0.0;    ///< of the state carried over, relative [-]
  bool balanced = false;    ///< equilibrium was restored before time went on
  int returned = 0;         ///< points put back onto the yield surface
  double seconds = 0.0;     ///< it took [s]
  std::vector<Lap> laps;    ///< that were welded

  /// Change of the plastic work over itself, or a thousandth of the run's if that is more: a state
  /// from the time of first touch has next to none [-].
  [[nodiscard]] double work_change() const;
  /// Largest change of a tool's force over the largest force [-].
  [[nodiscard]] double force_jump() const;
  /// What goes beyond the budget, one line each; empty: nothing.
  [[nodiscard]] std::vector<std::string> complaints() const;

  template <class Archive> void fields(Archive& archive) {
    archive(number, time, increment, cause, elements, nodes, quality, again, volume, plastic_work,
            work_of_run, mean_strain, largest_strain, forces, energy, residual, balanced, returned,
            seconds, laps);
  }
};

} // namespace billet::process
