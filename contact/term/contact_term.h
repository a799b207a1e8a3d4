// Contact and friction between the workpiece and rigid tools, as a force term.
//
// The contact area is unknown and found anew in every iteration: every integration point of every
// candidate face is projected on every tool that acts, and what lies inside is pushed out. A point
// may touch several tools. Distances are 1-Lipschitz, so a point that was far from a tool and has
// moved less than that distance is open without a query.
//
// Frames   tractions and histories in the tool's frame, forces in space. Theory:
// docs/theory/contact.md.

#pragma once

#include "contact/corners/corner_contact.h"
#include "contact/faces/face_pressure.h"
#include "contact/faces/face_stabilization.h"
#include "contact/law/interface_law.h"
#include "contact/surface/closed_point.h"
#include "contact/surface/contact_surface.h"
#include "contact/tools/tool.h"
#include "geometry/collision/penetration_bound.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/equilibrium/force_term.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// What one tool feels.
struct ToolLoad {
  Vec3 force = Vec3::Zero();  ///< of the workpiece on the tool [N]
  Vec3 torque = Vec3::Zero(); ///< about the tool's reference point [N mm]

  template <class Archive> void fields(Archive& archive) { archive(force, torque); }
};

/// Contact results of one point, summed over the tools it touches, in space.
struct PointResult {
  double gap = 0.0;          ///< smallest known signed distance [mm]; +inf: out of reach
  double pressure = 0.0;     ///< [MPa]
  Vec3 shear = Vec3::Zero(); ///< [MPa]
  Status status = Status::open;
  double sliding = 0.0; ///< sliding distance so far [mm]
};

/// How deep the workpiece lies inside tools: every point of every candidate face. (C.13)
struct Penetration {
  double bound = 0.0;           ///< no point of any face is deeper [mm]
  double share = 0.0;           ///< nor deeper than this relative to the element beneath [-]
  double sampled = 0.0;         ///< depth of the deepest point found [mm]
  double at_points = 0.0;       ///< of the deepest contact point [mm]
  double pressed = 0.0;         ///< likewise, as contact counts its gap [mm]
  double share_pressed = 0.0;   ///< likewise, relative to the element beneath [-]
  Vec3 position = Vec3::Zero(); ///< of the deepest point found, in space [mm]
  std::size_t tool = 0;         ///< in which that point lies
  /// The deepest point found relative to its parent element: another one on a graded mesh.
  struct Place {
    double share = 0.0;           ///< [-]
    double depth = 0.0;           ///< [mm]
    Vec3 position = Vec3::Zero(); ///< in space [mm]
    std::size_t tool = 0;
    Index face = -1; ///< -1: no face is in a tool

    template <class Archive> void fields(Archive& archive) {
      archive(share, depth, position, tool, face);
    }
  };
  Place relative;
  std::size_t queries = 0; ///< of tools' surfaces, for the cost

  template <class Archive> void fields(Archive& archive) {
    archive(bound, share, sampled, at_points, pressed, share_pressed, position, tool, relative,
            queries);
  }
};

/// Energies and work of contact since the start.
struct ContactWork {
  double external = 0.0; ///< done by the tools' motion [N mm]
  double friction = 0.0; ///< dissipated [N mm]
  /// Of it, what trapezoids of the work of forces do not see: slides that begin or turn within an
  /// increment; whoever drives them has done it. [N mm] (C.18a)
  double unseen = 0.0;
  double stored = 0.0; ///< in the penalties now [N mm]
  /// Done by raising penalties and multipliers, which work on what is pressed [N mm]. (C.23)
  double enforcement = 0.0;

  template <class Archive> void fields(Archive& archive) {
    archive(external, friction, unseen, stored, enforcement);
  }
};

/// Where contact stands at the end of an increment: what a term on another mesh of the same part
/// needs to go on.
struct ContactState {
  std::vector<char> enabled; ///< tools that may act, one flag a tool
  std::vector<char> held;    ///< driven tools that stay where they are, likewise
  ContactWork work;
  double stiffening = 1.0;                                 ///< penalty over that of the case [-]
  std::vector<std::vector<PointHistory>> history;          ///< shape (n_tools, n_points)
  std::vector<std::vector<CornerContact::Corner>> corners; ///< of tools, shape (n_tools, theirs)

