// Springback: of a part whose dies leave, and of a strip that has been bent.

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

constexpr double sprung_young = 200e3, sprung_poisson = 0.3; // of the upset cylinder [MPa], [-]

/// A cylinder pressed by a third between smooth dies, which then leave.
constexpr const char* upset_and_released = R"(title = "Upsetting and release"
analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "metal"
mesh = { box = [[0, 0], [10, 15]], cells = [2, 3] }
[material.metal]
elastic = { young = 200e3, poisson = 0.3 }
flow = { law = "linear", yield = 700, hardening = 300 }
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 15], normal = [0, -1] } }
motion = { velocity = [0, -1] }
[[stage]]
name = "press"
end = 5
[[stage]]
name = "release"
end = 6
unload = true
[solver]
tolerance = 1e-9
)";

// The strip: half of its length, its thickness and the radius that it is bent to [mm].
constexpr double strip_length = 2.0, strip_thickness = 1.0, strip_radius = 100.0;
// Nearly incompressible: plane strain then yields at 2 / sqrt(3) of the yield stress at once.
constexpr double strip_young = 200e3, strip_poisson = 0.49, strip_yield = 230.0;
constexpr double strip_angle = strip_length / strip_radius; // of the end, when bent [rad]
constexpr double released_to = 0.6; // share of the angle that the end is brought back to [-]

mechanics::Mesh strip_mesh() {
  mechanics::Mesh mesh =
      with_elements(mechanics::ElementKind::quad8, mapped_grid(6, 12, [](double x, double y) {
                      return Vec3(strip_length * x, strip_thickness * (y - 0.5), 0.0);
                    }));
  name_nodes(mesh, "symmetry", [](const Vec3& p) { return p[0] == 0.0; });
  name_nodes(mesh, "centre", [](const Vec3& p) { return p[0] == 0.0 && p[1] == 0.0; });
  name_nodes(mesh, "end", [](const Vec3& p) { return p[0] == strip_length; });
  name_each_node(mesh, "end");
  return mesh;
}

/// The angle of the end: up in the first second, down to `released_to` of it in the next [rad].
double angle_at(double time) {
  return strip_angle * (time <= 1.0 ? time : 1.0 - (1.0 - released_to) * (time - 1.0));
}

/// The end stays plane and turns, u = (R - y) sin(angle) - L; across the strip it is free.
std::string strip_text(const mechanics::Mesh& mesh) {
  std::string text = fmt::format(R"(title = "Bending of a strip"
analysis = "plane-strain"
[workpiece]
element = "quad8"
material = "metal"
mesh = {{ file = "strip.inp" }}
[material.metal]
elastic = {{ young = {}, poisson = {} }}
flow = {{ law = "perfect", yield = {} }}
[[support]]
where = "set:symmetry"
fix = ["x"]
[[support]]
where = "set:centre"
fix = ["y"]
[time]
end = 2
increments = {{ first = 0.025, max = 0.025 }}
)",
                                 strip_young, strip_poisson, strip_yield);
  for (const mechanics::Index node : mesh.node_sets.at("end")) {
    const double y = mesh.points[static_cast<std::size_t>(node)][1];
    text += fmt::format("[[support]]\nwhere = \"set:node-{}\"\nmove = {{ x = [", node);
    constexpr int n = 20;
    for (int i = 0; i <= n; ++i) {
      const double time = 2.0 * i / n, angle = angle_at(time);
      // The curvature goes with the angle: the arc of the middle keeps its length.
      const double radius = angle > 0.0 ? strip_length / angle : 0.0;
      const double u = angle > 0.0 ? (radius - y) * std::sin(angle) - strip_length : 0.0;
      text += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", time, u);
    }
    text += "] }\n";
  }
  return text;
}

/// Moment of the supports at the end about its middle [N mm/mm]; positive while it bends.
double moment_at_end(const process::Run& run) {
  const double middle = position(run, node_at(run, {strip_length, 0, 0}))[1];
  double moment = 0.0;
  for (const mechanics::Index node : run.mesh().node_sets.at("end"))
    moment -= run.state.reactions[idx(2 * node)] * (position(run, node)[1] - middle);
  return moment;
}

} // namespace

std::vector<Figure> springback_of_upsetting(const CaseBench& bench) {
  struct Size {
    double height = 0.0, radius = 0.0;
  };
  Size pressed, now;
  const auto look = [&](const process::Run& run, const process::IncrementReport& report) {
    now = {largest_coordinate(run, 1), largest_coordinate(run, 0)};
    if (report.time < 5.0 + 1e-9)
      pressed = now;
  };
  const auto process = bench.run("springback-upsetting", upset_and_released, look);
  const double strain = std::log(15.0 / pressed.height);
  const double elastic = (700.0 + 300.0 * strain) / (1.0 + 300.0 / sprung_young) / sprung_young;
  double stress = 0.0;
  for (const Mat3& sigma : process->view().model.bulk->stresses(process->view().positions()))
    stress = std::max(stress, sigma.norm());
  constexpr double digits = 1e-5;
  return {relative("logarithmic strain of the height that springs back, tau / E", "-",
                   std::log(now.height / pressed.height), elastic, digits),
          relative("the same of the radius, - nu tau / E", "-",
                   std::log(now.radius / pressed.radius), -sprung_poisson * elastic, digits),
          absolute("stress that is left, over the yield stress", "-", stress / 700.0, 0.0, 1e-5)};
}

std::vector<Figure> springback_of_bending(const CaseBench& bench) {
  const mechanics::Mesh mesh = strip_mesh();
  bench.write("strip.inp", inp_text(mesh));
  double bent = 0.0, last_moment = 0.0, last_angle = 0.0, free_angle = 0.0;
  const auto look = [&](const process::Run& run, const process::IncrementReport& report) {
    const double moment = moment_at_end(run), angle = angle_at(report.time);
    if (report.time < 1.0 + 1e-9)
      bent = moment;
    if (moment <= 0.0 && last_moment > 0.0) // elastic: linear in between
      free_angle = angle + (last_angle - angle) * moment / (moment - last_moment);
    last_moment = moment;
    last_angle = angle;
  };
  bench.run("springback-bending", strip_text(mesh), look);
  constexpr double k2 = 2.0 / std::numbers::sqrt3 * strip_yield;
  constexpr double modulus = strip_young / (1.0 - strip_poisson * strip_poisson);
  // Curvature at which the surface yields, over the curvature.
  constexpr double yielding = 2.0 * k2 / (modulus * strip_thickness) * strip_radius;
  constexpr double moment =
      0.25 * k2 * strip_thickness * strip_thickness * (1.0 - yielding * yielding / 3.0);
  // Twelve elements over the thickness; R/t = 100.
  constexpr double of_strip = 5e-3;
  return {relative("bending moment at R = 100 t", "N mm/mm", bent, moment, of_strip),
          relative("curvature left over curvature bent to", "-", free_angle / strip_angle,
                   1.0 - 1.5 * yielding * (1.0 - yielding * yielding / 3.0), of_strip)};
}

} // namespace billet::study
