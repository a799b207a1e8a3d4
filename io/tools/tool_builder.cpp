#include "io/tools/tool_builder.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/revolved_profile.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/tools/profile.h"
#include "io/tools/step.h"
#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "io/tools/stl_tool.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

std::string smoothing_note(const geometry::Smoothing& s, double feature_angle) {
  if (s.curved == 0 && s.kept == 0)
    return fmt::format(
        "nothing to smooth: every edge turns by more than {:g} degrees or not at all",
        feature_angle);
  std::string text = fmt::format(
      "smoothed below {:g} degrees: {} triangles curved, {} flat; chord error {:.3g} before, "
      "about {:.2g} after",
      feature_angle, s.curved, s.flat, s.chord_error, s.remaining_error);
  if (s.kept > 0)
    text += fmt::format("; {} triangles would fold and stay flat", s.kept);
  return text;
}

/// A profile, or the same one run the other way.
geometry::Profile turned(geometry::Profile profile, bool flip) {
  return flip ? geometry::reversed(profile) : std::move(profile);
}

/// A roll of facets lifts off along its flats and digs in with its edges as it turns.
std::string facets_note(const contact::Tool& tool) {
  const bool turns = tool.motion.rotation || tool.motion.torque;
  return fmt::format(
      "{}tool '{}': its facets are off the curved shape that they stand for by up to "
      "{:.2g}; smooth = true curves them{}",
      turns ? "warning: [faceted-roll] " : "", tool.name, tool.chord_error,
      turns ? ". It turns: metal springs back by less than that and loses touch with "
              "each flat, forces can be far too low"
            : "");
}

/// Builds the shape of each kind of surface.
struct SurfaceMaker {
  const std::string& tool;
  double workpiece_size;
  std::vector<std::string>& notes;
  double& chord_error; ///< set where there are facets [mm]

  geometry::SurfacePtr operator()(const PlaneSurface& s) const {
    return geometry::make_plane(s.point, s.normal);
  }
  geometry::SurfacePtr operator()(const CircleSurface& s) const {
    return geometry::make_circle(s.centre, s.radius, s.inside);
  }
  geometry::SurfacePtr operator()(const CylinderSurface& s) const {
    return geometry::make_cylinder(s.point, s.axis, s.radius, s.inside);
  }
  geometry::SurfacePtr operator()(const SphereSurface& s) const {
    return geometry::make_sphere(s.centre, s.radius, s.inside);
  }
  geometry::SurfacePtr operator()(const ConeSurface& s) const {
    return geometry::make_cone(s.apex, s.axis, s.half_angle * degree, s.inside);
  }
  geometry::SurfacePtr operator()(const TorusSurface& s) const {
    return geometry::make_torus(s.centre, s.axis, s.major, s.minor, s.inside);
  }
  geometry::SurfacePtr operator()(const RevolutionSurface& s) const {
    return geometry::make_revolved_profile(
        s.point, s.axis,
        turned(s.profile ? read_profile(s.profile->path) : geometry::polygon(s.points, s.closed),
               s.flip));
  }
  geometry::SurfacePtr operator()(const ProfileSurface& s) const {
    return geometry::make_profile(turned(read_profile(s.file.path), s.flip));
  }
  geometry::SurfacePtr operator()(const PointsSurface& s) const {
    std::vector<Vec2> points;
    for (const Vec3& p : s.points)
      points.emplace_back(p[0], p[1]);
    return geometry::make_profile(turned(geometry::polygon(points, s.closed), s.flip));
  }
  geometry::SurfacePtr operator()(const StlSurface& s) const {
    return triangulated(read_stl(s.file.path), {s.unit_factor, s.flip, s.feature_angle}, s.unit,
                        s.smooth);
  }
  geometry::SurfacePtr operator()(const StepSurface& s) const {
    std::optional<double> chord_error_mm;
    if (s.chord_error)
      chord_error_mm = *s.chord_error / s.unit_factor;
    return triangulated(read_step(s.file.path, chord_error_mm),
                        {s.unit_factor, s.flip, s.feature_angle}, "", s.smooth);
  }

private:
  [[nodiscard]] geometry::SurfacePtr triangulated(const FacetFile& file,
                                                  const StlUse& use,
                                                  const std::string& unit, // empty: no guess
                                                  bool smoothed) const {
    const StlTool mesh = tool_mesh(file, use);
    notes.push_back(fmt::format("tool '{}': {}", tool, report(file, mesh)));
    if (const auto warning = size_warning(mesh.health.bounds.size(), workpiece_size, unit))
      notes.push_back(fmt::format("warning: [stl-size] tool '{}': {}", tool, *warning));
    if (!smoothed) {
      chord_error = geometry::chord_error(mesh.mesh, use.feature_angle * degree);
      return geometry::make_triangle_surface(mesh.mesh);
    }
    geometry::SmoothSurface smooth =
        geometry::make_smooth_triangle_surface(mesh.mesh, use.feature_angle * degree);
    chord_error = smooth.smoothing.remaining_error;
    notes.push_back(
        fmt::format("tool '{}': {}", tool, smoothing_note(smooth.smoothing, use.feature_angle)));
    return std::move(smooth.surface);
  }
};

