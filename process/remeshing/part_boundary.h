// The boundary of a plane part as chains of edges, with all that hangs on it: supports, loads,
// named sets, contact faces, tools that touch. It is what survives when the part is meshed anew.
//
// Edges that carry the same things form a part of the boundary; where the part changes, a corner
// stays. A node that alone carries something is a corner as well.
//
// Units   those of the case. Theory: docs/theory/process.md (P.14).

#pragma once

#include "geometry/mesh2d/closed_folds.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "process/remeshing/attachments.h"
#include "process/scene/scene.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

/// An edge of the boundary.
struct SideNumber {
  std::int32_t loop;
  std::int32_t side;
};

/// The boundary of a part where it is now.
struct PartBoundary {
  std::vector<geometry::SideLoop> loops;
  std::vector<std::vector<Index>> corners; ///< node numbers, of each loop; -1: a weld
  /// Components of each of these nodes that a support prescribes: 1 for x, 2 for y, or both.
  std::vector<std::vector<unsigned char>> fixed;
  std::vector<Attachment> attachments; ///< of each part of the boundary
  /// Side of each face that is on it, by its first two nodes.
  std::map<std::pair<Index, Index>, SideNumber> sides;
};

/// @param x         positions of the nodes, shape (n_points, 2) [mm]
/// @param touching  the tool that touches each of the part's contact faces; -1: none
/// @param keep      names of node sets whose nodes stay corners
[[nodiscard]] PartBoundary part_boundary(const Part& part,
                                         std::span<const double> x,
                                         std::span<const int> touching,
                                         std::span<const std::string> keep);

/// Cuts folds that have closed off the boundary, but for such as hold supports: their walls are
/// welded, their faces are no part of it any more. (G.54)
///
/// @param near  as for `geometry::closed_fold`
/// @param rest  as for `geometry::without_fold`
/// @param deepest  roots of creases alone, no deeper than that: from its weld on a crease goes on
/// as
///                 it was [mm]
/// @return      what was cut off
std::vector<geometry::ClosedFold>
weld_folds(PartBoundary& boundary, double near, double rest, double deepest = HUGE_VAL);

/// Components that a support prescribes in a place of the boundary: 1 for x, 2 for y, or both.
[[nodiscard]] unsigned char fixed_components(const Part& part,
                                             const PartBoundary& boundary,
                                             std::int32_t section,
                                             const geometry::BoundaryPlace& place);

/// Edges in turn that the same tool touches.
struct ContactZone {
  std::size_t loop;
  std::size_t first; ///< edge of the loop
  std::size_t n_sides;
  int tool;
  double length;     ///< [mm]
  bool ends_in_side; ///< somewhere the boundary goes on beyond it without a corner
  bool longest;      ///< of its tool's

  /// Whether it has too few edges for the pressure in it.
  [[nodiscard]] bool too_short() const;
};

/// Zones of contact of a boundary whose attachments say which tool touches.
[[nodiscard]] std::vector<ContactZone> contact_zones(const PartBoundary& boundary);

/// How many edges a zone of contact has, in words.
[[nodiscard]] std::string sides_of(const ContactZone& zone);

/// Size of the edges of a zone of contact of a length that lets it have six of them [mm].
[[nodiscard]] double size_in_zone(double length);

/// Smallest sizes in zones of contact.
struct ZoneSizes {
  double min;            ///< [mm]
  double min_in_longest; ///< in the longest zone of a tool, which carries its force [mm]

  /// Size of the edges of a zone, where that length of it is to have six of them [mm].
  [[nodiscard]] double in(const ContactZone& zone, double length) const;
};

/// Sizes that let the zone where a tool touches have at least six edges, where it is long or short.
[[nodiscard]] std::vector<geometry::SizeAt> contact_sizes(const PartBoundary& boundary,
                                                          const ZoneSizes& limits);

/// What the scene has on a new mesh of the part.
struct RemeshedPart {
  mechanics::Mesh mesh; ///< tri6, in space tet10
  std::vector<Support> supports;
  std::vector<LoadSpec> loads;
  std::vector<mechanics::Face> contact_faces;
  /// Where each contact face begins, has its middle and ends on the old boundary; in the plane
  /// only.
  std::vector<std::array<geometry::BoundaryPlace, 3>> places;
  double old_measure = 0.0; ///< area, or its integral times x, or volume [mm^2, mm^3]
  double measure = 0.0;     ///< the same of the new mesh
};

/// @throws Error(Fault::geometry) if the boundary cannot be meshed
[[nodiscard]] RemeshedPart remesh_part(const Part& old,
                                       const PartBoundary& boundary,
                                       const geometry::RemeshSizes& sizes,
                                       const geometry::Snap& snap);

/// The two old contact points on either side of a place on the boundary, and how near the second
/// is.
class ContactStops {
public:
  /// @param faces        the part's contact faces
  /// @param coordinates  of the points on a face, in [-1, 1]
  ContactStops(const PartBoundary& boundary,
               std::span<const mechanics::Face> faces,
               std::span<const double> coordinates);

  [[nodiscard]] contact::PointSource around(const geometry::BoundaryPlace& place) const {
    return between(place.loop, way(place), part_at(place));
  }

private:
  friend std::vector<contact::PointSource>
  point_sources(const ContactStops& stops,
                std::span<const std::array<geometry::BoundaryPlace, 3>> places,
                std::span<const double> coordinates);

  /// A contact point on the way around a loop.
  struct Stop {
    double way;
    std::size_t point;
    std::int32_t part; ///< of the boundary
  };

  [[nodiscard]] double way(const geometry::BoundaryPlace& at) const;
  [[nodiscard]] double round(std::int32_t loop) const;
  [[nodiscard]] std::int32_t part_at(const geometry::BoundaryPlace& at) const;
  /// The stops on either side; round a corner of the part only where it has none itself.
  [[nodiscard]] contact::PointSource
  between(std::int32_t loop, double way, std::int32_t part) const;

  std::vector<std::vector<std::int32_t>> parts_; ///< of the edges of each loop
  std::vector<std::vector<double>> ends_;        ///< lengths of the edges of each loop, summed up
  std::vector<std::vector<Stop>> stops_;         ///< in turn around each loop
};

/// For every contact point of a new surface the two of the old one that it lies between.
///
/// @param places       of the new faces
/// @param coordinates  of the points on a new face, in [-1, 1]
[[nodiscard]] std::vector<contact::PointSource>
point_sources(const ContactStops& stops,
              std::span<const std::array<geometry::BoundaryPlace, 3>> places,
              std::span<const double> coordinates);

} // namespace billet::process
