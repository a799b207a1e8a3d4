// A case: what a case file says, validated, with every default filled in.
//
// Plain data between the case file (read_case.h) and the scene that is built from it. All numbers
// are in the unit system `units` of the case; angles are degrees, angular speeds rad/s. Vectors
// have three components: in a scene of the plane z is 0, and the axis of a rotation is z.
//
// Files   a path is kept as it was given and as it was found (relative to the case file).
// Format  docs/guide/case-file.md

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/time_function.h"
#include "io/case/case_tool.h"
#include "io/case/case_workpiece.h"
#include "mechanics/equilibrium/analysis.h"
#include "mechanics/linear/solver_settings.h"
#include "process/scene/measure.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace billet::io {

using mechanics::Analysis;

/// The system of units of all numbers of a case, and the labels to print next to them.
struct UnitSystem {
  std::string name = "mm-N-s-MPa-degC"; ///< as in the case file
  std::string length = "mm";
  std::string force = "N";
  std::string time = "s";
  std::string stress = "MPa";
  std::string temperature = "degC";
  int length_power = -3; ///< one unit of length is 10^length_power m

  bool operator==(const UnitSystem&) const = default;
};

/// Fixed or moved nodes; a component is in `fix` or in `move`, never in both.
struct Support {
  std::string name; ///< its force is reported; empty: it is not
  Where where;
  std::array<bool, 3> fix = {false, false, false};
  std::array<std::optional<TimeFunction>, 3> move; ///< displacement [mm]

  bool operator==(const Support&) const = default;
};

/// Pressure that follows the surface, positive inward.
struct PressureLoad {
  TimeFunction pressure; ///< [MPa]

  bool operator==(const PressureLoad&) const = default;
};

/// Force per area in a fixed direction.
struct TractionLoad {
  Vec3 traction;          ///< [MPa]
  TimeFunction amplitude; ///< factor on `traction` [-]; default 1

  bool operator==(const TractionLoad&) const = default;
};

/// Force per volume.
struct BodyForce {
  Vec3 force;             ///< [N/mm^3]
  TimeFunction amplitude; ///< factor on `force` [-]; default 1

  bool operator==(const BodyForce&) const = default;
};

struct Load {
  Where where;
  std::variant<PressureLoad, TractionLoad, BodyForce> kind;

  bool operator==(const Load&) const = default;
};

enum class ContactForm { mixed, compatible };
enum class ContactMethod { penalty, augmented };
enum class ContactIntegrator { radial, midpoint, exact };

/// Contact of the workpiece with itself.
struct SelfContact {
  bool on = true;
  Friction friction;

  bool operator==(const SelfContact&) const = default;
};

/// A gas in pockets that metal closes off on a tool.
struct TrappedGas {
  double pressure = 0.0; ///< of the surroundings, absolute [MPa]
  double exponent = 1.0; ///< [-]

  bool operator==(const TrappedGas&) const = default;
};

/// A lubricant there.
struct TrappedLubricant {
  double bulk_modulus = 0.0; ///< [MPa]

  bool operator==(const TrappedLubricant&) const = default;
};

using Trapped = std::variant<TrappedGas, TrappedLubricant>;

struct ContactSettings {
  /// Absent, which no case is that was read: mixed, or compatible where the part is meshed anew in
  /// the plane.
  std::optional<ContactForm> form;
  ContactMethod method = ContactMethod::penalty;
  double penalty = 100.0;                ///< multiple of adjacent stiffness / element size [-]
  double penalty_tangent = 10.0;         ///< the same, tangential [-]
  std::optional<double> max_penetration; ///< [mm]
  ContactIntegrator integrator = ContactIntegrator::radial;
  std::optional<int> substeps;  ///< of the midpoint integrator; absent: as many as needed
  std::optional<Where> surface; ///< where the workpiece may touch; absent: all free faces
  SelfContact self;
  std::optional<Trapped> trapped; ///< absent: pockets stay empty

  bool operator==(const ContactSettings&) const = default;
};

/// One operation of a chain; it lasts from the end of the last one to `end`.
struct Stage {
  std::string name;
  double end = 0.0;                              ///< [s]
  std::optional<std::vector<std::string>> tools; ///< those that act; absent: all
  bool unload = false;                           ///< the tools leave, the part springs back

  bool operator==(const Stage&) const = default;
};

