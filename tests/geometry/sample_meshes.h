// Triangulated bodies for the tests, and distances and signs found without any tree.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/triangle_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace billet::geometry {

inline const Vec3& corner(const TriangleMesh& mesh, std::size_t t, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(mesh.triangles[t][i])];
}

/// A prism over a counter-clockwise polygon that is a fan about its first corner.
inline TriangleMesh prism(const std::vector<Vec2>& base, double height) {
  TriangleMesh mesh;
  const auto n = static_cast<std::int32_t>(base.size());
  for (const double z : {0.0, height})
    for (const Vec2& p : base)
      mesh.points.emplace_back(p.x(), p.y(), z);
  for (std::int32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({n, n + i, n + i + 1});
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
  }
  return mesh;
}

inline TriangleMesh cube() { return prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1.0); }

/// A right angle of two bars: one concave edge. Its fan starts at the concave corner.
inline TriangleMesh angle_bar() {
  return prism({{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}}, 1.5);
}

/// Longitude-latitude sphere whose radius is a function of the direction.
inline TriangleMesh star(std::int32_t n, const std::function<double(const Vec3&)>& radius) {
  TriangleMesh mesh;
  const auto add = [&](const Vec3& direction) {
    mesh.points.emplace_back(radius(direction) * direction);
  };
  add(Vec3::UnitZ());
  for (std::int32_t i = 1; i < n; ++i)
    for (std::int32_t j = 0; j < 2 * n; ++j) {
      const double theta = std::numbers::pi * i / n, phi = std::numbers::pi * j / n;
      add({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  add(-Vec3::UnitZ());
  const auto last = static_cast<std::int32_t>(mesh.points.size()) - 1;
  const auto at = [n](std::int32_t i, std::int32_t j) { return 1 + (i - 1) * 2 * n + j % (2 * n); };
  for (std::int32_t j = 0; j < 2 * n; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::int32_t i = 1; i + 1 < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(n - 1, j), last, at(n - 1, j + 1)});
  }
  return mesh;
}

inline TriangleMesh sphere_mesh(std::int32_t n) {
  return star(n, [](const Vec3&) { return 1.0; });
}

/// Sharp spikes and valleys of every shape: each vertex at a radius of its own.
inline TriangleMesh spiky(std::int32_t n) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> radius(0.5, 1.5);
  return star(n, [&](const Vec3&) { return radius(generator); });
}

/// A square sheet of n x n cells over [0, 1]^2 in z = f(x, y), facing +z.
inline TriangleMesh sheet(std::int32_t n, const std::function<double(double, double)>& f) {
  TriangleMesh mesh;
  for (std::int32_t i = 0; i <= n; ++i)
    for (std::int32_t j = 0; j <= n; ++j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      mesh.points.emplace_back(x, y, f(x, y));
    }
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < n; ++j) {
      const std::int32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// Distance to a triangle by the regions of its barycentric coordinates.
inline double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (va > 0 && vb > 0 && vc > 0)
    return std::abs(ax.dot(ab.cross(ac).normalized()));
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    const double t = std::clamp((x - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (x - p - t * (q - p)).norm());
  }
  return least;
}

inline double brute_distance(const TriangleMesh& mesh, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    least = std::min(
        least, distance_to_triangle(x, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)));
  return least;
}

/// How often the surface winds around x: 1 inside, 0 outside (sum of solid angles).
inline double winding(const TriangleMesh& mesh, const Vec3& x) {
  double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = corner(mesh, t, 0) - x, b = corner(mesh, t, 1) - x, c = corner(mesh, t, 2) - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

/// Every triangle with corners of its own, as in an STL.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh loose;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(loose.points.size());
    loose.triangles.push_back({first, first + 1, first + 2});
    for (std::size_t i = 0; i < 3; ++i)
      loose.points.push_back(corner(mesh, t, i));
  }
  return loose;
}

} // namespace billet::geometry
