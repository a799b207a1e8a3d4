#include "io/scene/remesh_builder.h"

#include "geometry/base/error.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet::io {

namespace {

using mechanics::Face;
using mechanics::Index;
using mechanics::Mesh;

/// Whether nodes lie inside the part, or are faces, edges and corners of its boundary: those a new
/// mesh has, too.
bool can_be_carried(const Mesh& mesh,
                    const std::vector<Face>& boundary,
                    const std::vector<Index>& nodes) {
  std::vector<char> wanted(mesh.points.size(), 0);
  for (const Index node : nodes)
    wanted[idx(node)] = 1;
  std::vector<char> found(mesh.points.size(), 1);
  for (const Face& face : boundary)
    for (const Index node : face.nodes)
      found[idx(node)] = 0;
  for (const Face& face : boundary) {
    const bool whole = std::all_of(face.nodes.begin(), face.nodes.end(),
                                   [&](Index a) { return wanted[idx(a)] != 0; });
    const std::size_t n = mechanics::corners_per_face(mesh.kind);
    for (std::size_t a = 0; a < face.nodes.size(); ++a) {
      const std::size_t next = a + 1 < 2 * n ? a - n + 1 : 0; // the second corner of its edge
      const bool on_edge = a >= n && mesh.dimension() == 3 && wanted[idx(face.nodes[a - n])] != 0 &&
                           wanted[idx(face.nodes[next])] != 0;
      if (whole || a < n || on_edge)
        found[idx(face.nodes[a])] = 1;
    }
  }
  return nodes.size() == mesh.points.size() ||
         std::all_of(nodes.begin(), nodes.end(), [&](Index a) { return found[idx(a)] != 0; });
}

/// What cannot be carried from mesh to mesh.
void require_remeshable(const Case& content, const process::Part& part, const std::string& place) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw Error(Fault::case_file, place, "remesh: " + what + " not available in this version",
                remedy);
  };
  const std::string element = content.analysis == Analysis::solid ? "tet10" : "tri6";
  if (content.remesh->element && *content.remesh->element != element)
    refuse(fmt::format("element = \"{}\" is", *content.remesh->element),
           fmt::format("element = \"{}\"", element));
  const std::vector<Face> boundary = mechanics::boundary_faces(part.mesh);
  for (const process::Support& support : part.supports)
    if (!can_be_carried(part.mesh, boundary, support.nodes))
      refuse("a support of the middle node of an edge alone is",
             "support whole edges, corners, nodes inside the part or all nodes");
  for (const std::string& name : content.remesh->keep)
    if (!part.mesh.node_sets.contains(name))
      throw Error(Fault::case_file, place,
                  fmt::format("remesh.keep: the mesh has no set named '{}'", name));
}

} // namespace

std::optional<process::RemeshSettings>
remesh_settings_of(const Case& content, const process::Part& part, const std::string& place) {
  if (!content.remesh)
    return std::nullopt;
  require_remeshable(content, part, place);
  const Remesh& remesh = *content.remesh;
  process::RemeshSettings settings;
  settings.quality = remesh.quality;
  settings.strain = remesh.strain;
  settings.interval = remesh.interval;
  settings.penetration = remesh.penetration;
  settings.size = remesh.size_default;
  settings.size_min = remesh.size_min;
  settings.size_max = remesh.size_max;
  settings.size_contact = remesh.size_contact;
  settings.keep = remesh.keep;
  settings.weld = remesh.weld.value_or(!content.contact.self.on);
  return settings;
}

} // namespace billet::io
