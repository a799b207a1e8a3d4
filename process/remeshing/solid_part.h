// The boundary of a part in space as triangles, with all that hangs on it, and the part on a new
// mesh. The counterpart in the plane is part_boundary.h.
//
// Faces that carry the same things form a part of the boundary; where the part changes, a line
// stays. An edge or a node that alone carries something stays as well. Which tool touches changes
// no part: the ends of contact are free to move.
//
// Units   those of the case. Theory: docs/theory/process.md (P.14).

#pragma once

#include "geometry/mesh3d/solid_remesher.h"
#include "geometry/triangles/box_tree.h"
#include "process/remeshing/attachments.h"
#include "process/remeshing/part_boundary.h"
#include "process/scene/scene.h"

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace billet::process {

/// The boundary of a part in space where it is now.
struct SolidPart {
  /// What an edge carries that no adjacent face does.
  struct EdgeFlags {
    std::vector<char> supports;
    std::vector<char> sets;
  };

  geometry::SolidBoundary boundary;
  double volume = 0.0;                 ///< of the old mesh [mm^3]
  std::vector<Attachment> attachments; ///< of each part of the boundary; `tool` is not told apart
  std::vector<Index> node;             ///< of each point of the boundary; -1: middle of a face
  std::vector<Index> contact_face;     ///< of each triangle; -1: no tool may touch it
  /// Where the corners of each triangle are on its face's reference face.
  std::vector<std::array<Vec2, 3>> coordinates;
  std::map<std::array<Index, 2>, EdgeFlags> edges; ///< of lines of the boundary, by its points
};

/// @param x         positions of the nodes, shape (n_points, 3) [mm]
/// @param touching  the tool that touches each of the part's contact faces; -1: none
/// @param keep      names of node sets whose nodes stay corners
[[nodiscard]] SolidPart solid_part(const Part& part,
                                   std::span<const double> x,
                                   std::span<const int> touching,
                                   std::span<const std::string> keep);

/// @return the scene's lists on a new mesh of tet10; places and measures are left empty
/// @throws Error(Fault::geometry) if the boundary cannot be meshed
[[nodiscard]] RemeshedPart remesh_part(const Part& old,
                                       const SolidPart& part,
                                       const geometry::SolidSizes& sizes,
                                       const geometry::SnapSolid& snap);

/// The old contact points that are nearest to a place, on the face that is.
class ContactNeighbours {
public:
  /// @param coordinates  of the points on a face
  ContactNeighbours(const SolidPart& part, std::vector<Vec2> coordinates);

  /// Three points of the nearest face, weighted so that linear fields are exact between them;
  /// beyond them the nearest.
  [[nodiscard]] contact::PointSource around(const Vec3& x) const;

private:
  struct Triangle {
    std::array<Vec3, 3> corners;
    std::array<Vec2, 3> coordinates;
    Index face;
  };

  [[nodiscard]] contact::PointSource on_face(Index face, const Vec2& at) const;

  std::vector<Vec2> points_;
  std::vector<Triangle> triangles_;
  geometry::BoxTree tree_;
};

} // namespace billet::process
