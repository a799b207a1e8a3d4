// Nodes by place; a detail of io/advice.

#pragma once

#include "geometry/base/index.h"
#include "geometry/base/vector.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>

namespace billet::io {

/// Finds the point that lies at a place, to a tolerance. Points are much farther apart than that.
class NodeFinder {
public:
  /// @pre the points outlive the finder; tolerance > 0
  NodeFinder(std::span<const Vec3> points, double tolerance)
      : points_(points), tolerance_(tolerance) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cells_.emplace(key(cell_of(points[i])), i);
  }

  [[nodiscard]] std::optional<std::size_t> at(const Vec3& place) const {
    const std::array<std::int64_t, 3> low = cell_of(place - Vec3::Constant(tolerance_));
    const std::array<std::int64_t, 3> high = cell_of(place + Vec3::Constant(tolerance_));
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
          const auto [from, to] = cells_.equal_range(key({i, j, k}));
          for (auto found = from; found != to; ++found)
            if ((points_[found->second] - place).cwiseAbs().maxCoeff() <= tolerance_)
              return found->second;
        }
    return std::nullopt;
  }

private:
  /// Cells are so much larger than the tolerance that a place meets one or two along an axis.
  [[nodiscard]] std::array<std::int64_t, 3> cell_of(const Vec3& place) const {
    const double size = 16.0 * tolerance_;
    return {static_cast<std::int64_t>(std::floor(place[0] / size)),
            static_cast<std::int64_t>(std::floor(place[1] / size)),
            static_cast<std::int64_t>(std::floor(place[2] / size))};
  }
  [[nodiscard]] static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell)
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
    return hash;
  }

  std::span<const Vec3> points_;
  double tolerance_;
  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

} // namespace billet::io
