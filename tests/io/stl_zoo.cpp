#include "tests/io/stl_zoo.h"

#include "tests/geometry/sample_meshes.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>

namespace billet::io {

using geometry::TriangleMesh;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points)
    p += by;
  return mesh;
}

TriangleMesh posed(TriangleMesh mesh, Random& random) {
  const Vec3 axis = Vec3(between(random, -1, 1), between(random, -1, 1), 1.5).normalized();
  const Mat3 turn = Eigen::AngleAxisd(between(random, 0.0, 6.0), axis).toRotationMatrix();
  const double scale = between(random, 10.0, 100.0);
  const Vec3 shift(between(random, -50, 50), between(random, -50, 50), between(random, -50, 50));
  for (Vec3& p : mesh.points)
    p = scale * (turn * p) + shift;
  return mesh;
}

TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto first = static_cast<std::int32_t>(a.points.size());
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (const std::array<std::int32_t, 3>& t : b.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return both;
}

std::string binary_stl(const TriangleMesh& mesh, const std::string& header) {
  std::string bytes = header.substr(0, 80);
  bytes.resize(80, ' ');
  const auto put = [&](auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(value)>>(value);
    bytes.append(raw.data(), raw.size());
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = geometry::corner(mesh, t, 0), &b = geometry::corner(mesh, t, 1),
               &c = geometry::corner(mesh, t, 2);
    for (const Vec3& v : {Vec3((b - a).cross(c - a).stableNormalized()), a, b, c})
      for (int i = 0; i < 3; ++i)
        put(static_cast<float>(v[i]));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const TriangleMesh& mesh, int digits, const std::string& name) {
  std::string text = "solid " + name + "\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = geometry::corner(mesh, t, i);
      text += fmt::format("   vertex {0:.{3}g} {1:.{3}g} {2:.{3}g}\n", x.x(), x.y(), x.z(), digits);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

} // namespace billet::io
