// What contact is computed on: the faces of the workpiece, its bulk, the tools and the unknowns
// that move them. Constant during a mesh's life; what changes is a ContactState.

#pragma once

#include "contact/corners/corner_contact.h"
#include "contact/surface/contact_surface.h"
#include "contact/tools/tool.h"
#include "geometry/motion.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/linear/sparse_matrix.h"

#include <cstddef>
#include <span>
#include <vector>

namespace billet::contact {

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

/// Velocity of a tool's material at a place, and its spin, for a unit rate of a drive.
struct DriveRate {
  Vec3 velocity; ///< [-]
  Vec3 spin;     ///< [1/mm]
};

struct ContactModel {
  /// @pre surface, bulk, pattern and tools outlive the model
  ContactModel(const ContactSurface& surface,
               const mechanics::Bulk& bulk,
               const mechanics::BlockPattern& pattern,
               std::span<const Tool> tools,
               double reach,
               const DriveScale& scale);

  [[nodiscard]] Index face_of(std::size_t point) const {
    return static_cast<Index>(point / idx(surface->points()));
  }
  /// Length of the parent element of a point, normal to its face [mm].
  [[nodiscard]] double depth_at(std::size_t point) const { return surface->depth(face_of(point)); }
  /// Where a tool's free degrees of freedom are in a vector of unknowns.
  [[nodiscard]] geometry::Driven driven(std::size_t tool, std::span<const double> x) const;
  /// A tool's place at a time with those unknowns.
  [[nodiscard]] geometry::Pose
  pose(std::size_t tool, double time, std::span<const double> x) const {
    return tools[tool].motion.pose(time, driven(tool, x));
  }
  [[nodiscard]] DriveRate drive_rate(const DriveUnknown& drive,
                                     double time,
                                     std::span<const double> x,
                                     const Vec3& position) const;

  const ContactSurface* surface;
  const mechanics::Bulk* bulk;
  const mechanics::BlockPattern* pattern;
  std::span<const Tool> tools;
  double reach; ///< of queries of the tools' surfaces [mm]
  std::vector<DriveUnknown> drives;
  DriveScale scale;
  std::vector<CornerContact> corners; ///< of the tools
};

} // namespace billet::contact
