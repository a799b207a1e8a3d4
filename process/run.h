// The run loop: a scene through its stages, increment by increment.
//
// An increment moves the tools, solves for equilibrium with contact found anew in every iteration,
// and is accepted or cut back; the step grows on easy increments. Observers look at each accepted
// increment and change nothing. Theory: docs/theory/process.md (P.1)-(P.21).

#pragma once

#include "contact/term/contact_term.h"
#include "contact/wear/process_window.h"
#include "contact/wear/wear.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "geometry/surfaces/retreating_surface.h"
#include "mechanics/equilibrium/newton.h"
#include "mechanics/loads/loads.h"
#include "mechanics/loads/rigid_body_stabilization.h"
#include "process/blows.h"
#include "process/drives.h"
#include "process/energy_balance.h"
#include "process/flight.h"
#include "process/lap.h"
#include "process/narrow_tools.h"
#include "process/observer.h"
#include "process/part_boundary.h"
#include "process/phase_times.h"
#include "process/run_reports.h"
#include "process/scene.h"
#include "process/state.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace billet::geometry {
struct SolidSizes;
}

namespace billet::process {

struct Bend;
struct NewPart;
struct RemeshedPart;
struct SolidPart;
struct CarriedOver;
struct FirstTouch;
struct OutgrownSide;
struct CornerLoad;
struct CarriedState;
struct ToolMeeting;
struct StoredPart;

class Process {
public:
  /// Prepares a scene: brings tools to touch, checks that nothing overlaps and that all is held.
  /// @throws Error (Fault::geometry, Fault::case_file)
  explicit Process(Scene scene);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The run as it is between two increments, in bytes: what `resume` goes on from. The linear
  /// solver forgets, as it has where a run is resumed, so that both go on with the same bits.
  [[nodiscard]] std::string store();
  /// Goes on from where another run of the same scene was stored; before `run`.
  ///
  /// The scene may differ in what is still to come: later stages, the end, settings of the solver.
  /// @throws Error (Fault::input_output) if the bytes are not those of such a run
  void resume(std::string_view stored);

