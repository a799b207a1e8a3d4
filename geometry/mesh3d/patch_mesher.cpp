#include "geometry/mesh3d/patch_mesher.h"

#include "geometry/base/error.h"
#include "geometry/mesh3d/mesh_3.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace billet::geometry {

namespace {

using mesh_3::Complex;
using mesh_3::Domain;
using mesh_3::Kernel;
using mesh_3::Vertex;

/// Bounds over the size asked for: of the length of an edge on a line, of the radius of the circle
/// around a facet, of that of the sphere around a tetrahedron, and of how far a facet may lie off
/// the surface. The edges of the mesh then are as long as asked for, on the whole.
constexpr double line_share = 1.1;
constexpr double facet_share = 0.75;
constexpr double cell_share = 0.85;
constexpr double sag_share = 0.1;

/// CGAL's name for a patch; 0 is none.
int patch_name(std::int32_t patch) { return patch + 1; }

mesh_3::Polyhedron polyhedron(const PatchedSurface& surface) {
  mesh_3::Polyhedron result = mesh_3::polyhedron(surface.mesh);
  std::size_t t = 0;
  for (auto facet = result.facets_begin(); facet != result.facets_end(); ++facet)
    facet->set_patch_id(patch_name(surface.patch[t++]));
  return result;
}

/// A line as CGAL takes it.
struct Polyline {
  std::vector<Kernel::Point_3> points;
  std::vector<int> patches;
};

/// Property maps from a line to its points and to the patches adjacent to it.
struct PointsOf {
  using key_type = Polyline;
  using value_type = std::vector<Kernel::Point_3>;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;
  friend reference get(PointsOf /*map*/, const Polyline& line) { return line.points; }
};
struct PatchesOf {
  using key_type = Polyline;
  using value_type = std::vector<int>;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;
  friend reference get(PatchesOf /*map*/, const Polyline& line) { return line.patches; }
};

/// @return number of the line of each of the domain's curves
std::unordered_map<int, std::int32_t> add_lines(Domain& domain, const PatchedSurface& surface) {
  std::vector<Polyline> lines;
  for (const FeatureLine& line : surface.lines) {
    Polyline& added = lines.emplace_back();
    for (const Vec3& x : line.points)
      added.points.push_back(mesh_3::to_cgal(x));
    for (const std::int32_t patch : line.patches)
      added.patches.push_back(patch_name(patch));
  }
  std::vector<Domain::Curve_index> names;
  domain.add_features_and_incidences(lines.begin(), lines.end(), PointsOf(), PatchesOf(),
                                     std::back_inserter(names));
  std::unordered_map<int, std::int32_t> numbers;
  for (std::size_t i = 0; i < names.size(); ++i)
    numbers[names[i]] = static_cast<std::int32_t>(i);
  for (const Vec3& x : surface.corners)
    domain.add_corner(mesh_3::to_cgal(x));
  return numbers;
}

/// The field of sizes times a factor, as CGAL asks for it.
struct Field {
  using FT = Kernel::FT;
  using Index = Domain::Index;

  FT operator()(const Kernel::Point_3& x, int /*dimension*/, const Index& /*index*/) const {
    return factor * (*size)(Vec3(x.x(), x.y(), x.z()));
  }

  const SpaceSize* size;
  double factor;
};

class Extraction {
public:
  explicit Extraction(const Complex& complex) : complex_(complex) {}

  [[nodiscard]] PatchedSolid solid(const std::unordered_map<int, std::int32_t>& line_of) {
    for (auto cell = complex_.cells_in_complex_begin(); cell != complex_.cells_in_complex_end();
         ++cell)
      add(cell);
    for (auto edge = complex_.edges_in_complex_begin(); edge != complex_.edges_in_complex_end();
         ++edge) {
      const auto a = number_.find(edge->first->vertex(edge->second));
      const auto b = number_.find(edge->first->vertex(edge->third));
      if (a == number_.end() || b == number_.end())
        continue;
      const auto [low, high] = std::minmax(a->second, b->second);
      solid_.edges.push_back({{low, high}, line_of.at(complex_.curve_index(*edge))});
    }
    std::sort(solid_.edges.begin(), solid_.edges.end(),
              [](const auto& p, const auto& q) { return p.corners < q.corners; });
    return std::move(solid_);
  }

private:
  void add(Complex::Cell_handle cell) {
    std::array<std::int32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = number(cell->vertex(static_cast<int>(i)));
    // Sides of a cell, counter-clockwise seen from outside; side i is opposite to corner i.
    constexpr std::array<std::array<std::size_t, 3>, 4> sides{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const int side = static_cast<int>(i);
      if (complex_.is_in_complex(cell->neighbor(side)))
        continue;
      const auto& [a, b, c] = sides[i];
      solid_.facets.push_back({{corners[a], corners[b], corners[c]},
                               complex_.surface_patch_index(cell, side) - patch_name(0)});
    }
    solid_.mesh.tetrahedra.push_back(corners);
  }

  std::int32_t number(Vertex vertex) {
    const auto [place, is_new] =
        number_.try_emplace(vertex, static_cast<std::int32_t>(solid_.mesh.points.size()));
    if (is_new)
      solid_.mesh.points.push_back(mesh_3::from_cgal(vertex));
    return place->second;
  }

  struct Address {
    std::size_t operator()(Vertex vertex) const {
      return reinterpret_cast<std::size_t>(&*vertex) / sizeof(*vertex);
    }
  };

  const Complex& complex_;
  PatchedSolid solid_;
  std::unordered_map<Vertex, std::int32_t, Address> number_;
};

} // namespace

PatchedSolid mesh_patches(const PatchedSurface& surface, const SpaceSize& size, double most) {
  Domain domain = mesh_3::seeded_domain(polyhedron(surface));
  const std::unordered_map<int, std::int32_t> line_of = add_lines(domain, surface);
  namespace with = CGAL::parameters;
  const mesh_3::Criteria criteria(
      with::edge_size = Field{&size, line_share}, with::facet_angle = mesh_3::facet_angle,
      with::facet_size = Field{&size, facet_share}, with::facet_distance = Field{&size, sag_share},
      with::facet_topology = CGAL::FACET_VERTICES_ON_SAME_SURFACE_PATCH,
      with::cell_radius_edge_ratio = mesh_3::radius_over_edge,
      with::cell_size = Field{&size, cell_share});
  constexpr double tetrahedra_a_vertex = 4.0; // or more
  mesh_3::Refined refined =
      mesh_3::refined(domain, criteria, static_cast<std::size_t>(most / tetrahedra_a_vertex));
  if (refined.too_many) {
    const Vec3 x = mesh_3::middle_of_shortest_edge(refined.complex.triangulation());
    throw Error(Fault::geometry, "",
                fmt::format("a mesh of those sizes would have more than {:.3g} tetrahedra, the "
                            "smallest near ({:.6g}, {:.6g}, {:.6g})",
                            most, x.x(), x.y(), x.z()),
                "give larger sizes");
  }
  mesh_3::remove_slivers(refined.complex, domain);
  PatchedSolid solid = Extraction(refined.complex).solid(line_of);
  if (solid.mesh.tetrahedra.empty())
    throw Error(Fault::geometry, "", "the body could not be meshed");
  return solid;
}

} // namespace billet::geometry