  template <class Archive> void fields(Archive& archive) {
    archive(enabled, held, work, stiffening, history, corners);
  }
};

/// How the free degrees of freedom of driven tools enter the equations: as lengths, so that one
/// norm serves them and the nodes.
struct DriveScale {
  double length = 1.0;    ///< arm at which a turn counts as a length [mm]
  double stiffness = 0.0; ///< that holds a tool nothing else holds; far below the body's [N/mm]
};

/// A free degree of freedom of a tool, an unknown after those of the nodes.
struct DriveUnknown {
  std::size_t tool;
  bool turns; ///< about an axis; else it travels along one
};

/// The free degrees of freedom of all tools, in the order of the tools, travel before turn.
[[nodiscard]] std::vector<DriveUnknown> drive_unknowns(std::span<const Tool> tools);

class ContactTerm final : public mechanics::ForceTerm {
public:
  /// @pre surface, bulk, pattern and tools outlive the term
  ContactTerm(const ContactSurface& surface,
              const mechanics::Bulk& bulk,
              const mechanics::BlockPattern& pattern,
              std::span<const Tool> tools,
              double reach,
              const DriveScale& drives = {});

  /// Places the points at the start of the run; histories begin here.
  void start(std::span<const double> x, double time);
  /// Likewise for a tool that has been moved between increments; its history must be none.
  void start(std::size_t tool, std::span<const double> x, double time);

  /// Whether a point is closed on a tool in the committed state.
  [[nodiscard]] bool closed_on(std::size_t tool, std::size_t point) const {
    return states_[tool].history[point].closed();
  }
  /// How deep its pressure needs a point to lie in a tool, in the committed state [mm].
  [[nodiscard]] double depth_of_pressure(std::size_t tool, std::size_t point) const {
    const PointHistory& history = states_[tool].history[point];
    return std::max(0.0, history.pressure - history.multiplier) / penalty().normal;
  }
  /// What a point bears on a tool in the last trial, in the tool's frame.
  [[nodiscard]] const Traction& tried(std::size_t tool, std::size_t point) const {
    return states_[tool].trial[point];
  }
  /// Where it stands now; tries that failed since have softened or stiffened its penalty. (C.41)
  [[nodiscard]] ContactState state() const;
  /// Goes on where a term on an earlier mesh of the same part stood: its sums, its penalty, which
  /// tools act. After `start`.
  ///
  /// @param sources  for each of this term's points those of the other's that it lies between
  /// @param x        where the nodes are, shape (n_dofs + n_extra) [mm]
  void go_on_from(const ContactState& before,
                  std::span<const PointSource> sources,
                  std::span<const double> x,
                  double time);

  [[nodiscard]] Outcome<mechanics::Assembled> assemble(const mechanics::Trial& trial,
                                                       mechanics::System& system) override;
  [[nodiscard]] bool has_kinks() const override { return true; }
  void commit(const mechanics::Trial& trial) override;

  /// Where a tool's free degrees of freedom are in a vector of unknowns.
  [[nodiscard]] geometry::Driven driven(std::size_t tool, std::span<const double> x) const;
  /// A tool's place at a time with those unknowns.
  [[nodiscard]] geometry::Pose
  pose(std::size_t tool, double time, std::span<const double> x) const {
    return tools_[tool].motion.pose(time, driven(tool, x));
  }

