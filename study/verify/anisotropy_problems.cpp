// Friction that depends on the direction of sliding, and the wear that sliding leaves.

#include <fmt/format.h>

#include <numbers>
#include <string>

#include "study/verify/friction_block.h"
#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

constexpr double diagonal_pressure = 200.0, diagonal_speed = 1.0; // [MPa], [mm/s] along x and y

/// A brick that slides at 45 degrees to the axes of the floor.
std::string diagonal_block_text() {
  const double way = 2.0 * diagonal_speed;
  return fmt::format(R"(title = "Brick on an anisotropic floor"
analysis = "3d"
[workpiece]
element = "hex8"
material = "metal"
mesh = {{ box = [[0, 0, 0], [10, 10, 10]], cells = [1, 1, 1] }}
[material.metal]
elastic = {{ young = {0}, poisson = {1} }}
[[support]]
where = "all"
move = {{ x = [[0, 0], [2, {2}]], y = [[0, 0], [2, {2}]] }}
[[support]]
where = "z = 10"
fix = ["z"]
[[tool]]
name = "floor"
surface = {{ plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }} }}
motion = {{ force = {{ direction = [0, 0, 1], value = [[0, 0], [1, {3}], [2, {3}]] }} }}
touch = true
friction = {{ law = "coulomb", mu = 1, tensor = [[0.1, 0], [0, 0.3]], direction = [1, 0, 0] }}
[contact]
surface = "set:z-min"
[time]
end = 2
increments = {{ first = 0.1, max = 0.1 }}
[solver]
tolerance = 1e-9
)",
                     block_young, block_poisson, way, 100.0 * diagonal_pressure);
}

constexpr double worn_K = 1e-4, worn_hardness = 8000.0, worn_pressure = 500.0, worn_way = 100.0;

/// A block that slides 100 mm under 500 MPa over a floor that wears.
std::string worn_floor_text() {
  return fmt::format(R"(title = "Wear of a floor"
analysis = "plane-strain"
[workpiece]
element = "quad4"
material = "metal"
mesh = {{ box = [[0, 0], [10, 10]], cells = [1, 1] }}
[material.metal]
elastic = {{ young = {0}, poisson = {1} }}
[[support]]
where = "all"
move = {{ x = [[0, 0], [1, 0], [2, {2}]] }}
[[support]]
where = "y = 10"
fix = ["y"]
[[tool]]
name = "floor"
surface = {{ plane = {{ point = [0, 0], normal = [0, 1] }} }}
motion = {{ force = {{ direction = [0, 1], value = [[0, 0], [1, {3}], [2, {3}]] }} }}
touch = true
friction = {{ law = "coulomb", mu = 0.1 }}
wear = {{ law = "archard", K = {4}, hardness = {5} }}
[contact]
surface = "set:y-min"
[time]
end = 2
increments = {{ first = 0.1, max = 0.1 }}
)",
                     block_young, block_poisson, worn_way, 10.0 * worn_pressure, worn_K,
                     worn_hardness);
}

} // namespace

std::vector<Figure> anisotropic_block(const CaseBench& bench) {
  const auto process = bench.run("block-anisotropic", diagonal_block_text());
  const Vec3 force = force_on_tool(process->view());
  constexpr double area = 100.0, tolerance = 1e-6;
  const double along = diagonal_pressure / std::numbers::sqrt2; // p d_x = p d_y
  return {relative("shear along x, Q11 p d_x", "MPa", force[0] / area, 0.1 * along, tolerance),
          relative("shear along y, Q22 p d_y", "MPa", force[1] / area, 0.3 * along, tolerance)};
}

std::vector<Figure> worn_floor(const CaseBench& bench) {
  const auto process = bench.run("worn-floor", worn_floor_text());
  // The shear builds up over tau / K_t = 0.00025 mm of the way, in which nothing wears.
  constexpr double of_stick = 1e-5;
  return {relative("volume worn off the floor", "mm^3/mm",
                   process->view().model.wear->map(0)->volume(),
                   worn_K / worn_hardness * worn_pressure * 10.0 * worn_way, of_stick)};
}

} // namespace billet::study
