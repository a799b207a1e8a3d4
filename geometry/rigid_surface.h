// The shape of a die, seen from the contact search.
//
// A surface is immutable and lives in the frame of its tool; motion belongs to the tool. Queries
// come in batches, so the virtual call is paid once per batch; every query is const, returns the
// same bits whatever the order or the thread, and is safe to run from several threads.
//
// Signs   the normal points out of the tool; gap > 0 apart, gap < 0 inside the tool.
// Frame   tool frame, three components; in the plane z = 0 and normals have no z component.
// Units   those of the case (mm).

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"
#include "geometry/inner_ball.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace billet::geometry {

/// Closest point of a surface to one query point. (G.1)
struct Projection {
  double gap = std::numeric_limits<double>::infinity(); ///< signed distance [mm]; +inf: none
  Vec3 foot = Vec3::Zero();                             ///< closest point [mm]
  Vec3 normal = Vec3::Zero();                           ///< unit normal, gradient of gap [-]
  Mat3 dnormal_dx = Mat3::Zero();                       ///< d normal / d x [1/mm], symmetric
  std::int32_t patch = -1;                              ///< hint for the next query of this point

  [[nodiscard]] bool found() const noexcept {
    return gap < std::numeric_limits<double>::infinity();
  }

  template <class Archive> void fields(Archive& archive) {
    archive(gap, foot, normal, dnormal_dx, patch);
  }
};

/// Triangles and their lines for drawing and for wear maps.
struct DisplayMesh {
  std::vector<Vec3> points;                           ///< tool frame [mm]
  std::vector<std::array<std::int32_t, 2>> lines;     ///< in the plane
  std::vector<std::array<std::int32_t, 3>> triangles; ///< in space
};

/// A convex corner or a rounding of a tool in the plane. (G.56)
struct ToolCorner {
  Vec3 centre = Vec3::Zero(); ///< of the rounding; of a sharp one the corner itself [mm]
  double radius = 0.0;        ///< 0: sharp [mm]
  Vec3 from = Vec3::Zero();   ///< unit normals of the tool on both sides of it, turning left
  Vec3 to = Vec3::Zero();     ///< by less than half a turn

  template <class Archive> void fields(Archive& archive) { archive(centre, radius, from, to); }
};

/// Boundary of a rigid tool, oriented outwards.
class RigidSurface {
public:
  virtual ~RigidSurface() = default;
  RigidSurface(const RigidSurface&) = delete;
  RigidSurface& operator=(const RigidSurface&) = delete;

  /// Projects each point onto the surface.
  ///
  /// Points farther than `reach` outside, or deeper than `reach` inside, get a `Projection` with
  /// `found() == false`. `out[i].patch` on entry is the hint left by the last query of that point
  /// (-1: none); it never changes the result, only the time.
  ///
  /// @param points  shape (n), tool frame [mm]
  /// @param reach   search distance [mm], > 0
  /// @param out     shape (n), overwritten
  /// @pre points.size() == out.size()
  void project(std::span<const Vec3> points, double reach, std::span<Projection> out) const;

  /// Smallest axis-aligned box that holds the surface, tool frame [mm]; unbounded for a plane.
  [[nodiscard]] virtual Box bounds() const = 0;

  /// Its convex corners and roundings that turn by more than `angle` [rad], of those made of lines
  /// and arcs; others have none. (G.56)
  [[nodiscard]] virtual std::vector<ToolCorner> corners(double angle) const;

  /// Balls in the tool where it is narrower than a face of the workpiece; a plane has none. (G.60)
  [[nodiscard]] virtual std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const;

  /// The part of the surface inside `window`, for pictures. (in the plane: lines with z = 0)
  ///
  /// @param planar  true: the scene is in the plane, draw the section z = 0 as lines
  [[nodiscard]] virtual DisplayMesh display(const Box& window, bool planar) const = 0;

protected:
  RigidSurface() = default;

private:
  virtual void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const = 0;
};

using SurfacePtr = std::shared_ptr<const RigidSurface>;

} // namespace billet::geometry
