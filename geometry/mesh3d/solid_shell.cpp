#include "geometry/mesh3d/solid_shell.h"

#include "geometry/base/index.h"
#include "geometry/mesh3d/solid_quality.h"
#include "geometry/repair/mesh_health.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace billet::geometry {

namespace {

/// Edges of a tetrahedron in the order of their middles.
constexpr std::array<std::array<std::size_t, 2>, 6> tetra_ends{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Jacobians below this share of the straight tetrahedron's are bent too far.
constexpr double least_bend = 0.4;

/// A node is shifted for the volume by no more than this share of the edges around it.
constexpr double most_shift = 0.1;

/// A rule for a triangle, exact up to degree four: Dunavant, Int. J. Numer. Meth. Engng 21 (1985)
/// 1129, p = 4.
struct RulePoint {
  std::array<double, 3> l;
  double weight; ///< of the area
};
constexpr std::array<RulePoint, 6> rule() {
  constexpr double a = 0.445948490915965, b = 0.091576213509771;
  constexpr double u = 0.223381589678011, v = 0.109951743655322;
  return {{{{1.0 - 2.0 * a, a, a}, u},
           {{a, 1.0 - 2.0 * a, a}, u},
           {{a, a, 1.0 - 2.0 * a}, u},
           {{1.0 - 2.0 * b, b, b}, v},
           {{b, 1.0 - 2.0 * b, b}, v},
           {{b, b, 1.0 - 2.0 * b}, v}}};
}

} // namespace

SolidShell::SolidShell(const BoundarySurface& surface, PatchedSolid solid)
    : surface_(surface), solid_(std::move(solid)) {
  find_edges();
  if (!flaws_.empty())
    return;
  find_seats();
  place_corners();
  place_middles();
}

void SolidShell::find_edges() {
  std::map<std::array<std::int32_t, 2>, int> faces; // of each edge of the boundary
  const auto key = [](std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return std::array{low, high};
  };
  for (const PatchedSolid::Facet& facet : solid_.facets)
    for (std::size_t i = 0; i < 3; ++i)
      ++faces[key(facet.corners[i], facet.corners[(i + 1) % 3])];
  for (const auto& [corners, count] : faces) {
    edges_.push_back({corners, Vec3::Zero()});
    edges_.back().middle = chord_middle(edges_.size() - 1);
    if (count != 2)
      flaws_.push_back(edges_.back().middle);
  }
  if (flaws_.empty())
    find_pinches();
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    facet_edges_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      facet_edges_.back()[i] = edge_between(facet.corners[i], facet.corners[(i + 1) % 3]);
  }
  find_edges_of_tetrahedra();
}

void SolidShell::find_edges_of_tetrahedra() {
  tetra_edges_.clear();
  for (const auto& tetrahedron : solid_.mesh.tetrahedra) {
    tetra_edges_.emplace_back();
    for (std::size_t i = 0; i < 6; ++i)
      tetra_edges_.back()[i] =
          edge_between(tetrahedron[tetra_ends[i][0]], tetrahedron[tetra_ends[i][1]]);
  }
}

void SolidShell::find_pinches() {
  TriangleMesh boundary{solid_.mesh.points, {}};
  for (const PatchedSolid::Facet& facet : solid_.facets)
    boundary.triangles.push_back(facet.corners);
  if (const auto pinch = health(boundary).non_manifold_vertex_at)
    flaws_.push_back(*pinch);
}

std::int32_t SolidShell::edge_between(std::int32_t a, std::int32_t b) const {
  const auto [low, high] = std::minmax(a, b);
  const std::array wanted{low, high};
  const auto found = std::lower_bound(
      edges_.begin(), edges_.end(), wanted,
      [](const RemeshedSolid::Edge& edge, const auto& corners) { return edge.corners < corners; });
  return found != edges_.end() && found->corners == wanted
             ? static_cast<std::int32_t>(found - edges_.begin())
             : -1;
}

