// The die and the points of the benchmark of the search.
//
// A cavity of 100 x 100 mm with waves of 30 mm and ripples of 4 mm, as a sheet of triangles that
// faces up; a workpiece of which the points lie on it or up to 1 mm off, and creep over it.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace billet::bench {

inline constexpr double side = 100.0; // of the die [mm]
inline constexpr double reach = 10.0; // of the search [mm]

/// Height of the die over the plane. [mm]
inline double height(double x, double y) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return 5.0 * std::sin(turn * x / 30.0) * std::cos(turn * y / 30.0) +
         0.1 * std::sin(turn * (x + y) / 4.0);
}

/// At least `count` triangles over a square, facing up.
inline geometry::TriangleMesh
square(std::int64_t count, double low, double high, double (*z)(double, double)) {
  geometry::TriangleMesh mesh;
  const auto n = static_cast<std::int32_t>(std::ceil(std::sqrt(0.5 * static_cast<double>(count))));
  for (std::int32_t i = 0; i <= n; ++i)
    for (std::int32_t j = 0; j <= n; ++j) {
      const double x = low + (high - low) * i / n, y = low + (high - low) * j / n;
      mesh.points.emplace_back(x, y, z(x, y));
    }
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < n; ++j) {
      const std::int32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

inline geometry::TriangleMesh die(std::int64_t count) { return square(count, 0.0, side, height); }

/// Points of a workpiece's surface in rows, `farthest` or less off the die on either side; moved by
/// `step` over it.
inline std::vector<Vec3> workpiece(std::size_t rows, double farthest, const Vec3& step) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> offset(-farthest, farthest);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < rows; ++j) {
      const auto part = [rows](std::size_t k) {
        return 0.05 * side + 0.9 * side * static_cast<double>(k) / static_cast<double>(rows);
      };
      points.emplace_back(Vec3(part(i), part(j), height(part(i), part(j)) + offset(generator)) +
                          step);
    }
  return points;
}

/// Points anywhere over the die, up to its size away.
inline std::vector<Vec3> scattered(std::size_t count) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> along(0.0, side);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = along(generator), y = along(generator), z = along(generator);
    points.emplace_back(x, y, z);
  }
  return points;
}

} // namespace billet::bench
