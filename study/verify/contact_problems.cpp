// Contact without friction: the patch test, the paper's mixed element, Hertz's line and point.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

using mechanics::ElementKind;

// --- The patch test of contact ------------------------------------------------------------------

constexpr double patch_force = 20.0; // on 2 x 1 [N]
constexpr double of_rounding = 1e-8;

/// Rollers, or a clamp where the block is turned: without Poisson's effect they hold the same.
std::string supports_of_block(bool solid, bool turned) {
  if (turned)
    return fmt::format("[[support]]\nwhere = \"set:y-min\"\nfix = [\"x\", \"y\"{}]\n",
                       solid ? ", \"z\"" : "");
  std::string rollers;
  for (const char axis : {'x', 'y', 'z'})
    if (solid || axis != 'z')
      rollers += fmt::format("[[support]]\nwhere = \"{0} = 0\"\nfix = [\"{0}\"]\n", axis);
  return rollers;
}

/// A block of uneven cells under a flat die that a force presses on it.
/// @param turn  of block and die together about z [degrees]
std::string pressed_block_text(ElementKind kind, double turn) {
  const bool solid = mechanics::dimension(kind) == 3;
  const double angle = turn * std::numbers::pi / 180.0, s = std::sin(angle), c = std::cos(angle);
  const std::string z = solid ? ", 0" : "";
  const std::string supports = supports_of_block(solid, turn != 0.0);
  return fmt::format(
      R"(title = "Contact patch test of {0}"
analysis = "{1}"
[workpiece]
element = "{0}"
material = "elastic"
mesh = {{ box = [[0, 0{2}], [2, 1{3}]], cells = [4, 3{4}], grading = [3, 1{5}] }}
place = {{ rotate = {{ {6}degrees = {7} }} }}
[material.elastic]
elastic = {{ young = 1000, poisson = {8} }}
{9}[[tool]]
name = "die"
surface = {{ plane = {{ point = [{10}, {11}{2}], normal = [{12}, {13}{2}] }} }}
motion = {{ force = {{ direction = [{12}, {13}{2}], value = [[0, 0], [1, {14}]] }} }}
touch = true
[contact]
surface = "set:y-max"
[time]
end = 1
increments = {{ first = 0.25, max = 0.25 }}
[solver]
tolerance = 1e-11
)",
      mechanics::name(kind), solid ? "3d" : "plane-strain", z, solid ? ", 1" : "",
      solid ? ", 3" : "", solid ? ", 2" : "", solid ? "axis = [0, 0, 1], " : "", turn,
      turn == 0.0 ? 0.3 : 0.0, supports, -s, c, s, -c, patch_force);
}

/// Force over the area that the top has now, and the largest deviation of a pressure from it.
void add_pressed_block(const CaseBench& bench,
                       ElementKind kind,
                       double turn,
                       std::vector<Figure>& to) {
  const std::string element(mechanics::name(kind));
  const auto process =
      bench.run(fmt::format("contact-patch-{}{}", element, turn == 0.0 ? "" : "-turned"),
                pressed_block_text(kind, turn));
  const process::Run& run = process->view();
  double area = 2.0;
  if (turn == 0.0) // else the block does not widen
    area = largest_coordinate(run, 0) *
           (run.mesh().dimension() == 3 ? largest_coordinate(run, 2) : 1.0);
  const double pressure = patch_force / area;
  double farthest = pressure;
  for (const ContactReading& point : contact_readings(run))
    if (std::abs(point.pressure - pressure) >= std::abs(farthest - pressure))
      farthest = point.pressure;
  to.push_back(relative(fmt::format("{}{}: pressure at the contact point where it is farthest off",
                                    element, turn == 0.0 ? "" : ", turned by 30 degrees"),
                        "MPa", farthest, pressure, of_rounding));
}

// --- The mixed contact element ------------------------------------------------------------------

constexpr double mixed_young = 1000.0, mixed_penalty = 2.0, mixed_tilt = 0.01, mixed_stroke = 0.05;

