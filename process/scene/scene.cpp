#include "process/scene/scene.h"

#include "geometry/base/box.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

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

/// Gram matrix of the motions at the supported unknowns: its rank is the number of motions held.
Eigen::MatrixXd gram_of_supports(const Part& part) {
  const Box box = box_of(part.mesh.points);
  const Vec3 centre = 0.5 * (box.low + box.high);
  const auto n = rigid_motions(part.analysis, Vec3::Zero()).cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  for (const Support& support : part.supports)
    for (const Index node : support.nodes) {
      const Vec3 p = (part.mesh.points[static_cast<std::size_t>(node)] - centre) / box.size();
      const Eigen::RowVectorXd row = rigid_motions(part.analysis, p).row(support.component);
      gram += row.transpose() * row;
    }
  return gram;
}

/// The motions that are not held, one a column; shape (n_motions, n_free).
Eigen::MatrixXd free_space(const Eigen::MatrixXd& gram) {
  if (gram.isZero(0.0))
    return Eigen::MatrixXd::Identity(gram.rows(), gram.cols());
  Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
  lu.setThreshold(1e-10);
  return lu.rank() == gram.cols() ? Eigen::MatrixXd(gram.rows(), 0) : Eigen::MatrixXd(lu.kernel());
}

/// Whether a vector is a sum of columns.
bool in_span(const Eigen::MatrixXd& columns, const Eigen::VectorXd& vector) {
  constexpr double rounding = 1e-6; // of a unit vector
  if (columns.cols() == 0 || columns.rows() == 0)
    return false;
  const Eigen::VectorXd nearest = columns * columns.completeOrthogonalDecomposition().solve(vector);
  return (nearest - vector).norm() < rounding;
}

} // namespace

const std::vector<mechanics::Face>& faces_of(const LoadSpec& load) {
  const auto* pressure = std::get_if<PressureOn>(&load);
  return pressure != nullptr ? pressure->faces : std::get<DeadForces>(load).density.faces;
}

std::vector<mechanics::Face>& faces_of(LoadSpec& load) {
  auto* pressure = std::get_if<PressureOn>(&load);
  return pressure != nullptr ? pressure->faces : std::get<DeadForces>(load).density.faces;
}

int free_rigid_motions(const Part& part) {
  return static_cast<int>(free_space(gram_of_supports(part)).cols());
}

FreeMotions free_motions(const Part& part) {
  const Eigen::MatrixXd space = free_space(gram_of_supports(part));
  const auto n = space.rows();
  FreeMotions free;
  const auto shift = [&](Eigen::Index column) {
    return in_span(space, Eigen::VectorXd::Unit(n, column));
  };
  if (part.analysis == mechanics::Analysis::axisymmetric) {
    free.along[1] = shift(0);
    return free;
  }
  const Eigen::Index dim = part.mesh.dimension();
  for (Eigen::Index i = 0; i < dim; ++i)
    free.along[static_cast<std::size_t>(i)] = shift(i);
  // A turn about some line: the part of a free motion that turns, whatever shift goes with it.
  const Eigen::MatrixXd turns = space.bottomRows(n - dim);
  for (Eigen::Index i = 0; i < n - dim; ++i)
    free.about[dim == 2 ? 2 : static_cast<std::size_t>(i)] =
        in_span(turns, Eigen::VectorXd::Unit(n - dim, i));
  return free;
}

double body_size(const mechanics::Mesh& mesh) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : mesh.points)
    middle += point;
  middle /= static_cast<double>(mesh.points.size());
  double farthest = 0.0;
  for (const Vec3& point : mesh.points)
    farthest = std::max(farthest, (point - middle).squaredNorm());
  return 2.0 * std::sqrt(farthest);
}

} // namespace billet::process