Vec3 SolidShell::chord_middle(std::size_t edge) const {
  const auto& [a, b] = edges_[edge].corners;
  return 0.5 * (solid_.mesh.points[idx(a)] + solid_.mesh.points[idx(b)]);
}

void SolidShell::find_seats() {
  const FeatureLines& lines = surface_.lines();
  const std::vector<Vec3>& old = surface_.boundary().mesh.points;
  std::map<std::array<double, 3>, std::int32_t> corners;
  const auto add_corner = [&](std::int32_t point) {
    const Vec3& x = old[idx(point)];
    corners[{x.x(), x.y(), x.z()}] = point;
  };
  for (const std::vector<LinePiece>& chain : lines.chains)
    if (chain.front().ends[0] != chain.back().ends[1]) {
      add_corner(chain.front().ends[0]);
      add_corner(chain.back().ends[1]);
    }
  for (const std::int32_t point : lines.lone_corners)
    add_corner(point);

  const std::size_t n = solid_.mesh.points.size();
  seats_.resize(n + edges_.size());
  const auto sit = [&](std::size_t node, std::int32_t patch) {
    Seat& seat = seats_[node];
    seat.patch = seat.patch < 0 ? patch : std::min(seat.patch, patch);
  };
  for (std::size_t f = 0; f < solid_.facets.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      sit(idx(solid_.facets[f].corners[i]), solid_.facets[f].patch);
      sit(n + idx(facet_edges_[f][i]), solid_.facets[f].patch);
    }
  for (const PatchedSolid::LineEdge& edge : solid_.edges) {
    const std::int32_t number = edge_between(edge.corners[0], edge.corners[1]);
    if (number < 0)
      continue; // cut off by exudation
    seats_[n + idx(number)].line = edge.line;
    for (const std::int32_t corner : edge.corners)
      seats_[idx(corner)].line = edge.line;
  }
  for (std::size_t node = 0; node < n; ++node) {
    const Vec3& x = solid_.mesh.points[node];
    if (const auto found = corners.find({x.x(), x.y(), x.z()});
        seats_[node].patch >= 0 && found != corners.end())
      seats_[node].point = found->second;
  }
}

SurfacePlace SolidShell::place(const Seat& seat, const Vec3& x) const {
  if (seat.point < 0 && seat.line >= 0)
    return surface_.on_triangle(surface_.place_on_line(seat.line, x));
  return surface_.place(seat.patch, x);
}

Vec3 SolidShell::seated(const Seat& seat, const Vec3& x) const {
  if (seat.point >= 0)
    return surface_.boundary().mesh.points[idx(seat.point)];
  if (seat.line >= 0)
    return surface_.point(surface_.place_on_line(seat.line, x));
  return seat.patch >= 0 ? surface_.point(surface_.place(seat.patch, x)) : x;
}

void SolidShell::place_corners() {
  places_.resize(seats_.size());
  for (std::size_t node = 0; node < solid_.mesh.points.size(); ++node)
    if (seats_[node].patch >= 0) {
      Vec3& x = solid_.mesh.points[node];
      places_[node] = place(seats_[node], x);
      x = seated(seats_[node], x);
    }
}

void SolidShell::place_middles() {
  const std::size_t n = solid_.mesh.points.size();
  old_line_piece_.assign(edges_.size(), -1);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Vec3 chord = chord_middle(e);
    const Seat& seat = seats_[n + e];
    places_[n + e] = place(seat, chord);
    edges_[e].middle = seated(seat, chord);
    if (seat.line >= 0)
      old_line_piece_[e] = surface_.place_on_line(seat.line, chord).piece;
  }
}

Vec3& SolidShell::position(std::size_t node) {
  const std::size_t n = solid_.mesh.points.size();
  return node < n ? solid_.mesh.points[node] : edges_[node - n].middle;
}

const Vec3& SolidShell::position(std::size_t node) const {
  const std::size_t n = solid_.mesh.points.size();
  return node < n ? solid_.mesh.points[node] : edges_[node - n].middle;
}

