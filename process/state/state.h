// The state of a run: what it cannot go on without, as plain values.
//
// No references into scene or model, and no pointers but to the part, a constant that copies share:
// it can be copied, stored and read. What is built
// on the mesh keeps a state of its own (mechanics::Bulk, contact::ContactTerm, ...), which a
// checkpoint holds next to this one.
//
// Units: those of the case.

#pragma once

#include "contact/self/self_state.h"
#include "contact/term/contact_term.h"
#include "contact/trapped/trapped_term.h"
#include "contact/wear/process_window.h"
#include "geometry/base/time_function.h"
#include "process/control/increment_control.h"
#include "process/reports/energy_balance.h"
#include "process/reports/run_reports.h"
#include "process/scene/scene.h"
#include "process/state/wall.h"
#include "process/tools/flight.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace billet::process {

/// Where a run was at the end of an increment: a new mesh may go on from there. (P.19), (P.20)
struct Snapshot {
  double time = 0.0;     ///< [s]
  int increment = 0;     ///< the last one before it
  std::vector<double> x; ///< of the nodes, then of driven tools
  std::vector<mechanics::PointState> states;
  std::vector<double> temperatures; ///< of the points; empty: isothermal [degC]
  std::vector<double> velocity;     ///< of the nodes in the increment that ended there [mm/s]
  std::vector<double> last_step;    ///< of x in it; empty: the next one begins from x [mm]
  double last_dt = 0.0;             ///< its length [s]
  std::vector<double> plastic_rate; ///< of the points [1/s]
  contact::ContactSnapshot contact;
  contact::SelfContactSnapshot self_contact;
  contact::TrappedSnapshot trapped;
  double reference_volume = 0.0; ///< the part's without pressure [mm^3]
  double plastic_work = 0.0;     ///< done so far [N mm]
  double support_work = 0.0;     ///< done so far [N mm]
  double load_work = 0.0;        ///< done so far [N mm]
  double stabilization = 0.0;    ///< lost so far [N mm]

  template <class Archive> void fields(Archive& archive) {
    archive(time, increment, x, states, temperatures, velocity, last_step, last_dt, plastic_rate,
            contact, self_contact, trapped, reference_volume, plastic_work, support_work, load_work,
            stabilization);
  }
};

/// A mesh that was wanted and could not be made.
struct Refusal {
  double time = 0.0; ///< [s]
  std::string why;

  template <class Archive> void fields(Archive& archive) { archive(time, why); }
};

/// A tool that began to act where the workpiece was.
struct InitialPenetration {
  std::size_t tool = 0;
  double time = 0.0; ///< at the end of that increment [s]
  std::string where; ///< how deep, and at which place
  int increment = 0; ///< the last one before it

  template <class Archive> void fields(Archive& archive) { archive(tool, time, where, increment); }
};

/// Where a tool has been the deepest in the part so far, relative to the element there: to its
/// depth or the length of its face, whichever is larger, or to the shortest edges asked for.
struct DeepestTool {
  double share = 0.0;     ///< of the element, without what an end is ahead of its points [-]
  double depth = 0.0;     ///< of the deepest point found [mm]
  double at_points = 0.0; ///< of the deepest contact point then [mm]
  double time = 0.0;      ///< [s]
  std::size_t tool = 0;
  Vec3 place = Vec3::Zero(); ///< in space [mm]

  template <class Archive> void fields(Archive& archive) {
    archive(share, depth, at_points, time, tool, place);
  }
};

/// Works that the balance of energy sums up [N mm].
struct Works {
  double most = 0.0; ///< that any of its larger terms has been
  double supports = 0.0;
  double loads_before = 0.0; ///< of loads on earlier meshes
  double tools_gone = 0.0;   ///< of penalties, gone with tools that left

  template <class Archive> void fields(Archive& archive) {
    archive(most, supports, loads_before, tools_gone);
  }
};

