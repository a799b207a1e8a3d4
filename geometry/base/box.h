// Axis-aligned box of points.

#pragma once

#include "geometry/base/vector.h"

#include <limits>
#include <span>

namespace billet {

/// Smallest box that holds every point added to it; empty at first.
struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());   ///< smallest coordinates
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity()); ///< largest coordinates

  bool operator==(const Box&) const = default;

  void add(const Vec3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  [[nodiscard]] bool empty() const { return (low.array() > high.array()).any(); }
  /// Length of the diagonal; 0 for an empty box.
  [[nodiscard]] double size() const { return empty() ? 0.0 : (high - low).norm(); }
  [[nodiscard]] bool contains(const Vec3& point) const {
    return (low.array() <= point.array()).all() && (point.array() <= high.array()).all();
  }
  [[nodiscard]] bool overlaps(const Box& other, double margin) const {
    return ((low.array() - margin) <= other.high.array()).all() &&
           ((other.low.array() - margin) <= high.array()).all();
  }
};

/// The smallest box that holds all points.
inline Box box_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points)
    box.add(p);
  return box;
}

} // namespace billet