std::array<std::size_t, 6> SolidShell::nodes_of(const PatchedSolid::Facet& facet) const {
  const std::size_t n = solid_.mesh.points.size();
  const auto f = static_cast<std::size_t>(&facet - solid_.facets.data());
  std::array<std::size_t, 6> nodes{};
  for (std::size_t i = 0; i < 3; ++i) {
    nodes[i] = idx(facet.corners[i]);
    nodes[3 + i] = n + idx(facet_edges_[f][i]);
  }
  return nodes;
}

void SolidShell::improve_nodes(const std::vector<char>& movable, double wanted) {
  // The place on the straight triangles is where a node's search starts from.
  const Confine confine = [&](std::int32_t node, const Vec3& x) {
    return seated(seats_[idx(node)], x);
  };
  improve(solid_.mesh, movable, confine, wanted);
  find_edges_of_tetrahedra();
}

void SolidShell::slide(double wanted) {
  std::vector<char> movable;
  for (std::size_t node = 0; node < solid_.mesh.points.size(); ++node)
    movable.push_back(static_cast<char>(seats_[node].point < 0 && seats_[node].line < 0));
  improve_nodes(movable, wanted);
  for (std::size_t node = 0; node < solid_.mesh.points.size(); ++node)
    if (movable[node] != 0 && seats_[node].patch >= 0)
      places_[node] = place(seats_[node], solid_.mesh.points[node]);
  place_middles();
}

void SolidShell::smooth(double wanted) {
  std::vector<char> movable;
  for (std::size_t node = 0; node < solid_.mesh.points.size(); ++node)
    movable.push_back(static_cast<char>(seats_[node].patch < 0));
  improve_nodes(movable, wanted);
}

void SolidShell::snap(const SnapSolid& snap) {
  std::vector<std::set<std::int32_t>> parts(seats_.size());
  const SolidBoundary& boundary = surface_.boundary();
  for (const PatchedSolid::Facet& facet : solid_.facets)
    for (const std::size_t node : nodes_of(facet)) {
      // All triangles of a patch are of one part.
      const Vec3& x = position(node);
      parts[node].insert(boundary.part[idx(surface_.place(facet.patch, x).triangle)]);
    }
  for (std::size_t node = 0; node < seats_.size(); ++node)
    if (!parts[node].empty()) {
      const std::vector<std::int32_t> list(parts[node].begin(), parts[node].end());
      position(node) = snap(list, places_[node], position(node));
    }
}

SolidShell::Enclosed SolidShell::enclosed() const {
  Enclosed result{0.0, std::vector<Vec3>(seats_.size(), Vec3::Zero())};
  const Vec3 origin = solid_.mesh.points.front(); // near the body, for the sake of rounding
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    const std::array<std::size_t, 6> nodes = nodes_of(facet);
    for (const auto& [l, weight] : rule()) {
      const std::array<double, 6> N{l[0] * (2.0 * l[0] - 1.0), l[1] * (2.0 * l[1] - 1.0),
                                    l[2] * (2.0 * l[2] - 1.0), 4.0 * l[0] * l[1],
                                    4.0 * l[1] * l[2],         4.0 * l[2] * l[0]};
      std::array<Vec3, 3> d{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}; // by l
      Vec3 x = -origin;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &corner = position(nodes[i]), &middle = position(nodes[3 + i]);
        x += N[i] * corner + N[3 + i] * middle;
        d[i] += (4.0 * l[i] - 1.0) * corner + 4.0 * l[(i + 1) % 3] * middle;
        d[(i + 1) % 3] += 4.0 * l[i] * middle;
      }
      const Vec3 area = 0.5 * weight * (d[1] - d[0]).cross(d[2] - d[0]);
      result.volume += x.dot(area) / 3.0;
      for (std::size_t i = 0; i < 6; ++i)
        result.slope[nodes[i]] += N[i] * area;
    }
  }
  return result;
}