/// Forces that increments are judged by.
struct ForceRecord {
  double largest = 0.0;                 ///< of a tool or at an unknown of a support so far [N]
  std::vector<double> before;           ///< on all tools, before the last increment [N]
  std::vector<double> largest_on_tools; ///< on all tools, largest since they touched nothing [N]
  std::vector<char> acted; ///< tools in the last increment that was tried, one flag a tool

  template <class Archive> void fields(Archive& archive) {
    archive(largest, before, largest_on_tools, acted);
  }
};

/// How the stabilization of free motions gets lighter.
struct StabilizationRecord {
  int failures = 0; ///< to do with a lighter one, in a row
  int wait = 0;     ///< increments until that is tried again

  template <class Archive> void fields(Archive& archive) { archive(failures, wait); }
};

/// Tools that leave the part. (P.5), (P.5a)
struct LeavingTools {
  /// Forces of a tool that has left, which fade.
  struct Forces {
    std::vector<double> nodal; ///< shape (n_dofs) [N]
    double from = 0.0;         ///< whole at that time [s]
    double until = 0.0;        ///< gone [s]

    template <class Archive> void fields(Archive& archive) { archive(nodal, from, until); }
  };
  std::vector<Forces> decaying;
  double decay_until = 0.0;            ///< [s]
  std::vector<std::size_t> retreating; ///< tools whose surfaces draw back
  double retreat_begins = 0.0;         ///< [s]
  double retreat_ends = 0.0;           ///< [s]
  double flow_in_decay = 0.0;          ///< plastic work while nothing but such forces acted [N mm]

  template <class Archive> void fields(Archive& archive) {
    archive(decaying, decay_until, retreating, retreat_begins, retreat_ends, flow_in_decay);
  }
};

/// Flights of the run. (P.31)
struct FlightRecord {
  std::optional<Flight> now;
  std::size_t mesh = 0;     ///< remeshings before it began
  double none_before = 0.0; ///< one has failed [s]
  double flown = 0.0;       ///< time spent in flights [s]

  template <class Archive> void fields(Archive& archive) { archive(now, mesh, none_before, flown); }
};

/// The present mesh when it was new, and what has become of it.
struct MeshRecord {
  double first_side = 0.0;              ///< of the elements of the first mesh [mm]
  double shortest = 0.0;                ///< of the edges asked for; 0: the first mesh [mm]
  double quality = 1.0;                 ///< of the worst element [-]
  double aspect = 1.0;                  ///< the largest of its elements [-]
  double excess = 0.0;                  ///< of the edge most outgrown [-]
  double coarse = 0.0;                  ///< coarse_contact() [-]
  double time = 0.0;                    ///< at which it was made [s]
  int increment = 0;                    ///< at which it was made
  std::vector<double> strain;           ///< plastic, at the points [-]
  double share = 0.0;                   ///< relative penetration of its first increment [-]
  int turned_inside_out = 0;            ///< increments refused for that
  std::optional<int> refused_increment; ///< after which the last new mesh could not be made
  double refused_quality = 1.0;         ///< at which the part could not be meshed anew [-]

  template <class Archive> void fields(Archive& archive) {
    archive(first_side, shortest, quality, aspect, excess, coarse, time, increment, strain, share,
            turned_inside_out, refused_increment, refused_quality);
  }
};

/// Where a run is within a stage.
struct StageProgress {
  std::size_t stage = 0;
  bool begun = false;  ///< its tools act, its presses have been started
  double start = 0.0;  ///< of it, or of the rest after a flight [s]
  double length = 0.0; ///< from there to its end [s]
  IncrementControl::Limits limits;
  IncrementControl control;
  std::vector<std::string> tried; ///< of the increment that is being looked for, a line each
  std::string unmeshed;           ///< why the last remeshing was not possible
  int failures = 0;               ///< of that increment
  int refusals = 0;               ///< of it for penetration
  /// While tools draw back points part in rows: where the last increment was cut back, too, halves
  /// would be cut back and back.
  int in_rows = 0;
  int wary = 0;              ///< increments that end before touches: one has been refused lately
  double after_fading = 0.0; ///< length of the increment that follows forces that fade now [s]
  bool rested = false;       ///< nothing moves any more

