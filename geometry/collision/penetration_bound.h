// How deep faces lie inside a rigid surface: a bound for every point of them, not for samples.
//
// A signed distance changes by no more than the way. So a ball clear of the tool, wherever it is,
// bounds the depth of a face by the distance of its control points from the ball; a large ball
// that touches the tool where the face is deepest makes the bound as good as the tool is smooth.
// Pieces of faces whose bound is too far above the deepest sample are halved, the worst first.
//
// An open surface ends at its rim, and its gap jumps there (G.11): what of a face lies behind it
// and beyond the rim does not count, and near the rim the bound is that of a finite refinement.
//
// Frame   tool frame. Units: lengths in mm. Theory: docs/theory/geometry.md (G.24)-(G.28).

#pragma once

#include "geometry/curved/bezier_patch.h"
#include "geometry/rigid_surface.h"

#include <cstddef>
#include <span>

namespace billet::geometry {

/// A face of the workpiece that may lie inside a tool.
struct CandidateFace {
  BezierPatch shape;  ///< tool frame [mm]
  double depth;       ///< of the element beneath, what penetration is compared with [mm]
  std::size_t id = 0; ///< the caller's number of the face
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
[[nodiscard]] PenetrationBound bound_penetration(const RigidSurface& surface,
                                                 std::span<const CandidateFace> faces,
                                                 const BoundSearch& search);

} // namespace billet::geometry