  /// Runs to the end, or to where it cannot go on or an observer stops it; called again it goes on.
  RunStatus run(const std::vector<Observer*>& observers);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] double time() const { return state_.time; }
  [[nodiscard]] const mechanics::Bulk& bulk() const { return *bulk_; }
  [[nodiscard]] const contact::ContactTerm* contact() const { return contact_.get(); }
  [[nodiscard]] const contact::ContactSurface* surface() const { return surface_.get(); }
  /// Pressure, sliding, strain and strain rate on the tools over the run.
  [[nodiscard]] const contact::ProcessWindow& window() const { return state_.record.window; }
  /// Null: no tool has a law of wear.
  [[nodiscard]] const contact::Wear* wear() const { return wear_.get(); }
  /// Committed unknowns: positions and driven tools, shape (n_dofs + n_extra) [mm].
  [[nodiscard]] std::span<const double> unknowns() const { return state_.x; }
  /// Committed positions, shape (n_dofs) [mm].
  [[nodiscard]] std::span<const double> positions() const {
    return std::span(state_.x).first(state_.origins.size());
  }
  /// Positions of the last trial, shape (n_dofs) [mm]; of interest after a failure.
  [[nodiscard]] std::span<const double> trial_positions() const {
    return std::span(trial_x_).first(state_.origins.size());
  }
  /// Where a tool's free degrees of freedom are.
  [[nodiscard]] geometry::Driven driven(std::size_t tool) const {
    return contact_ ? contact_->driven(tool, state_.x) : geometry::Driven{};
  }
  /// Blows of presses given by their energy, in the order in which they began.
  [[nodiscard]] std::span<const BlowReport> blows() const {
    return blows_ ? std::span(blows_->reports()) : std::span<const BlowReport>();
  }
  /// Whether the run has ended before its time because its presses have no energy left.
  [[nodiscard]] bool energy_used_up() const { return state_.energy_used_up; }
  /// Displacement rate of the last increment, shape (n_dofs) [mm/s].
  [[nodiscard]] std::span<const double> velocity() const { return state_.velocity; }
  /// Plastic strain rate of the last increment at the points, shape (n_elements, points) [1/s].
  [[nodiscard]] std::span<const double> plastic_rate() const { return state_.plastic_rate; }
  /// Forces of the supports on the workpiece, shape (n_dofs) [N].
  [[nodiscard]] std::span<const double> reactions() const { return state_.reactions; }
  [[nodiscard]] const EnergyBalance& energy() const { return state_.energy; }
  [[nodiscard]] const PhaseTimes& times() const { return times_; }
  /// Factorizations and substitutions of the run.
  [[nodiscard]] mechanics::SolverWork solver_work() const {
    return newton_->solver_work().after(earlier_work_);
  }
  /// Where the material at the nodes was at the start, shape (n_dofs) [mm].
  [[nodiscard]] std::span<const double> origins() const { return state_.origins; }
  /// Meshes that were wanted and could not be made, in their order.
  [[nodiscard]] std::span<const Refusal> refusals() const { return state_.record.refusals; }
  /// Tools that began to act where the workpiece was.
  [[nodiscard]] std::span<const InitialPenetration> initial_penetrations() const {
    return state_.record.initial_penetrations;
  }
  [[nodiscard]] const DeepestTool& deepest_tool() const { return state_.record.deepest_tool; }
  /// Where tools touch now; in the plane only.
  [[nodiscard]] std::vector<ContactZone> zones_of_contact() const;
  /// Places where the part's boundary crosses itself in creases deeper than a quarter of an
  /// element.
  [[nodiscard]] std::vector<Lap> laps() const;
  /// Tools that loads have driven into others, which do not feel it.
  [[nodiscard]] std::vector<ToolMeeting> overlapping_tools() const;
  /// The tool of whose pressure corners bear the largest share; none: share 0.
  [[nodiscard]] CornerLoad most_at_corner() const;
  /// Share of the contact that lies on sides longer than the case wants there [-].
  [[nodiscard]] double coarse_contact() const;
  /// Tools that touch in too short zones only: their forces can be far too high.
  [[nodiscard]] std::vector<ContactZone> poorly_resolved_tools() const;
  /// Whether what a tool does in a zone is to indent: pressure near the flow stress of the part
  /// there, or an indentation that takes part in the work.
  [[nodiscard]] bool indents(const ContactZone& zone) const;
  /// Remeshings of the run, in their order.
  [[nodiscard]] std::span<const RemeshReport> remeshings() const {
    return state_.record.remeshings;
  }
  /// Sizes that the part would be meshed with now, in the plane or in space; the scene has settings
  /// for that.
  [[nodiscard]] geometry::RemeshSizes remesh_sizes() const;
  [[nodiscard]] geometry::SolidSizes solid_sizes() const;
  /// Number of the present stage, from 0.
  [[nodiscard]] std::size_t stage() const { return state_.progress.stage; }
  [[nodiscard]] int increments() const { return state_.increment; }
  [[nodiscard]] int iterations() const { return state_.counters.iterations; }
  [[nodiscard]] int cutbacks() const { return state_.counters.cutbacks; }
  /// Iterations that went into tries that failed.
  [[nodiscard]] int wasted_iterations() const { return state_.counters.wasted_iterations; }
  /// Iterations on new meshes before time went on: for equilibrium, and what was solved again.
  [[nodiscard]] int remeshing_iterations() const { return state_.counters.remeshing_iterations; }
  /// Plastic work done while forces of tools that had left faded and no tool touched [N mm].
  [[nodiscard]] double flow_in_fading() const { return state_.leaving.flow_in_fading; }
  /// Rigid motions held by stabilization alone.
  [[nodiscard]] int grounded_motions() const { return grounded_; }

private:
  void check_overlap() const;
  /// How deep and where the workpiece lies inside a tool now; empty: no more than chords of faces
  /// do.
  [[nodiscard]] std::string overlap(std::size_t tool, double time) const;
  /// Likewise, of the workpiece's boundary alone.
  [[nodiscard]] std::string depth_in(std::size_t tool, double time) const;
  /// Whether all places of a tool that are nearest to the workpiece's faces lie in the workpiece.
  [[nodiscard]] bool lies_within(std::size_t tool, double time) const;
  void make_terms();
  [[nodiscard]] contact::DriveScale drive_scale() const;
  void check_drives() const;
  [[nodiscard]] bool is_pulled_off(std::size_t tool) const;
  [[nodiscard]] Vec3 towards(std::size_t tool, double load) const;
  /// Loads that drive tools at a time, and what answered them in the last try. (P.33)
  [[nodiscard]] std::vector<DriveState> drive_states(double time) const;
  /// What of them is known to have no answer, for the reason of a failure.
  [[nodiscard]] std::string unbalanced_loads(double time) const;
  void make_loads();
  /// Force per displacement of the size of the body's own stiffness [N/mm].
  [[nodiscard]] double body_stiffness() const;
  void start_stage(const Stage& stage);
  /// Why the presses of a stage cannot strike; empty: they do.
  [[nodiscard]] std::string begin_blows(const Stage& stage);
  /// First, longest and shortest increment of a stage; blows under way may ask for shorter ones.
  [[nodiscard]] IncrementControl::Limits limits(double length) const;
  [[nodiscard]] double longest_for_blows() const;
  /// A shorter increment than the one just solved, if a press has turned back in it.
  [[nodiscard]] std::optional<double> step_to_stop(double dt) const;
  /// Whether the blows of a stage are over and nothing else moves in the rest of it.
  [[nodiscard]] bool rests(const Stage& stage) const;
  [[nodiscard]] bool stands_still(const Stage& stage, double from, double to) const;
  /// Lets the forces of tools that touch now and do not act at `next_time` fade until `gone_time`.
  void release_tools(double next_time, double gone_time);
  [[nodiscard]] mechanics::Prescribed prescribed(double time) const;
  /// Unknowns after `dt` more if all goes on as in the last increment, seen from the first guess.
  [[nodiscard]] std::vector<double> predicted(double dt) const;
  /// The step, or as much of it as passes before more of the part comes to touch. (P.27)
  [[nodiscard]] double up_to_touch(double step);
  /// Whether the run is in a flight, or one begins now. (P.31)
  ///
  /// @param length  of the stage, since the last flight [s]
  [[nodiscard]] bool flies(const Stage& stage, double length);
  /// An increment of the flight, to its end or as far as it may go at once.
  /// @return whether it has come to its end
  bool fly(const Stage& stage, const std::vector<Observer*>& observers);
  [[nodiscard]] bool try_flight(double dt, std::string& why);
  void guess_flight(const Vec3& shift, double dt);
  [[nodiscard]] bool
  try_increment(double dt, mechanics::Continuation continuation, std::string& why);
  /// Whether the part lies on any tool.
  [[nodiscard]] bool touched() const;
  /// Likewise, with contact as it has been started for the try.
  [[nodiscard]] bool
  solve_increment(double dt, mechanics::Continuation continuation, std::string& why);
  /// Whether a tool's force falls so far in the increment just tried that half of its work, with
  /// the force before, would spoil the balance of energy. (P.23)
  [[nodiscard]] bool lets_go_too_fast(double dt) const;
  /// Work that says nothing: no increment is refused for it. [N mm]
  [[nodiscard]] double work_of_rounding() const;
  /// What an increment just tried misses of its work; empty: no more than it may. (P.24)
  ///
  /// @param length  of the stage [s]
  [[nodiscard]] std::string misses_too_much(double dt, double length) const;
  /// Where the load curve bends so within an early increment just tried that its work is missed.
  /// (P.24a)
  ///
  /// @param length    of the stage [s]
  /// @param shortest  that a part may be [s]
  [[nodiscard]] std::optional<Bend> bend_within(double dt, double length, double shortest) const;
  /// By way of softer contact, after an increment has failed. (N.10)
  ///
  /// @param more_iterations  with as many iterations as it takes, in the end
  [[nodiscard]] bool try_softened(double dt, bool more_iterations, std::string& why);
  /// Likewise, with less friction where points go from stick to slip and back.
  [[nodiscard]] bool
  try_friction_limited(double dt, mechanics::Continuation continuation, std::string& why);
  /// Likewise, the tool that a load drives held in one place after the other, until the part bears
  /// the load. (P.32)
  [[nodiscard]] bool try_held_tool(double dt, std::string& why);
  [[nodiscard]] std::optional<std::size_t> driven_alone(double time) const;
  /// Whether an increment that Newton has solved may be accepted.
  [[nodiscard]] bool plausible(double dt, double force_scale, std::string& why) const;
  [[nodiscard]] bool is_squeezed() const;
  void draw_tools_back(double until);
  void draw_back_to(double time);
  void put_tools_back();
  void put_on_retreating_surface(std::size_t tool);
  void add_fading(const LeavingTools::Forces& forces);
  [[nodiscard]] double force_floor(double time) const;
  /// Largest force so far, or of the loads at a time [N].
  [[nodiscard]] double acting_force(double time) const;
  /// Whether forces are so small that they may be no more than what rounding makes of a touch.
  [[nodiscard]] bool may_hardly_touch(double time) const;
  /// @param of_stabilization  what the stabilization has resisted with in the increment [N]
  void note_largest_force(double of_stabilization);
  /// Whether the stabilization takes more of the increment just tried than it may.
  [[nodiscard]] bool stabilization_weighs(double dt) const;
  [[nodiscard]] Outcome<mechanics::NewtonReport>
  with_light_stabilization(double dt, const mechanics::NewtonReport& solved);
  /// Whether increments are accepted only as deep as a limit allows.
  [[nodiscard]] bool bounds_penetration() const;
  /// Presses harder until the limit of penetration holds. (P.7)
  [[nodiscard]] bool limit_penetration(double dt, std::string& why);
  [[nodiscard]] bool too_deep() const;
  /// Of the tool where it is the deepest in the part; 0: flat, or an edge [mm]
  [[nodiscard]] double radius_there() const;
  /// How deep a tool may lie in the part at the deepest place without bearing on it there: what is
  /// not narrow meets contact points once it is as deep as it bulges between them. (P.40) [mm]
  [[nodiscard]] double most_unfelt() const;
  /// Keeps where a tool has been the deepest.
  void note_deepest_tool();
  /// Whether a tool lies in the part where it does not bear on it. (P.40)
  [[nodiscard]] bool lies_in_unfelt(std::string& why) const;
  void press_harder(double gain);
  /// Which contact points kept changing in the last try, for the log; empty: none.
  [[nodiscard]] std::string chattering_points();
  /// Tools that begin to act by `until`, in the midst of the run: those under a force come to
  /// touch, others that lie in the workpiece are noted.
  void activate_tools(const Stage& stage, double until);
  void come_to_touch(std::size_t tool, double time);
  void note_initial_penetration(std::size_t tool);
  /// Those that the increment that could not be solved would have met, for its post-mortem.
  [[nodiscard]] std::string initial_penetrations_now() const;
  enum class Progress { easy, laboured, none };
  /// Takes a softer penalty where iterations are many and penetrations needlessly small, and back.
  void adapt_penalty(Progress progress);
  void begin_with_stiffness(double factor);
  void take_times();
  [[nodiscard]] std::string penetration_failure(int rounds) const;
  void certify(double dt);
  /// Linear systems solved for the try now made.
  [[nodiscard]] int spent() const;
  [[nodiscard]] PostMortem
  post_mortem(double dt, const std::string& why, std::vector<std::string> tried) const;
  /// Whether the trial turns an element inside out that was not, or was less so.
  [[nodiscard]] bool turns_inside_out(std::string& why);
  /// Whether the trial carries the workpiece through a tool.
  [[nodiscard]] bool passes_through(double dt, std::string& why) const;
  void accept(double dt);
  /// Makes the trial the state of the run.
  void commit(double dt);
  /// What the balance of the increment misses, as a share of its work, if the run needs better
  /// ones and may choose them; else 0 [-].
  ///
  /// @param gone  share of the stage that is behind
  [[nodiscard]] double missed_since(const EnergyBalance& before, double gone) const;
  void update_energy();
  /// The sums of the run with these energies of the metal and this contact.
  [[nodiscard]] EnergyBalance
  balance_of(double elastic, double plastic, const contact::ContactTerm* contact) const;
  /// What the balance would be with the increment just tried; nothing changes.
  [[nodiscard]] EnergyBalance energy_after(double dt) const;
  /// In the increment just tried [N mm].
  [[nodiscard]] double work_of_supports(double dt) const;
  /// Takes the increment just accepted into the sums over contact.
  void account_contact(double dt);
  [[nodiscard]] IncrementReport report(double dt, int cutbacks) const;
  /// Begins a stage: its tools, its presses, its increments.
  /// @return why it cannot begin; empty: it has
  [[nodiscard]] std::string begin_stage(const Stage& stage, double start);
  /// Increments as at the beginning of a stage, from a time on [s].
  void begin_increments(const Stage& stage, double start);
  [[nodiscard]] RunStatus
  run_stage(const Stage& stage, double start, const std::vector<Observer*>& observers);
  [[nodiscard]] double next_landing(double stage_end) const;
  /// Whether a new mesh would give a zone of contact with too few sides more of them. (P.18)
  [[nodiscard]] bool can_be_refined(const ContactZone& zone) const;
  /// A tool that will touch in the increment just solved, where nothing near touched yet, on sides
  /// too long for what it touches. (P.18)
  [[nodiscard]] FirstTouch poor_first_touch(double dt) const;
  /// Whether a tool's force falls: its zones of contact shrink and need no new mesh.
  [[nodiscard]] bool leaves(std::size_t tool) const;
  /// Keeps the forces on all tools before an increment.
  void note_forces();
  /// A zone of contact that a new mesh would give more sides.
  [[nodiscard]] std::optional<ContactZone> zone_to_refine() const;
  /// Notes what remeshing needs to know of the first mesh.
  void start_remeshing();
  /// Of the present mesh since it was made, the largest growth of plastic strain [-].
  [[nodiscard]] double strain_since_mesh() const;
  /// Longest over shortest edge of the most slender element [-].
  [[nodiscard]] double aspect() const;
  /// The side in contact that is the most too long for the tool beneath it; excess 0: there is
  /// none.
  [[nodiscard]] OutgrownSide most_outgrown_side() const;
  /// Why the part should be meshed anew now, `left` before the stage ends; empty: it need not.
  [[nodiscard]] std::string remeshing_due(double left) const;
  /// Whether a mesh can be exchanged now, and has been used since it was made.
  [[nodiscard]] bool may_remesh() const;
  /// Meshes the part anew and carries everything over. (P.14)-(P.17)
  ///
  /// @param at  sizes besides, where a tool is about to touch
  /// @return why it could not be done; empty: it was. Then nothing has changed
  [[nodiscard]] std::string remesh(const std::string& cause,
                                   const std::vector<Observer*>& observers,
                                   const std::vector<geometry::SizeAt>& at = {});
  /// The states of the run on a new mesh, without the sources of its contact points. (P.16), (P.19)
  [[nodiscard]] CarriedOver carry_over(const RemeshedPart& part) const;
  /// Puts a new mesh in the place of the present one, with all that is built on a mesh.
  /// @return where its contact points come from
  [[nodiscard]] std::vector<contact::PointSource> exchange_mesh(NewPart anew,
                                                                const CarriedOver& carried);
  /// Where the run is now.
  [[nodiscard]] Snapshot snapshot() const;
  /// Elastic energy of shape of the points that flow [N mm].
  [[nodiscard]] double flowing_energy() const;
  /// Keeps where the run is now, if the metal has flowed far enough since the last time. (P.20)
  void take_snapshot();
  /// Finds equilibrium on the new mesh. (P.17), (P.19)
  void settle(const CarriedOver& carried, std::span<const double> forces, RemeshReport& report);
  /// Largest change of a tool's force over the largest of those before [-].
  [[nodiscard]] double jump_from(std::span<const double> before) const;
  /// Goes on from a state that has been carried over to the present mesh, and notes what that has
  /// changed.
  void start_from(const CarriedState& at,
                  std::span<const contact::PointSource> sources,
                  RemeshReport& report);
  /// Gives the part on its new mesh a volume by moving the surface that touches no tool. (P.21)
  void restore_volume(double volume,
                      const contact::ContactSnapshot& contact,
                      std::span<const contact::PointSource> sources);
  /// The part on a new mesh; nothing of the run has changed.
  /// @throws Error(Fault::geometry) if it cannot be meshed
  [[nodiscard]] NewPart new_part(const std::vector<geometry::SizeAt>& at) const;
  [[nodiscard]] NewPart new_plane_part(const std::vector<geometry::SizeAt>& at) const;
  [[nodiscard]] NewPart new_plane_part_within(const PartBoundary& boundary,
                                              const std::vector<geometry::SizeAt>& at) const;
  [[nodiscard]] NewPart new_solid_part() const;
  [[nodiscard]] NewPart new_solid_part_within(const SolidPart& boundary) const;
  /// The tool that touches each contact face; -1: none.
  [[nodiscard]] std::vector<int> touching_tools() const;
  /// What the case asks for, and what it leaves open from the mesh at the start [mm].
  struct UsualSizes {
    double usual, at_contact, min, max;
    ZoneSizes zones;
  };
  [[nodiscard]] UsualSizes usual_sizes() const;
  /// Sizes that follow how the rate of flow changes from place to place. (P.22)
  [[nodiscard]] std::vector<geometry::SizeAt> sizes_for_flow() const;
  /// Size asked for at a place by tools that are near. [mm]
  [[nodiscard]] std::function<double(const Vec3&)> wanted_size(double turn, double growth) const;
  /// How a node of the new boundary may go to a tool.
  struct WayToTool {
    double most_gap = 0.0; ///< that it is off a tool that it touches [mm]
    double depth = 0.0;    ///< in the tool at which it may stay, as its pressure needs [mm]
    unsigned fixed = 0;    ///< components that stay: 1 for x, 2 for y, 4 for z
  };
  /// The nearest point of a tool that the node may go to; none: it is out of reach or further off.
  [[nodiscard]] std::optional<Vec3>
  onto_tool(std::size_t tool, const Vec3& x, const WayToTool& way) const;
  /// A node of the new boundary put on the tools that old contact points beside it touch, and out
  /// of the others.
  ///
  /// @param tool  the only one that may be touched, -1: none; empty: any
  [[nodiscard]] Vec3 settled(const contact::PointSource& source,
                             const Vec3& x,
                             std::optional<int> tool,
                             const WayToTool& way) const;
  /// Solves for equilibrium without moving on; if there is none nothing changes. (P.17)
  /// @return whether it was found
  [[nodiscard]] bool restore_balance(RemeshReport& report);
  /// Solves again what led there. (P.19)
  /// @return with how many increments; 0: it could not be solved
  [[nodiscard]] int solve_again(const Snapshot& end);
  /// Magnitudes of the forces on all tools; empty: there is no contact. [N]
  [[nodiscard]] std::vector<double> forces_on_tools() const;
  void notify(const std::vector<Observer*>& observers, const IncrementReport& report);
  [[nodiscard]] std::string stored() const;
  /// Hands the run as it is now to the observers that want it.
  void write_checkpoint(const std::vector<Observer*>& observers, CheckpointReason reason);
  /// Puts a stored part in the place of the present one, with all that is built on a mesh.
  void take_part(StoredPart part);

