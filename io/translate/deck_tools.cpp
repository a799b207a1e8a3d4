#include "io/translate/deck_tools.h"

#include "geometry/base/box.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace billet::io {

namespace {

using Facet = std::array<Vec3, 3>;

std::string stl_text(const std::string& name, const std::vector<Facet>& facets) {
  std::string text = "solid " + name + "\n";
  for (const Facet& f : facets) {
    const Vec3 n = (f[1] - f[0]).cross(f[2] - f[0]).normalized();
    text += fmt::format(" facet normal {:.9g} {:.9g} {:.9g}\n  outer loop\n", n[0], n[1], n[2]);
    for (const Vec3& corner : f)
      text += fmt::format("   vertex {:.9g} {:.9g} {:.9g}\n", corner[0], corner[1], corner[2]);
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

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

std::string stl_surface(const std::string& file, const std::string& unit) {
  return fmt::format("{{ stl = \"{}\", unit = \"{}\", smooth = true }}", file, unit);
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

/// A piece of a profile in the plane.
struct Piece {
  Vec3 to;
  double radius = 0.0; ///< of an arc, positive: turning left; 0: a line
  Vec3 centre = Vec3::Zero();
};

struct PlaneProfile {
  Vec3 start = Vec3::Zero();
  std::vector<Piece> pieces;
};

PlaneProfile profile_of(const DeckSurface& surface, std::vector<std::string>& remarks) {
  PlaneProfile profile;
  Vec3 last = Vec3::Zero();
  for (const DeckCurve& curve : surface.curves) {
    const auto number = [&](std::size_t i) {
      return i < curve.numbers.size() ? curve.numbers[i] : 0.0;
    };
    const Vec3 point(number(0), number(1), 0.0);
    if (curve.word == "START") {
      profile.start = point;
    } else if (curve.word == "CIRCL") {
      const Vec3 centre(number(2), number(3), 0.0);
      const Vec3 a = last - centre, b = point - centre;
      const double turn = a.x() * b.y() - a.y() * b.x();
      profile.pieces.push_back({point, std::copysign(0.5 * (a.norm() + b.norm()), turn), centre});
    } else if (curve.word == "PARAB") {
      const Vec3 end(number(2), number(3), 0.0);
      constexpr int pieces = 24;
      for (int k = 1; k <= pieces; ++k) {
        const double s = static_cast<double>(k) / pieces;
        const Vec3 control = 2.0 * point - 0.5 * (last + end);
        profile.pieces.push_back(
            {(1.0 - s) * (1.0 - s) * last + 2.0 * s * (1.0 - s) * control + s * s * end});
      }
      remarks.push_back("a parabola is drawn as 24 lines");
      last = end;
      continue;
    } else {
      profile.pieces.push_back({point});
    }
    last = point;
  }
  return profile;
}

std::string profile_text(const PlaneProfile& profile, bool swapped) {
  const auto place = [&](const Vec3& p) {
    return fmt::format("[{:.10g}, {:.10g}]", swapped ? p[1] : p[0], swapped ? p[0] : p[1]);
  };
  std::string text = "start = " + place(profile.start) + "\n";
  for (const Piece& piece : profile.pieces) {
    text += "\n[[segment]]\nto = " + place(piece.to) + "\n";
    if (piece.radius != 0.0)
      text += fmt::format("radius = {:.10g}\n", swapped ? -piece.radius : piece.radius);
  }
  return text;
}

/// The profile as points, arcs in steps of two degrees.
std::vector<Vec3> points_of(const PlaneProfile& profile) {
  constexpr double step = std::numbers::pi / 90.0;
  std::vector<Vec3> points{profile.start};
  for (const Piece& piece : profile.pieces) {
    if (piece.radius != 0.0) {
      const Vec3 a = points.back() - piece.centre, b = piece.to - piece.centre;
      const double from = std::atan2(a.y(), a.x());
      double angle = std::atan2(b.y(), b.x()) - from;
      angle = std::remainder(angle, 2.0 * std::numbers::pi); // less than half a turn
      const int n = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / step)));
      for (int k = 1; k < n; ++k) {
        const double at = from + angle * k / n;
        points.push_back(piece.centre +
                         std::abs(piece.radius) * Vec3(std::cos(at), std::sin(at), 0.0));
      }
    }
    points.push_back(piece.to);
  }
  return points;
}

Vec3 frame_point(const DeckSurface& surface, std::size_t i, const Vec3& otherwise) {
  return surface.frame.size() >= 3 * i + 3
             ? Vec3(surface.frame[3 * i], surface.frame[3 * i + 1], surface.frame[3 * i + 2])
             : otherwise;
}

/// A profile drawn along its generator, over the workpiece and a good deal beyond.
DeckToolSurface
swept(const DeckSurface& given, const std::string& name, const DeckSurroundings& around) {
  DeckToolSurface surface;
  const Vec3 origin = frame_point(given, 0, Vec3::Zero());
  const Vec3 x = (frame_point(given, 1, origin + Vec3::UnitX()) - origin).normalized();
  const Vec3 generator = (frame_point(given, 2, origin - Vec3::UnitZ()) - origin).normalized();
  const Vec3 z = -generator, y = z.cross(x);
  const auto place = [&](const Vec3& p) -> Vec3 { return origin + p.x() * x + p.y() * y; };
  const std::vector<Vec3> points = points_of(profile_of(given, surface.remarks));
  if (points.size() == 2) { // free on the left of the line
    const Vec3 along = points[1] - points[0];
    const Vec3 normal = -along.y() * x + along.x() * y;
    surface.text =
        fmt::format("{{ plane = {{ point = {}, normal = {} }} }}",
                    vector_text(place(points[0]), true), vector_text(normal.normalized(), true));
    return surface;
  }
  double low = 0.0, high = 0.0;
  for (const Vec3& p : around.points) {
    low = std::min(low, (p - origin).dot(z));
    high = std::max(high, (p - origin).dot(z));
  }
  const double margin = std::max(high - low, 1e-12);
  const Vec3 from = (low - margin) * z, to = (high + margin) * z;
  std::vector<Facet> facets; // their normals, (to - from) x (b - a), point to the free side
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 a = place(points[i]), b = place(points[i + 1]);
    facets.push_back({a + from, b + to, b + from});
    facets.push_back({a + from, a + to, b + to});
  }
  const std::string file = name + ".stl";
  surface.files.push_back({file, stl_text(name, facets)});
  surface.text = stl_surface(file, around.unit);
  return surface;
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
  const std::string file = name + ".stl";
  surface.files.push_back({file, stl_text(name, facets)});
  surface.text = stl_surface(file, around.unit);
  return surface;
}

DeckToolSurface surface_of_profile(const DeckSurface& given,
                                   const std::string& name,
                                   const DeckSurroundings& around) {
  if (given.type == "CYLINDER")
    return swept(given, name, around);
  DeckToolSurface surface;
  const PlaneProfile profile = profile_of(given, surface.remarks);
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
