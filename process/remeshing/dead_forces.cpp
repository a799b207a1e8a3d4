#include "process/remeshing/dead_forces.h"

#include "geometry/base/box.h"
#include "geometry/triangles/box_tree.h"
#include "geometry/triangles/nearest_in_triangle.h"
#include "mechanics/loads/loads.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/state/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace billet::process {

namespace {

using mechanics::Face;

/// Faces by their straight sides: in the plane from corner to corner, in space as triangles.
class StraightFaces {
public:
  StraightFaces(const mechanics::Mesh& mesh,
                const std::vector<Face>& faces,
                std::span<const double> x) {
    const std::vector<Vec3> points = as_points(x, mesh.dimension());
    const std::size_t corners = mechanics::corners_per_face(mesh.kind);
    std::vector<Box> boxes;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t last = std::min<std::size_t>(corners - 1, 2); last < corners; ++last) {
        const std::vector<Index>& nodes = faces[f].nodes;
        pieces_.push_back(
            {f, {points[idx(nodes[0])], points[idx(nodes[last - 1])], points[idx(nodes[last])]}});
        Box& box = boxes.emplace_back();
        for (const Vec3& corner : pieces_.back().corners)
          box.add(corner);
      }
    tree_ = geometry::BoxTree(boxes);
  }

  [[nodiscard]] std::size_t nearest(const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity();
    std::int32_t found = 0;
    tree_.walk(point, least, [&](std::int32_t i) {
      const double distance2 = (pieces_[idx(i)].nearest(point) - point).squaredNorm();
      if (distance2 < least || (distance2 == least && i < found)) {
        least = distance2;
        found = i;
      }
      return least;
    });
    return pieces_[idx(found)].face;
  }

private:
  struct Piece {
    std::size_t face;
    std::array<Vec3, 3> corners; ///< in the plane the first is there twice

    [[nodiscard]] Vec3 nearest(const Vec3& point) const {
      const auto& [a, b, c] = corners;
      if (a == b) {
        const double along = (point - a).dot(c - a) / (c - a).squaredNorm();
        return a + std::clamp(along, 0.0, 1.0) * (c - a);
      }
      const std::array<double, 3> l = geometry::nearest_in_triangle(a, b, c, point);
      return l[0] * a + l[1] * b + l[2] * c;
    }
  };

  std::vector<Piece> pieces_;
  geometry::BoxTree tree_;
};

/// What forces of a new mesh are multiplied with for the old ones' resultant.
double share_of(const Vec3& old, const Vec3& anew) {
  return anew.isZero(0.0) ? 1.0 : old.dot(anew) / anew.squaredNorm();
}

Vec3 resultant(std::span<const Vec3> tractions, std::span<const double> areas) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f)
    sum += areas[f] * tractions[f];
  return sum;
}

/// The mean traction on a face of a new mesh of tractions on an old one, at its corners and middles
/// drawn towards its centre.
Vec3 mean_traction(const Face& face,
                   const std::vector<Vec3>& points,
                   const StraightFaces& old,
                   std::span<const Vec3> tractions) {
  constexpr double inward = 0.25;
  Vec3 centre = Vec3::Zero(), sum = Vec3::Zero();
  const auto n = static_cast<double>(face.nodes.size());
  for (const Index node : face.nodes)
    centre += points[idx(node)] / n;
  for (const Index node : face.nodes)
    sum += tractions[old.nearest((1.0 - inward) * points[idx(node)] + inward * centre)] / n;
  return sum;
}

void carry_tractions(const Part& old,
                     std::span<const double> x,
                     const DeadForces& before,
                     const RemeshedPart& anew,
                     DeadForces& load) {
  const DeadForceDensity& density = before.density;
  const std::vector<double> made = mechanics::face_areas(old.mesh, old.analysis, density.faces,
                                                         mechanics::node_positions(old.mesh));
  const std::vector<double> now = mechanics::face_areas(old.mesh, old.analysis, density.faces, x);
  std::vector<Vec3> tractions = density.tractions; // per present area
  for (std::size_t f = 0; f < tractions.size(); ++f)
    tractions[f] *= made[f] / now[f];
  const StraightFaces faces(old.mesh, density.faces, x);
  DeadForceDensity& after = load.density;
  after.tractions.clear();
  for (const Face& face : after.faces)
    after.tractions.push_back(mean_traction(face, anew.mesh.points, faces, tractions));
  const std::vector<double> areas = mechanics::face_areas(anew.mesh, old.analysis, after.faces,
                                                          mechanics::node_positions(anew.mesh));
  const double share =
      share_of(resultant(density.tractions, made), resultant(after.tractions, areas));
  for (Vec3& traction : after.tractions)
    traction *= share;
  load.forces = mechanics::traction_forces(anew.mesh, old.analysis, after.faces, after.tractions);
}

Vec3 sum_of(std::span<const double> forces, int dim) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < forces.size(); ++i)
    sum[static_cast<Eigen::Index>(i) % dim] += forces[i];
  return sum;
}

void carry_body_force(const Part& old,
                      const DeadForces& before,
                      const RemeshedPart& anew,
                      DeadForces& load) {
  const int dim = old.mesh.dimension();
  load.forces = mechanics::body_forces(anew.mesh, old.analysis, before.density.body);
  const double share = share_of(sum_of(before.forces, dim), sum_of(load.forces, dim));
  load.density.body = share * before.density.body;
  for (double& force : load.forces)
    force *= share;
}

} // namespace

void carry_dead_forces(const Part& old, std::span<const double> x, RemeshedPart& anew) {
  for (std::size_t l = 0; l < old.loads.size(); ++l) {
    const auto* before = std::get_if<DeadForces>(&old.loads[l]);
    if (before == nullptr)
      continue;
    auto& load = std::get<DeadForces>(anew.loads[l]);
    if (before->density.faces.empty())
      carry_body_force(old, *before, anew, load);
    else
      carry_tractions(old, x, *before, anew, load);
  }
}

} // namespace billet::process
