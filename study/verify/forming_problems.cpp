// Upsetting of solid and hollow cylinders: closed forms without friction, the slab method and upper
// bounds with it.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/verify/problems.h"
#include "study/verify/readings.h"
#include "study/verify/ring_bound.h"

namespace billet::study {

namespace {

/// The upper half of a cylinder, a ring or a bar, pressed by a flat die.
struct FlatUpsetting {
  std::string name;
  std::string analysis; ///< "axisymmetric" or "3d"
  std::string element;
  std::string box;   ///< corners
  std::string cells; ///< numbers
  double height;     ///< half of the part's [mm]
  double reduction;  ///< [-]
  std::string flow;
  std::string friction;
  std::string extra = ""; ///< lines at the end
};

std::string upsetting_text(const FlatUpsetting& u) {
  const bool solid = u.analysis == "3d";
  const std::string up = solid ? "z" : "y", zero = solid ? "0, 0, " : "0, ";
  std::string supports = fmt::format("[[support]]\nwhere = \"{0} = 0\"\nfix = [\"{0}\"]\n", up);
  if (u.name.find("ring") == std::string::npos)
    supports += "[[support]]\nwhere = \"x = 0\"\nfix = [\"x\"]\n";
  if (solid)
    supports += "[[support]]\nwhere = \"y = 0\"\nfix = [\"y\"]\n";
  return fmt::format(R"(title = "Upsetting: {0}"
analysis = "{1}"
[workpiece]
element = "{2}"
material = "metal"
mesh = {{ box = [{3}], cells = [{4}] }}
[material.metal]
elastic = {{ young = 200e3, poisson = 0.3 }}
flow = {5}
{6}[[tool]]
name = "die"
surface = {{ plane = {{ point = [{7}{8}], normal = [{7}-1] }} }}
motion = {{ velocity = [{7}-1] }}
friction = {9}
[time]
end = {10}
{11}
)",
                     u.name, u.analysis, u.element, u.box, u.cells, u.flow, supports, zero,
                     u.height, u.friction, u.reduction * u.height, u.extra);
}

// --- Without friction ---------------------------------------------------------------------------

constexpr double hard_yield = 700.0, hard_slope = 300.0, hard_young = 200e3, hard_poisson = 0.3;
constexpr const char* hard_flow = R"({ law = "linear", yield = 700, hardening = 300 })";

/// Uniaxial compression to a logarithmic strain: Kirchhoff stress [MPa] and lateral strain [-].
struct Compressed {
  double tau;
  double lateral;
};

/// tau = (sy + H e) / (1 + H / E); of the lateral strain nu tau / E is elastic and half of the
/// plastic one is plastic.
Compressed compressed(double strain, double yield, double slope) {
  const double tau = (yield + slope * strain) / (1.0 + slope / hard_young);
  return {tau, hard_poisson * tau / hard_young + 0.5 * (strain - tau / hard_young)};
}

/// Force per initial area when the part is as high as its nodes say, which is more than the die's
/// height by the penetration of the contact.
void add_homogeneous(const CaseBench& bench,
                     const FlatUpsetting& u,
                     double area,
                     std::vector<Figure>& to) {
  const auto process = bench.run("upsetting-" + u.name, upsetting_text(u));
  const int axis = u.analysis == "3d" ? 2 : 1;
  const double now = largest_coordinate(process->view(), axis) / u.height;
  const Compressed exact = compressed(-std::log(now), hard_yield, hard_slope);
  constexpr double of_newton = 1e-6;
  to.push_back(
      relative(fmt::format("{}: force at a reduction of {} %", u.name, 100.0 * u.reduction), "N",
               force_on_tool(process->view()).norm(), exact.tau * area / now, of_newton));
}

// --- With friction ------------------------------------------------------------------------------

constexpr double soft_yield = 400.0;
constexpr double disk_radius = 20.0, disk_half_height = 2.5, disk_reduction = 0.03;

/// Mean pressure over the yield stress of a disk, R/h = 4, pressed by 3 %.
double disk_pressure(const CaseBench& bench, const std::string& name, const std::string& friction) {
  const FlatUpsetting u{
      name,           "axisymmetric",
      "quad8",        fmt::format("[0, 0], [{}, {}]", disk_radius, disk_half_height),
      "32, 4",        disk_half_height,
      disk_reduction, R"({ law = "perfect", yield = 400 })",
      friction};
  const auto process = bench.run("upsetting-" + name, upsetting_text(u));
  const double area = std::numbers::pi * disk_radius * disk_radius / (1.0 - disk_reduction);
  return force_on_tool(process->view()).norm() / (soft_yield * area);
}

// The ring of Male and Cockcroft, 6 : 3 : 2.
constexpr double ring_outside = 9.0, ring_bore = 4.5, ring_half_height = 3.0; // radii, [mm]

/// The bore's radius in the middle plane at two reductions, as a decrease [%].
std::array<double, 2> bore_decreases(const CaseBench& bench, const std::string& name, double m) {
  const FlatUpsetting u{name,
                        "axisymmetric",
                        "quad8",
                        fmt::format("[{}, 0], [{}, {}]", ring_bore, ring_outside, ring_half_height),
                        "12, 6",
                        ring_half_height,
                        0.6,
                        R"({ law = "linear", yield = 400, hardening = 2 })",
                        fmt::format("{{ law = \"tresca\", m = {} }}", m),
                        "increments = { first = 0.012, max = 0.024 }"};
  std::array<double, 2> decreases{};
  const auto look = [&](const process::Run& run, const process::IncrementReport& report) {
    const double radius = position(run, node_at(run, {ring_bore, 0, 0}))[0];
    const double decrease = 100.0 * (1.0 - radius / ring_bore);
    if (report.time < 0.4 * ring_half_height + 1e-6)
      decreases[0] = decrease;
    decreases[1] = decrease;
  };
  bench.run("upsetting-" + name, upsetting_text(u), look);
  return decreases;
}

} // namespace

