// Corners of tools in the plane, pressed on by the faces of the workpiece between their contact
// points. (C.46)
//
// A contact point knows only what is beneath it. Between two points a face could let a tool's
// corner in, and as the metal slides past the corner point after point would lose the tool with
// all its pressure. So a corner presses on the boundary it is inside of, along the way to the
// closest place, like a contact point that stands for half an element, with the same law of
// friction. The place wanders along the faces as the metal slides past.

#pragma once

#include "contact/corners/corner_search.h"
#include "contact/law/interface_law.h"
#include "geometry/motion.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// What a corner does to the workpiece.
struct CornerPress {
  std::optional<CornerFoot> foot; ///< none: it does not press
  Traction traction{};            ///< in the tool's frame
  double depth = 0.0;             ///< of the parent element [mm]
  double area = 0.0;              ///< that it stands for: half of that [mm^2]
  Vec3 place = Vec3::Zero();      ///< of the tool, in space [mm]
  Vec3 force = Vec3::Zero();      ///< on the workpiece, in space [N]
  double mean_pressure = 0.0;     ///< over the increment, set when it is committed [MPa]

  template <class Archive> void fields(Archive& archive) {
    archive(foot, traction, depth, area, place, force, mean_pressure);
  }
};

/// How a place that moves with a tool does so for a unit rate of one of its free degrees of
/// freedom.
struct PlaceRate {
  std::size_t drive; ///< number of the unknown
  Vec3 velocity;     ///< [-]
  Vec3 spin;         ///< [1/mm]
};

/// What is committed of a corner. Its history's shear and normal are those of its place, which is
/// not one of the workpiece; its position says nothing.
struct CornerState {
  PointHistory history{};
  double shear_yield = 0.0; ///< k of the parent element [MPa]
  CornerPress press{};

  template <class Archive> void fields(Archive& archive) { archive(history, shear_yield, press); }
};

/// What is tried of it.
struct CornerTrial {
  double multiplier = 0.0; ///< [MPa]
  CornerPress press{};

  template <class Archive> void fields(Archive& archive) { archive(multiplier, press); }
};

/// The corners of one tool on the faces of one mesh; constant, what changes is an argument. Lists
/// of states and trials have shape (size()).
class CornerContact {
public:
  /// The trial and the tool in it.
  struct At {
    const ContactSurface& surface;
    const mechanics::BlockPattern& pattern;
    const mechanics::Trial& trial;
    const geometry::Pose& pose;
    const geometry::Pose& pose_old; ///< at its beginning
    double drawn_back;              ///< by its surface, along its normals [mm]
    const Friction& friction;
    Penalty penalty; ///< without softening
    /// Free degrees of freedom of the tool, for a place.
    const std::function<std::vector<PlaceRate>(const Vec3& place)>& rates;
  };
  /// Where a tool is on a new mesh.
  struct Placed {
    const ContactSurface& surface;
    const geometry::Pose& pose;
    std::span<const double> x; ///< shape (n_dofs) [mm]
  };

  CornerContact(const ContactSurface& surface, const geometry::RigidSurface& tool);

  [[nodiscard]] bool empty() const { return shapes_.empty(); }
  [[nodiscard]] std::size_t size() const { return shapes_.size(); }
  /// In the tool's frame.
  [[nodiscard]] const geometry::ToolCorner& shape(std::size_t corner) const {
    return shapes_[corner];
  }

  /// Finds what the corners press on in a trial and adds forces and their exact derivatives.
  ///
  /// @return corners whose status is not that of the trial before
  int add(const At& at,
          std::span<const CornerState> committed,
          std::span<CornerTrial> trial,
          mechanics::System& system) const;
  /// Goes on where the corners of the same tool stood on another mesh; gaps are off by what the
  /// meshes differ. (C.41)
  ///
  /// @param penalty  pressure per depth [MPa/mm]
  [[nodiscard]] std::vector<CornerState>
  mapped(std::span<const CornerState> before, const Placed& tool, double penalty) const;

private:
  struct Pressing;
  template <class Shape>
  void
  press(const At& at, const Pressing& corner, CornerPress& trial, mechanics::System& system) const;

  CornerSearch search_;
  double largest_depth_ = 0.0; ///< of a parent element [mm]
  std::vector<geometry::ToolCorner> shapes_;
};

/// Adds the committed forces of a tool's corners to those on the nodes, shape (n_dofs) [N].
void add_corner_forces(const ContactSurface& surface,
                       std::span<const CornerState> corners,
                       std::span<double> forces);

} // namespace billet::contact