  /// Begins a try of an increment: enforcement is that of the committed state, nothing is
  /// predicted.
  void restart();
  /// Likewise, and points that were chattering in the last try, with more shear than pressure, get
  /// no more of it than that in this one. (F.3)
  ///
  /// @return whether there are any
  bool restart_friction_limited();
  /// Tells where everything will be at the end of this try if it goes on as it does. Points that
  /// come down on a tool rub from where they touch; without this, from the next increment on.
  /// (C.42)
  ///
  /// @param x  shape (n_dofs + n_extra) [mm]
  void predict(std::span<const double> x);
  /// When points that are open come to touch in the increment as it has been predicted, as shares
  /// of it, the earliest first. (P.27)
  [[nodiscard]] std::vector<double> touches(const mechanics::Trial& trial) const;
  /// Increments committed since a point last left a tool, or since the first.
  [[nodiscard]] int since_parting() const { return since_parting_; }
  /// Whether a tool that acts turns in an increment.
  [[nodiscard]] bool any_turns(const mechanics::Trial& trial) const;
  /// Makes the normal penalty stiffer from the next trial on. (C.21)
  void stiffen(double factor) { stiffening_ *= factor; }
  /// Changes the penalty with which the tries of the next increment begin; below that of the case
  /// the one against slip is no stiffer than it. (C.24)
  void begin_with_stiffness(double factor) { stiffening_next_ *= factor; }
  /// Makes the pressures of the last trial the multipliers of the next. (C.22)
  void augment();
  /// Likewise as the tries of the next increment begin [-].
  [[nodiscard]] double next_stiffening() const { return stiffening_next_; }
  /// Penalty now over the penalty of the case [-].
  [[nodiscard]] double stiffening() const { return stiffening_; }

  /// A contact point that keeps changing between open, stick and slip.
  struct ChatteringPoint {
    std::size_t tool;
    Vec3 position; ///< in space [mm]
    int changes;   ///< of its status in this try
  };
  /// Points that have changed in many evaluations of this try, the most chattering first.
  [[nodiscard]] std::vector<ChatteringPoint> chattering() const;

  /// Tools that may act now (a stage's choice), one flag a tool.
  void enable(std::vector<char> enabled) { enabled_ = std::move(enabled); }

  /// Whether a tool that a force drives stays where it is, whatever acts on it.
  void hold(std::size_t tool, bool held) { held_[tool] = held ? 1 : 0; }
  /// Whether a tool neither travels nor turns, whatever acts on it and whatever drives it.
  void rest(std::size_t tool, bool rests) { rests_[tool] = rests ? 1 : 0; }

  /// Whether a tool is enabled and active.
  [[nodiscard]] bool acts(std::size_t tool, double time) const;

  /// Resultants of the last committed trial, one a tool.
  [[nodiscard]] std::span<const ToolLoad> loads() const { return loads_; }
  [[nodiscard]] const ContactWork& work() const { return work_; }
  /// Time spent in all assemblies [s].
  struct Times {
    double search = 0.0;
    double elements = 0.0; ///< laws, contact elements, loads of tools
  };
  [[nodiscard]] const Times& times() const { return times_; }
  /// Points of the last committed trial, shape (n_points).
  [[nodiscard]] std::vector<PointResult> results() const;
  /// What the points closed on each tool did in the last committed increment, shape (n_tools).
  [[nodiscard]] std::span<const std::vector<ClosedPoint>> closed() const { return closed_; }
  /// What the corners of a tool press on in the committed state. (C.46)
  [[nodiscard]] std::span<const CornerContact::Corner> corners(std::size_t tool) const {
    return states_[tool].corners.corners();
  }
  /// Area in contact of the last committed trial [mm^2].
  [[nodiscard]] double area() const { return area_; }
  /// With what corners stand for: nothing only where nothing bears any force [mm^2].
  [[nodiscard]] double bearing_area() const;
  /// Penetration at the last assembled trial, over whole faces.
  ///
  /// @param limit  that it is compared with: a bound is resolved to a twentieth of it [mm]
  [[nodiscard]] Penetration
  penetration(const mechanics::Trial& trial,
              double limit = std::numeric_limits<double>::infinity()) const;
  /// A tool's forces at one end of an increment.
  struct ForcesOfTool {
    double sum = 0.0;  ///< of the magnitudes at all points [N]
    double work = 0.0; ///< over its way in the increment [N mm]
  };
  /// Those at the beginning and at the end of the increment of the last trial.
  [[nodiscard]] std::array<ForcesOfTool, 2> forces_of_tool(std::size_t tool,
                                                           const mechanics::Trial& trial) const;
  /// Whether a point lies on a tool, or on a corner of it, in the committed state, with or without
  /// pressure.
  [[nodiscard]] bool lies_on(std::size_t tool) const;
  /// Whether a tool bears, in the last trial, on a face or on one that shares a node with it.
  [[nodiscard]] bool bears_near(std::size_t tool, Index face) const;
  /// Whether a tool's surface has begun to draw back.
  [[nodiscard]] bool draws_back(std::size_t tool) const { return states_[tool].drawn_back > 0.0; }
  /// Whether a tool touches in the committed state but will not act at `time`.
  [[nodiscard]] bool leaves(std::size_t tool, double time) const;
  /// Tells how far a tool's surface has drawn back at the end of this try, along its normals,
  /// beside what its motion does; it may be less than in the try before.
  ///
  /// @param all  with what it has drawn back in increments before [mm]
  void retreat(std::size_t tool, double distance, double all);
  /// Takes a tool's contact away: returns its committed nodal forces on the workpiece, shape
  /// (n_dofs) [N], and forgets its history. The penalties' energy goes with it.
  [[nodiscard]] std::vector<double> release(std::size_t tool);