/// One quad8 of 2 x 1 under a die that is tilted a little: the face's nodes are pressed in by
/// different amounts.
std::string mixed_element_text() {
  return fmt::format(R"(title = "One mixed contact element"
analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "elastic"
mesh = {{ box = [[-1, 0], [1, 1]], cells = [1, 1] }}
[material.elastic]
elastic = {{ young = {}, poisson = 0.3 }}
[[support]]
where = "y = 0"
fix = ["x", "y"]
[[tool]]
name = "die"
surface = {{ plane = {{ point = [0, 1.02], normal = [{}, {}] }} }}
motion = {{ velocity = [0, {}] }}
[contact]
form = "mixed"
penalty = {}
surface = "set:y-max"
[time]
end = 1
[solver]
tolerance = 1e-10
)",
                     mixed_young, std::sin(mixed_tilt), -std::cos(mixed_tilt),
                     -(mixed_stroke + 0.02), mixed_penalty);
}

// --- Hertz --------------------------------------------------------------------------------------

constexpr double hertz_radius = 100.0, hertz_young = 210e3, hertz_poisson = 0.3;
constexpr double hertz_modulus = hertz_young / (1.0 - hertz_poisson * hertz_poisson);
constexpr double contact_radius = 0.75; // a [mm]

/// A rigid cylinder or ball on the half of a block that is far larger than the contact.
/// @param force  of the half in plane strain, of the full turn else [N]
std::string hertz_text(const std::string& analysis, double force) {
  // Cells of a/33 under the middle, of a/7 at the border of the contact. In plane strain a block
  // of finite size adds stresses of the order of a / size to those of the half space.
  constexpr int cells = 66;
  constexpr double size = 300.0 * contact_radius, grading = 1000.0;
  return fmt::format(R"(title = "Hertz"
analysis = "{0}"
[workpiece]
element = "quad8"
material = "elastic"
mesh = {{ box = [[0, {1}], [{2}, 0]], cells = [{3}, {3}], grading = [{4}, {5}] }}
[material.elastic]
elastic = {{ young = {6}, poisson = {7} }}
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = {1}"
fix = ["y"]
[[tool]]
name = "indenter"
surface = {{ circle = {{ centre = [0, {8}], radius = {8} }} }}
motion = {{ force = {{ direction = [0, -1], value = [[0, 0], [1, {9}]] }} }}
touch = true
[contact]
surface = "set:y-max"
[time]
end = 1
increments = {{ first = 0.25, max = 0.25 }}
)",
                     analysis, -size, size, cells, grading, 1.0 / grading, hertz_young,
                     hertz_poisson, hertz_radius, force);
}

constexpr double of_mesh = 5e-3;  // the border of the contact lies within a cell of a/7
constexpr double of_shear = 1e-2; // the same, and what the finite block adds

/// The pressures of contact points compared with p0 sqrt(1 - r^2 / a^2).
struct HertzFit {
  double amplitude;     ///< best p0 for the points found [MPa]
  double second_moment; ///< sum of p A r^2 [N mm^2]
  double middle;        ///< mean pressure within a/4 over that of the reference [-]
};

HertzFit hertz_fit(const process::Run& run, double p0) {
  const auto shape = [](double r) {
    const double s = 1.0 - r * r / (contact_radius * contact_radius);
    return s > 0.0 ? std::sqrt(s) : 0.0;
  };
  double with_shape = 0.0, of_shape = 0.0, moment = 0.0, found = 0.0, expected = 0.0;
  for (const ContactReading& point : contact_readings(run)) {
    const double r = point.position[0], w = shape(r);
    with_shape += point.pressure * w * point.area;
    of_shape += w * w * point.area;
    moment += point.pressure * point.area * r * r;
    if (r < 0.25 * contact_radius) {
      found += point.pressure * point.area;
      expected += p0 * w * point.area;
    }
  }
  return {with_shape / of_shape, moment, found / expected};
}

/// Largest shear stress in the plane at the integration points of the elements next to x = 0 [MPa].
double largest_shear_in_the_middle(const process::Run& run) {
  const std::vector<Mat3> stresses = run.model.bulk->stresses(run.positions());
  double largest = 0.0;
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    const auto nodes = run.model.bulk->nodes_around(i);
    const bool in_the_middle = std::any_of(nodes.begin(), nodes.end(), [&](mechanics::Index node) {
      return run.mesh().points[static_cast<std::size_t>(node)][0] == 0.0;
    });
    const Mat3& sigma = stresses[i];
    if (in_the_middle)
      largest = std::max(largest, std::hypot(0.5 * (sigma(0, 0) - sigma(1, 1)), sigma(0, 1)));
  }
  return largest;
}

} // namespace

std::vector<Figure> contact_patch(const CaseBench& bench) {
  std::vector<Figure> figures;
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                                 ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    add_pressed_block(bench, kind, 0.0, figures);
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex20})
    add_pressed_block(bench, kind, 30.0, figures);
  return figures;
}

