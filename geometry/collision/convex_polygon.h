// A plane convex polygon, or a line, and what half-spaces leave of it.
//
// Units   lengths in mm.

#pragma once

#include "geometry/base/box.h"
#include "geometry/base/vector.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace billet::geometry {

/// Corners in turn, in one plane; two of them are a line, fewer are nothing.
class ConvexPolygon {
public:
  static constexpr std::size_t most_corners = 16;

  /// @param corners  in turn; each cut may add one, up to `most_corners`
  explicit ConvexPolygon(std::span<const Vec3> corners);

  [[nodiscard]] std::span<const Vec3> corners() const { return std::span(corners_).first(n_); }
  /// Whether nothing is left.
  [[nodiscard]] bool empty() const { return n_ < 2; }
  /// Keeps where (x - point) . inward >= 0.
  void cut(const Vec3& point, const Vec3& inward);
  /// Keeps what lies in a box; a side at infinity cuts nothing.
  void cut(const Box& box);
  /// Of a polygon, along the normal about which the corners turn [mm^2]; 0 for a line.
  [[nodiscard]] Vec3 area_vector() const;
  /// Mean of the corners [mm].
  [[nodiscard]] Vec3 middle() const;
  /// From one of the two corners that lie farthest apart to the other [mm].
  [[nodiscard]] std::pair<Vec3, Vec3> farthest_corners() const;

private:
  void add(const Vec3& corner) { corners_[n_++] = corner; }

  std::array<Vec3, most_corners> corners_;
  std::size_t n_ = 0;
};

} // namespace billet::geometry
