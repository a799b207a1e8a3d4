#include "process/scene.h"

#include "geometry/base/box.h"

#include <Eigen/Dense>

#include <algorithm>

namespace billet::process {

namespace {

/// Rigid motions of an analysis as velocities at a point, one a column.
Eigen::Matrix<double, 3, Eigen::Dynamic> rigid_motions(mechanics::Analysis analysis,
                                                       const Vec3& p) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> modes;
  switch (analysis) {
  case mechanics::Analysis::axisymmetric:
    modes = Vec3::UnitY();
    break;
  case mechanics::Analysis::plane_strain:
    modes.resize(3, 3);
    modes << Vec3::UnitX(), Vec3::UnitY(), Vec3(-p[1], p[0], 0.0);
    break;
  case mechanics::Analysis::solid:
    modes.resize(3, 6);
    modes << Mat3::Identity(), Vec3(0.0, -p[2], p[1]), Vec3(p[2], 0.0, -p[0]),
        Vec3(-p[1], p[0], 0.0);
    break;
  }
  return modes;
}

} // namespace

int free_rigid_motions(const Scene& scene) {
  const Box box = box_of(scene.mesh.points);
  const Vec3 centre = 0.5 * (box.low + box.high);
  const auto n = rigid_motions(scene.analysis, Vec3::Zero()).cols();
  // Gram matrix of the motions at the supported unknowns: its rank is the number of motions held.
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  for (const Support& support : scene.supports)
    for (const Index node : support.nodes) {
      const Vec3 p = (scene.mesh.points[static_cast<std::size_t>(node)] - centre) / box.size();
      const Eigen::RowVectorXd row = rigid_motions(scene.analysis, p).row(support.component);
      gram += row.transpose() * row;
    }
  Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
  lu.setThreshold(1e-10);
  return static_cast<int>(n - (gram.isZero(0.0) ? 0 : lu.rank()));
}

double body_size(const mechanics::Mesh& mesh) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : mesh.points)
    middle += point / static_cast<double>(mesh.points.size());
  double farthest = 0.0;
  for (const Vec3& point : mesh.points)
    farthest = std::max(farthest, (point - middle).norm());
  return 2.0 * farthest;
}

} // namespace billet::process