/// On which side of its surface a tool lies, and how it is turned round.
struct FacingRule {
  std::string operator()(const PlaneSurface&) const {
    return "a plane's normal points out of its tool, to the workpiece";
  }
  std::string operator()(const ProfileSurface&) const { return of_profile; }
  std::string operator()(const PointsSurface&) const { return of_profile; }
  std::string operator()(const RevolutionSurface&) const { return of_profile; }
  std::string operator()(const StlSurface&) const { return of_facets; }
  std::string operator()(const StepSurface&) const { return of_facets; }
  template <class Round> std::string operator()(const Round&) const {
    return "the workpiece is outside of it, or with inside = true within it";
  }

  static constexpr const char* of_profile =
      "a tool lies on the left of the direction in which its profile runs; flip = true puts it on "
      "the right";
  static constexpr const char* of_facets =
      "the facets of a tool face out of it; flip = true turns them round";
};

contact::CoefficientTable evolution_of(const Friction& friction) {
  if (friction.evolution.empty())
    return {};
  std::vector<double> sliding;
  std::vector<double> factors;
  for (const auto& [distance, factor] : friction.evolution) {
    sliding.push_back(distance);
    factors.push_back(factor);
  }
  return {{{{}, {}, std::move(sliding)}}, std::move(factors)};
}

/// What drives a press that strikes: of its energy the workpiece can have a share, which is that of
/// a lighter mass at the same speed. (P.10)
geometry::Drive drive_of(const StrikingPress& press, double mass, double speed) {
  return {Vec3::Zero(), press.direction.normalized(), press.force,
          geometry::Blow{press.efficiency * mass, speed}};
}

/// Sets the part of a motion that each kind of translation stands for.
struct TranslationMaker {
  geometry::Motion& motion;

  void operator()(const VelocityMotion& m) const { motion.velocity = m.velocity; }
  void operator()(const DisplacementMotion& m) const { motion.displacement = m.displacement; }
  void operator()(const ForceMotion& m) const {
    motion.force = geometry::Drive{Vec3::Zero(), m.direction.normalized(), m.value};
  }
  void operator()(const PressMotion& m) const { std::visit(*this, m); }
  void operator()(const CrankMotion& m) const {
    motion.crank =
        geometry::Crank{m.direction.normalized(), m.radius, m.rod, m.start * degree, m.speed};
  }
  void operator()(const HammerMotion& m) const {
    motion.force = drive_of(m.press, m.mass, m.velocity);
  }
  void operator()(const ScrewMotion& m) const {
    const double arm = m.pitch / (2.0 * std::numbers::pi); // way of the ram for a radian
    motion.force = drive_of(m.press, m.mass + m.inertia / (arm * arm), m.speed * arm);
  }
};

