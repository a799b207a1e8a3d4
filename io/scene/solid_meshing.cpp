#include "io/scene/solid_meshing.h"

#include "geometry/base/error.h"
#include "geometry/mesh3d/mesher_3d.h"
#include "geometry/repair/mesh_health.h"
#include "io/tools/stl_report.h"
#include "io/tools/stl_tool.h"
#include "mechanics/mesh/domain_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace billet::io {

namespace {

using geometry::coordinates;

/// Shells in no other one: a workpiece has one.
void require_one_body(const geometry::MeshParts& parts, const std::string& place) {
  constexpr std::size_t most_named = 6;
  std::size_t n = 0;
  std::string boxes;
  for (const geometry::MeshPart& part : parts.list) {
    if (part.in.size() % 2 != 0)
      continue; // a cavity
    if (n++ < most_named)
      boxes += fmt::format("{}{} to {}", n == 1 ? "" : "; ", coordinates(part.bounds.low),
                           coordinates(part.bounds.high));
  }
  if (n > 1)
    throw Error(Fault::geometry, place,
                fmt::format("the file holds {} bodies, in the boxes {}{}", n, boxes,
                            n > most_named ? "; ..." : ""),
                "a workpiece is one body: write each to a file of its own, or unite those that "
                "belong together in the CAD system");
}

std::string estimate_in_words(const geometry::SolidEstimate& estimate,
                              const geometry::SolidRefinement& wanted) {
  std::string text =
      fmt::format("meshing in space, about {:.2g} tetrahedra of size {:.6g} and less",
                  estimate.tetrahedra(), wanted.size);
  if (wanted.details > 0.0)
    text += fmt::format(", details below {:.6g} passed over", wanted.details);
  if (const std::string why = geometry::reason(estimate); !why.empty())
    text += fmt::format(" ({:.2g} for the volume alone; {})", estimate.bulk, why);
  return text;
}

} // namespace

mechanics::Mesh solid_mesh(const BodyFile& body,
                           const geometry::SolidRefinement& wanted,
                           const Say& say,
                           std::vector<std::string>& notes) {
  const StlTool tool = tool_mesh(body.facets, {body.scale, false, wanted.feature_angle});
  notes.push_back(fmt::format("workpiece: {}", report(body.facets, tool)));
  if (!tool.health.closed() || tool.health.inside_out())
    throw Error(Fault::geometry, body.file.given,
                tool.health.closed() ? "the surface of the body is inside out"
                                     : "the surface of a body must be closed",
                tool.health.closed() ? "turn its facets in the CAD system"
                                     : "close its holes; an open surface can only be a tool");
  require_one_body(tool.parts, body.file.given);
  const geometry::SolidEstimate estimate = geometry::solid_estimate(tool.mesh, wanted);
  if (say)
    say(fmt::format("{}: {}", body.file.given, estimate_in_words(estimate, wanted)));
  const geometry::SolidMesh mesh = geometry::mesh_solid(tool.mesh, wanted, estimate);
  const double volume = geometry::volume(mesh);
  notes.push_back(fmt::format(
      "{}: meshed with {} tetrahedra of size {:.6g}, smallest dihedral angle {:.1f} degrees; "
      "volume {:.6g}, {:+.2g} % of that of the surface",
      body.file.given, mesh.tetrahedra.size(), wanted.size, geometry::smallest_dihedral(mesh),
      volume, 100.0 * (volume / tool.health.volume - 1.0)));
  return mechanics::tetrahedron_mesh(mesh);
}

} // namespace billet::io
