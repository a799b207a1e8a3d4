// What a run is made of, and the checks that it can begin.

#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/loads/loads.h"
#include "process/remeshing.h"
#include "process/run.h"
#include "process/sudden_loads.h"
#include "process/touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace billet::process {

Process::Process(Scene scene)
    : scene_(std::move(scene)), state_(scene_.tools.size()),
      pattern_(mechanics::block_pattern(scene_.mesh)) {
  started_ = seconds_now();
  grow_sudden_loads(scene_);
  for (const Vec3& p : scene_.mesh.points)
    state_.origins.insert(state_.origins.end(), p.data(), p.data() + scene_.mesh.dimension());
  state_.x = state_.origins;
  state_.x.resize(state_.origins.size() + contact::drive_unknowns(scene_.tools).size(), 0.0);
  trial_x_ = state_.x;
  state_.velocity.assign(state_.origins.size(), 0.0);
  state_.reactions.assign(state_.origins.size(), 0.0);
  make_terms();
  if (scene_.remesh)
    start_remeshing();
  start_stage(scene_.stages.front()); // only its tools have to lie right at the start
  if (surface_)
    bring_to_touch(scene_, *surface_, state_.x);
  check_overlap();
  if (contact_) {
    contact_->start(state_.x, 0.0);
    if (contact::Wear::wanted(scene_.tools))
      wear_ = std::make_unique<contact::Wear>(*surface_, scene_.tools, box_of(scene_.mesh.points));
    check_drives();
  }
}

Process::~Process() = default;

void Process::make_terms() {
  bulk_ =
      std::make_unique<mechanics::Bulk>(scene_.mesh, scene_.analysis, scene_.material, pattern_);
  state_.plastic_rate.assign(bulk_->states().size(), 0.0);
  newton_ = std::make_unique<mechanics::Newton>(
      pattern_, scene_.solver,
      mechanics::NewtonSettings{.tolerance = scene_.tolerance,
                                .largest_correction = body_size(scene_.mesh)},
      contact::drive_unknowns(scene_.tools).size());
  terms_ = {bulk_.get()};
  make_loads();
  if (!scene_.tools.empty()) {
    surface_ = std::make_unique<contact::ContactSurface>(scene_.mesh, *bulk_, pattern_,
                                                         scene_.contact_faces, scene_.contact);
    contact_ = std::make_unique<contact::ContactTerm>(*surface_, *bulk_, pattern_, scene_.tools,
                                                      4.0 * body_size(scene_.mesh), drive_scale());
    terms_.push_back(contact_.get());
    narrow_ = std::make_unique<NarrowTools>(scene_, *surface_, state_.x);
  }
  const bool strikes =
      std::any_of(scene_.tools.begin(), scene_.tools.end(), [](const contact::Tool& tool) {
        return tool.motion.force && tool.motion.force->blow;
      });
  if (strikes) {
    blows_ = std::make_unique<Blows>(scene_, *contact_, state_.origins.size());
    terms_.push_back(&blows_->term());
  }
  grounded_ = free_rigid_motions(scene_);
  if (grounded_ > 0 && scene_.tools.empty())
    throw Error(Fault::case_file, "",
                fmt::format("the workpiece can move freely: {} rigid motion(s) are held by no "
                            "support and there is no tool",
                            grounded_),
                "add a [[support]] that holds them");
  if (grounded_ > 0) {
    // Spread over all nodes it is a hundred-millionth of the body's own stiffness.
    constexpr double share = 1e-8;
    stabilization_ = std::make_unique<mechanics::RigidBodyStabilization>(
        share * body_stiffness() / scene_.mesh.n_points(), pattern_);
    terms_.push_back(stabilization_.get());
  }
  newton_->set_force_floor(force_floor(state_.time));
  constexpr double rounding = 1e-16; // of E times the volume: strains of 1e-8
  state_.energy.nothing = rounding * scene_.material.elasticity.young * bulk_->reference_volume();
}

double Process::body_stiffness() const {
  const double young = scene_.material.elasticity.young;
  // Force per length: in plane strain it is that of a slice of unit thickness.
  return scene_.analysis == mechanics::Analysis::plane_strain ? young
                                                              : young * body_size(scene_.mesh);
}

void Process::make_loads() {
  for (const LoadSpec& spec : scene_.loads) {
    if (const auto* pressure = std::get_if<PressureOn>(&spec))
      loads_.push_back(mechanics::make_pressure(scene_.mesh, scene_.analysis, pattern_,
                                                pressure->faces, pressure->pressure));
    else
      loads_.push_back(mechanics::make_dead_load(std::get<DeadForces>(spec).forces,
                                                 std::get<DeadForces>(spec).amplitude));
    terms_.push_back(loads_.back().get());
  }
}

