// A rigid tool of a case: surface, place, motion, friction, wear.
//
// Units   those of the case (mm, MPa, N, s here); angles degrees, angular speeds rad/s.
// Frame   surfaces are given in the case's frame before `place`; motions in the case's frame.

#pragma once

#include "contact/friction/any_friction_law.h"
#include "io/case/case_common.h"

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace billet::io {

/// Half-space below a plane.
struct PlaneSurface {
  Vec3 point = Vec3::Zero();   ///< [mm]
  Vec3 normal = Vec3::UnitY(); ///< out of the tool, not zero, of any length

  bool operator==(const PlaneSurface&) const = default;
};

/// A circle of the plane.
struct CircleSurface {
  Vec3 centre = Vec3::Zero(); ///< [mm]
  double radius = 0.0;        ///< [mm]
  bool inside = false;        ///< the metal is inside

  bool operator==(const CircleSurface&) const = default;
};

/// An endless cylinder.
struct CylinderSurface {
  Vec3 point = Vec3::Zero(); ///< on the axis [mm]
  Vec3 axis = Vec3::UnitZ(); ///< not zero, of any length
  double radius = 0.0;       ///< [mm]
  bool inside = false;       ///< the metal is inside

  bool operator==(const CylinderSurface&) const = default;
};

struct SphereSurface {
  Vec3 centre = Vec3::Zero(); ///< [mm]
  double radius = 0.0;        ///< [mm]
  bool inside = false;        ///< the metal is inside

  bool operator==(const SphereSurface&) const = default;
};

/// One nappe of a cone, opening from `apex` along `axis`.
struct ConeSurface {
  Vec3 apex = Vec3::Zero();  ///< [mm]
  Vec3 axis = Vec3::UnitZ(); ///< not zero, of any length
  double half_angle = 0.0;   ///< [degrees], 0 < half_angle < 90
  bool inside = false;       ///< the metal is inside

  bool operator==(const ConeSurface&) const = default;
};

struct TorusSurface {
  Vec3 centre = Vec3::Zero(); ///< [mm]
  Vec3 axis = Vec3::UnitZ();  ///< not zero, of any length
  double major = 0.0;         ///< radius of the centre line [mm]
  double minor = 0.0;         ///< radius of the tube, < major [mm]
  bool inside = false;        ///< the metal is inside

  bool operator==(const TorusSurface&) const = default;
};

/// A profile turned about an axis: (height along the axis from `point`, radius); the tool lies on
/// the left of the direction of travel.
struct RevolutionSurface {
  Vec3 point = Vec3::Zero();        ///< where the height is zero [mm]
  Vec3 axis = Vec3::UnitZ();        ///< not zero, of any length
  std::optional<InputFile> profile; ///< lines and arcs; absent: `points`
  std::vector<Vec2> points;         ///< straight lines, shape (n >= 2), neighbours differ [mm]
  bool closed = false;              ///< of `points`: a line leads from the last to the first
  bool flip = false;                ///< the tool lies on the right

  bool operator==(const RevolutionSurface&) const = default;
};

/// A file of lines and arcs in the plane; the tool lies on the left of the direction of travel.
struct ProfileSurface {
  InputFile file;
  bool flip = false; ///< the tool lies on the right

  bool operator==(const ProfileSurface&) const = default;
};

/// A chain of straight lines in the plane; the tool lies on the left of the direction of travel.
struct PointsSurface {
  std::vector<Vec3> points; ///< shape (n >= 2), neighbours differ [mm]
  bool closed = false;      ///< a line leads from the last point to the first
  bool flip = false;        ///< the tool lies on the right

  bool operator==(const PointsSurface&) const = default;
};

/// A triangulated surface.
struct StlSurface {
  InputFile file;
  std::string unit;            ///< of the file's numbers, as given ("mm")
  double unit_factor = 1.0;    ///< from the file's numbers to the case's lengths [mm]
  bool smooth = false;         ///< curved triangles in place of flat ones
  double feature_angle = 30.0; ///< edges sharper than this stay sharp [degrees]
  bool flip = false;           ///< the file's normals point into the tool

  bool operator==(const StlSurface&) const = default;
};

/// A surface out of CAD, which knows its unit.
struct StepSurface {
  InputFile file;
  double unit_factor = 1.0;          ///< from mm to the case's lengths
  std::optional<double> chord_error; ///< of its triangles; none: a share of its size [mm]
  bool smooth = true;                ///< curved triangles in place of flat ones
  double feature_angle = 30.0;       ///< edges sharper than this stay sharp [degrees]
  bool flip = false;                 ///< the file's normals point into the tool

  bool operator==(const StepSurface&) const = default;
};

using ToolSurface = std::variant<PlaneSurface,
                                 CircleSurface,
                                 CylinderSurface,
                                 SphereSurface,
                                 ConeSurface,
                                 TorusSurface,
                                 RevolutionSurface,
                                 ProfileSurface,
                                 PointsSurface,
                                 StlSurface,
                                 StepSurface>;

/// A constant velocity.
struct VelocityMotion {
  Vec3 velocity = Vec3::Zero(); ///< [mm/s]

  bool operator==(const VelocityMotion&) const = default;
};

/// A displacement by table; the three functions share their times.
struct DisplacementMotion {
  std::array<TimeFunction, 3> displacement; ///< [mm]

  bool operator==(const DisplacementMotion&) const = default;
};

/// Free to move along `direction` under a force.
struct ForceMotion {
  Vec3 direction = Vec3::UnitY(); ///< not zero, of any length
  TimeFunction value;             ///< [N]

  bool operator==(const ForceMotion&) const = default;
};

/// The slide of a crank press: 0 at top dead centre.
struct CrankMotion {
  Vec3 direction = Vec3::UnitY(); ///< of the slide to bottom dead centre, not zero, of any length
  double radius = 0.0;            ///< of the crank, half the stroke [mm]
  double rod = 0.0;               ///< of the connecting rod, > radius [mm]
  TimeFunction speed;             ///< of the crank, >= 0 [rad/s]
  double start = 0.0;             ///< crank angle at time 0 [degrees]

  bool operator==(const CrankMotion&) const = default;
};

/// What presses given by their energy have in common.
struct StrikingPress {
  Vec3 direction = Vec3::UnitY(); ///< of the blow, not zero, of any length
  double efficiency = 1.0;        ///< share of the energy that the workpiece can have [-]
  TimeFunction force;             ///< that drives the ram on, its weight for one [N]

  bool operator==(const StrikingPress&) const = default;
};

/// A ram that flies freely.
struct HammerMotion {
  StrikingPress press;
  double mass = 0.0;     ///< of all that moves [t]
  double velocity = 0.0; ///< at which it strikes [mm/s]

  bool operator==(const HammerMotion&) const = default;
};

/// A ram on a screw that a flywheel turns.
struct ScrewMotion {
  StrikingPress press;
  double inertia = 0.0; ///< of flywheel and screw about their axis [t mm^2]
  double pitch = 0.0;   ///< way of the ram for one turn [mm]
  double speed = 0.0;   ///< of the flywheel when the blow begins [rad/s]
  double mass = 0.0;    ///< of the ram [t]

  bool operator==(const ScrewMotion&) const = default;
};

using PressMotion = std::variant<CrankMotion, HammerMotion, ScrewMotion>;

/// A prescribed turn; the axis travels with the translation.
struct RotationMotion {
  Vec3 point = Vec3::Zero(); ///< on the axis [mm]
  Vec3 axis = Vec3::UnitZ(); ///< not zero, of any length; z in the plane
  TimeFunction speed;        ///< right-handed about `axis` [rad/s]

  bool operator==(const RotationMotion&) const = default;
};

/// Free to turn about the axis under a torque.
struct TorqueMotion {
  Vec3 point = Vec3::Zero(); ///< on the axis [mm]
  Vec3 axis = Vec3::UnitZ(); ///< not zero, of any length; z in the plane
  TimeFunction value;        ///< right-handed about `axis` [N mm]

  bool operator==(const TorqueMotion&) const = default;
};

/// How a tool moves; both parts absent: it is fixed.
struct ToolMotion {
  std::optional<std::variant<VelocityMotion, DisplacementMotion, ForceMotion, PressMotion>>
      translation;
  std::optional<std::variant<RotationMotion, TorqueMotion>> rotation;

  bool operator==(const ToolMotion&) const = default;
};

/// The friction laws; their keys, units and bounds are listed in their headers.
using FrictionLaw = contact::AnyFrictionLaw;

/// A law's coefficient on a grid; an empty axis does not matter.
struct FrictionTable {
  std::vector<double> pressure; ///< [MPa]
  std::vector<double> speed;    ///< of sliding [mm/s]
  std::vector<double> sliding;  ///< distance [mm]
  std::vector<double> values;   ///< [-], the last axis running fastest; empty: no table

  bool operator==(const FrictionTable&) const = default;
};

struct Friction {
  FrictionLaw law;
  std::optional<std::array<std::array<double, 2>, 2>> tensor; ///< anisotropy
  std::optional<Vec3> direction;                              ///< of the tensor's first axis
  std::vector<std::pair<double, double>> evolution; ///< (sliding distance [mm], factor [-])
  FrictionTable table;                              ///< in place of the coefficient

  bool operator==(const Friction&) const = default;
};

/// Archard's law.
struct Wear {
  double K = 0.0;                    ///< of the tool [-]
  double hardness = 0.0;             ///< of the tool [MPa]
  std::optional<double> K_workpiece; ///< with the material's hardness; absent: not asked for [-]
  double strokes = 1.0;              ///< to extrapolate the tool's wear to

  bool operator==(const Wear&) const = default;
};

struct Tool {
  std::string name;
  ToolSurface surface;
  Place place;
  ToolMotion motion;
  bool touch = false; ///< brought to first contact along its motion before the start
  Friction friction;  ///< default: frictionless
  std::optional<Wear> wear;
  std::optional<std::array<double, 2>> active; ///< from, to [s]; absent: always
  std::string said_at; ///< where the case names it, for messages: "case.toml:12:1"

  bool operator==(const Tool& other) const {
    return std::tie(name, surface, place, motion, touch, friction, wear, active) ==
           std::tie(other.name, other.surface, other.place, other.motion, other.touch,
                    other.friction, other.wear, other.active);
  }
};

} // namespace billet::io
