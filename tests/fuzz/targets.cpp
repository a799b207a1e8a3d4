#include "tests/fuzz/targets.h"

#include "geometry/base/error.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/case/read_case.h"
#include "io/mesh/read_mesh.h"
#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "io/tools/stl_tool.h"
#include "mechanics/elements/mesh_check.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace billet::fuzz {

namespace {

namespace fs = std::filesystem;

void require(bool holds, std::string_view what) {
  if (holds)
    return;
  std::cerr << "fuzz: broken: " << what << '\n';
  std::abort();
}

/// A folder of this process for the files that are read.
class Scratch {
public:
  Scratch() : path_(fs::temp_directory_path() / ("billet-fuzz-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path file(const char* name, std::string_view bytes) const {
    const fs::path path = path_ / name;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

private:
  fs::path path_;
};

const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

// --- STL -----------------------------------------------------------------------------------------

void project(const geometry::RigidSurface& surface, const geometry::TriangleMesh& mesh) {
  const double size = surface.bounds().size();
  const Vec3 middle = 0.5 * (surface.bounds().low + surface.bounds().high);
  const std::array points{mesh.points.front(), mesh.points.back(), middle,
                          Vec3(surface.bounds().high + Vec3(0.1, 0.2, 0.3) * size)};
  std::array<geometry::Projection, points.size()> cold, hinted;
  for (std::size_t i = 0; i < hinted.size(); ++i)
    hinted[i].patch = static_cast<std::int32_t>(i * mesh.triangles.size() / hinted.size());
  surface.project(points, 2.0 * size, cold);
  surface.project(points, 2.0 * size, hinted);
  for (std::size_t i = 0; i < cold.size(); ++i) {
    require(cold[i].found() == hinted[i].found(), "a hint decides what is found");
    if (!cold[i].found())
      continue;
    require(std::isfinite(cold[i].gap) && cold[i].foot.allFinite(), "a gap is not a number");
    require(std::abs(cold[i].normal.norm() - 1.0) < 1e-9, "a normal is no unit vector");
    require(cold[i].gap == hinted[i].gap && cold[i].patch == hinted[i].patch,
            "a hint changes the result");
  }
}

/// The surface in the file, if it is fit for a tool.
std::optional<geometry::TriangleMesh> die(std::string_view bytes) {
  const io::FacetFile file = io::read_stl(scratch().file("die.stl", bytes));
  io::StlTool tool = io::examine(file, {});
  (void)io::report(file, tool);
  (void)io::table(file, tool);
  if (!tool.complaints.empty())
    return std::nullopt;
  return std::move(tool.mesh);
}

void stl(std::string_view bytes) {
  if (const auto mesh = die(bytes))
    project(*geometry::make_triangle_surface(*mesh), *mesh);
}

// On its own: it takes twice the time of all before.
void smooth(std::string_view bytes) {
  constexpr double feature_angle = std::numbers::pi / 6.0;
  if (const auto mesh = die(bytes))
    project(*geometry::make_smooth_triangle_surface(*mesh, feature_angle).surface, *mesh);
}

// --- meshes --------------------------------------------------------------------------------------

void mesh(const char* name, std::string_view bytes) {
  const io::MeshFile file = io::read_mesh(scratch().file(name, bytes));
  const auto n_points = static_cast<mechanics::Index>(file.mesh.points.size());
  for (const Vec3& point : file.mesh.points)
    require(point.allFinite(), "a coordinate is not a number");
  for (const mechanics::Index node : file.mesh.cells)
    require(node >= 0 && node < n_points, "a cell has a node that is not there");
  for (const auto& [set, nodes] : file.mesh.node_sets)
    for (const mechanics::Index node : nodes)
      require(node >= 0 && node < n_points, "a set has a node that is not there");
  (void)mechanics::check_mesh(file.mesh, name, false);
}

/// With a file that it may include; its own name is part.inp.
void deck(std::string_view bytes) {
  (void)scratch().file("nodes.inc", "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*INCLUDE,INPUT=part.inp\n");
  mesh("part.inp", bytes);
}

// --- case files ----------------------------------------------------------------------------------

void case_file(std::string_view bytes) {
  const fs::path& folder = scratch().path();
  const io::Case content = io::read_case_text(std::string(bytes), "case.toml", folder);
  const std::string whole = io::resolved_toml(content);
  try {
    const io::Case again = io::read_case_text(whole, "resolved.toml", folder);
    require(io::resolved_toml(again) == whole, "the resolved case is another case");
  } catch (const Error& error) {
    std::cerr << whole << '\n' << error.what() << '\n';
    require(false, "the resolved case cannot be read");
  }
}

template <void (*read)(std::string_view)> void tolerant(std::string_view bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    require(!error.complaints().empty(), "an error says nothing");
  }
}

constexpr std::array all{
    Target{"stl", "stl", tolerant<stl>},
    Target{"smooth", "stl", tolerant<smooth>},
    Target{"msh", "msh", tolerant<[](std::string_view bytes) { mesh("part.msh", bytes); }>},
    Target{"vtu", "vtu", tolerant<[](std::string_view bytes) { mesh("part.vtu", bytes); }>},
    Target{"inp", "inp", tolerant<deck>},
    Target{"case", "case", tolerant<case_file>},
};

} // namespace

std::span<const Target> targets() { return all; }

} // namespace billet::fuzz