  template <class Archive> void fields(Archive& archive) {
    archive(stage, begun, start, length, limits, control, tried, unmeshed, failures, refusals,
            in_rows, wary, after_fading, rested);
  }
};

/// Tries and iterations.
struct Counters {
  int iterations = 0;
  int cutbacks = 0;
  int friction_lagged = 0;      ///< increments with friction of the pressure before (F.3a)
  int wasted_iterations = 0;    ///< of tries that failed
  int remeshing_iterations = 0; ///< on new meshes before time went on

  template <class Archive> void fields(Archive& archive) {
    archive(iterations, cutbacks, friction_lagged, wasted_iterations, remeshing_iterations);
  }
};

/// The force on a tool over time, and what of it lay at points that had come to touch within their
/// increment without being expected: they have no friction there. (C.42)
struct TouchRecord {
  double impulse = 0.0;    ///< of the normal force [N s]
  double unexpected = 0.0; ///< of that [N s]

  template <class Archive> void fields(Archive& archive) { archive(impulse, unexpected); }
};

/// What reports tell of a run so far.
struct Record {
  explicit Record(std::size_t n_tools = 0) : window(n_tools), touches(n_tools) {}

  DeepestTool deepest_tool;
  contact::ProcessWindow window;
  std::vector<TouchRecord> touches; ///< shape (n_tools)
  std::vector<RemeshReport> remeshings;
  std::vector<Refusal> refusals;
  std::vector<InitialPenetration> initial_penetrations;
  std::vector<std::string> events; ///< of the last increment
  std::string penalty_event;       ///< a change of the penalty since then
  std::string refusal_event;       ///< a remeshing that was refused since then

  template <class Archive> void fields(Archive& archive) {
    archive(deepest_tool, window, touches, remeshings, refusals, initial_penetrations, events,
            penalty_event, refusal_event);
  }
};

/// Why a run ended.
enum class EndedBy {
  end_of_time,
  energy_used_up, ///< of its presses
  full_cavity,
  tools_overloaded, ///< more than any tool bears
  tools_together,   ///< but for a film of metal
  lap               ///< as deep as the case says
};

struct State {
  explicit State(std::size_t n_tools = 0) : record(n_tools) {}

  std::shared_ptr<const Part> part; ///< the workpiece on its present mesh
  double time = 0.0;                ///< [s]
  int increment = 0;                ///< accepted ones
  double last_dt = 0.0;             ///< of the last one [s]
  double longest = 0.0;             ///< increment of the present stage [s]
  std::vector<double> origins;      ///< of the material at the nodes, shape (n_dofs) [mm]
  std::vector<double> x;            ///< of the nodes, then of driven tools: (n_dofs + n_extra) [mm]
  std::vector<double> last_step;    ///< of x in the last increment; empty: none [mm]
  std::vector<double> velocity;     ///< of the nodes in it, shape (n_dofs) [mm/s]
  std::vector<double> plastic_rate; ///< of the points, shape (n_elements, points) [1/s]
  std::vector<double> reactions;    ///< of the supports, shape (n_dofs) [N]
  EnergyBalance energy;
  Works works;
  ForceRecord forces;
  StabilizationRecord stabilization;
  LeavingTools leaving;
  FlightRecord flights;
  MeshRecord mesh;
  std::vector<Wall> walls;
  std::vector<Snapshot> snapshots; ///< where a new mesh may begin, the earliest first
  StageProgress progress;
  Counters counters;
  Record record;
  bool springs_back = false; ///< the last increment took work out of the metal
  EndedBy ended_by = EndedBy::end_of_time;

  /// But for the part: only a new mesh makes another one than the scene's.
  template <class Archive> void fields(Archive& archive) {
    archive(time, increment, last_dt, longest, origins, x, last_step, velocity, plastic_rate,
            reactions, energy, works, forces, stabilization, leaving, flights, mesh, walls,
            snapshots, progress, counters, record, springs_back, ended_by);
  }
};

} // namespace billet::process