  template <class Archive> void fields(Archive& archive) {
    archive(enabled_, since_parting_, held_, rests_, states_, positions_, predicted_,
            predicted_positions_, areas_, touched_, loads_, closed_, work_, area_, stiffening_,
            stiffening_old_, stiffening_next_);
  }

private:
  /// Changes of status that make a point chattering: on its way to contact or to slip it changes
  /// once or twice.
  static constexpr int chattering_changes = 4;

  /// A face on which pressures follow from the gaps of all points. (C.45)
  struct EvenFace {
    Index face;
    FaceCompliance compliance;
    FacePressure now; ///< of the trial

    template <class Archive> void fields(Archive& archive) { archive(face, compliance, now); }
  };

  /// Working memory of one tool; shape (n_points) each.
  struct ToolState {
    std::vector<PointHistory> history;
    std::vector<double> multiplier;              ///< of the trial [MPa]
    std::vector<std::optional<double>> touching; ///< shares of the increment, those asked for
    /// How it is predicted to turn against each face, as vectors in its frame [rad]; empty: not yet
    /// asked for.
    std::vector<Vec3> turn;
    std::vector<Traction> trial;
    std::vector<Vec3> position; ///< tried, tool frame
    std::vector<geometry::Projection> foot;
    std::vector<int> changes;           ///< of status in this try
    std::vector<char> friction_limited; ///< points that get no more shear than pressure in this try
    std::vector<Vec3> queried_at;       ///< where `known_gap` holds
    std::vector<double> known_gap;
    std::vector<Vec3> force;                    ///< committed force on the workpiece, in space
    Mat3 rotation = Mat3::Identity();           ///< of the tool's frame at the last trial
    Mat3 committed_rotation = Mat3::Identity(); ///< likewise at the last committed one
    double stored = 0.0;                        ///< energy in its penalties and springs [N mm]
    FaceStabilization stabilization;
    CornerContact corners;
    std::vector<EvenFace> even; ///< in the order of faces; set at the end of an increment
    std::vector<Index> even_at; ///< of a face in `even`, -1: it is not there; shape (n_faces)
    bool touches = false;       ///< in the committed state
    double retreat = 0.0;       ///< of its surface in the increment, along its normals [mm]
    double drawn_back = 0.0;    ///< likewise since it began to [mm]

    template <class Archive> void fields(Archive& archive) {
      archive(history, multiplier, touching, turn, trial, position, foot, changes, friction_limited,
              queried_at, known_gap, force, rotation, committed_rotation, stored, stabilization,
              corners, even, even_at, touches, retreat, drawn_back);
    }
  };

