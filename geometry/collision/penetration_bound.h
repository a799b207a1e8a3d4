// How deep faces lie inside a rigid surface: a bound for every point of them, not for samples.
//
// A signed distance changes by no more than the way. So a ball clear of the tool, wherever it is,
// bounds the depth of a face by the distance of its control points from the ball; a large ball
// that touches the tool where the face is deepest makes the bound as good as the tool is smooth.
// Pieces of faces whose bound is too far above the deepest sample are halved, the worst first.
// What is clear of a rigid tool stays so: the balls of one search serve the next one, when the
// faces have moved a little, and most faces then cost no query.
//
// An open surface ends at its rim, and its gap jumps there (G.11): what of a face lies behind it
// and beyond the rim does not count, and near the rim the bound is that of a finite refinement.
//
// Frame   tool frame. Units: lengths in mm. Theory: docs/theory/geometry.md (G.24)-(G.28), (G.59).

#pragma once

#include "geometry/curved/bezier_patch.h"
#include "geometry/rigid_surface.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace billet::geometry {

/// A face of the workpiece that may lie inside a tool.
struct CandidateFace {
  BezierPatch shape;  ///< tool frame [mm]
  double depth;       ///< of the element beneath, what penetration is compared with [mm]
  std::size_t id = 0; ///< the caller's number of the face
};

/// A ball that holds no point of a tool.
struct ClearBall {
  Vec3 centre = Vec3::Zero();                               ///< tool frame [mm]
  double radius = -std::numeric_limits<double>::infinity(); ///< none [mm]

  template <class Archive> void fields(Archive& archive) { archive(centre, radius); }
};

/// Balls that bounded a piece of a face in the search before.
struct KnownPiece {
  std::size_t face = 0;           ///< its id
  std::uint64_t place = 1;        ///< 1 for the whole, 2 p and 2 p + 1 for the halves of p
  bool halved = false;            ///< the balls were not enough
  std::array<ClearBall, 2> clear; ///< at least the first is one

  template <class Archive> void fields(Archive& archive) { archive(face, place, halved, clear); }
};

/// The deepest place found, by one of the two measures.
struct DeepestSample {
  double depth = 0.0;           ///< [mm], or [-] relative to the element beneath
  Vec3 position = Vec3::Zero(); ///< tool frame [mm]
  std::size_t face = 0;         ///< its id; of no meaning where depth is 0
};

/// No point of the faces is deeper than the bounds; the samples are that deep.
struct PenetrationBound {
  double bound = 0.0;          ///< [mm]
  double relative_bound = 0.0; ///< to the depth of the element beneath [-]
  DeepestSample deepest;
  DeepestSample deepest_relative;
  std::size_t queries = 0; ///< of the surface
};

/// When to be satisfied with a bound.
struct BoundSearch {
  double reach = 0.0;           ///< what is deeper counts as beyond the tool [mm], > 0
  double tightness = 0.01;      ///< bound over deepest sample - 1 [-]
  double floor = 1e-6;          ///< differences below this share of the element do not matter
  std::size_t most_queries = 0; ///< of the surface, about; then the bound is as it is
  double known_depth = 0.0;     ///< some point anywhere is that deep [mm]
  double known_relative = 0.0;  ///< and that deep relative to its element [-]
};

/// (G.24)-(G.28)
///
/// @param known  of a search of the same tool before, sorted by face and place; replaced by what
///               this one leaves. Any, even of other faces, give a valid bound. (G.59)
[[nodiscard]] PenetrationBound bound_penetration(const RigidSurface& surface,
                                                 std::span<const CandidateFace> faces,
                                                 const BoundSearch& search,
                                                 std::vector<KnownPiece>& known);

} // namespace billet::geometry