geometry::Motion motion_of(const ToolMotion& motion) {
  geometry::Motion result;
  if (motion.translation)
    std::visit(TranslationMaker{result}, *motion.translation);
  if (motion.rotation) {
    if (const auto* turn = std::get_if<RotationMotion>(&*motion.rotation))
      result.rotation = geometry::Rotation{turn->point, turn->axis.normalized(), turn->speed};
    else if (const auto* torque = std::get_if<TorqueMotion>(&*motion.rotation))
      result.torque = geometry::Drive{torque->point, torque->axis.normalized(), torque->value};
  }
  return result;
}

/// A direction normal to a plane has no projection on it.
void check_direction(const Tool& tool) {
  constexpr double smallest = 1e-6; // sine of the angle between them
  const auto* const plane = std::get_if<PlaneSurface>(&tool.surface);
  if (plane == nullptr || !tool.friction.direction)
    return;
  if (plane->normal.normalized().cross(tool.friction.direction->normalized()).norm() < smallest)
    throw Error(Fault::case_file, tool.said_at,
                fmt::format("tool '{}': friction.direction is normal to its plane and tells no "
                            "first axis of the tensor",
                            tool.name),
                "give a direction along the plane");
}

} // namespace

contact::Friction friction_of(const Friction& friction) {
  contact::Friction result = friction.law;
  result.evolution = evolution_of(friction);
  const FrictionTable& table = friction.table;
  if (!table.values.empty())
    result.table = {{{table.pressure, table.speed, table.sliding}}, table.values};
  if (friction.tensor) {
    const auto& q = *friction.tensor;
    result.tensor =
        contact::FrictionTensor{(contact::Mat2() << q[0][0], q[0][1], q[1][0], q[1][1]).finished(),
                                friction.direction->normalized()};
  }
  return result;
}

geometry::Pose pose_of(const Place& place) {
  geometry::Pose pose;
  if (place.rotate)
    pose = geometry::rotation_about(place.rotate->point, place.rotate->axis.normalized(),
                                    place.rotate->degrees * degree);
  pose.translation += place.translate;
  return pose;
}

contact::Tool build_tool(const Tool& tool,
                         Analysis analysis,
                         double workpiece_size,
                         std::vector<std::string>& notes) {
  contact::Tool result;
  result.name = tool.name;
  result.said_at = tool.said_at;
  result.facing = std::visit(FacingRule{}, tool.surface);
  const bool in_space = std::holds_alternative<StlSurface>(tool.surface) ||
                        std::holds_alternative<StepSurface>(tool.surface);
  if (analysis != Analysis::solid && in_space)
    throw Error(
        Fault::geometry, tool.said_at,
        fmt::format("tool '{}': an STL or STEP file is a surface in space; this scene is in "
                    "the plane",
                    tool.name),
        "give the tool as a profile, or make the analysis 3d");
  try {
    result.surface = std::visit(SurfaceMaker{tool.name, workpiece_size, notes, result.chord_error},
                                tool.surface);
  } catch (const Error& error) {
    if (error.fault() != Fault::geometry)
      throw;
    std::vector<Complaint> complaints = error.complaints();
    for (Complaint& complaint : complaints)
      complaint.message = fmt::format("tool '{}': {}", tool.name, complaint.message);
    throw Error(Fault::geometry, std::move(complaints));
  }
  result.motion = motion_of(tool.motion);
  result.motion.place = pose_of(tool.place);
  if (result.motion.rotation)
    result.reference = result.motion.place.to_tool(result.motion.rotation->point);
  if (result.motion.torque)
    result.reference = result.motion.place.to_tool(result.motion.torque->point);
  const auto* stl = std::get_if<StlSurface>(&tool.surface);
  const auto* step = std::get_if<StepSurface>(&tool.surface);
  const bool faceted = (stl != nullptr && !stl->smooth) || (step != nullptr && !step->smooth);
  constexpr double seen = 1e-6; // of the workpiece: less is rounding of the file
  if (faceted && result.chord_error > seen * workpiece_size)
    notes.push_back(facets_note(result));
  check_direction(tool);
  result.friction = friction_of(tool.friction);
  if (tool.active) {
    result.active_from = (*tool.active)[0];
    result.active_to = (*tool.active)[1];
  }
  return result;
}

} // namespace billet::io
