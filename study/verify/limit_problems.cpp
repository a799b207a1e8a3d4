// Thick-walled tube and sphere of perfectly plastic metal under internal pressure (Hill 1950, ch.
// V).
//
// The references hold for small strains. Displacements go with sigma_y / E, so E is taken ten times
// that of steel: what finite strains add is below 5e-4.

#include "geometry/base/index.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "study/verify/mesh_text.h"
#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

constexpr double bore = 100.0, outside = 200.0; // radii [mm]
constexpr double front = 160.0;                 // plastic radius of the comparison [mm]
constexpr double vessel_yield = 240.0, vessel_young = 2100e3;

// Ten quadratic elements over the wall, eight of them yielding at the comparison.
constexpr double of_pressure = 2e-3, of_displacement = 5e-3;

/// The material: nearly incompressible, so that von Mises' metal flows as Tresca's does in plane
/// strain, where the closed form of the tube is Tresca's; and locking elements would show.
std::string vessel_material(double poisson) {
  return fmt::format(R"([material.wall]
elastic = {{ young = {}, poisson = {} }}
flow = {{ law = "perfect", yield = {} }}
)",
                     vessel_young, poisson, vessel_yield);
}

std::string tube_case_text(double poisson, const std::string& loading) {
  return fmt::format(R"(title = "Tube in plane strain"
analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "wall"
mesh = {{ box = [[{0}, 0], [{1}, 10]], cells = [10, 1] }}
{2}
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "y = 10"
fix = ["y"]
{3}
[time]
end = 1
increments = {{ first = 0.04, max = 0.04 }}
[solver]
tolerance = 1e-5
)",
                     bore, outside, vessel_material(poisson), loading);
}

/// A quarter of the sphere's meridian, its sets inner, axis and equator.
mechanics::Mesh sphere_mesh() {
  // To the bit on the planes of symmetry.
  const auto place = [](double r, double turn) {
    const double angle = 0.5 * std::numbers::pi * turn;
    const double radius = bore + (outside - bore) * r;
    return turn == 1.0 ? Vec3(0.0, radius, 0.0)
                       : Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  mechanics::Mesh mesh = with_elements(mechanics::ElementKind::quad8, mapped_grid(10, 8, place));
  // Middle nodes of the arcs go onto them; they were made in the middle of chords.
  for (Vec3& p : mesh.points) {
    const double cell = (outside - bore) / 20.0;
    const double radius = bore + cell * std::round((p.norm() - bore) / cell);
    if (p[0] > 0.0 && p[1] > 0.0)
      p *= radius / p.norm();
  }
  name_nodes(mesh, "inner", [](const Vec3& p) { return std::abs(p.norm() - bore) < 1e-6; });
  name_nodes(mesh, "axis", [](const Vec3& p) { return p[0] == 0.0; });
  name_nodes(mesh, "equator", [](const Vec3& p) { return p[1] == 0.0; });
  name_each_node(mesh, "inner");
  return mesh;
}

std::string sphere_case_text(const std::string& loading) {
  return fmt::format(R"(title = "Sphere"
analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "wall"
mesh = {{ file = "sphere.inp" }}
{}
[[support]]
where = "set:axis"
fix = ["x"]
[[support]]
where = "set:equator"
fix = ["y"]
{}
[time]
end = 1
increments = {{ first = 0.04, max = 0.04 }}
[solver]
tolerance = 1e-5
)",
                     vessel_material(0.3), loading);
}

/// Supports that push the bore of the sphere out along its radii.
std::string pushed_sphere(const mechanics::Mesh& mesh, double push) {
  std::string text;
  for (const mechanics::Index node : mesh.node_sets.at("inner")) {
    const Vec3 u = push / bore * mesh.points[static_cast<std::size_t>(node)];
    std::string move;
    if (u[0] != 0.0)
      move += fmt::format("x = [[0, 0], [1, {}]]", u[0]);
    if (u[1] != 0.0)
      move += fmt::format("{}y = [[0, 0], [1, {}]]", move.empty() ? "" : ", ", u[1]);
    text += fmt::format("[[support]]\nwhere = \"set:node-{}\"\nmove = {{ {} }}\n", node, move);
  }
  return text;
}

