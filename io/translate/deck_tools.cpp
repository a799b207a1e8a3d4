#include "io/translate/deck_tools.h"

#include "io/translate/deck_profile.h"
#include "io/translate/deck_sweep.h"
#include "io/translate/face_turns.h"
#include "io/translate/tool_facets.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace billet::io {

namespace {

/// Triangles of a face, by its middle nodes where it has them.
void add_facets(const Deck& deck, const DeckFace& face, std::vector<Facet>& facets) {
  const auto at = [&](const std::vector<DeckNumber>& nodes, std::size_t i) -> const Vec3& {
    return deck_point(deck, nodes[i % nodes.size()]);
  };
  const std::size_t n = face.corners.size();
  if (face.middles.size() != n) {
    for (std::size_t i = 1; i + 1 < n; ++i)
      facets.push_back({at(face.corners, 0), at(face.corners, i), at(face.corners, i + 1)});
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    facets.push_back({at(face.corners, i), at(face.middles, i), at(face.middles, i + n - 1)});
  for (std::size_t i = 1; i + 1 < n; ++i)
    facets.push_back({at(face.middles, 0), at(face.middles, i), at(face.middles, i + 1)});
}

/// What became of faces that turn, for the log; empty: nothing needs to be said.
std::string
turns_remark(const FaceTurns& turns, const std::vector<Facet>& facets, const std::string& unit) {
  const std::string edges =
      turns.alone == 0.0
          ? ""
          : fmt::format("edges that turn by {:.3g} degrees and more stand alone and stay sharp",
                        turns.alone);
  if (!turns.is_curved())
    return edges.empty() ? "" : "the faces of its elements stay flat: " + edges;
  const std::optional<double> off = curving_of(facets, turns.feature_angle());
  return fmt::format("the faces of its elements turn alike by up to {:.3g} degrees: they are "
                     "curved (smooth = true){}{}",
                     turns.curved,
                     off ? fmt::format(", by up to {:.2g} {} (chord error)", *off, unit) : "",
                     edges.empty() ? "" : "; " + edges);
}

std::string points_text(const std::vector<Vec3>& points, bool closed) {
  std::string text = fmt::format("closed = {}\npoints = [\n", closed);
  for (const Vec3& p : points)
    text += fmt::format("  [{:.10g}, {:.10g}],\n", p[0], p[1]);
  return text + "]\n";
}

/// Nodes of the edges one after the other; the body stays on the left.
std::vector<DeckNumber> chain_of(const std::vector<DeckFace>& edges, bool& closed) {
  std::map<DeckNumber, const DeckFace*> from;
  std::map<DeckNumber, int> ends;
  for (const DeckFace& edge : edges) {
    from[edge.corners[0]] = &edge;
    ++ends[edge.corners[1]];
  }
  DeckNumber start = edges.front().corners[0];
  for (const auto& [node, edge] : from)
    if (!ends.contains(node))
      start = node; // of an open chain
  std::vector<DeckNumber> chain{start};
  for (DeckNumber node = start; from.contains(node) && chain.size() <= 2 * edges.size() + 1;) {
    const DeckFace& edge = *from.at(node);
    chain.insert(chain.end(), edge.middles.begin(), edge.middles.end());
    node = edge.corners[1];
    if (node == start)
      break;
    chain.push_back(node);
  }
  closed = from.contains(chain.back()) && chain.size() > 2 && ends.contains(start);
  return chain;
}

/// Whether the nearest node of the workpiece lies on the left of an open chain.
bool is_workpiece_left(const std::vector<Vec3>& chain, const DeckSurroundings& around) {
  double nearest = std::numeric_limits<double>::infinity();
  bool left = false;
  for (const Vec3& p : around.points)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Vec3 along = chain[i + 1] - chain[i], to = p - chain[i];
      const double s = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance = (to - s * along).norm();
      const double side = along.x() * to.y() - along.y() * to.x();
      if (distance < nearest && side != 0.0) {
        nearest = distance;
        left = side > 0.0;
      }
    }
  return left;
}

DeckToolSurface plane_chain(const Deck& deck,
                            const std::vector<DeckFace>& edges,
                            const std::string& name,
                            const DeckSurroundings& around) {
  DeckToolSurface surface;
  bool closed = false;
  std::vector<Vec3> points;
  for (const DeckNumber node : chain_of(edges, closed))
    points.push_back(deck_point(deck, node));
  if (!closed && is_workpiece_left(points, around))
    std::reverse(points.begin(), points.end());
  const std::string file = name + ".toml";
  surface.files.push_back({file, points_text(points, closed)});
  surface.text = fmt::format("{{ profile = \"{}\" }}", file);
  return surface;
}

// --- analytical surfaces ------------------------------------------------------------------------

std::string profile_text(const DeckProfile& profile, bool swapped) {
  const auto place = [&](const Vec3& p) {
    return fmt::format("[{:.10g}, {:.10g}]", swapped ? p[1] : p[0], swapped ? p[0] : p[1]);
  };
  std::string text = "start = " + place(profile.start) + "\n";
  for (const ProfileStep& piece : profile.pieces) {
    text += "\n[[segment]]\nto = " + place(piece.to) + "\n";
    if (piece.radius != 0.0)
      text += fmt::format("radius = {:.10g}\n", swapped ? -piece.radius : piece.radius);
  }
  return text;
}

} // namespace