double SolidShell::volume() const { return enclosed().volume; }

std::vector<double> SolidShell::freedom() const {
  const SolidBoundary& boundary = surface_.boundary();
  std::vector<char> held(seats_.size(), 0), on(seats_.size(), 0);
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    const std::array<std::size_t, 6> nodes = nodes_of(facet);
    const Vec3 middle = (position(nodes[0]) + position(nodes[1]) + position(nodes[2])) / 3.0;
    const bool holds = boundary.hold[idx(surface_.place(facet.patch, middle).triangle)] != 0;
    for (const std::size_t node : nodes) {
      on[node] = 1;
      held[node] = static_cast<char>(held[node] != 0 || holds);
    }
  }
  std::vector<double> result(seats_.size(), 0.0);
  for (std::size_t node = 0; node < seats_.size(); ++node)
    result[node] = on[node] != 0 && held[node] == 0 && seats_[node].point < 0 ? 1.0 : 0.0;
  std::vector<char> beside(seats_.size(), 0);
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    const std::array<std::size_t, 6> nodes = nodes_of(facet);
    if (std::any_of(nodes.begin(), nodes.end(), [&](std::size_t node) { return held[node] != 0; }))
      for (const std::size_t node : nodes)
        beside[node] = 1;
  }
  for (std::size_t node = 0; node < seats_.size(); ++node)
    if (beside[node] != 0)
      result[node] *= 0.5;
  return result;
}

std::vector<Vec3> SolidShell::normals() const {
  std::vector<Vec3> result(seats_.size(), Vec3::Zero());
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    const std::array<std::size_t, 6> nodes = nodes_of(facet);
    const Vec3 area =
        (position(nodes[1]) - position(nodes[0])).cross(position(nodes[2]) - position(nodes[0]));
    for (const std::size_t node : nodes)
      result[node] += area;
  }
  for (Vec3& normal : result)
    normal = normal.stableNormalized();
  return result;
}

void SolidShell::restore_volume(double wanted) {
  constexpr int most_rounds = 6;
  constexpr double rounding = 1e-13;
  const std::vector<double> free = freedom();
  const std::vector<Vec3> normal = normals();
  double mean_edge = 0.0;
  for (const RemeshedSolid::Edge& edge : edges_)
    mean_edge +=
        (solid_.mesh.points[idx(edge.corners[0])] - solid_.mesh.points[idx(edge.corners[1])])
            .norm() /
        static_cast<double>(edges_.size());
  const double most = most_shift * mean_edge;
  double shifted = 0.0;
  for (int round = 0; round < most_rounds; ++round) {
    const Enclosed now = enclosed();
    double gain = 0.0, area = 0.0;
    for (std::size_t node = 0; node < free.size(); ++node) {
      gain += free[node] * normal[node].dot(now.slope[node]);
      area += now.slope[node].norm();
    }
    const double missing = wanted - now.volume;
    if (!(gain > 1e-6 * area) || std::abs(missing) <= rounding * wanted)
      return;
    const double target = std::clamp(shifted + missing / gain, -most, most);
    const double shift = target - shifted;
    shifted = target;
    for (std::size_t node = 0; node < free.size(); ++node)
      if (free[node] > 0.0)
        position(node) += shift * free[node] * normal[node];
  }
}

std::array<Vec3, 4> SolidShell::corners_of(std::size_t tetrahedron) const {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = solid_.mesh.points[idx(solid_.mesh.tetrahedra[tetrahedron][i])];
  return corners;
}

std::array<Vec3, 6> SolidShell::middles_of(std::size_t tetrahedron) const {
  const std::array<std::int32_t, 4>& corners = solid_.mesh.tetrahedra[tetrahedron];
  std::array<Vec3, 6> middles;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::int32_t edge = tetra_edges_[tetrahedron][i];
    middles[i] = edge >= 0 ? edges_[idx(edge)].middle
                           : Vec3(0.5 * (solid_.mesh.points[idx(corners[tetra_ends[i][0]])] +
                                         solid_.mesh.points[idx(corners[tetra_ends[i][1]])]));
  }
  return middles;
}

