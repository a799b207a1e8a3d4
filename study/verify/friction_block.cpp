#include "study/verify/friction_block.h"

#include <fmt/format.h>

#include <cmath>

#include "study/verify/readings.h"

namespace billet::study {

namespace {

std::string block_text(const SlidingBlock& block) {
  std::string places = "[0, 0]", forces = "[0, 0]";
  double time = 0.0, way = 0.0;
  for (const BlockStep& step : block.steps) {
    const double force = step.pressure * block_size;
    way += step.speed * SlidingBlock::duration();
    forces += fmt::format(", [{}, {}]", time + 0.5 * SlidingBlock::duration(), force);
    time += SlidingBlock::duration();
    forces += fmt::format(", [{}, {}]", time, force);
    places += fmt::format(", [{}, {}]", time, way);
  }
  return fmt::format(R"(title = "Sliding block: {0}"
analysis = "plane-strain"
temperature = 20
[workpiece]
element = "quad4"
material = "metal"
mesh = {{ box = [[0, 0], [{1}, {1}]], cells = [1, 1] }}
[material.metal]
elastic = {{ young = {2}, poisson = {3} }}
flow = {{ law = "perfect", yield = {4} }}
[[support]]
where = "all"
move = {{ x = [{5}] }}
[[support]]
where = "y = {1}"
fix = ["y"]
[[tool]]
name = "floor"
surface = {{ plane = {{ point = [0, 0], normal = [0, 1] }} }}
motion = {{ force = {{ direction = [0, 1], value = [{6}] }} }}
touch = true
friction = {7}
[contact]
surface = "set:y-min"
[time]
end = {8}
increments = {{ first = 0.1, max = 0.1 }}
[solver]
tolerance = 1e-9
)",
                     block.name, block_size, block_young, block_poisson, block_yield, places,
                     forces, block.friction, time);
}

} // namespace

std::vector<Figure>
block_figures(const CaseBench& bench, const SlidingBlock& block, const ShearLaw& law) {
  std::vector<Figure> figures;
  BlockStep now{0.0, 0.0, 0.0};
  const auto look = [&](const process::Run& run, const process::IncrementReport& report) {
    const std::size_t done = figures.size();
    const double end = SlidingBlock::duration() * static_cast<double>(done + 1);
    if (done == block.steps.size() || std::abs(report.time - end) > 1e-6)
      return;
    now = {block.steps[done].pressure, block.steps[done].speed,
           now.way + SlidingBlock::duration() * block.steps[done].speed};
    // Of the block on the floor, along the motion: the shear on the block is opposite.
    const double shear = force_on_tool(run)[0] / block_size;
    figures.push_back(relative(fmt::format("{}: shear at p = {} MPa, v = {} mm/s, s = {} mm",
                                           block.name, now.pressure, now.speed, now.way),
                               "MPa", shear, law(now), block.tolerance));
  };
  bench.run("block-" + block.name, block_text(block), look);
  return figures;
}

} // namespace billet::study