std::string plain_name(const std::string& name) {
  std::string result;
  for (const char c : name)
    result += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '-';
  return result.empty() ? "tool" : result.substr(0, 60);
}

std::string vector_text(const Vec3& vector, bool in_space) {
  return in_space ? fmt::format("[{:.10g}, {:.10g}, {:.10g}]", vector[0], vector[1], vector[2])
                  : fmt::format("[{:.10g}, {:.10g}]", vector[0], vector[1]);
}

DeckToolSurface surface_of_body(const Deck& deck,
                                const DeckBody& body,
                                const std::string& name,
                                const DeckSurroundings& around) {
  const std::vector<DeckFace> faces = boundary_of(deck, body);
  DeckToolSurface surface;
  if (faces.empty())
    return surface;
  const bool has_edges = faces.front().corners.size() == 2;
  if (!around.in_space && has_edges)
    return plane_chain(deck, faces, name, around);
  if (!around.in_space || has_edges) {
    surface.remarks.push_back("its elements are of another dimension than the workpiece");
    return surface;
  }
  std::vector<Facet> facets;
  for (const DeckFace& face : faces)
    add_facets(deck, face, facets);
  const FaceTurns turns = turns_between(deck, faces);
  const std::string file = name + ".stl";
  surface.files.push_back({file, stl_text(name, facets)});
  surface.text = stl_surface(file, around.unit, turns.is_curved() ? turns.feature_angle() : 0.0);
  const std::string remark = turns_remark(turns, facets, around.unit);
  if (!remark.empty())
    surface.remarks.push_back(remark);
  return surface;
}

DeckToolSurface surface_of_profile(const DeckSurface& given,
                                   const std::string& name,
                                   const DeckSurroundings& around) {
  if (given.type == "CYLINDER")
    return swept_surface(given, name, around);
  DeckToolSurface surface;
  const DeckProfile profile = profile_of(given, surface.remarks);
  const std::string file = name + ".toml";
  if (given.type == "SEGMENTS") { // the metal is on the right of ours, and on the left of theirs
    surface.files.push_back({file, profile_text(profile, false)});
    surface.text = fmt::format("{{ profile = \"{}\", flip = true }}", file);
  } else if (given.type == "REVOLUTION") { // (r, z) as (height, radius): left becomes right
    const Vec3 origin = frame_point(given, 0, Vec3::Zero());
    const Vec3 axis = (frame_point(given, 1, origin + Vec3::UnitZ()) - origin).normalized();
    surface.files.push_back({file, profile_text(profile, true)});
    surface.text = fmt::format("{{ revolution = {{ point = {}, axis = {}, profile = \"{}\" }} }}",
                               vector_text(origin, true), vector_text(axis, true), file);
  } else {
    surface.remarks.push_back(fmt::format("TYPE={} is not understood", given.type));
  }
  return surface;
}

} // namespace billet::io
