#include "geometry/repair/self_intersection.h"

#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/box_pairs.h"
#include "geometry/triangles/triangle_pair.h"
#include "geometry/triangles/triangle_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace billet::geometry {

namespace {

// Pairs of near triangles looked at for each triangle: a dozen in a good mesh.
constexpr std::int64_t most_pairs_each = 60;
constexpr std::int64_t most_pairs_at_least = 1000000;

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::int32_t t) {
  const std::array<std::int32_t, 3>& corners = mesh.triangles[static_cast<std::size_t>(t)];
  return {corner(mesh, corners, 0), corner(mesh, corners, 1), corner(mesh, corners, 2)};
}

std::vector<Box> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      boxes[t].add(corner(mesh, mesh.triangles[t], i));
  return boxes;
}

/// Sorts the pairs that meet.
class Census {
public:
  Census(const TriangleMesh& mesh, const MeshParts& parts, double tolerance)
      : mesh_(mesh), parts_(parts), tolerance_(tolerance) {}

  void look_at(std::int32_t i, std::int32_t j) {
    const TrianglePair pair(corners_of(mesh_, i), corners_of(mesh_, j));
    if (!pair.meets())
      return;
    const std::int32_t a = part(i), b = part(j);
    if (a != b && solid(a) && solid(b))
      note(found.overlaps, found.overlap_at, first_overlap_, {i, j}, pair);
    else if (pair.depth() > tolerance_ || pair.back_to_back(tolerance_))
      note(found.cuts, found.cut_at, first_cut_, {i, j}, pair);
    else
      ++found.touches;
  }

  SelfIntersections found;

private:
  using Numbers = std::pair<std::int32_t, std::int32_t>;

  [[nodiscard]] std::int32_t part(std::int32_t t) const {
    return parts_.of_triangle[static_cast<std::size_t>(t)];
  }
  [[nodiscard]] bool solid(std::int32_t number) const {
    const MeshPart& part = parts_.list[static_cast<std::size_t>(number)];
    return part.closed && part.volume > 0.0;
  }
  // The pair of smallest numbers, since the search has no order.
  static void note(std::int64_t& count,
                   std::optional<Vec3>& at,
                   Numbers& first,
                   const Numbers& numbers,
                   const TrianglePair& pair) {
    ++count;
    if (at && first < numbers)
      return;
    first = numbers;
    at = pair.place();
  }

  const TriangleMesh& mesh_;
  const MeshParts& parts_;
  double tolerance_;
  Numbers first_cut_, first_overlap_;
};

} // namespace

SelfIntersections
self_intersections(const TriangleMesh& mesh, const MeshParts& parts, double tolerance) {
  const std::vector<Box> boxes = boxes_of(mesh);
  const std::int64_t limit =
      std::max(most_pairs_at_least, most_pairs_each * static_cast<std::int64_t>(boxes.size()));
  Census census(mesh, parts, tolerance);
  std::int64_t pairs = 0;
  census.found.complete = visit_box_pairs(boxes, [&](std::int32_t i, std::int32_t j) {
    census.look_at(i, j);
    return ++pairs < limit;
  });
  return census.found;
}

std::vector<std::array<std::int32_t, 2>> cutting_pairs(const TriangleMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> found;
  visit_box_pairs(boxes_of(mesh), [&](std::int32_t i, std::int32_t j) {
    const TrianglePair pair(corners_of(mesh, i), corners_of(mesh, j));
    if (pair.meets() && (pair.depth() > 0.0 || pair.back_to_back(0.0)))
      found.push_back({i, j});
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Complaint> complaints(const SelfIntersections& found, const std::string& place) {
  if (found.cuts == 0)
    return {};
  return {{place,
           fmt::format("{} pairs of triangles cut each other or lie back to back, the first near "
                       "{}: what is inside is ambiguous there",
                       found.cuts, coordinates(*found.cut_at)),
           "unite the bodies in the CAD system, or remove the folded or inner faces"}};
}

} // namespace billet::geometry