  Scene scene_;
  State state_;
  mechanics::BlockPattern pattern_;
  std::unique_ptr<mechanics::Bulk> bulk_;
  std::unique_ptr<contact::ContactSurface> surface_;
  std::unique_ptr<contact::ContactTerm> contact_;
  std::unique_ptr<NarrowTools> narrow_;
  std::unique_ptr<Blows> blows_; ///< none: no press strikes
  std::vector<std::unique_ptr<mechanics::Load>> loads_;
  std::unique_ptr<mechanics::RigidBodyStabilization> stabilization_;
  std::vector<std::unique_ptr<mechanics::Load>> fading_; ///< forces of tools that have left
  /// A tool that touched when an unload stage began, its surface in another that draws back.
  struct Retreating {
    std::size_t tool;
    geometry::RetreatingSurface* surface;
  };
  std::vector<Retreating> retreating_;
  std::vector<mechanics::ForceTerm*> terms_;
  std::unique_ptr<mechanics::Newton> newton_;
  std::unique_ptr<contact::Wear> wear_;
  std::vector<double> trial_x_;
  bool refused_as_too_deep_ = false;                 ///< the last try
  bool refused_inside_out_ = false;                  ///< likewise
  bool hardly_touches_ = false;                      ///< forces count as none in this try
  std::vector<contact::ChatteringPoint> chattering_; ///< of the last try that had any
  long systems_before_try_ = 0;
  int grounded_ = 0;
  mechanics::SolverWork earlier_work_; ///< on earlier meshes
  PhaseTimes earlier_times_;           ///< likewise
  PhaseTimes times_;
  double analysis_before_run_ = 0.0; ///< time of it outside the iteration [s]
  double started_ = 0.0;
  double times_before_ = 0.0; ///< of the run before it was resumed [s]
  bool resumed_ = false;
  bool between_increments_ = true; ///< nothing has been tried since the last one was accepted
};

} // namespace billet::process