namespace {

/// Whether no candidate face lies in front of a tool: it has the part on the wrong side, most
/// likely. Beyond the ends of an open surface there is no tool.
bool has_all_behind(const contact::Tool& tool,
                    const geometry::Pose& pose,
                    const contact::ContactSurface& surface,
                    std::span<const double> x,
                    double reach) {
  constexpr double touching = 0.02; // of the parent element
  for (Index f = 0; f < surface.n_faces(); ++f)
    for (const Vec3& p : surface.samples(x, f, 1)) {
      const Vec3 at = pose.to_tool(p);
      geometry::Projection foot;
      tool.surface->project(std::span(&at, 1), reach, std::span(&foot, 1));
      if (foot.found() && foot.gap > touching * surface.depth(f))
        return false;
    }
  return true;
}

std::string turned(const contact::Tool& tool) {
  return "the whole workpiece lies inside of the tool, which may be turned" +
         (tool.facing.empty() ? "" : ": " + tool.facing);
}

} // namespace

void Process::check_overlap() const {
  if (!contact_)
    return;
  std::vector<Complaint> complaints;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t)
    if (contact_->acts(t, 0.0))
      if (const std::string where = overlap(t, state_.time); !where.empty())
        complaints.push_back(
            {scene_.tools[t].said_at,
             fmt::format("the workpiece overlaps tool '{}' before the start: {}",
                         scene_.tools[t].name, where),
             has_all_behind(scene_.tools[t], contact_->pose(t, state_.time, state_.x), *surface_,
                            state_.x, body_size(scene_.mesh))
                 ? turned(scene_.tools[t])
                 : "move the tool or the workpiece apart, or give the tool touch = true"});
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
}

std::string Process::overlap(std::size_t tool, double time) const {
  std::string where = depth_in(tool, time);
  return where.empty() && lies_within(tool, time) ? "the tool lies wholly within it" : where;
}

bool Process::lies_within(std::size_t tool, double time) const {
  const mechanics::MeshLocator locator(scene_.mesh, positions());
  const geometry::Pose pose = contact_->pose(tool, time, state_.x);
  bool any = false;
  for (Index f = 0; f < surface_->n_faces(); ++f)
    for (const Vec3& x : surface_->samples(state_.x, f, 1)) {
      const Vec3 at = pose.to_tool(x);
      geometry::Projection foot;
      scene_.tools[tool].surface->project(std::span(&at, 1), body_size(scene_.mesh),
                                          std::span(&foot, 1));
      if (!foot.found())
        continue;
      constexpr double clear = 0.02, inside = 1e-6; // of the parent element
      // A little beneath the tool's surface: one that touches a face has that outside.
      const double depth = surface_->depth(f);
      const Vec3 beneath = pose.to_space(foot.foot - clear * depth * foot.normal);
      if (foot.gap < clear * depth || locator.locate(beneath).distance > inside * depth)
        return false;
      any = true;
    }
  return any;
}

std::string Process::depth_in(std::size_t tool, double time) const {
  // A chord of a curved face may lie a little inside a tool that touches its nodes; a sharp tool
  // that was brought to the contact points of a face may lie deeper between them.
  const bool brought = tool < scene_.touch.size() && scene_.touch[tool] != 0;
  const double allowed_share = brought ? 0.5 : 0.02; // of the parent element
  const geometry::Pose pose = contact_->pose(tool, time, state_.x);
  double deepest = 0.0;
  Vec3 at = Vec3::Zero();
  for (Index f = 0; f < surface_->n_faces(); ++f) {
    std::vector<Vec3> points = surface_->samples(state_.x, f);
    for (Vec3& p : points)
      p = pose.to_tool(p);
    std::vector<geometry::Projection> feet(points.size());
    scene_.tools[tool].surface->project(points, body_size(scene_.mesh), feet);
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (-feet[i].gap > std::max(deepest, allowed_share * surface_->depth(f))) {
        deepest = -feet[i].gap;
        at = pose.to_space(points[i]);
      }
  }
  return deepest > 0.0
             ? fmt::format("{:.6g} deep at ({:.6g}, {:.6g}, {:.6g})", deepest, at[0], at[1], at[2])
             : std::string();
}

contact::DriveScale Process::drive_scale() const {
  // So little beside the body's own stiffness that it carries rounding, never a load, be the body
  // as slender as can be.
  constexpr double share = 1e-12;
  return {body_size(scene_.mesh), share * body_stiffness()};
}

void Process::check_drives() const {
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    const contact::Tool& tool = scene_.tools[t];
    const bool pressed = tool.motion.force && !tool.motion.force->blow; // a blow begins by touching
    if (pressed && contact_->acts(t, 0.0) && !contact::lies_on(*contact_, t))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("tool '{}' is driven by a force but does not touch the workpiece: "
                              "nothing tells where it is",
                              tool.name),
                  "give it touch = true, or place it where it touches");
    if (pressed && contact_->acts(t, 0.0) && is_pulled_off(t))
      throw Error(Fault::case_file, tool.said_at,
                  fmt::format("the force on tool '{}' pulls it off the workpiece: contact pushes "
                              "only, and nothing holds the tool",
                              tool.name),
                  "turn its direction round, or give the force the other sign");
  }
}

} // namespace billet::process
