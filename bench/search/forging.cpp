#include "bench/search/forging.h"

#include "io/case/read_case.h"
#include "io/scene/scene_builder.h"
#include "io/tools/stl.h"
#include "process/loop/process.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bench/search/clocks.h"
#include "bench/search/dies.h"

namespace billet::bench {

namespace {

namespace fs = std::filesystem;

// The case upsetting-1018-3d, to 40 % of its height, on a cup in place of the flat die.
constexpr const char* forging = R"(analysis = "3d"

[workpiece]
element  = "hex8"
material = "steel-1018"
mesh     = {{ cylinder = {{ radius = 5, height = 15 }}, cells = [{}, {}], sector = 90 }}

[material.steel-1018]
elastic = {{ young = "210 GPa", poisson = 0.3 }}
flow    = {{ law = "swift", K = 740, eps0 = 0.01, n = 0.2 }}

[[support]]
where = "x = 0"
fix   = ["x"]

[[support]]
where = "y = 0"
fix   = ["y"]

[[tool]]
name     = "punch"
surface  = {{ plane = {{ point = [0, 0, 15], normal = [0, 0, -1] }} }}
motion   = {{ velocity = [0, 0, -0.5] }}
touch    = true
friction = {{ law = "tresca", m = 0.08 }}

[[tool]]
name     = "die"
surface  = {{ stl = "cup.stl", unit = "mm" }}
place    = {{ translate = [0, 0, -2] }}
touch    = true
motion   = {{ velocity = [0, 0, 1e-9] }}
friction = {{ law = "tresca", m = 0.08 }}

[time]
end = 12
)";

double cup(double x, double y) { return 0.01 * (x * x + y * y); }

/// Asks another surface, and counts what it takes.
class TimedSurface final : public geometry::RigidSurface {
public:
  struct Cost {
    std::int64_t queries = 0;
    double seconds = 0.0;
  };

  TimedSurface(geometry::SurfacePtr surface, Cost& cost)
      : surface_(std::move(surface)), cost_(cost) {}

  [[nodiscard]] Box bounds() const override { return surface_->bounds(); }
  [[nodiscard]] geometry::DisplayMesh display(const Box& window, bool planar) const override {
    return surface_->display(window, planar);
  }

private:
  void do_project(std::span<const Vec3> points,
                  double reach,
                  std::span<geometry::Projection> out) const override {
    cost_.queries += static_cast<std::int64_t>(points.size());
    cost_.seconds += seconds(processor_time, [&] { surface_->project(points, reach, out); });
  }

  geometry::SurfacePtr surface_;
  Cost& cost_; // one thread only
};

process::Scene scene(int cells, std::int64_t triangles) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("billet-{}", getpid());
  fs::create_directories(folder);
  io::write_stl(folder / "cup.stl", square(triangles, -10.0, 10.0, cup));
  const io::Case content =
      io::read_case_text(fmt::format(forging, cells, 7 * cells / 2), "forging", folder);
  process::Scene scene = io::build_scene(content, "forging").scene;
  fs::remove_all(folder);
  return scene;
}

} // namespace

std::string forge(int cells, std::int64_t triangles) {
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  process::Scene scene = bench::scene(cells, triangles);
  TimedSurface::Cost cost;
  contact::Tool& die = scene.tools.back();
  die.surface = std::make_unique<const TimedSurface>(std::move(die.surface), cost);
  process::Process process(std::move(scene));
  const TimedSurface::Cost before = std::exchange(cost, {});
  const double start = processor_time();
  if (process.run({}) != process::RunStatus::done)
    throw std::runtime_error("the forging did not converge");
  const double total = processor_time() - start;
  const process::PhaseTimes& times = process.view().clock.times;
  return fmt::format(
      "| {} | {} | {} | {:.2f} | {:.1f} | {} | {} | {:.3f} | {:.1f} % | {:.3f} | {:.1f} % |", cells,
      process.view().positions().size(), before.queries, before.seconds, total,
      process.view().state.counters.iterations, cost.queries, times.search,
      100.0 * times.search / times.total, times.certificate,
      100.0 * times.certificate / times.total);
}

} // namespace billet::bench
