// A scene: everything a forming process needs, in plain values, checked before it gets here.
//
// Units are those of the case; results do not depend on which.

#pragma once

#include "contact/surface/contact_surface.h"
#include "contact/tools/tool.h"
#include "geometry/base/time_function.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/linear/linear_solver.h"
#include "mechanics/mesh/mesh.h"
#include "process/scene/measure.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace billet::process {

using mechanics::Index;

/// Nodes of which one component follows a displacement over time (0: fixed).
struct Support {
  std::vector<Index> nodes;
  int component;
  TimeFunction displacement; ///< [mm]
  std::string name = {};     ///< its force is reported; empty: it is not

  template <class Archive> void fields(Archive& archive) {
    archive(nodes, component, displacement, name);
  }
};

/// Pressure on faces, following them.
struct PressureOn {
  std::vector<mechanics::Face> faces;
  TimeFunction pressure; ///< [MPa]

  template <class Archive> void fields(Archive& archive) { archive(faces, pressure); }
};

/// What nodal forces come from, for another mesh of the part: tractions on faces, or a body force.
struct DeadForceDensity {
  std::vector<mechanics::Face> faces;
  std::vector<Vec3> tractions; ///< on each, per area of the mesh as it was made [MPa]
  Vec3 body = Vec3::Zero();    ///< per volume of that mesh [N/mm^3]

  template <class Archive> void fields(Archive& archive) { archive(faces, tractions, body); }
};

/// Nodal forces with an amplitude over time.
struct DeadForces {
  std::vector<double> forces; ///< shape (n_dofs) [N]
  TimeFunction amplitude;     ///< [-]
  DeadForceDensity density{}; ///< empty: of single nodes

  template <class Archive> void fields(Archive& archive) { archive(forces, amplitude, density); }
};

using LoadSpec = std::variant<PressureOn, DeadForces>;

/// The faces on which a load acts; empty: on the whole part or on single nodes.
[[nodiscard]] const std::vector<mechanics::Face>& faces_of(const LoadSpec& load);
[[nodiscard]] std::vector<mechanics::Face>& faces_of(LoadSpec& load);

/// One operation; it lasts from the end of the one before.
struct Stage {
  std::string name;
  double end;              ///< [s]
  std::vector<char> tools; ///< which tools act, one flag a tool
  bool unload = false;     ///< the tools leave and the part springs back
};

/// Sizes of increments; what is absent follows from the length of the stage.
struct IncrementLimits {
  std::optional<double> first; ///< [s]
  std::optional<double> min;   ///< [s]
  std::optional<double> max;   ///< [s]
  double share = 1.0;          ///< of the usual first and longest ones, where not given [-]
};

/// First and longest increment of a stage where the case does not say [s]. (P.1)
/// Metal that follows the rate of flow resists at once: the trapezoid of the first increment's work
/// misses half of it.
[[nodiscard]] constexpr double default_first(double length, bool follows_rate) {
  return length / (follows_rate ? 1000.0 : 100.0);
}
[[nodiscard]] constexpr double default_longest(double length) { return length / 50.0; }

/// Share of a stage over which the forces of a tool fade that leaves where it begins, or within it.
inline constexpr double fade_share = 0.05;

/// When the part is meshed anew, and how finely. What is absent follows from the mesh at the start.
struct RemeshSettings {
  std::optional<double> quality;      ///< as soon as an element is worse [-]
  std::optional<double> strain;       ///< ... the plastic strain at a point has grown by this [-]
  std::optional<double> interval;     ///< ... this much time has passed [s]
  std::optional<double> penetration;  ///< ... a face lies deeper in a tool [mm]
  std::optional<double> size;         ///< sides of the new mesh [mm]
  std::optional<double> size_min;     ///< [mm]
  std::optional<double> size_max;     ///< [mm]
  std::optional<double> size_contact; ///< where a tool touches [mm]
  std::vector<std::string> keep;      ///< node sets whose nodes stay corners
  bool weld = true; ///< folds may be welded that no mesh is fine enough for, in the plane
};

/// The workpiece: its mesh, and what refers to nodes and faces of it. A new mesh makes a new part.
struct Part {
  mechanics::Analysis analysis = mechanics::Analysis::plane_strain;
  mechanics::Mesh mesh;
  std::vector<Support> supports;
  std::vector<LoadSpec> loads;
  std::vector<mechanics::Face> contact_faces; ///< that tools may touch

  /// But for the analysis, which is the case's.
  template <class Archive> void fields(Archive& archive) {
    archive(mesh, supports, loads, contact_faces);
  }
};

/// What ends a run before its time.
struct StopRules {
  bool on_full_cavity = true;
  bool on_tools_overloaded = true;
  double bearable = HUGE_VAL;        ///< mean pressure of a tool, over it that is [MPa]
  bool on_tools_together = true;     ///< but for a film of metal
  std::optional<double> on_lap = {}; ///< deeper than this [mm]
};

struct Scene {
  std::string title;
  Part part; ///< at the start
  mechanics::Material material;
  std::vector<contact::Tool> tools;
  std::vector<char> touch; ///< tools to be brought to first contact, one flag a tool
  contact::ContactSettings contact;
  std::vector<Stage> stages; ///< at least one
  IncrementLimits increments;
  std::vector<double> landing_times;    ///< times an increment must end at, sorted [s]
  std::vector<double> hand_overs;       ///< a tool's load grows from then on as others fade [s]
  std::vector<Measure> measures;        ///< columns of history.csv
  std::optional<RemeshSettings> remesh; ///< none: the mesh of the start serves to the end
  StopRules stop;
  double tolerance = 1e-6;
  mechanics::SolverSettings solver;
};

/// Rigid motions that the supports leave free (the contact may still stop them).
[[nodiscard]] int free_rigid_motions(const Part& part);

/// Which rigid motions the supports leave free, along and about the axes. In the plane z is left
/// out and turns are about z.
struct FreeMotions {
  std::array<bool, 3> along = {false, false, false}; ///< shifts
  std::array<bool, 3> about = {false, false, false}; ///< turns about some line of that direction
};
[[nodiscard]] FreeMotions free_motions(const Part& part);

/// Diameter of the ball about the mean of the nodes that holds the part [mm]: a length that does
/// not depend on how the part lies in space, as that of its box does.
[[nodiscard]] double body_size(const mechanics::Mesh& mesh);

} // namespace billet::process