std::vector<Figure> mixed_contact_element(const CaseBench& bench) {
  const auto process = bench.run("mixed-contact-element", mixed_element_text());
  const process::Run& run = process->view();
  const Vec3 normal(std::sin(mixed_tilt), -std::cos(mixed_tilt), 0.0);
  const Vec3 on_die(0.0, 1.0 - mixed_stroke, 0.0);
  // How deep the nodes of the face are in the die, U - u_F of the paper: 1 and 3 at its ends.
  std::array<double, 3> U{};
  for (std::size_t a = 0; a < 3; ++a)
    U[a] = (on_die - position(run, node_at(run, {static_cast<double>(a) - 1.0, 1.0, 0.0})))
               .dot(normal);
  std::vector<ContactReading> points = contact_readings(run);
  std::sort(points.begin(), points.end(), [](const ContactReading& a, const ContactReading& b) {
    return a.position[0] < b.position[0];
  });
  if (points.size() != 2)
    return {absolute("contact points of a mixed quad8 face", "-",
                     static_cast<double>(points.size()), 2.0, 0.0)};
  // The pressure is linear along the face: from the two points to its ends.
  const double mean = 0.5 * (points[0].pressure + points[1].pressure);
  const double half = 0.5 * std::numbers::sqrt3 * (points[1].pressure - points[0].pressure);
  constexpr double K = mixed_penalty * mixed_young; // per depth of the element, 1 mm
  const auto along = [&](double xi) {
    return 0.5 * xi * (xi - 1.0) * U[0] + (1.0 - xi * xi) * U[1] + 0.5 * xi * (xi + 1.0) * U[2];
  };
  constexpr double at = 1.0 / std::numbers::sqrt3;
  return {relative("p1 = Kp [(2 U1 + 2 U2 - U3) / 3 - uF], eq 15", "MPa", mean - half,
                   K * (2.0 * U[0] + 2.0 * U[1] - U[2]) / 3.0, of_rounding),
          relative("p3 = Kp [(2 U3 + 2 U2 - U1) / 3 - uF], eq 15", "MPa", mean + half,
                   K * (2.0 * U[2] + 2.0 * U[1] - U[0]) / 3.0, of_rounding),
          relative("p(-1/sqrt 3) = Kp [u - uF], eq 16", "MPa", points[0].pressure, K * along(-at),
                   of_rounding),
          relative("p(+1/sqrt 3) = Kp [u - uF], eq 16", "MPa", points[1].pressure, K * along(at),
                   of_rounding)};
}

std::vector<Figure> hertz_line(const CaseBench& bench) {
  constexpr double a = contact_radius;
  const double p0 = hertz_modulus * a / (2.0 * hertz_radius);
  const double force = std::numbers::pi / 4.0 * p0 * a;
  const auto process = bench.run("hertz-line", hertz_text("plane-strain", force));
  const HertzFit fit = hertz_fit(process->view(), p0);
  return {relative("largest pressure, best fit of the ellipse", "MPa", fit.amplitude, p0, of_mesh),
          relative("mean pressure within a/4 of the middle, over Hertz's", "-", fit.middle, 1.0,
                   of_mesh),
          relative("half width of contact, from the second moment of pressure", "mm",
                   std::sqrt(4.0 * fit.second_moment / force), a, of_mesh),
          relative("largest shear stress below the surface, 0.300 p0", "MPa",
                   largest_shear_in_the_middle(process->view()), 0.300 * p0, of_shear)};
}

std::vector<Figure> hertz_point(const CaseBench& bench) {
  constexpr double a = contact_radius;
  const double p0 = 2.0 * hertz_modulus * a / (std::numbers::pi * hertz_radius);
  const double force = 2.0 / 3.0 * std::numbers::pi * a * a * p0;
  const auto process = bench.run("hertz-point", hertz_text("axisymmetric", force));
  const HertzFit fit = hertz_fit(process->view(), p0);
  return {
      relative("largest pressure, best fit of the ellipsoid", "MPa", fit.amplitude, p0, of_mesh),
      relative("mean pressure within a/4 of the middle, over Hertz's", "-", fit.middle, 1.0,
               of_mesh),
      relative("radius of contact, from the second moment of pressure", "mm",
               std::sqrt(2.5 * fit.second_moment / force), a, of_mesh)};
}

} // namespace billet::study