/// Radial force of the supports on the bore over the bore's area: the pressure that they stand for.
double pressure_on_bore(const process::Run& run) {
  double force = 0.0;
  for (const mechanics::Index node : run.mesh().node_sets.at("inner"))
    for (int i = 0; i < 2; ++i)
      force += run.state.reactions[idx(2 * node + i)] *
               run.mesh().points[static_cast<std::size_t>(node)][i] / bore;
  return force / (2.0 * std::numbers::pi * bore * bore);
}

// The bore goes three times as far as when all of the wall has begun to flow.
constexpr double pushed_out = 0.16;

} // namespace

std::vector<Figure> tube_under_pressure(const CaseBench& bench) {
  constexpr double poisson = 0.4999, k2 = 2.0 / std::numbers::sqrt3 * vessel_yield;
  const double c = front / outside,
               pressure = 0.5 * k2 * (2.0 * std::log(front / bore) + 1.0 - c * c);
  const auto pressed = bench.run(
      "tube-pressed",
      tube_case_text(poisson, fmt::format("[[load]]\nwhere = \"x = {}\"\npressure = [[0, 0], [1, "
                                          "{}]]\n",
                                          bore, pressure)));
  const double moved =
      position(pressed->view(), node_at(pressed->view(), {outside, 0, 0}))[0] - outside;
  const auto pushed = bench.run(
      "tube-pushed",
      tube_case_text(poisson, fmt::format("[[support]]\nwhere = \"x = {}\"\nmove = {{ x = [[0, 0], "
                                          "[1, {}]] }}\n",
                                          bore, pushed_out)));
  const double limit =
      reaction(pushed->view(), "x-min", 0) / (2.0 * std::numbers::pi * bore * 10.0);
  return {relative("displacement of the outside, plastic to r = 160", "mm", moved,
                   k2 * (1.0 - poisson * poisson) * front * front / (vessel_young * outside),
                   of_displacement),
          relative("pressure at which all of the wall flows", "MPa", limit,
                   k2 * std::log(outside / bore), of_pressure)};
}

std::vector<Figure> sphere_under_pressure(const CaseBench& bench) {
  const mechanics::Mesh mesh = sphere_mesh();
  bench.write("sphere.inp", inp_text(mesh));
  const double cube = std::pow(front / outside, 3);
  const double pressure = 2.0 * vessel_yield * (std::log(front / bore) + (1.0 - cube) / 3.0);
  const auto pressed =
      bench.run("sphere-pressed",
                sphere_case_text(fmt::format(
                    "[[load]]\nwhere = \"set:inner\"\npressure = [[0, 0], [1, {}]]\n", pressure)));
  const auto displacement = [&](double radius) {
    return position(pressed->view(), node_at(pressed->view(), {radius, 0, 0}))[0] - radius;
  };
  constexpr double poisson = 0.3, c3 = front * front * front;
  const double at_bore =
      vessel_yield / vessel_young *
      ((1.0 - poisson) * c3 / (bore * bore) -
       2.0 / 3.0 * (1.0 - 2.0 * poisson) * (3.0 * std::log(front / bore) + 1.0 - cube) * bore);
  const auto pushed = bench.run("sphere-pushed", sphere_case_text(pushed_sphere(mesh, pushed_out)));
  return {relative("displacement of the bore, plastic to r = 160", "mm", displacement(bore),
                   at_bore, of_displacement),
          relative("displacement of the outside, plastic to r = 160", "mm", displacement(outside),
                   vessel_yield / vessel_young * (1.0 - poisson) * c3 / (outside * outside),
                   of_displacement),
          relative("pressure at which all of the wall flows", "MPa",
                   pressure_on_bore(pushed->view()), 2.0 * vessel_yield * std::log(outside / bore),
                   of_pressure)};
}

} // namespace billet::study
