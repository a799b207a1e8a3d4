#include "process/tools/part_depth.h"

#include "geometry/triangles/nearest_in_triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace billet::process {

namespace {

/// Square of the distance of x from a segment [mm^2].
double distance2_from_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 way = b - a;
  const double length2 = way.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((x - a).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (a + share * way - x).squaredNorm();
}

double distance2_from_facet(const geometry::DisplayMesh& mesh, std::size_t facet, const Vec3& x) {
  const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
  if (mesh.triangles.empty()) {
    const auto& [a, b] = mesh.lines[facet];
    return distance2_from_segment(point(a), point(b), x);
  }
  const auto& [a, b, c] = mesh.triangles[facet];
  const auto share = geometry::nearest_in_triangle(point(a), point(b), point(c), x);
  return (share[0] * point(a) + share[1] * point(b) + share[2] * point(c) - x).squaredNorm();
}

std::size_t n_facets(const geometry::DisplayMesh& mesh) {
  return mesh.triangles.empty() ? mesh.lines.size() : mesh.triangles.size();
}

Box box_of_facet(const geometry::DisplayMesh& mesh, std::size_t facet) {
  Box box;
  const auto add = [&](std::int32_t i) { box.add(mesh.points[static_cast<std::size_t>(i)]); };
  if (mesh.triangles.empty())
    for (const std::int32_t i : mesh.lines[facet])
      add(i);
  else
    for (const std::int32_t i : mesh.triangles[facet])
      add(i);
  return box;
}

} // namespace

Box box_of_nodes(const mechanics::Mesh& mesh, std::span<const double> x) {
  Box box;
  const int dim = mesh.dimension();
  for (Index node = 0; node < mesh.n_points(); ++node)
    box.add(mechanics::node_position(x, dim, node));
  return box;
}

PartDepth::PartDepth(const mechanics::Mesh& mesh,
                     const contact::ContactSurface& surface,
                     std::span<const double> x)
    : surface_(&surface), x_(x), locator_(mesh, x), bounds_(box_of_nodes(mesh, x)) {
  constexpr double of_size = 1e-9;
  rounding_ = of_size * bounds_.size();
}

void PartDepth::draw() {
  facets_ = Facets{drawn(*surface_, x_), geometry::BoxTree()};
  std::vector<Box> boxes(n_facets(facets_->drawing.mesh));
  for (std::size_t i = 0; i < boxes.size(); ++i)
    boxes[i] = box_of_facet(facets_->drawing.mesh, i);
  facets_->tree = geometry::BoxTree(boxes);
}

PlaceInPart PartDepth::nearest_face(const Vec3& point, double reach) {
  if (!facets_)
    draw();
  const geometry::DisplayMesh& mesh = facets_->drawing.mesh;
  double nearest2 = reach * reach;
  std::int32_t nearest = -1;
  facets_->tree.walk(point, nearest2, [&](std::int32_t facet) {
    const double distance2 = distance2_from_facet(mesh, static_cast<std::size_t>(facet), point);
    if (distance2 < nearest2) {
      nearest2 = distance2;
      nearest = facet;
    }
    return nearest2;
  });
  if (nearest < 0 || surface_->n_faces() == 0)
    return {-std::numeric_limits<double>::infinity(), -1};
  const auto a_face = static_cast<std::int32_t>(n_facets(mesh)) / surface_->n_faces();
  return {std::sqrt(nearest2), nearest / a_face};
}

// Faces are cheaper to ask than elements, and most tools are outside.
PlaceInPart PartDepth::at(const Vec3& point, double reach) {
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const bool outside = locator_.locate(point, rounding_).element < 0;
  PlaceInPart place = nearest_face(point, outside ? std::max(rounding_, reach) : anywhere);
  if (outside)
    place.depth = -std::abs(place.depth);
  return place;
}

} // namespace billet::process
