// Triangulations of round bodies, as a CAD program writes them.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace billet::geometry {

enum class Diagonals { parallel, alternating };

/// A cylinder about z through its corners, from z = 0 to `length`.
struct RoundBar {
  std::int32_t n = 36;     ///< facets around
  double radius = 10.0;    ///< of the corners [mm]
  double length = 50.0;    ///< [mm]
  std::int32_t layers = 1; ///< along z
  Diagonals diagonals = Diagonals::parallel;
  bool caps = true;
  double unevenness = 0.0; ///< of the angles between corners, below 1
};

inline TriangleMesh round_bar(const RoundBar& bar) {
  TriangleMesh mesh;
  const std::int32_t n = bar.n;
  for (std::int32_t k = 0; k <= bar.layers; ++k)
    for (std::int32_t i = 0; i < n; ++i) {
      const double turn = 2.0 * std::numbers::pi / n;
      const double angle = turn * (i + 0.5 * bar.unevenness * std::sin(2.7 * i));
      mesh.points.emplace_back(bar.radius * std::cos(angle), bar.radius * std::sin(angle),
                               bar.length * k / bar.layers);
    }
  for (std::int32_t k = 0; k < bar.layers; ++k)
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = k * n + i, b = k * n + (i + 1) % n, c = b + n, d = a + n;
      if (bar.diagonals == Diagonals::parallel || (i + k) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  const std::int32_t top = bar.layers * n;
  for (std::int32_t i = 1; bar.caps && i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({top, top + i, top + i + 1});
  }
  return mesh;
}

/// A sphere of radius 1 from an icosahedron, each triangle divided in four `levels` times.
inline TriangleMesh icosphere(int levels) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [it, added] = middles.try_emplace(std::minmax(a, b), 0);
      if (added) {
        it->second = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.emplace_back(mesh.points[static_cast<std::size_t>(a)] +
                                 mesh.points[static_cast<std::size_t>(b)]);
      }
      return it->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
    for (Vec3& p : mesh.points)
      p.normalize();
  }
  for (Vec3& p : mesh.points)
    p.normalize();
  return mesh;
}

/// A flat table that runs tangentially into a quarter round of radius 0.5.
inline TriangleMesh table_with_round(std::int32_t n) {
  constexpr double pi = std::numbers::pi;
  TriangleMesh mesh;
  std::vector<Vec2> section{{-3.0, 0.0}};
  for (std::int32_t i = 0; i <= n; ++i)
    section.emplace_back(0.5 * std::sin(0.5 * pi * i / n), 0.5 * std::cos(0.5 * pi * i / n) - 0.5);
  for (const Vec2& p : section) {
    mesh.points.emplace_back(p.x(), 0.0, p.y());
    mesh.points.emplace_back(p.x(), 4.0, p.y());
  }
  for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(section.size()); ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

/// A cone of height 2 on a circle of radius 1.
inline TriangleMesh cone(std::int32_t n) {
  constexpr double pi = std::numbers::pi;
  TriangleMesh mesh;
  mesh.points = {{0, 0, 2}, {0, 0, 0}};
  for (std::int32_t i = 0; i < n; ++i)
    mesh.points.emplace_back(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0.0);
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t a = 2 + i, b = 2 + (i + 1) % n;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

} // namespace billet::geometry