  [[nodiscard]] Penalty penalty() const;
  /// Pressure that needs no penetration: the multiplier, and what a softer penalty on the way to a
  /// solution leaves of the pressure at the start of the increment [MPa]. (N.10)
  [[nodiscard]] double carried(const ToolState& state, std::size_t point) const;
  /// Gap below which a point touches, but for a multiplier: rounding of coordinates [mm].
  [[nodiscard]] double touching_gap(std::size_t point) const;
  /// Gap at which a point opens: a multiplier holds it beyond touching [mm].
  [[nodiscard]] double opening_gap(const ToolState& state, std::size_t point) const;
  /// The face of a point, where its pressures follow from all its gaps; null: each from its own.
  [[nodiscard]] const EvenFace* even_face(const ToolState& state, std::size_t point) const {
    const Index at = state.even_at[idx(face_of(point))];
    return at < 0 ? nullptr : &state.even[idx(at)];
  }
  /// Pressure of a point of such a face in the trial.
  [[nodiscard]] SharedPressure shared_pressure(const EvenFace& face, std::size_t point) const;
  /// What a trial's gaps press such faces with.
  ///
  /// @param keep  what touched stays, if need be under tension (C.15)
  void press_even_faces(ToolState& state, bool keep) const;
  /// How deep a point of the trial lies in a tool, as contact counts its gap [mm].
  [[nodiscard]] double pressed_depth(const ToolState& state, std::size_t point) const;
  /// What the trial adds to the gap of a point of such a face, were its penalty its own [mm].
  [[nodiscard]] double relief(const ToolState& state, std::size_t point) const;
  void search(const Tool& tool, ToolState& state, const geometry::Pose& pose);
  /// Faces that known distances do not keep clear of a tool, in its frame.
  [[nodiscard]] std::vector<geometry::CandidateFace> faces_near(const ToolState& state,
                                                                const mechanics::Trial& trial,
                                                                const geometry::Pose& pose) const;
  /// @return points whose status is not that of the trial before
  [[nodiscard]] int evaluate(std::size_t tool, const mechanics::Trial& trial, bool keep);
  /// Share of the increment in which a point that was open touches the tool, as the motion of point
  /// and tool predicts at its beginning, whatever the trial; 0: they would not meet. (C.42)
  [[nodiscard]] double
  touching_share(std::size_t tool, std::size_t point, const mechanics::Trial& trial) const;
  /// How a tool turns against the faces in the increment if all goes on as it does. (C.5a)
  [[nodiscard]] std::vector<Vec3> turns(std::size_t tool, const mechanics::Trial& trial) const;
  void forget_predicted();
  /// Counts the gaps of straight faces anew from where faces agree. (C.43)
  void level_faces(std::size_t tool, const geometry::Pose& pose, std::span<const double> x);
  /// Chooses the faces whose pressure is not to be high and low in turn. (C.45)
  void choose_even_faces(std::size_t tool);
  /// Whether faces lie on a tool, but for points that uneven pressure may have lifted off.
  [[nodiscard]] std::vector<char> faces_lying_on(std::size_t tool) const;
  /// What evening the pressure moves a point by at most [mm].
  [[nodiscard]] double most_relief(std::size_t point) const;
  /// Holds the shape of quadratic faces in the next increment. (C.44)
  void stabilize(std::size_t tool, const geometry::Pose& pose, std::span<const double> x);
  /// Feet of the points of faces that touch a tool and of two rings around; of others, not found.
  [[nodiscard]] std::vector<geometry::Projection> feet_around_contact(std::size_t tool) const;
  /// k of the material beneath a point in the trial [MPa].
  [[nodiscard]] double strength(const Friction& friction, std::size_t point) const;
  /// Whether so many points have lost a tool that the trial says nothing about the contact set.
  [[nodiscard]] bool many_parted(const ToolState& state) const;
  /// Whether a point is kept closed under tension.
  [[nodiscard]] static bool pulls(const ToolState& state);
  void sum(const ToolState& state, const geometry::Pose& pose);
  void scatter(std::span<const double> x, mechanics::System& system) const;
  /// Adds to a face's tangent what pressures owe to the gaps of other points. (C.45)
  template <class Shape, class Square>
  void couple_points(const std::vector<mechanics::FacePoint<Shape>>& places,
                     std::size_t first,
                     Square& tangent,
                     Square& near) const;
  /// Adds what the tractions owe to the strength beneath, which the nodes of whole elements change.
  void add_strength(const mechanics::Trial& trial, mechanics::System& system) const;
  /// Velocity of a tool's material at a place, and its spin, for a unit rate of a drive.
  struct DriveRate {
    Vec3 velocity; ///< [-]
    Vec3 spin;     ///< [1/mm]
  };
  [[nodiscard]] DriveRate drive_rate(const DriveUnknown& drive,
                                     double time,
                                     std::span<const double> x,
                                     const Vec3& position) const;
  /// Adds what a tool's corners do. (C.46)
  void press_corners(std::size_t tool,
                     const geometry::Pose& pose,
                     const mechanics::Trial& trial,
                     mechanics::System& system);
  /// Takes their works and forces into the books.
  ///
  /// @param gone  by points that touch, in the increment [mm]
  void commit_corners(std::size_t tool, const mechanics::Trial& trial, double gone);
  /// Whether a free degree of freedom follows its load now.
  [[nodiscard]] bool follows(const DriveUnknown& drive, double time) const {
    return acts(drive.tool, time) && rests_[drive.tool] == 0 &&
           (drive.turns || held_[drive.tool] == 0);
  }
  /// History of a point that lies between points of an earlier surface.
  ///
  /// @param depth  of the element beneath [mm]
  [[nodiscard]] PointHistory between(std::span<const PointHistory> before,
                                     const PointSource& source,
                                     const geometry::Projection& foot,
                                     double depth) const;
  void add_loads(const mechanics::Trial& trial, mechanics::System& system) const;
  void add_borders(const mechanics::Trial& trial, mechanics::System& system) const;
  template <class Shape, class Rule>
  void
  add_border_of(std::size_t drive, const mechanics::Trial& trial, mechanics::System& system) const;
  /// How a tool's material moves in the increment from where it is at a time.
  struct WayOfTool {
    Vec3 shift; ///< [mm]
    Vec3 turn;  ///< about the axis [rad]
    Vec3 axis;  ///< a point on it at that time [mm]

