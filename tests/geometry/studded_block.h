// A block with small studs in rows on its top: a large part with small details.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace billet::geometry {

/// 20 x 20 x 6, with n x n cubes of side `width` on z = 6.
inline TriangleMesh studded_block(int n, double width) {
  std::array<std::vector<double>, 3> at{std::vector{0.0}, {}, {0.0, 6.0, 6.0 + width}};
  for (int i = 0; i < n; ++i)
    for (const double side : {-0.5, 0.5})
      at[0].push_back((i + 0.5) * 20.0 / n + side * width);
  at[0].push_back(20.0);
  at[1] = at[0];
  const auto filled = [&](std::array<int, 3> cell) {
    const int last = static_cast<int>(at[0].size()) - 2;
    if (cell[0] < 0 || cell[1] < 0 || cell[0] > last || cell[1] > last)
      return false;
    return cell[2] == 0 || (cell[2] == 1 && cell[0] % 2 == 1 && cell[1] % 2 == 1);
  };
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto point = [&](const std::array<int, 3>& corner) {
    const auto [place, is_new] =
        numbers.try_emplace(corner, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new)
      mesh.points.emplace_back(at[0][static_cast<std::size_t>(corner[0])],
                               at[1][static_cast<std::size_t>(corner[1])],
                               at[2][static_cast<std::size_t>(corner[2])]);
    return place->second;
  };
  const int cells = static_cast<int>(at[0].size()) - 1;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < 2; ++k)
        for (std::size_t axis = 0; axis < 3 && filled({i, j, k}); ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> beside{i, j, k};
            beside[axis] += 2 * side - 1;
            if (filled(beside))
              continue;
            std::array<std::int32_t, 4> ring{};
            for (std::size_t c = 0; c < 4; ++c) {
              std::array<int, 3> corner{i, j, k};
              corner[axis] += side;
              corner[(axis + 1) % 3] += c == 1 || c == 2 ? 1 : 0;
              corner[(axis + 2) % 3] += c >= 2 ? 1 : 0;
              ring[side == 1 ? c : 3 - c] = point(corner);
            }
            mesh.triangles.push_back({ring[0], ring[1], ring[2]});
            mesh.triangles.push_back({ring[0], ring[2], ring[3]});
          }
  return mesh;
}

} // namespace billet::geometry
