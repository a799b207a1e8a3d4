// How fast the search of triangulated dies is: time to build, queries per second with and without
// the hint of the last query, compared with CGAL and FCL, and what a die of a million triangles
// costs.
//
// bench-search [--markdown FILE] [--seconds S] [--largest TRIANGLES]; one thread, processor time.
// Each rate is the best of several passes, every one at least S seconds long (0.2).

#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/tools/stl.h"
#include "io/tools/stl_tool.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/search/clocks.h"
#include "bench/search/dies.h"
#include "bench/search/engines.h"
#include "bench/search/forging.h"

namespace billet::bench {
namespace {

using geometry::Projection;
using geometry::RigidSurface;
using geometry::TriangleMesh;

constexpr std::size_t rows = 150; // of the workpiece's points
constexpr int passes = 3;
constexpr std::array off{0.01, 0.1, 1.0}; // of the points, at most [mm]
constexpr double feature_angle = std::numbers::pi / 6.0;
constexpr double agreement = 1e-9; // share of the size of the die, between engines

double least_time = 0.2; // of a pass [s]

/// Queries per second of `work`, which makes `count` of them.
double rate(std::size_t count, const std::function<void()>& work) {
  double best = 0.0;
  for (int pass = 0; pass < passes; ++pass) {
    std::size_t done = 0;
    double time = 0.0;
    while (time < least_time) {
      time += seconds(processor_time, work);
      done += count;
    }
    best = std::max(best, static_cast<double>(done) / time);
  }
  return best;
}

double peak_memory() { // [MB]
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e3;
}

class Report {
public:
  explicit Report(std::string file) : file_(std::move(file)) {}
  void line(const std::string& text) {
    std::cout << text << std::endl;
    text_ += text + '\n';
  }
  void write() const {
    if (!file_.empty())
      std::ofstream(file_) << text_;
  }

private:
  std::string file_;
  std::string text_;
};

// --- a million triangles from a file -------------------------------------------------------------

void load(Report& report) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("billet-{}.stl", getpid());
  io::write_stl(path, die(1'000'000));
  io::FacetFile file;
  io::StlTool tool;
  geometry::SurfacePtr surface;
  const double start = wall_time();
  const double reading = seconds(processor_time, [&] { file = io::read_stl(path); });
  std::filesystem::remove(path);
  const double checking = seconds(processor_time, [&] { tool = io::tool_mesh(file, {}); });
  const double building =
      seconds(processor_time, [&] { surface = geometry::make_triangle_surface(tool.mesh); });
  const double wall = wall_time() - start, plain = peak_memory();
  surface.reset();
  const double smoothing = seconds(processor_time, [&] {
    surface = geometry::make_smooth_triangle_surface(tool.mesh, feature_angle).surface;
  });
  report.line(
      "| triangles | read | repair and check | ready | together | wall | memory | smoothed in "
      "| memory |");
  report.line("|---|---|---|---|---|---|---|---|---|");
  report.line(fmt::format("| {} | {:.2f} s | {:.2f} s | {:.2f} s | {:.2f} s | {:.2f} s | {:.0f} MB "
                          "| {:.2f} s | {:.0f} MB |\n",
                          tool.mesh.triangles.size(), reading, checking, building,
                          reading + checking + building, wall, plain, smoothing, peak_memory()));
}

// --- queries -------------------------------------------------------------------------------------

/// The workpiece as it creeps over the die to and fro; one set of points a query.
struct Motion {
  std::vector<std::vector<Vec3>> places;
  std::size_t next = 0;

  Motion(double farthest, double step) {
    for (const int k : {0, 1, 2, 3, 2, 1})
      places.push_back(workpiece(rows, farthest, k * step * Vec3(0.6, 0.7, -0.4)));
  }
  const std::vector<Vec3>& move() { return places[next++ % places.size()]; }
};

void forget(std::vector<Projection>& feet) {
  for (Projection& foot : feet)
    foot.patch = -1;
}

/// Queries per second of a surface.
struct Rates {
  double cold, coherent;
};

Rates rates(const RigidSurface& surface, double farthest) {
  constexpr double step = 0.005; // of a point between two queries [mm]
  Motion motion(farthest, step);
  const std::size_t count = motion.places[0].size();
  std::vector<Projection> feet(count);
  const double cold = rate(count, [&] {
    forget(feet);
    surface.project(motion.move(), reach, feet);
  });
  for (std::size_t k = 0; k < motion.places.size(); ++k) // what is found out once, is
    surface.project(motion.move(), reach, feet);
  const double coherent = rate(count, [&] { surface.project(motion.move(), reach, feet); });
  return {cold, coherent};
}

double scattered_rate(const RigidSurface& surface, const std::vector<Vec3>& points) {
  std::vector<Projection> feet(points.size());
  return rate(points.size(), [&] {
    forget(feet);
    surface.project(points, 2.0 * side, feet);
  });
}

double rate(Engine& engine, const std::vector<Vec3>& points) {
  std::vector<double> distances(points.size());
  return rate(points.size(), [&] { engine.distances(points, distances); });
}

/// The engines must agree, or their times mean nothing.
void require_agreement(Engine& engine, const RigidSurface& surface) {
  const std::vector<Vec3> points = workpiece(20, 1.0, Vec3::Zero());
  std::vector<double> distances(points.size());
  std::vector<Projection> feet(points.size());
  engine.distances(points, distances);
  surface.project(points, reach, feet);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(std::abs(feet[i].gap) - distances[i]) > agreement * side)
      throw std::runtime_error(
          fmt::format("point {}: distance {}, gap {}", i, distances[i], feet[i].gap));
}

