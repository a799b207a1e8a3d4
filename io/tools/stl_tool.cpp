#include "io/tools/stl_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace billet::io {

namespace {

struct Soup {
  geometry::TriangleMesh mesh;
  double largest = 0.0; ///< coordinate
  Vec3 largest_at = Vec3::Zero();
  double diagonal = 0.0;
};

Soup soup_of(const FacetFile& file, double scale) {
  Soup soup;
  Box box;
  soup.mesh.points.reserve(3 * file.facets.size());
  soup.mesh.triangles.reserve(file.facets.size());
  for (const std::array<Vec3, 3>& facet : file.facets) {
    const auto first = static_cast<std::int32_t>(soup.mesh.points.size());
    soup.mesh.triangles.push_back({first, first + 1, first + 2});
    for (const Vec3& corner : facet) {
      soup.mesh.points.emplace_back(scale * corner);
      box.add(soup.mesh.points.back());
      const double size = soup.mesh.points.back().cwiseAbs().maxCoeff();
      if (size > soup.largest) {
        soup.largest = size;
        soup.largest_at = soup.mesh.points.back();
      }
    }
  }
  soup.diagonal = box.size();
  return soup;
}

} // namespace

StlTool examine(const FacetFile& file, const StlUse& use) {
  const std::string place = file.path.string();
  Soup soup = soup_of(file, use.scale);
  StlTool tool;
  tool.mesh = std::move(soup.mesh);
  const double tolerance = geometry::default_repair_tolerance * soup.diagonal;
  tool.precision = static_cast<double>(std::numeric_limits<float>::epsilon()) * soup.largest;
  // A triangle flatter than the single precision of the file is flat.
  geometry::Repaired repaired =
      geometry::repair(tool.mesh, tolerance, std::min(tool.precision, tolerance));
  if (use.flip) {
    tool.mesh = geometry::flipped(std::move(tool.mesh));
    for (geometry::MeshPart& part : repaired.parts.list)
      part.volume = -part.volume;
  }
  tool.repairs = repaired.done;
  tool.parts = std::move(repaired.parts);
  tool.health = geometry::health(tool.mesh, use.feature_angle);
  tool.complaints = geometry::complaints(tool.health, place);
  if (tool.mesh.triangles.empty())
    tool.complaints = {{place,
                        fmt::format("no facet is larger than the precision of coordinates like {}",
                                    geometry::coordinates(soup.largest_at)),
                        "remove stray facets; move the surface to the origin"}};
  if (tool.complaints.empty()) {
    tool.intersections = geometry::self_intersections(tool.mesh, tool.parts, tolerance);
    tool.complaints = geometry::complaints(tool.intersections, place);
  }
  // A file cut short leaves a hole.
  if (!tool.health.closed())
    tool.complaints.insert(tool.complaints.begin(), file.doubts.begin(), file.doubts.end());
  return tool;
}

StlTool tool_mesh(const FacetFile& file, const StlUse& use) {
  StlTool tool = examine(file, use);
  if (!tool.complaints.empty())
    throw Error(Fault::geometry, std::move(tool.complaints));
  return tool;
}

} // namespace billet::io