double SolidShell::bend(std::size_t tetrahedron) const {
  return bent_jacobian(corners_of(tetrahedron), middles_of(tetrahedron));
}

double SolidShell::bent_quality(std::size_t tetrahedron) const {
  return geometry::bent_quality(corners_of(tetrahedron), middles_of(tetrahedron));
}

bool SolidShell::straighten(double wanted) {
  constexpr double worth_it = 0.01;
  std::set<std::int32_t> bent;
  for (std::size_t e = 0; e < tetra_edges_.size(); ++e) {
    const double quality = bent_quality(e);
    if (bend(e) < least_bend ||
        (quality < wanted && quality + worth_it < shape_quality(corners_of(e))))
      for (const std::int32_t edge : tetra_edges_[e])
        if (edge >= 0)
          bent.insert(edge);
  }
  for (const std::int32_t edge : bent)
    edges_[idx(edge)].middle = 0.5 * (edges_[idx(edge)].middle + chord_middle(idx(edge)));
  return !bent.empty();
}

double SolidShell::smallest_angle() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < tetra_edges_.size(); ++e)
    least = std::min(least, smallest_dihedral(corners_of(e)));
  return least;
}

double SolidShell::quality() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < tetra_edges_.size(); ++e)
    least = std::min({least, shape_quality(corners_of(e)), bent_quality(e)});
  return least;
}

std::vector<Vec3> SolidShell::poor_places(double angle, double quality) const {
  std::vector<std::pair<double, std::size_t>> poor;
  for (std::size_t e = 0; e < tetra_edges_.size(); ++e) {
    const std::array<Vec3, 4> corners = corners_of(e);
    const double least = std::min({smallest_dihedral(corners) / angle,
                                   shape_quality(corners) / quality, bent_quality(e) / quality});
    const double bent = bend(e);
    if (least < 1.0 || bent <= 0.0)
      poor.emplace_back(std::min(least, bent), e);
  }
  std::sort(poor.begin(), poor.end());
  std::vector<Vec3> places;
  for (const auto& [least, e] : poor) {
    const std::array<Vec3, 4> x = corners_of(e);
    places.emplace_back(0.25 * (x[0] + x[1] + x[2] + x[3]));
  }
  return places;
}

double SolidShell::smallest_jacobian() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < tetra_edges_.size(); ++e)
    least = std::min(least, bend(e));
  return least;
}

RemeshedSolid SolidShell::result() && {
  RemeshedSolid result;
  result.volume = volume();
  result.smallest_angle = smallest_angle() * 180.0 / std::numbers::pi;
  const SolidBoundary& boundary = surface_.boundary();
  for (const PatchedSolid::Facet& facet : solid_.facets) {
    const Vec3 middle =
        (solid_.mesh.points[idx(facet.corners[0])] + solid_.mesh.points[idx(facet.corners[1])] +
         solid_.mesh.points[idx(facet.corners[2])]) /
        3.0;
    result.facets.push_back(
        {facet.corners, boundary.part[idx(surface_.place(facet.patch, middle).triangle)]});
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (old_line_piece_[e] >= 0) {
      const std::int32_t line = seats_[solid_.mesh.points.size() + e].line;
      const auto& ends = surface_.lines().chains[idx(line)][idx(old_line_piece_[e])].ends;
      const auto [low, high] = std::minmax(ends[0], ends[1]);
      result.on_lines.push_back({e, {low, high}});
    }
  for (std::size_t node = 0; node < solid_.mesh.points.size(); ++node)
    if (seats_[node].point >= 0)
      result.kept.push_back({static_cast<std::int32_t>(node), seats_[node].point});
  result.mesh = std::move(solid_.mesh);
  result.edges = std::move(edges_);
  return result;
}

} // namespace billet::geometry
