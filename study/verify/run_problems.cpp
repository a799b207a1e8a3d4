// What must not change a result: that a run was stored and resumed, how the part lies in space, the
// units, the numbers of the nodes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "study/verify/mesh_text.h"
#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

/// A billet pressed with friction, meshed anew on its way.
constexpr const char* resumed_text = R"(title = "Run that is resumed"
analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "metal"
mesh = { box = [[0, 0], [5, 8]], cells = [4, 6] }
[material.metal]
elastic = { young = "200 GPa", poisson = 0.3 }
flow = { law = "swift", K = "700 MPa", eps0 = 0.01, n = 0.2 }
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "die"
surface = { plane = { point = [0, 8], normal = [0, -1] } }
motion = { velocity = [0, -1] }
friction = { law = "coulomb", mu = 0.2 }
[remesh]
when = { strain = 0.3 }
[time]
end = 2.5
)";

/// Keeps the run as it was stored at the beginning of one increment.
class StoringOnce final : public process::Observer {
public:
  explicit StoringOnce(int increment) : increment_(increment) {}
  [[nodiscard]] bool wants_checkpoint(const process::Run& run,
                                      process::CheckpointReason /*why*/) override {
    return bytes.empty() && run.state.increment >= increment_;
  }
  void checkpoint(const process::Run& run, const std::string& stored) override {
    time = run.state.time;
    bytes = stored;
  }
  std::string bytes;
  double time = 0.0; ///< [s]

private:
  int increment_;
};

/// How the same block is described: turned, mirrored, in other units, with other numbers of nodes.
struct Telling {
  std::string name;
  double turn = 0.0;     ///< about z [degrees]
  bool mirrored = false; ///< x to -x
  bool in_metres = false;
  NodeOrder order = NodeOrder::forward;
};

/// A block in plane strain that a flat die with friction presses and drags along.
std::string told_text(const Telling& telling) {
  const double angle = telling.turn * std::numbers::pi / 180.0, s = std::sin(angle),
               c = std::cos(angle);
  const double length = telling.in_metres ? 1e-3 : 1.0, stress = telling.in_metres ? 1e6 : 1.0;
  const double side = telling.mirrored ? -1.0 : 1.0;
  const double along = 0.2 * side, down = -1.0;
  return fmt::format(R"(title = "Block: {0}"
analysis = "plane-strain"
units = "{1}"
[workpiece]
element = "quad8"
material = "metal"
mesh = {{ file = "block-{0}.inp" }}
[material.metal]
elastic = {{ young = {2}, poisson = 0.3 }}
flow = {{ law = "linear", yield = {3}, hardening = {4} }}
[[support]]
where = "set:bottom"
fix = ["x", "y"]
[[tool]]
name = "die"
surface = {{ plane = {{ point = [{5}, {6}], normal = [{7}, {8}] }} }}
motion = {{ velocity = [{9}, {10}] }}
touch = true
friction = {{ law = "coulomb", mu = 0.2 }}
[time]
end = 0.3
increments = {{ first = 0.03, max = 0.03 }}
[solver]
tolerance = 1e-9
)",
                     telling.name, telling.in_metres ? "m-N-s-Pa-degC" : "mm-N-s-MPa-degC",
                     200e3 * stress, 300.0 * stress, 500.0 * stress, -2.0 * s * length,
                     2.0 * c * length, s, -c, length * (c * along - s * down),
                     length * (s * along + c * down));
}

