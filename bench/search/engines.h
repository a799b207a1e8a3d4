// The other engines: plain CGAL and FCL, asked for the distance from points to the same triangles.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/triangles/triangle_mesh.h"

#include <memory>
#include <span>

namespace billet::bench {

/// A search tree over triangles.
class Engine {
public:
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Unsigned distance of each point. [mm]
  ///
  /// @param points, out  shape (n)
  virtual void distances(std::span<const Vec3> points, std::span<double> out) = 0;

protected:
  Engine() = default;
};

/// CGAL's AABB tree, `closest_point` with its own kd-tree of hints.
[[nodiscard]] std::unique_ptr<Engine> make_cgal(const geometry::TriangleMesh& mesh);

/// FCL's `distance` between a tree of OBB-RSS and a sphere too small to matter.
[[nodiscard]] std::unique_ptr<Engine> make_fcl(const geometry::TriangleMesh& mesh);

} // namespace billet::bench
