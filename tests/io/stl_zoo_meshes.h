// Surfaces for the zoo, and the damage they come to.

#pragma once

#include "tests/geometry/sample_meshes.h"
#include "tests/io/stl_zoo.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace billet::io {

using geometry::cube;
using geometry::flipped;
using geometry::sphere_mesh;
using geometry::TriangleMesh;

using Triangle = std::array<std::int32_t, 3>;

inline TriangleMesh ball() { return sphere_mesh(10); }

inline TriangleMesh flat(std::int32_t n) {
  return geometry::sheet(n, [](double, double) { return 0.0; });
}

inline TriangleMesh box(double x, double y, double z) {
  return geometry::prism({{0, 0}, {x, 0}, {x, y}, {0, y}}, z);
}

inline std::size_t any(Random& random, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

inline Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

inline TriangleMesh with(TriangleMesh mesh, const Triangle& t) {
  mesh.triangles.push_back(t);
  return mesh;
}

// Every triangle drawn towards its middle.
inline TriangleMesh shrunk(const TriangleMesh& mesh, double by) {
  TriangleMesh soup = geometry::soup(mesh);
  for (std::size_t i = 0; i < soup.points.size(); i += 3) {
    const Vec3 middle = (soup.points[i] + soup.points[i + 1] + soup.points[i + 2]) / 3.0;
    for (std::size_t k = i; k < i + 3; ++k)
      soup.points[k] += by * (middle - soup.points[k]);
  }
  return soup;
}

inline TriangleMesh without(TriangleMesh mesh, std::size_t first, std::size_t every) {
  TriangleMesh rest{mesh.points, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t % every != first)
      rest.triangles.push_back(mesh.triangles[t]);
  return rest;
}

inline TriangleMesh partly_turned(TriangleMesh mesh, std::size_t every) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += every)
    mesh.triangles[t] = turned(mesh.triangles[t]);
  return mesh;
}

// Every corner of every triangle a little off.
inline TriangleMesh shaken(const TriangleMesh& mesh, double by, Random& random) {
  TriangleMesh soup = geometry::soup(mesh);
  for (Vec3& p : soup.points)
    p += Vec3(between(random, -by, by), between(random, -by, by), between(random, -by, by));
  return soup;
}

// The triangle after `share` of its first side is cut in two, and its neighbour not; `filled` by a
// triangle without height.
inline TriangleMesh split_on_one_side(TriangleMesh mesh, std::size_t t, double share, bool filled) {
  const Triangle old = mesh.triangles[t];
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  const Vec3 a = geometry::corner(mesh, t, 0), b = geometry::corner(mesh, t, 1);
  mesh.points.emplace_back(a + share * (b - a));
  mesh.triangles[t] = {old[0], middle, old[2]};
  mesh.triangles.push_back({middle, old[1], old[2]});
  if (filled)
    mesh.triangles.push_back({old[0], old[1], middle});
  return mesh;
}

// A band with a number of half turns.
inline TriangleMesh band(int half_turns) {
  constexpr std::int32_t n = 40;
  TriangleMesh mesh;
  for (std::int32_t i = 0; i <= n; ++i) {
    const double phi = 2.0 * std::numbers::pi * i / n, tilt = 0.5 * phi * half_turns;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    for (const double w : {-0.3, 0.3})
      mesh.points.emplace_back((1.0 + w * std::cos(tilt)) * out +
                               w * std::sin(tilt) * Vec3::UnitZ());
  }
  // The last pair is the first, swapped after an odd number of half turns.
  const bool odd = half_turns % 2 != 0;
  mesh.points[2 * n] = mesh.points[odd ? 1 : 0];
  mesh.points[2 * n + 1] = mesh.points[odd ? 0 : 1];
  for (std::int32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

inline TriangleMesh heap(Random& random) {
  TriangleMesh mesh;
  for (std::int32_t i = 0; i < 300; ++i)
    mesh.points.emplace_back(between(random, 0, 1), between(random, 0, 1), between(random, 0, 1));
  for (std::int32_t i = 0; i < 300; i += 3)
    mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

// A cube glued to its mirror image: the face between has the same two triangles.
inline TriangleMesh mirrored_cube() {
  TriangleMesh mesh = flipped(cube());
  for (Vec3& p : mesh.points)
    p.x() = 2.0 - p.x();
  return mesh;
}

inline TriangleMesh upright(double x, double turn) {
  TriangleMesh mesh = flat(3);
  for (Vec3& p : mesh.points)
    p = Eigen::AngleAxisd(turn, Vec3::UnitX()) * Vec3(p - Vec3(x, 0.51, 0));
  return mesh;
}

} // namespace billet::io
