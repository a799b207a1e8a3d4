// Pairs of meshes of one body, for carrying fields from the one to the other.

#pragma once

#include "mechanics/elements/mesh_locator.h"
#include "mechanics/mesh/mesh_generators.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace billet::support {

inline constexpr std::array transfer_kinds{
    mechanics::ElementKind::quad4, mechanics::ElementKind::quad8, mechanics::ElementKind::tri6,
    mechanics::ElementKind::hex8,  mechanics::ElementKind::hex20, mechanics::ElementKind::tet10};

/// A box of unit cells along x, `width` across, all borders between cells moved by `shift` along x
/// but the ends; inner nodes moved by waves of about `waves`, so that edges curve.
inline mechanics::Mesh
shifted_strip(mechanics::ElementKind kind, int length, int width, double shift, double waves) {
  const bool solid = mechanics::dimension(kind) == 3;
  const int n = length + (shift > 0.0 ? 1 : 0);
  mechanics::Mesh mesh = mechanics::box_mesh(
      {.kind = kind, .high = Vec3(n, width, width), .cells = {n, width, solid ? width : 1}});
  // Tetrahedra are half as large as the cells they are cut from.
  const double size = kind == mechanics::ElementKind::tet10 ? 0.5 * waves : waves;
  for (Vec3& p : mesh.points) {
    if (shift > 0.0)
      p[0] = p[0] < 1.0      ? p[0] * shift
             : p[0] > length ? length - 1 + shift + (p[0] - length) * (1.0 - shift)
                             : p[0] - 1.0 + shift;
    const double along = std::sin(std::numbers::pi * p[0] / length);
    const double across = std::sin(std::numbers::pi * p[1] / width);
    const double phase = 7.1 * p[0] + 3.3 * p[1] + 2.0 * p[2];
    p[0] += size * along * std::sin(phase);
    p[1] += size * across * std::cos(0.7 * phase);
  }
  return mesh;
}

/// A mesh with values at its integration points.
struct PointwiseField {
  mechanics::Mesh mesh;
  std::vector<double> x;
  std::vector<Vec3> points;
  std::vector<double> values;

  explicit PointwiseField(mechanics::Mesh of)
      : mesh(std::move(of)), x(mechanics::node_positions(mesh)),
        points(mechanics::integration_points(mesh, x)), values(points.size()) {}
  PointwiseField(mechanics::Mesh of, const std::function<double(const Vec3&)>& f)
      : PointwiseField(std::move(of)) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = f(points[i]);
  }
};

} // namespace billet::support
