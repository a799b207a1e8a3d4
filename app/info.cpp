// billet info: what a file contains, and what is wrong with it.

#include "app/command_line.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "io/case/units.h"
#include "io/mesh/read_mesh.h"
#include "io/results/checkpoint.h"
#include "io/text/text.h"
#include "io/tools/step.h"
#include "io/tools/stl.h"
#include "io/tools/stl_report.h"
#include "io/tools/stl_tool.h"
#include "mechanics/elements/mesh_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace billet::app {

namespace {

int info_facets(const io::FacetFile& file, double factor, std::string_view lengths) {
  const io::StlTool tool = io::examine(file, {factor});
  fmt::print("{}: {}, lengths in {}\n", file.path.string(), io::name(file.format), lengths);
  for (const io::ReportRow& row : io::table(file, tool))
    fmt::print("  {:24s} {}\n", row.name, row.value);
  for (const std::string& remark : io::remarks(file, tool))
    fmt::print("  note: {}\n", remark);
  for (const Complaint& complaint : tool.complaints)
    fmt::print("  wrong: {}\n", complaint.text());
  return tool.complaints.empty() ? 0 : static_cast<int>(Fault::geometry);
}

int info_stl(const std::filesystem::path& path, const std::optional<std::string>& unit) {
  const Outcome<double> factor =
      unit ? io::length_factor(*unit, io::UnitSystem{}) : Outcome<double>(1.0);
  if (!factor)
    throw Error(Fault::usage, "",
                fmt::format("--unit needs a unit of length such as mm, m or in, not '{}'", *unit));
  return info_facets(io::read_stl(path), *factor, unit ? "mm" : "the file's own unit");
}

int info_mesh(const std::filesystem::path& path, bool allow_outside) {
  const io::MeshFile file = io::read_mesh(path, 1.0, {{}, allow_outside});
  const mechanics::Mesh& mesh = file.mesh;
  const Box box = box_of(mesh.points);
  fmt::print("{}: {} {} elements, {} nodes\n", path.string(), mesh.n_elements(),
             mechanics::name(mesh.kind), mesh.n_points());
  fmt::print("  box ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", box.low[0], box.low[1],
             box.low[2], box.high[0], box.high[1], box.high[2]);
  for (const auto& [name, nodes] : mesh.node_sets)
    fmt::print("  set {}: {} nodes\n", name, nodes.size());
  for (const std::string& note : file.notes)
    fmt::print("  note: {}\n", note);
  const auto complaints = mechanics::check_mesh(mesh, path.string(), false, file.labels);
  for (const Complaint& complaint : complaints)
    fmt::print("  wrong: {}\n", complaint.text());
  const auto qualities = mechanics::element_qualities(mesh, mesh.points);
  fmt::print("  worst element quality {:.3f}\n",
             *std::min_element(qualities.begin(), qualities.end()));
  return complaints.empty() ? 0 : static_cast<int>(Fault::geometry);
}

int info_results(const std::filesystem::path& folder) {
  std::ifstream summary(folder / "summary.json");
  if (!summary && std::filesystem::exists(folder / "history.csv"))
    throw Error(Fault::input_output, folder.string(),
                "has no summary.json yet: the run is going on, or was killed",
                fmt::format("billet watch {} tells how it is going", folder.string()));
  if (!summary)
    throw Error(Fault::input_output, folder.string(),
                "is a folder without summary.json: not the results of a run");
  const std::string text(std::istreambuf_iterator<char>(summary), {});
  if (!nlohmann::json::accept(text))
    throw Error(Fault::input_output, (folder / "summary.json").string(), "is damaged: no JSON", "",
                error_code::results_unreadable);
  fmt::print("{}", text);
  return 0;
}

int info_checkpoint(const std::filesystem::path& file) {
  const io::Checkpoint c = io::read_checkpoint(file);
  fmt::print("{}: checkpoint of billet {}, written {} UTC ({})\n", file.string(), c.version,
             c.written, c.reason);
  const auto row = [](std::string_view name, const auto& value) {
    fmt::print("  {:24s} {}\n", name, value);
  };
  row("case", c.title.empty() ? "without title" : c.title);
  row("time", c.time);
  row("increment", c.increment);
  row("stage", c.stage + 1);
  row("unknowns", c.n_unknowns);
  row("state", fmt::format("{} bytes", c.run.size()));
  row("results", fmt::format("{} bytes", c.results.size()));
  row("scene", c.scene);
  if (c.version != BILLET_VERSION)
    fmt::print("  note: this is billet {}, which cannot go on from it\n", BILLET_VERSION);
  return 0;
}

} // namespace

int show_info(const Arguments& arguments) {
  const std::filesystem::path path = arguments.file;
  if (!std::filesystem::exists(path))
    throw Error(Fault::input_output, path.string(), "no such file or folder");
  if (std::filesystem::is_directory(path))
    return info_results(path);
  const std::string suffix = io::in_small_letters(path.extension().string());
  if (suffix == ".stl")
    return info_stl(path, arguments.unit);
  if (suffix == ".checkpoint")
    return info_checkpoint(path);
  if (suffix == ".toml")
    throw Error(Fault::geometry, path.string(),
                "is a case, a study or a chart, not a file of shapes",
                "billet check CASE.toml shows what a case makes", error_code::usage);
  const bool is_step = suffix == ".step" || suffix == ".stp";
  if (is_step && arguments.unit)
    throw Error(Fault::usage, "", "--unit is for STL files: a STEP file knows its unit");
  if (arguments.unit && !is_step)
    throw Error(Fault::usage, "",
                fmt::format("--unit is for STL files, {} is none", path.filename().string()));
  if (is_step)
    return info_facets(io::read_step(path), 1.0, "mm");
  return info_mesh(path, arguments.allow_outside);
}

} // namespace billet::app