std::string thousands(double per_second) { return fmt::format("{:.0f}", per_second / 1e3); }

std::string row(const std::string& name, double building, const RigidSurface& surface) {
  std::string row = fmt::format("{} | {:.2f} |", name, building);
  for (const double farthest : off) {
    const Rates r = rates(surface, farthest);
    row += fmt::format(" {} | {} | {:.1f} x |", thousands(r.cold), thousands(r.coherent),
                       r.coherent / r.cold);
  }
  return row + fmt::format(" {} |", thousands(scattered_rate(surface, scattered(2000))));
}

std::string row(const std::string& name, double building, Engine& engine) {
  std::string row = fmt::format("{} | {:.2f} |", name, building);
  for (const double farthest : off)
    row +=
        fmt::format(" {} | | |", thousands(rate(engine, workpiece(rows, farthest, Vec3::Zero()))));
  return row + fmt::format(" {} |", thousands(rate(engine, scattered(200))));
}

void compare(std::int64_t count, Report& report) {
  const TriangleMesh mesh = die(count);
  const std::string head = fmt::format("| {} | ", mesh.triangles.size());
  geometry::SurfacePtr surface, smooth;
  std::unique_ptr<Engine> cgal, fcl;
  const double building =
      seconds(processor_time, [&] { surface = geometry::make_triangle_surface(mesh); });
  report.line(head + row("billet", building, *surface));
  const double smoothing = seconds(processor_time, [&] {
    smooth = geometry::make_smooth_triangle_surface(mesh, feature_angle).surface;
  });
  report.line(head + row("billet, smoothed", smoothing, *smooth));
  const double building_cgal = seconds(processor_time, [&] { cgal = make_cgal(mesh); });
  require_agreement(*cgal, *surface);
  report.line(head + row("CGAL", building_cgal, *cgal));
  const double building_fcl = seconds(processor_time, [&] { fcl = make_fcl(mesh); });
  require_agreement(*fcl, *surface);
  report.line(head + row("FCL", building_fcl, *fcl));
}

constexpr const char* introduction = R"(# Measured

Written by `./dev bench search --markdown`; [README](README.md) says what the columns are. Processor
time of one thread; thousands of queries per second.
)";

struct Options {
  std::string markdown;             ///< file
  std::int64_t largest = 1'000'000; ///< triangles
};

Options options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::string value = i + 1 < words.size() ? words[i + 1] : "";
    if (words[i] == "--markdown" && !value.empty())
      options.markdown = value;
    else if (words[i] == "--seconds" && !value.empty())
      least_time = std::stod(value);
    else if (words[i] == "--largest" && !value.empty())
      options.largest = std::stoll(value);
    else
      throw std::runtime_error("[--markdown FILE] [--seconds S] [--largest TRIANGLES]");
  }
  return options;
}

void run(const Options& options) {
  Report report(options.markdown);
  report.line(introduction);
  load(report);
  report.line(
      "| triangles | engine | build s | 0.01 mm: cold | coherent | | 0.1 mm: cold | coherent "
      "| | 1 mm: cold | coherent | | scattered |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (std::int64_t count = 10'000; count <= options.largest; count *= 10)
    compare(count, report);
  report.line("\n| cells | unknowns | queries before | s | CPU s of the run | iterations | queries "
              "| search s | share | certificate s | share |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|");
  for (const int cells : {4, 6, 8, 12})
    report.line(forge(cells, options.largest));
  report.write();
}

} // namespace

} // namespace billet::bench

int main(int argc, char** argv) {
  try {
    billet::bench::run(billet::bench::options({argv + 1, argv + argc}));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "bench-search: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