/// 3 x 2 mm in 6 x 5 cells.
mechanics::Mesh told_mesh(const Telling& telling) {
  const double angle = telling.turn * std::numbers::pi / 180.0;
  const double length = telling.in_metres ? 1e-3 : 1.0;
  const auto place = [&](double x, double y) {
    // A mirrored grid is walked from the other end, so that its cells turn the right way.
    const double u = telling.mirrored ? -3.0 * (1.0 - x) : 3.0 * x, v = 2.0 * y;
    return Vec3(length * (std::cos(angle) * u - std::sin(angle) * v),
                length * (std::sin(angle) * u + std::cos(angle) * v), 0.0);
  };
  mechanics::Mesh mesh = with_elements(mechanics::ElementKind::quad8, mapped_grid(6, 5, place));
  name_nodes(mesh, "bottom", [&](const Vec3& p) {
    return std::abs(-std::sin(angle) * p[0] + std::cos(angle) * p[1]) < 1e-9 * length;
  });
  return mesh;
}

/// What is compared, turned back and in mm and N/mm.
struct Told {
  Vec3 corner; ///< where the upper corner has gone that the die leads
  Vec3 force;  ///< on the die
};

Told told(const CaseBench& bench, const Telling& telling) {
  bench.write("block-" + telling.name + ".inp", inp_text(told_mesh(telling), telling.order));
  const auto process = bench.run("block-" + telling.name, told_text(telling));
  const double angle = telling.turn * std::numbers::pi / 180.0;
  const double length = telling.in_metres ? 1e-3 : 1.0, force = telling.in_metres ? 1e3 : 1.0;
  Mat3 back;
  back << std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  const Vec3 mirror(telling.mirrored ? -1.0 : 1.0, 1.0, 1.0);
  const Vec3 corner = back.transpose() * mirror.cwiseProduct(Vec3(3.0, 2.0, 0.0)) * length;
  const process::Run& run = process->view();
  return {mirror.cwiseProduct(back * position(run, node_at(run, corner))) / length,
          mirror.cwiseProduct(back * force_on_tool(run)) / force};
}

} // namespace

std::vector<Figure> resumed_run(const CaseBench& bench) {
  StoringOnce store(30);
  const std::unique_ptr<process::Process> whole = bench.ready("resumed-run", resumed_text);
  run_to_end(*whole, "resumed-run", {&store});
  const std::unique_ptr<process::Process> rest = bench.ready("resumed-run", resumed_text);
  rest->resume(store.bytes);
  run_to_end(*rest, "resumed-run", {});
  const process::Run &a = whole->view(), &b = rest->view();
  double farthest = a.positions().size() == b.positions().size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.positions().size(), b.positions().size()); ++i)
    farthest = std::max(farthest, std::abs(a.positions()[i] - b.positions()[i]));
  return {absolute(fmt::format("largest difference of a node's place, resumed at time {:.3g}",
                               store.time),
                   "mm", farthest, 0.0, 0.0),
          absolute("force on the die", "N", force_on_tool(b)[1], force_on_tool(a)[1], 0.0),
          absolute("increments", "-", b.state.increment, a.state.increment, 0.0),
          absolute("new meshes", "-", static_cast<double>(b.state.record.remeshings.size()),
                   static_cast<double>(a.state.record.remeshings.size()), 0.0)};
}

std::vector<Figure> invariance(const CaseBench& bench) {
  constexpr double rounding = 1e-9;
  const Told plain = told(bench, {.name = "as-it-is"});
  std::vector<Figure> figures;
  for (const Telling& telling :
       {Telling{.name = "turned-by-37-degrees", .turn = 37.0},
        Telling{.name = "mirrored", .mirrored = true},
        Telling{.name = "in-metres", .in_metres = true},
        Telling{.name = "numbered-backwards", .order = NodeOrder::backward}}) {
    const Told other = told(bench, telling);
    figures.push_back(relative(telling.name + ": force along the die", "N/mm", other.force[0],
                               plain.force[0], rounding));
    figures.push_back(relative(telling.name + ": force across the die", "N/mm", other.force[1],
                               plain.force[1], rounding));
    figures.push_back(absolute(telling.name + ": corner of the block, distance", "mm",
                               (other.corner - plain.corner).norm(), 0.0, rounding));
  }
  return figures;
}

} // namespace billet::study
