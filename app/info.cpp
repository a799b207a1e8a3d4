// billet info: what a file contains, and what is wrong with it.

#include "app/command_line.h"
#include "geometry/base/error.h"
#include "io/mesh/read_mesh.h"
#include "io/stl.h"
#include "mechanics/mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string>

namespace billet::app {

namespace {

int info_stl(const std::filesystem::path& path) {
  const io::StlFile file = io::read_stl(path);
  geometry::TriangleMesh mesh;
  for (const auto& facet : file.facets) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), facet.begin(), facet.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const geometry::CleanUp mended = geometry::clean_up(mesh, 0.0);
  const geometry::MeshHealth health = geometry::health(mesh);
  fmt::print("{}: {} STL, {} facets\n", path.string(), file.binary ? "binary" : "ASCII",
             file.facets.size());
  fmt::print("  box ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}), in the file's own unit\n",
             health.bounds.low[0], health.bounds.low[1], health.bounds.low[2],
             health.bounds.high[0], health.bounds.high[1], health.bounds.high[2]);
  fmt::print("  {} points, {} triangles, {} component(s), area {:.6g}\n", health.points,
             health.triangles, health.components, health.area);
  fmt::print("  dropped on reading: {} degenerate, {} duplicate triangles\n",
             mended.degenerate_triangles, mended.duplicate_triangles);
  if (health.closed())
    fmt::print("  closed, volume {:.6g}{}\n", health.volume,
               health.inside_out() ? " (inside out: use flip = true)" : "");
  else
    fmt::print("  open: {} border edges\n", health.border_edges);
  const auto complaints = geometry::complaints(health, path.string());
  for (const Complaint& complaint : complaints)
    fmt::print("  wrong: {}\n", complaint.text());
  return complaints.empty() ? 0 : static_cast<int>(Fault::geometry);
}

int info_mesh(const std::filesystem::path& path) {
  const io::MeshFile file = io::read_mesh(path);
  const mechanics::Mesh& mesh = file.mesh;
  Box box;
  for (const Vec3& p : mesh.points)
    box.add(p);
  fmt::print("{}: {} {} elements, {} nodes\n", path.string(), mesh.n_elements(),
             mechanics::name(mesh.kind), mesh.n_points());
  fmt::print("  box ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", box.low[0], box.low[1],
             box.low[2], box.high[0], box.high[1], box.high[2]);
  for (const auto& [name, nodes] : mesh.node_sets)
    fmt::print("  set {}: {} nodes\n", name, nodes.size());
  for (const std::string& note : file.notes)
    fmt::print("  note: {}\n", note);
  const auto complaints = mechanics::check_mesh(mesh, path.string(), false);
  for (const Complaint& complaint : complaints)
    fmt::print("  wrong: {}\n", complaint.text());
  const auto qualities = mechanics::element_qualities(mesh, mesh.points);
  fmt::print("  worst element quality {:.3f}\n",
             *std::min_element(qualities.begin(), qualities.end()));
  return complaints.empty() ? 0 : static_cast<int>(Fault::geometry);
}

int info_results(const std::filesystem::path& folder) {
  std::ifstream summary(folder / "summary.json");
  if (!summary)
    throw Error(Fault::input_output, folder.string(),
                "is a folder without summary.json: not the results of a run");
  fmt::print("{}", std::string(std::istreambuf_iterator<char>(summary), {}));
  return 0;
}

} // namespace

int show_info(const Arguments& arguments) {
  const std::filesystem::path path = arguments.file;
  if (!std::filesystem::exists(path))
    throw Error(Fault::input_output, path.string(), "no such file or folder");
  if (std::filesystem::is_directory(path))
    return info_results(path);
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".stl")
    return info_stl(path);
  return info_mesh(path);
}

} // namespace billet::app