std::vector<Figure> homogeneous_upsetting(const CaseBench& bench) {
  const std::string none = R"({ law = "frictionless" })";
  constexpr double disk = 100.0 * std::numbers::pi;
  std::vector<Figure> figures;
  for (const std::string element : {"quad4", "quad8", "tri6"})
    add_homogeneous(
        bench,
        {element, "axisymmetric", element, "[0, 0], [10, 15]", "3, 4", 15.0, 0.6, hard_flow, none},
        disk, figures);
  for (const std::string element : {"hex8", "hex20", "tet10"})
    add_homogeneous(
        bench,
        {element, "3d", element, "[0, 0, 0], [10, 10, 15]", "1, 1, 2", 15.0, 0.6, hard_flow, none},
        100.0, figures);
  return figures;
}

std::vector<Figure> slab_upsetting(const CaseBench& bench) {
  // As wide over high as it has become.
  const double ratio = disk_radius / (2.0 * disk_half_height) / std::pow(1.0 - disk_reduction, 1.5);
  // The slab method takes the stress as uniform over the height: good to 2 % from R/h = 4 on.
  constexpr double of_slab = 0.02;
  std::vector<Figure> figures;
  for (const double mu : {0.05, 0.1}) {
    const double x = 2.0 * mu * ratio;
    const double p = disk_pressure(bench, fmt::format("disk-coulomb-{}", mu),
                                   fmt::format("{{ law = \"coulomb\", mu = {} }}", mu));
    figures.push_back(relative(fmt::format("coulomb, mu = {}: mean pressure over yield stress", mu),
                               "-", p, 2.0 / (x * x) * (std::exp(x) - x - 1.0), of_slab));
  }
  for (const double m : {0.1, 0.5}) {
    const double p = disk_pressure(bench, fmt::format("disk-tresca-{}", m),
                                   fmt::format("{{ law = \"tresca\", m = {} }}", m));
    const double slab = 1.0 + 2.0 * m * ratio / (3.0 * std::numbers::sqrt3);
    if (m < 0.2) // with more the stress is no longer uniform over the height
      figures.push_back(relative(fmt::format("tresca, m = {}: mean pressure over yield stress", m),
                                 "-", p, slab, of_slab));
    figures.push_back(
        at_most(fmt::format("tresca, m = {}: below the upper bound of parallel flow", m), "-", p,
                slab, 1e-3));
    figures.back().source = "Avitzur 1968; a bound for perfectly plastic metal";
  }
  return figures;
}

std::vector<Figure> frictionless_ring(const CaseBench& bench) {
  const FlatUpsetting u{"ring-frictionless",
                        "axisymmetric",
                        "quad8",
                        fmt::format("[{}, 0], [{}, {}]", ring_bore, ring_outside, ring_half_height),
                        "4, 3",
                        ring_half_height,
                        0.6,
                        hard_flow,
                        R"({ law = "frictionless" })"};
  const auto process = bench.run("upsetting-" + u.name, upsetting_text(u));
  const process::Run& run = process->view();
  const double now = largest_coordinate(run, 1) / ring_half_height;
  const Compressed exact = compressed(-std::log(now), hard_yield, hard_slope);
  constexpr double of_newton = 1e-6;
  std::vector<Figure> figures;
  for (const auto& [radius, what] :
       {std::pair(ring_bore, "bore"), std::pair(ring_outside, "outside")})
    figures.push_back(relative(fmt::format("radius of the {} at a reduction of 60 %", what), "mm",
                               position(run, node_at(run, {radius, 0, 0}))[0],
                               radius * std::exp(exact.lateral), of_newton));
  return figures;
}

std::vector<Figure> ring_with_friction(const CaseBench& bench) {
  // The bore barrels a little where the field has it straight.
  constexpr double points = 0.5;
  std::vector<Figure> figures;
  for (const double m : {0.05, 0.1}) {
    const std::array<double, 2> found = bore_decreases(bench, fmt::format("ring-{}", m), m);
    for (const std::size_t i : {0U, 1U}) {
      const double reduction = i == 0 ? 0.4 : 0.6;
      const RingShape ring{ring_bore, ring_outside, 2.0 * ring_half_height};
      figures.push_back(absolute(
          fmt::format("m = {}: decrease of the bore at a reduction of {} %", m, 100.0 * reduction),
          "%", found[i], bore_decrease_of_bound(ring, m, reduction), points));
    }
  }
  return figures;
}

} // namespace billet::study