/// Sizes of the increments of time; what is absent the run chooses.
struct Increments {
  std::optional<double> first; ///< [s]
  std::optional<double> min;   ///< [s]
  std::optional<double> max;   ///< [s]
  double refine = 1.0;         ///< as many more of them, where first and max are not given [-]

  bool operator==(const Increments&) const = default;
};

struct TimeSettings {
  double end = 0.0; ///< [s]; the end of the last stage where there are stages
  Increments increments;

  bool operator==(const TimeSettings&) const = default;
};

enum class Accuracy { draft, standard, fine };

struct SolverSettings {
  mechanics::SolverChoice linear = mechanics::SolverChoice::automatic;
  double tolerance = 1e-6;    ///< relative residual; by default that of `accuracy` [-]
  std::optional<int> threads; ///< absent: all of the machine
  Accuracy accuracy = Accuracy::standard;

  bool operator==(const SolverSettings&) const = default;
};

/// When and how fine to mesh anew.
struct Remesh {
  std::optional<double> quality;      ///< below this element quality [-]
  std::optional<double> interval;     ///< after this much time [s]
  std::optional<double> penetration;  ///< above this penetration between points [mm]
  std::optional<double> strain;       ///< after this much plastic strain at a point [-]
  std::optional<double> size_default; ///< element sizes [mm]
  std::optional<double> size_min;     ///< [mm]
  std::optional<double> size_max;     ///< [mm]
  std::optional<double> size_contact; ///< [mm]
  std::optional<std::string> element; ///< of the new mesh
  std::vector<std::string> keep;      ///< names of sets, without "set:"
  std::optional<bool> weld;           ///< folds, in the plane; absent: where no self-contact is

  bool operator==(const Remesh&) const = default;
};

/// What ends a run before `time.end`.
struct StopSettings {
  bool on_full_cavity = true;
  bool on_tools_overloaded = true;
  bool on_tools_together = true; ///< but for a film of metal
  std::optional<double> on_lap;  ///< deeper than this [mm]

  bool operator==(const StopSettings&) const = default;
};

enum class FieldSet { standard, all };

/// When a run is stored to go on from.
struct CheckpointInterval {
  double length = 600.0;  ///< [s]; infinite: only at the end of stages, of the run, and at signals
  bool wall_clock = true; ///< else time of the process

  bool operator==(const CheckpointInterval&) const = default;
};

struct OutputSettings {
  std::optional<double> every; ///< a frame after this much time [s]; absent: 1/25 of the run
  std::vector<double> at;      ///< frames at exactly these times, increasing [s]
  std::variant<FieldSet, std::vector<std::string>> fields = FieldSet::standard;
  CheckpointInterval checkpoint_every;

  bool operator==(const OutputSettings&) const = default;
};

using MeasureKind = process::Measure::Kind;

/// A figure of the part's shape, followed as a column of history.csv.
struct Measure {
  std::string name = {};
  MeasureKind kind = MeasureKind::height;
  Vec3 point = Vec3::Zero();           ///< on the line of radii; of scenes in space [mm]
  Vec3 axis = Vec3::UnitY();           ///< of radii, any length
  Vec3 direction = Vec3::UnitY();      ///< of height and reach, any length
  std::string tool = {};               ///< that is touched; empty: the kind asks for none
  std::optional<double> touching = {}; ///< gap up to which the surface touches [mm]
  std::optional<Box> within = {};      ///< what counts, or the cavity's box [mm]

  bool operator==(const Measure&) const = default;
};

/// Everything a case file says.
struct Case {
  std::string title;
  UnitSystem units;
  Analysis analysis = Analysis::plane_strain;
  std::optional<double> temperature; ///< of the workpiece [degC]; absent: nothing asks for it
  Workpiece workpiece;
  std::map<std::string, Material> materials; ///< by name; holds `workpiece.material`
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Tool> tools; ///< names are unique
  ContactSettings contact;
  TimeSettings time;
  std::vector<Stage> stages; ///< ends increase; empty: one operation until `time.end`
  SolverSettings solver;
  std::optional<Remesh> remesh;
  std::vector<Measure> measures; ///< names are unique
  StopSettings stop;
  OutputSettings output;

  bool operator==(const Case&) const = default;

  /// 2 in the plane, 3 in space.
  [[nodiscard]] int dimension() const { return analysis == Analysis::solid ? 3 : 2; }
};

} // namespace billet::io
