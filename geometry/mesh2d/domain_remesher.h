// New triangles in a domain of the plane whose boundary is that of a distorted mesh.
//
// The boundary comes as closed chains of quadratic edges. Between corners that must stay it is read
// as a smooth curve through all its nodes; new nodes are spread along that curve by a field of
// sizes, triangles are refined by the same field, and the enclosed measure (area, or that of the
// body of revolution) is given back what the resampling took. The same loops give the same mesh, to
// the bit. Theory: docs/theory/geometry.md (G.40)-(G.44).
//
// Frame   of a body of revolution x is the radius, y the axis.
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh2d/mesher_2d.h"

#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

namespace billet::geometry {

/// A closed chain of edges; the domain lies on the left of the way. Edge i goes from corner i to
/// corner i + 1 through middle i, a parabola.
struct SideLoop {
  std::vector<Vec2> corners;      ///< [mm]
  std::vector<Vec2> middles;      ///< of each edge [mm]
  std::vector<std::int32_t> part; ///< of each edge; where it changes the corner is kept
  std::vector<char> keep;         ///< of each corner: kept in any case
  std::vector<char> hold; ///< of each edge: nodes stay on it (tool, symmetry); others may be moved
                          ///< along the normal to restore the measure
};

/// Length that edges should have near a place.
struct SizeAt {
  Vec2 at;     ///< [mm]
  double size; ///< [mm]
};

/// What the new edges should be like.
struct RemeshSizes {
  double min; ///< shortest edge asked for [mm], > 0; poor angles are improved down to min / 16
  double max; ///< longest edge on the boundary [mm]
  double turn = std::numbers::pi / 18.0; ///< most an edge's tangent turns, unless that makes it
                                         ///< shorter than `min` [rad]
  double growth = 0.3;                   ///< most change of size per distance [-]
  int across = 3;                        ///< edges across a thin place (web, flash)
  /// Size asked for at a place of the domain [mm]; empty: `max`.
  std::function<double(const Vec2&)> wanted = {};
  std::vector<SizeAt> at = {}; ///< asked for in addition, even below `min`
  /// Longest edge that passes over ripples of the boundary near a place, 0: none; empty: the size
  /// asked for there. (G.42a) [mm]
  std::function<double(const Vec2&)> over_ripples = {};
  bool or_parabolas = true; ///< where the smooth curve (G.41) touches itself, edges are taken as
                            ///< the parabolas they are
};

/// What is kept of the domain.
enum class Measure {
  area,    ///< area [mm^2]
  revolved ///< the integral of x over the area, volume by 2 pi [mm^3]
};

/// Where on the old boundary.
struct BoundaryPlace {
  std::int32_t loop;
  std::int32_t side;
  double xi; ///< from 0 at the first corner of the edge to 1 at the second [-]
};

/// Where a new node of the boundary should rather be, e.g. on the tool that its edge lies on.
///
/// Called for both corners and the middle of every edge: part of the edge, place on the old
/// boundary, position on its curve; returns the new position [mm]. Nodes of edges that are not held
/// are moved for the measure afterwards.
using Snap = std::function<Vec2(std::int32_t part, const BoundaryPlace& at, const Vec2& x)>;

/// The new mesh and where its boundary comes from.
struct RemeshedDomain {
  PlaneMesh mesh; ///< boundary edges loop by loop, each in turn; their `segment` is the old part
  std::vector<BoundaryPlace> corner_places; ///< of the first corner of each boundary edge
  std::vector<BoundaryPlace> middle_places; ///< of the middle of each boundary edge
  double old_measure;                       ///< enclosed by the old edges
  double measure; ///< enclosed by the new ones; the same to 1e-10 of it if an edge may be moved
};

/// Meshes the domain anew.
///
/// Corners are kept where `part` changes, where `keep` says so and where the boundary turns by more
/// than 30 degrees (10 where it would touch itself otherwise) and by more than the edges next to it
/// do. (G.40)
///
/// @param snap  puts nodes of the boundary where they should be; empty: they stay on its curve
/// @param loops  one that turns left around each piece of the domain, and one that turns right
///               around each of its holes
/// @throws Error(Fault::geometry), with the place, if loops cross or touch themselves or each
///         other, turn the wrong way or have an edge without length; Error(Fault::limit) if it
///         would take more than ten million triangles
[[nodiscard]] RemeshedDomain remesh_domain(std::span<const SideLoop> loops,
                                           const RemeshSizes& sizes,
                                           Measure measure,
                                           const Snap& snap = {});

} // namespace billet::geometry
