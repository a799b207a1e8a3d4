#include "geometry/mesh3d/solid_estimate.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/base/index.h"
#include "geometry/mesh3d/wall_widths.h"
#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/sharp_edges.h"
#include "geometry/triangles/triangle_shape.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

// Shares found on bodies of many kinds: see (G.57).
constexpr double in_a_cube = 4.0;       ///< tetrahedra of size 1
constexpr double on_a_square = 0.5;     ///< further ones of size 1 along the surface
constexpr double on_an_edge = 1.5;      ///< and along sharp edges
constexpr double on_small_square = 3.0; ///< of smaller ones: those that lead over to the size too
constexpr double at_small_edge = 9.0;   ///< the same, around a piece of a sharp edge
constexpr double edge_share = 0.4; ///< length of such a piece over the distance to the next edge
constexpr double wall_share = 1.3; ///< edge of tetrahedra in a wall over its thickness
/// Radius of a rounding, over what facets may lie off, that they do not bridge.
constexpr double least_curve = 3.0;

constexpr double sag = 0.03;           ///< of a facet off the surface, over the size
constexpr double sag_of_details = 0.5; ///< the same over the details

void count_among(SmallShapes& shapes, double tetrahedra, double width, const Vec3& at) {
  shapes.tetrahedra += tetrahedra;
  if (shapes.width == 0.0 || width < shapes.width) {
    shapes.width = width;
    shapes.at = at;
  }
}

/// Pieces of the sharp edges, as long as the distance to the next edge lets them be.
void add_edges(const TriangleMesh& mesh, const SolidRefinement& wanted, SolidEstimate& estimate) {
  constexpr double most_places = 16.0; // on one edge
  const std::vector<SharpEdge> edges = sharp_edges(mesh, wanted.feature_angle);
  const SharpNetwork network(mesh, edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec3 &a = mesh.points[idx(edges[i].a)], &b = mesh.points[idx(edges[i].b)];
    const double places = std::clamp(std::ceil(edges[i].length / wanted.size), 1.0, most_places);
    for (int k = 0; k < static_cast<int>(places); ++k) {
      const Vec3 x = a + (k + 0.5) / places * (b - a);
      const double apart =
          network.distance(static_cast<std::int32_t>(i), x, wanted.size / edge_share);
      const double piece = edge_share * apart;
      const double length = edges[i].length / places;
      if (apart < wanted.details)
        continue;
      if (piece >= wanted.size)
        estimate.skin += on_an_edge * length / wanted.size;
      else
        count_among(estimate.edges, at_small_edge * length / piece, apart, x);
    }
  }
}

/// The largest curvature at each triangle, by the angles to its neighbours [1/mm].
std::vector<double> curvatures(const TriangleMesh& mesh, double feature_angle) {
  std::vector<double> result(mesh.triangles.size(), 0.0);
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2)
      return;
    const double length = (mesh.points[idx(uses[0].high)] - mesh.points[idx(uses[0].low)]).norm();
    const Vec3 first = doubled_area(mesh, mesh.triangles[idx(uses[0].triangle)]),
               second = doubled_area(mesh, mesh.triangles[idx(uses[1].triangle)]);
    const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
    const double apart = 0.5 * (first.norm() + second.norm()) / length; // average of the heights
    if (angle <= feature_angle * degree)
      for (const EdgeUse& use : uses)
        result[idx(use.triangle)] = std::max(result[idx(use.triangle)], angle / apart);
  });
  return result;
}

/// Of each triangle [mm]; +inf: not thinner than what matters.
std::vector<double> walls_at(const TriangleMesh& mesh, const SolidRefinement& wanted) {
  std::vector<double> result(mesh.triangles.size(), std::numeric_limits<double>::infinity());
  for (const WallWidth& width : wall_widths(mesh, wanted.size / wall_share))
    if (!width.outside && width.width >= wanted.details)
      result[idx(width.triangle)] = width.width;
  return result;
}

/// Facets of the surface, as small as walls and roundings want them.
void add_facets(const TriangleMesh& mesh, const SolidRefinement& wanted, SolidEstimate& estimate) {
  const std::vector<double> curvature = curvatures(mesh, wanted.feature_angle);
  const std::vector<double> wall = walls_at(mesh, wanted);
  const double off = wanted.distance();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const Vec3 middle =
        (corner(mesh, triangle, 0) + corner(mesh, triangle, 1) + corner(mesh, triangle, 2)) / 3.0;
    const double area = 0.5 * doubled_area(mesh, triangle).norm();
    const double radius = 1.0 / curvature[t]; // +inf: flat
    const double by_curve =
        radius > least_curve * off ? std::sqrt(8.0 * radius * off) : wanted.size;
    const double by_wall = wall_share * wall[t];
    if (by_wall < std::min(by_curve, wanted.size))
      count_among(estimate.walls, on_small_square * area / (by_wall * by_wall), wall[t], middle);
    else if (by_curve < wanted.size)
      count_among(estimate.curves, on_small_square * area / (by_curve * by_curve), radius, middle);
    else
      estimate.skin += on_a_square * area / (wanted.size * wanted.size);
  }
}

} // namespace

double SolidRefinement::distance() const { return std::max(sag * size, sag_of_details * details); }

SolidEstimate solid_estimate(const TriangleMesh& surface, const SolidRefinement& wanted) {
  SolidEstimate estimate;
  estimate.bulk = in_a_cube * health(surface).volume / std::pow(wanted.size, 3);
  add_edges(surface, wanted, estimate);
  add_facets(surface, wanted, estimate);
  return estimate;
}

std::string reason(const SolidEstimate& estimate) {
  constexpr double worth_a_word = 0.25; // of all
  const std::array shapes{
      std::pair{&estimate.edges, "sharp edges that are only {:.3g} apart, the closest at {}"},
      std::pair{&estimate.walls, "walls that are only {:.3g} thick, the thinnest at {}"},
      std::pair{&estimate.curves, "roundings of radius {:.3g} and more, the smallest at {}"}};
  const auto& [most, text] =
      *std::max_element(shapes.begin(), shapes.end(), [](const auto& p, const auto& q) {
        return p.first->tetrahedra < q.first->tetrahedra;
      });
  if (most->tetrahedra < worth_a_word * estimate.tetrahedra())
    return {};
  return fmt::format("{:.0f} % of them because of ",
                     100.0 * most->tetrahedra / estimate.tetrahedra()) +
         fmt::format(fmt::runtime(text), most->width, coordinates(most->at));
}

double most_tetrahedra(const SolidEstimate& estimate) {
  constexpr double for_small_shapes = 2e5, over_bulk = 10.0;
  return for_small_shapes + over_bulk * (estimate.bulk + estimate.skin);
}

void require_meshable(const SolidEstimate& estimate, const SolidRefinement& wanted) {
  constexpr double most_of_all = 5e6;
  const double most = most_tetrahedra(estimate);
  if (!(estimate.tetrahedra() <= most_of_all))
    throw Error(
        Fault::limit, "",
        fmt::format("tetrahedra of size {:.6g} would be about {:.2g}; at most {:.0e} are made",
                    wanted.size, estimate.tetrahedra(), most_of_all),
        "give a larger size");
  if (estimate.tetrahedra() <= most)
    return;
  throw Error(Fault::limit, "",
              fmt::format("tetrahedra of size {:.6g} would be about {:.2g}, {}; at most {:.2g} are "
                          "made here",
                          wanted.size, estimate.tetrahedra(), reason(estimate), most),
              "pass over small shapes with details = ..., leave them out of the file, or check its "
              "unit");
}

} // namespace billet::geometry
