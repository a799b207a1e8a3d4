// Where a tool is narrow: the parts of it that may go between the contact points of a face.
//
// Contact looks at points of the workpiece. A needle, an edge or a thin rod can enter a face
// without meeting one of them, and once it is inside, no face lies in the tool any more. So a tool
// tells where it is narrow: by balls that lie in it, at its sharp convex corners and edges (radius
// 0) and along its round parts of a small radius. How deep such a ball lies in the workpiece is how
// deep the tool does.
//
// Frame   tool frame. Units: mm. Theory: docs/theory/geometry.md (G.60).

#pragma once

#include "geometry/base/vector.h"
#include "geometry/inner_ball.h"
#include "geometry/triangles/triangle_mesh.h"

#include <vector>

namespace billet::geometry {

/// Turn of a convex edge or corner from which it counts as sharp, however large the tool is [rad].
inline constexpr double sharp_turn = 0.26;

/// Of a surface of triangles: vertices of its narrow edges, and places along them. (G.60)
[[nodiscard]] std::vector<InnerBall> narrow_parts(const TriangleMesh& mesh,
                                                  const NarrowSearch& search);

/// A circle about an axis, the centres of balls of a tool of revolution.
struct CircleOfBalls {
  Vec3 centre;     ///< of the circle [mm]
  Vec3 axis;       ///< unit vector
  double radius;   ///< of the circle; 0: a point [mm]
  double of_balls; ///< radius of the balls [mm]
};

/// Adds balls along a circle, at steps no longer than asked for, near the window.
void add_around(const CircleOfBalls& circle,
                const NarrowSearch& search,
                std::vector<InnerBall>& balls);

} // namespace billet::geometry
