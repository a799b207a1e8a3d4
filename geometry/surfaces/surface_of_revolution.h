// What cylinder, sphere, cone and torus have in common: a meridian turned about an axis.
//
// A query point is reduced to (h, r), height along the axis and distance from it; the meridian
// answers there with the signed distance, the normal (n_h, n_r) and the two principal curvatures of
// the level surface, from which the space quantities follow (G.3).
//
// Frame   tool frame. Units: mm. Internal to geometry/: the make_ functions are the interface.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"
#include "geometry/collision/narrow_parts.h"
#include "geometry/rigid_surface.h"

#include <concepts>
#include <span>
#include <utility>
#include <vector>

namespace billet::geometry {

/// Distances from the axis or centre of a large tool are known to 1e-16 of its size, penetrations
/// are a 1e-11th of it: a roll of 1000 m lets one see its noise in the forces. So gaps are
/// differences of numbers with more digits.
using Wide = long double;

/// A line with a direction: where a meridian is turned.
struct Axis {
  Vec3 origin = Vec3::Zero();         ///< (h, r) = (0, 0) [mm]
  Vec3 direction = Vec3::UnitZ();     ///< unit vector a
  Vec3 perpendicular = Vec3::UnitX(); ///< unit vector used where r = 0; in z = 0 if the axis is
};

/// @param direction  any length but zero
[[nodiscard]] Axis make_axis(const Vec3& origin, const Vec3& direction);

/// Signed distance to a meridian, metal outside.
struct MeridianPoint {
  double gap;        ///< [mm]
  double n_h;        ///< normal along the axis [-]
  double n_r;        ///< normal away from the axis [-]
  double k_meridian; ///< curvature of the level surface in the meridian plane [1/mm]
  double k_hoop;     ///< curvature across it, n_r / r [1/mm]; 0 where it is infinite
};

/// A ball in a solid of revolution, its centre in the half-plane. (G.60)
struct MeridianBall {
  double h, r;   ///< [mm]
  double radius; ///< [mm]
};

/// A value type that answers in the half-plane (h, r >= 0).
///
/// `narrow(low, high, width)` gives balls on the inside of the meridian where it is narrower than
/// `width`, of the part with low <= h <= high if it is endless, at steps of a quarter of it.
/// `line(low, high)` gives points (h, r) along the meridian for drawing, metal on the right of the
/// way, of the part with low <= h <= high if it is endless. shape (n)
template <class M>
concept Meridian = std::copyable<M> && requires(const M& m, double x, Wide y, const Axis& axis) {
  { m.narrow(x, x, x) } -> std::same_as<std::vector<MeridianBall>>;
  { m.at(y, y) } -> std::same_as<MeridianPoint>;
  { m.size() } -> std::same_as<double>;
  { m.bounds(axis) } -> std::same_as<Box>;
  { m.line(x, x) } -> std::same_as<std::vector<Vec2>>;
};

/// Projection in space from the answer in the meridian plane. (G.3)
[[nodiscard]] Projection revolved(const Axis& axis,
                                  const Vec3& e_r,
                                  const Vec3& point,
                                  const MeridianPoint& at,
                                  bool inside);

/// Height and distance of `point`, and the radial unit vector.
struct AxisCoordinates {
  Wide h; ///< [mm]
  Wide r; ///< [mm]
  Vec3 e_r;
};

/// @param size  length of the shape; distances that are rounding errors relative to it count as
///              zero
[[nodiscard]] AxisCoordinates axis_coordinates(const Axis& axis, const Vec3& point, double size);

/// Range of h over the corners of `window`.
[[nodiscard]] std::pair<double, double> heights(const Axis& axis, const Box& window);

/// Pieces of circle a full turn is drawn with.
inline constexpr int pieces_round = 128;

/// The meridian turned about the axis as triangles, or its section z = 0 as lines.
[[nodiscard]] DisplayMesh
revolved_display(const Axis& axis, const std::vector<Vec2>& line, bool planar, bool inside);

/// Half-extent of a disk normal to the axis, along each coordinate, per unit radius.
[[nodiscard]] Vec3 disk_extent(const Axis& axis);

/// Rigid surface of a meridian.
template <Meridian M> class RevolvedSurface final : public RigidSurface {
public:
  RevolvedSurface(const Axis& axis, const M& meridian, bool inside)
      : axis_(axis), meridian_(meridian), inside_(inside) {}

  [[nodiscard]] Box bounds() const override { return meridian_.bounds(axis_); }

  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override {
    if (window.empty())
      return {};
    const auto [low, high] = heights(axis_, window);
    const double margin = window.size(); // also for a window without thickness
    return revolved_display(axis_, meridian_.line(low - margin, high + margin), planar, inside_);
  }

  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override {
    std::vector<InnerBall> balls;
    if (inside_ || search.window.empty())
      return balls;
    const auto [low, high] = heights(axis_, search.window);
    for (const MeridianBall& ball :
         meridian_.narrow(low - search.width, high + search.width, search.width))
      add_around({axis_.origin + ball.h * axis_.direction, axis_.direction, ball.r, ball.radius},
                 search, balls);
    return balls;
  }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const AxisCoordinates c = axis_coordinates(axis_, points[i], meridian_.size());
      const MeridianPoint at = meridian_.at(c.h, c.r);
      out[i] = at.gap <= reach && -at.gap <= reach ? revolved(axis_, c.e_r, points[i], at, inside_)
                                                   : Projection{};
    }
  }

  Axis axis_;
  M meridian_;
  bool inside_;
};

} // namespace billet::geometry
