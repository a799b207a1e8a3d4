#include "io/tools/stl_report.h"

#include "geometry/repair/mesh_health.h"
#include "io/case/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace billet::io {

namespace {

using geometry::coordinates;
using geometry::MeshHealth;
using geometry::MeshPart;

std::string counted(std::int64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string openness(const MeshHealth& h) {
  if (h.closed())
    return fmt::format("closed, volume {:g}", h.volume);
  std::string text = fmt::format("open, {}", counted(h.border_edges, "border edge"));
  if (h.border_at)
    text += fmt::format(" in {}, the first at {}", counted(h.border_loops, "loop"),
                        coordinates(*h.border_at));
  return text;
}

void remark_on_parts(const StlTool& tool, std::vector<std::string>& remarks) {
  if (tool.health.inside_out())
    remarks.push_back("inside out: the tool is outside of the surface (flip = true turns it)");
  if (!tool.parts.nesting_known)
    remarks.push_back("too many parts to find out which lies in which");
  const bool inverted = tool.health.inside_out();
  for (const MeshPart& part : tool.parts.list)
    if (part.closed && part.in.size() % 2 == 1 && (part.volume > 0.0) != inverted)
      remarks.push_back(
          fmt::format("the part at {} lies inside another one and faces its material: "
                      "it has no effect from outside",
                      coordinates(part.at)));
    else if (part.closed && part.in.empty() && part.volume < 0.0 && !inverted)
      remarks.push_back(
          fmt::format("the closed part at {} faces its inside", coordinates(part.at)));
}

void remark_on_meetings(const geometry::SelfIntersections& found,
                        double tolerance,
                        std::vector<std::string>& remarks) {
  if (found.overlaps > 0)
    remarks.push_back(fmt::format("closed parts overlap or touch, the first near {}; they act as "
                                  "one body on what comes from outside, not on a part that begins "
                                  "within one of them",
                                  coordinates(*found.overlap_at)));
  if (found.touches > 0)
    remarks.push_back(fmt::format("{} of triangles touch or cut by less than {:.3g}",
                                  counted(found.touches, "pair"), tolerance));
  if (!found.complete)
    remarks.push_back("too many triangles lie close together: not all were tested for cuts");
}

std::string repairs_text(const StlTool& tool) {
  const std::vector<std::string> done = tool.repairs.notes();
  if (done.empty())
    return "none";
  return fmt::format("{} (tolerance {:.3g})", fmt::join(done, ", "), tool.repairs.tolerance);
}

} // namespace

std::vector<std::string> remarks(const FacetFile& file, const StlTool& tool) {
  std::vector<std::string> remarks;
  if (tool.health.closed())
    for (const Complaint& doubt : file.doubts)
      remarks.push_back(doubt.message + "; the surface is closed, so nothing is missing");
  if (file.opposed_normals > 0)
    remarks.push_back(
        fmt::format("{} stated normals contradict the order of the corners, which counts",
                    file.opposed_normals));
  remark_on_parts(tool, remarks);
  remark_on_meetings(tool.intersections, tool.repairs.tolerance, remarks);
  if (tool.health.needles > 0)
    remarks.push_back(fmt::format("{} (longer than {:g} times their height), the worst at {}",
                                  counted(tool.health.needles, "needle"), geometry::needle_aspect,
                                  coordinates(*tool.health.worst_aspect_at)));
  if (tool.health.non_manifold_vertices > 0)
    remarks.push_back(fmt::format("{} touch in a point only, the first at {}",
                                  counted(tool.health.non_manifold_vertices, "fan"),
                                  coordinates(*tool.health.non_manifold_vertex_at)));
  if (file.format == FacetFormat::binary_stl && tool.precision > tool.repairs.tolerance)
    remarks.push_back(
        fmt::format("so far from the origin the file's coordinates are known to {:.3g} "
                    "only; export the surface nearer to it",
                    tool.precision));
  return remarks;
}

std::string report(const FacetFile& file, const StlTool& tool) {
  const MeshHealth& h = tool.health;
  const Vec3 size = h.bounds.high - h.bounds.low;
  std::string text = fmt::format("{} ({}): {} facets, {} points, {}, {:g} x {:g} x {:g}; {}; {}",
                                 file.path.string(), name(file.format), h.triangles, h.points,
                                 counted(h.components, "part"), size.x(), size.y(), size.z(),
                                 openness(h), counted(h.feature_edges, "feature edge"));
  if (!tool.repairs.notes().empty())
    text += "; repaired: " + repairs_text(tool);
  for (const std::string& remark : remarks(file, tool))
    text += "; " + remark;
  return text;
}

std::vector<ReportRow> table(const FacetFile& file, const StlTool& tool) {
  const MeshHealth& h = tool.health;
  const geometry::SelfIntersections& cuts = tool.intersections;
  const auto first = [](const std::optional<Vec3>& at) {
    return at ? ", the first at " + coordinates(*at) : std::string();
  };
  std::vector<ReportRow> rows{
      {"facets in the file", fmt::format("{}", file.facets.size())},
      {"box", h.bounds.empty()
                  ? "none"
                  : fmt::format("{} to {}", coordinates(h.bounds.low), coordinates(h.bounds.high))},
      {"triangles", fmt::format("{} on {} points, area {:.6g}", h.triangles, h.points, h.area)},
      {"parts", fmt::format("{}", h.components)},
      {"surface", openness(h)},
      {"edges of three and more",
       fmt::format("{}{}", h.non_manifold_edges, first(h.non_manifold_at))},
      {"edges turned both ways",
       fmt::format("{}{}", h.inconsistent_edges, first(h.inconsistent_at))},
      {"cuts", fmt::format("{}{}", cuts.cuts, first(cuts.cut_at))},
      {"overlaps, touches", fmt::format("{}, {}", cuts.overlaps, cuts.touches)},
      {"feature edges", fmt::format("{}", h.feature_edges)},
      {"needles", fmt::format("{}, worst aspect ratio {:.3g}", h.needles, h.worst_aspect)},
      {"repairs", repairs_text(tool)},
  };
  constexpr std::size_t most_parts = 20;
  for (std::size_t i = 0; i < tool.parts.list.size() && i < most_parts && h.components > 1; ++i) {
    const MeshPart& part = tool.parts.list[i];
    rows.push_back(
        {fmt::format("part {}", i + 1),
         fmt::format("{} at {}, {}{}", counted(part.triangles, "triangle"), coordinates(part.at),
                     part.closed ? fmt::format("volume {:.6g}", part.volume) : "open",
                     part.in.empty() ? "" : ", inside another one")});
  }
  return rows;
}

std::optional<std::string> size_warning(double die, double workpiece, std::string_view unit) {
  // A die as large as the workpiece is off by 25.4 in inches; rolls are larger than what they roll.
  constexpr double large = 20.0, small = 1.0 / 20.0, huge = 1000.0;
  const double ratio = die / workpiece;
  if (ratio <= large && ratio >= small)
    return std::nullopt;
  const UnitSystem system;
  std::string likely;
  double best = std::abs(std::log(ratio));
  const Outcome<double> given = length_factor(unit, system);
  for (const char* name : {"mm", "cm", "m", "in"}) {
    const Outcome<double> factor = length_factor(name, system);
    const double off = factor && given ? std::abs(std::log(ratio * *factor / *given)) : best;
    if (off < best) {
      best = off;
      likely = name;
    }
  }
  if (likely.empty() && ratio > small && ratio < huge)
    return std::nullopt;
  return fmt::format("the die is {:.3g} times {} than the workpiece{}",
                     ratio > 1.0 ? ratio : 1.0 / ratio, ratio > 1.0 ? "larger" : "smaller",
                     likely.empty()
                         ? "; is its unit right?"
                         : fmt::format(": is the file in {} instead of {}?", likely, unit));
}

} // namespace billet::io
