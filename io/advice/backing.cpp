#include "io/advice/backing.h"

#include "geometry/base/box.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace billet::io {

std::vector<Vec3>
nodes_at_tools(const process::Scene& scene, int axis, End end, std::span<const Vec3> nodes) {
  constexpr double near = 0.02; // of the part's size
  constexpr double facing = 0.7;
  const double size = process::body_size(scene.part.mesh);
  const double outward = end == End::high ? 1.0 : -1.0;
  std::vector<Vec3> backed;
  for (const contact::Tool& tool : scene.tools) {
    const geometry::Pose pose = tool.motion.pose(0.0);
    std::vector<Vec3> places;
    for (const Vec3& x : nodes)
      places.push_back(pose.to_tool(x));
    std::vector<geometry::Projection> feet(places.size());
    tool.surface->project(places, size, feet);
    for (std::size_t n = 0; n < feet.size(); ++n)
      if (feet[n].found() && feet[n].gap < near * size &&
          -outward * (pose.rotation * feet[n].normal)[axis] > facing)
        backed.push_back(nodes[n]);
  }
  return backed;
}

bool are_opposite(std::span<const Vec3> a, std::span<const Vec3> b, int axis, double height) {
  constexpr double most_across = 0.5; // of the height
  return std::any_of(a.begin(), a.end(), [&](const Vec3& one) {
    return std::any_of(b.begin(), b.end(), [&](const Vec3& other) {
      Vec3 across_axis = one - other;
      across_axis[axis] = 0.0;
      return across_axis.norm() <= most_across * height;
    });
  });
}

double solid_share(const process::Part& part) {
  const Box box = box_of(part.mesh.points);
  const Vec3 extent = box.high - box.low;
  const std::size_t corners = mechanics::corners_per_face(part.mesh.kind);
  double volume = 0.0;
  for (const mechanics::Face& face : mechanics::boundary_faces(part.mesh)) {
    const auto arm = [&](std::size_t k) {
      return Vec3(part.mesh.points[idx(face.nodes[k])] - box.low);
    };
    if (corners == 2)
      volume += 0.5 * arm(0).cross(arm(1))[2];
    for (std::size_t k = 2; k < corners; ++k)
      volume += arm(0).dot(arm(k - 1).cross(arm(k))) / 6.0;
  }
  return volume / (corners == 2 ? extent[0] * extent[1] : extent.prod());
}

} // namespace billet::io