    /// Along the arc [mm].
    [[nodiscard]] Vec3 of(const Vec3& x) const { return shift + turn.cross(x - axis); }
  };
  /// From where it is at the beginning of the increment and at its end.
  [[nodiscard]] std::array<WayOfTool, 2> ways(std::size_t tool,
                                              const mechanics::Trial& trial) const;
  /// Of the tool or the workpiece in points that touch or touched, in the increment [mm].
  [[nodiscard]] double longest_way(const ToolState& state,
                                   const geometry::Pose& pose,
                                   const geometry::Pose& pose_old) const;
  void commit_tool(std::size_t t, const mechanics::Trial& trial);
  /// Energy of a closed point in its normal penalty over its area [N/mm].
  [[nodiscard]] double stored(const Traction& now, double multiplier) const;
  /// Work over area by which enforcement has changed a point in the increment [N/mm]. (C.23)
  [[nodiscard]] double
  enforcement_work(const PointHistory& old, const Traction& now, double multiplier) const;
  /// What of a shift of the gap moves a point under pressure [mm]: all of it; where it opens or
  /// closes, no more than its depth.
  [[nodiscard]] double pressed_shift(const PointHistory& old,
                                     const Traction& now,
                                     double multiplier,
                                     double shift) const;
  [[nodiscard]] Index face_of(std::size_t point) const;

  const ContactSurface* surface_;
  const mechanics::Bulk* bulk_;
  const mechanics::BlockPattern* pattern_;
  std::span<const Tool> tools_;
  double reach_;
  std::vector<char> enabled_;
  int since_parting_ = 0;
  std::vector<char> held_;  ///< likewise one flag a tool
  std::vector<char> rests_; ///< likewise
  std::vector<ToolState> states_;
  std::vector<Vec3> positions_;
  std::vector<double> predicted_;         ///< unknowns at the end of this try; empty: not told [mm]
  std::vector<Vec3> predicted_positions_; ///< of the points, then
  std::vector<double> areas_;
  std::vector<Vec3> traction_;
  std::vector<Mat3> dtraction_;
  std::vector<Mat3> symmetric_; ///< of each derivative, what a symmetric tangent may have of it
  std::vector<char> touched_;
  std::vector<ToolLoad> loads_;
  std::vector<std::vector<ClosedPoint>> closed_;
  std::vector<DriveUnknown> drives_;
  DriveScale scale_;
  ContactWork work_;
  double area_ = 0.0;
  Times times_;
  double softening_ = 1.0;       ///< of the normal penalty while a trial is assembled [-]
  double stiffening_ = 1.0;      ///< of the normal penalty in the trial [-]
  double stiffening_old_ = 1.0;  ///< in the committed state [-]
  double stiffening_next_ = 1.0; ///< at the beginning of a try [-]
};

} // namespace billet::contact
