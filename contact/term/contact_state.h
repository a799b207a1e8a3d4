// Where contact stands: all that changes in a run. Plain values, without pointers, so a copy is as
// good as the original and what a run stores is exact. Functions read it together with the model
// that it is a state of: a ContactView.
//
// Frames   tractions and histories in the tool's frame, forces in space.

#pragma once

#include "contact/corners/corner_contact.h"
#include "contact/faces/face_pressure.h"
#include "contact/faces/face_stabilization.h"
#include "contact/law/interface_law.h"
#include "contact/surface/closed_point.h"
#include "contact/term/contact_model.h"
#include "contact/term/contact_work.h"
#include "contact/term/penalty_factors.h"
#include "contact/term/tool_activity.h"
#include "geometry/collision/penetration_bound.h"
#include "geometry/rigid_surface.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace billet::contact {

/// What one tool feels.
struct ToolLoad {
  Vec3 force = Vec3::Zero();  ///< of the workpiece on the tool [N]
  Vec3 torque = Vec3::Zero(); ///< about the tool's reference point [N mm]

  template <class Archive> void fields(Archive& archive) { archive(force, torque); }
};

/// A pressure-averaged face: its pressures follow from the gaps of all its points. (C.45)
struct AveragedFace {
  Index face;
  FaceCompliance compliance;

  template <class Archive> void fields(Archive& archive) { archive(face, compliance); }
};

/// Contact with one tool at the end of the last increment.
struct CommittedContact {
  std::vector<PointHistory> history;  ///< shape (n_points)
  std::vector<Vec3> force;            ///< on the workpiece, in space, shape (n_points) [N]
  Mat3 rotation = Mat3::Identity();   ///< of the tool's frame
  double stored = 0.0;                ///< energy in its penalties and springs [N mm]
  bool touches = false;               ///< at a point or a corner
  FaceStabilization stabilization;    ///< of the next increment
  std::vector<CornerState> corners;   ///< shape (corners of the tool)
  std::vector<AveragedFace> averaged; ///< of the next increment, in the order of faces
  std::vector<Index> averaged_at;     ///< of a face there, -1: it is not; shape (n_faces)

  template <class Archive> void fields(Archive& archive) {
    archive(history, force, rotation, stored, touches, stabilization, corners, averaged,
            averaged_at);
  }
};

/// Contact with one tool in the increment being tried.
struct TrialContact {
  // Of the trial assembled last
  std::vector<Traction> traction;         ///< shape (n_points)
  std::vector<Vec3> position;             ///< in the tool's frame, shape (n_points) [mm]
  std::vector<geometry::Projection> foot; ///< shape (n_points)
  Mat3 rotation = Mat3::Identity();       ///< of the tool's frame
  std::vector<CornerTrial> corners;       ///< shape (corners of the tool)
  std::vector<FacePressure> averaged;     ///< of `CommittedContact::averaged`
  // Of the try
  std::vector<double> multiplier;    ///< shape (n_points) [MPa]
  std::vector<int> changes;          ///< of status, shape (n_points)
  std::vector<char> friction_lagged; ///< slip limit of the pressure before, shape (n_points)
  std::vector<std::optional<double>> touching; ///< shares of the increment, those asked for
  /// How the tool is predicted to turn against each face, as vectors in its frame [rad]; empty: not
  /// yet asked for.
  std::vector<Vec3> turn;
  double retreat = 0.0;    ///< of its surface in the increment, along its normals [mm]
  double drawn_back = 0.0; ///< the same, since it began to retreat [mm]

  template <class Archive> void fields(Archive& archive) {
    archive(traction, position, foot, rotation, corners, averaged, multiplier, changes,
            friction_lagged, touching, turn, retreat, drawn_back);
  }
};

/// What earlier queries of a tool's surface tell.
struct SearchCache {
  std::vector<Vec3> queried_at;            ///< where `known_gap` holds, in the tool's frame,
                                           ///< shape (n_points) [mm]
  std::vector<double> known_gap;           ///< shape (n_points) [mm]
  std::vector<geometry::KnownPiece> clear; ///< of the last certificate (G.59)

  template <class Archive> void fields(Archive& archive) { archive(queried_at, known_gap, clear); }
};

struct ToolContact {
  CommittedContact committed;
  TrialContact trial;
  SearchCache search;

  template <class Archive> void fields(Archive& archive) { archive(committed, trial, search); }
};

/// Where everything will be at the end of this try if it goes on as it does. (C.42)
struct Prediction {
  std::vector<double> unknowns; ///< empty: not told [mm]
  std::vector<Vec3> positions;  ///< of the points, shape (n_points) [mm]

  template <class Archive> void fields(Archive& archive) { archive(unknowns, positions); }
};

struct ContactState {
  ContactState() = default;
  /// Nothing has touched.
  explicit ContactState(const ContactModel& model);

  ToolActivity activity;
  PenaltyFactors penalty;
  std::vector<ToolContact> tools;
  // Of the last increment
  std::vector<ToolLoad> loads;                  ///< of the tools
  std::vector<std::vector<ClosedPoint>> closed; ///< of the tools
  ContactWork work;                             ///< since the start
  double area = 0.0;                            ///< in contact [mm^2]
  std::vector<double> areas;                    ///< that the points stand for [mm^2]
  int since_parting = 0; ///< increments committed since a point last left a tool, or the first
  // Of the increment being tried
  std::vector<Vec3> positions; ///< of the points in the trial assembled last, in space [mm]
  Prediction predicted;

  template <class Archive> void fields(Archive& archive) {
    archive(activity, penalty, tools, loads, closed, work, area, areas, since_parting, positions,
            predicted);
  }
};

/// What a term on another mesh of the same part needs to go on. Tries that failed on this mesh say
/// nothing about contact on another one, so none of what they changed is in it.
struct ContactSnapshot {
  ToolActivity activity;
  ContactWork work;
  double stiffening = 1.0;                        ///< penalty over that of the case [-]
  std::vector<std::vector<PointHistory>> history; ///< shape (n_tools, n_points)
  std::vector<std::vector<CornerState>> corners;  ///< of tools, shape (n_tools, theirs)

  template <class Archive> void fields(Archive& archive) {
    archive(activity, work, stiffening, history, corners);
  }
};

/// A state and what it is a state of.
struct ContactView {
  const ContactModel& model;
  const ContactState& state;

  /// Whether a tool is enabled and active.
  [[nodiscard]] bool acts(std::size_t tool, double time) const {
    return state.activity.enabled(tool) && model.tools[tool].active(time);
  }
  /// Whether a free degree of freedom follows its load now.
  [[nodiscard]] bool follows(const DriveUnknown& drive, double time) const {
    return acts(drive.tool, time) && !state.activity.rests(drive.tool) &&
           (drive.turns || !state.activity.held(drive.tool));
  }
};

} // namespace billet::contact
