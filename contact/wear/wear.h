// Wear of the tools, and of the workpiece on them, over a run.
//
// Only irreversible sliding wears: a point that sticks does not, nor does its elastic slip. The
// sums grow when an increment is accepted and at no other time, so tries that are refused leave no
// trace.
//
// Units   mm; volumes are those of the full turn in axisymmetry, per thickness in plane strain, and
//         of the part that is modelled where planes of symmetry cut it.
// Theory  docs/theory/contact.md (W.1)-(W.7).

#pragma once

#include "contact/surface/contact_surface.h"
#include "contact/term/contact_term.h"
#include "contact/tools/tool.h"
#include "contact/wear/wear_map.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

/// What one tool has worn off the workpiece.
struct WorkpieceWear {
  std::vector<double> depth; ///< at the contact points, shape (n_points) [mm]
  double volume = 0.0;       ///< [mm^3]

  template <class Archive> void fields(Archive& archive) { archive(depth, volume); }
};

class Wear {
public:
  /// @param body  the workpiece at the start, in space [mm]
  /// @pre surface and tools outlive the object; tools are where they start
  Wear(const ContactSurface& surface, std::span<const Tool> tools, const Box& body);

  /// Whether any tool has a law of wear.
  [[nodiscard]] static bool wanted(std::span<const Tool> tools);

  /// Goes on with the contact surface of a new mesh of the same part.
  ///
  /// @param sources  where its points lie on the surface before, shape (n_points)
  void change_surface(const ContactSurface& surface, std::span<const PointSource> sources);

  /// Takes the last committed increment of contact in. (W.2)-(W.4), (W.10)
  ///
  /// @param x  positions at its end, shape (n_dofs + n_extra) [mm]
  void add(const ContactTerm& contact, std::span<const double> x, double time);

  /// Of a tool; none: it has no law of wear.
  [[nodiscard]] const std::optional<WearMap>& map(std::size_t tool) const { return maps_[tool]; }
  /// Of the workpiece on a tool; none: it was not asked for.
  [[nodiscard]] const std::optional<WorkpieceWear>& workpiece(std::size_t tool) const {
    return workpiece_[tool];
  }
  /// Depth at the contact points by all tools, shape (n_points) [mm]; empty: not asked for.
  [[nodiscard]] std::vector<double> workpiece_depth() const;

  template <class Archive> void fields(Archive& archive) {
    archive(last_, rotation_, maps_, workpiece_);
  }

private:
  /// The workpiece when an increment ends, a tool's place then, and by how much the workpiece has
  /// turned against it, a vector in its frame.
  struct Place {
    std::span<const double> x;
    geometry::Pose pose;
    Vec3 turn; ///< [rad]
  };

  /// Wears tool and workpiece where a point slides.
  ///
  /// @param pressed_way  integral of the pressure over the way [MPa mm]
  /// @param moved        where the footprint of now has to be moved to [mm]
  void wear_off(std::size_t tool,
                const ClosedPoint& at,
                double pressed_way,
                const Place& place,
                const Vec3& moved);
  /// The same for a corner of the tool. (C.46)
  void wear_off(std::size_t tool, const CornerPress& press, const Place& place);
  /// What points that have opened wore off before they did.
  void leave(std::size_t tool, std::span<const ClosedPoint> closed, const Place& place);

  const ContactSurface* surface_;
  std::span<const Tool> tools_;
  std::vector<std::vector<ClosedPoint>> last_; ///< closed in the increment before, by tool
  std::vector<Mat3> rotation_;                 ///< of each tool, an increment ago
  std::vector<std::optional<WearMap>> maps_;
  std::vector<std::optional<WorkpieceWear>> workpiece_;
};

} // namespace billet::contact
