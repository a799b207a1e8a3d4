// The first job in space of many: a die of flat facets that a force drives into a round bar. (P.32)

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace billet::test::faceted_die_test {

namespace {

std::string facet(const std::array<std::array<double, 3>, 3>& corners) {
  std::string text = "facet normal 0 0 0\nouter loop\n";
  for (const auto& [x, y, z] : corners) {
    std::array<char, 96> line{};
    std::snprintf(line.data(), line.size(), "vertex %.9g %.9g %.9g\n", x, y, z);
    text += line.data();
  }
  return text + "endloop\nendfacet\n";
}

/// A dome of radius 20 in 360 facets whose lowest point is (0, 0, 15).
std::string dome() {
  constexpr int rings = 8, sectors = 24;
  const auto corner = [](int ring, int sector) {
    const double r = 15.0 * ring / rings, turn = 2.0 * std::numbers::pi * sector / sectors;
    return std::array{r * std::cos(turn), r * std::sin(turn), 35.0 - std::sqrt(400.0 - r * r)};
  };
  std::string text = "solid x\n";
  for (int j = 0; j < sectors; ++j)
    for (int i = 0; i < rings; ++i) {
      text += facet({corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
      if (i > 0)
        text += facet({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
    }
  return text + "endsolid x\n";
}

const std::string bar = R"(analysis = "3d"
[workpiece]
element = "hex8"
material = "metal"
mesh = { cylinder = { radius = 10, height = 15 }, cells = [4, 6], sector = 90 }
[material.metal]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "swift", K = "180 MPa", eps0 = 0.01, n = 0.25 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "z = 0"
fix = ["z"]
[[tool]]
name = "die"
surface = { stl = "dome.stl", unit = "mm" }
motion = { force = { direction = [0, 0, -1], value = [[0, 0], [1, 25000]] } }
touch = true
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 1
)";

TEST(FacetedDieLong, GoesOnWhereItsForceDipsFromFacetToFacet) {
  // The part bears up to 3 % less over a tenth of a millimetre whenever corners pass a ridge, so
  // that a growing force finds no equilibrium next to the last one.
  const TemporaryFolder folder;
  static_cast<void>(folder.file("dome.stl", dome()));
  static_cast<void>(folder.file("bar.toml", bar));
  const Outcome outcome = billet({"run", "bar.toml", "--quiet", "-o", "out"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

} // namespace
} // namespace billet::test::faceted_die_test
