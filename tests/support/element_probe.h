// One element by itself: forces and tangent at any nodal positions, with its history.

#pragma once

#include "mechanics/bulk/element_kernel.h"
#include "mechanics/elements/elements.h"
#include "mechanics/mesh/mesh_edges.h"
#include "tests/support/tensors.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace billet::support {

struct ElementCase {
  mechanics::ElementKind kind;
  mechanics::Analysis analysis;

  [[nodiscard]] int dim() const { return mechanics::dimension(kind); }
  [[nodiscard]] bool planar() const { return dim() == 2; }
  [[nodiscard]] bool simplex() const { return mechanics::is_simplex(kind); }
  [[nodiscard]] std::string name() const {
    constexpr std::array suffix{"plane strain", "axisymmetric", "solid"};
    return std::string(mechanics::name(kind)) + " " + suffix[static_cast<std::size_t>(analysis)];
  }
};

/// Every element in every analysis it serves.
inline constexpr std::array every_element{
    ElementCase{mechanics::ElementKind::quad4, mechanics::Analysis::plane_strain},
    ElementCase{mechanics::ElementKind::quad8, mechanics::Analysis::plane_strain},
    ElementCase{mechanics::ElementKind::quad4, mechanics::Analysis::axisymmetric},
    ElementCase{mechanics::ElementKind::quad8, mechanics::Analysis::axisymmetric},
    ElementCase{mechanics::ElementKind::hex8, mechanics::Analysis::solid},
    ElementCase{mechanics::ElementKind::hex20, mechanics::Analysis::solid},
    ElementCase{mechanics::ElementKind::tri6, mechanics::Analysis::plane_strain},
    ElementCase{mechanics::ElementKind::tri6, mechanics::Analysis::axisymmetric},
    ElementCase{mechanics::ElementKind::tet4, mechanics::Analysis::solid},
    ElementCase{mechanics::ElementKind::tet10, mechanics::Analysis::solid},
};

/// Nodes of an element of size 2, at radii 2 to 4, each moved at random by up to `shift`; a simplex
/// has its first corner in the lowest corner of the block.
inline std::vector<double> distorted_nodes(const ElementCase& element, double shift) {
  Random random(7);
  std::vector<double> x;
  mechanics::visit_element(element.kind, [&](auto e) {
    for (const auto& node : decltype(e)::Shape::corners)
      for (std::size_t i = 0; i < node.size(); ++i)
        x.push_back((element.simplex() ? 2.0 * node[i] - 1.0 : node[i]) + (i == 0 ? 3.0 : 0.0) +
                    random.number(-shift, shift));
  });
  return x;
}

/// Positions F X + d of nodes; shapes (nodes, dim).
inline std::vector<double>
moved(const std::vector<double>& X, int dim, const Mat3& F, const Vec3& d = Vec3::Zero()) {
  std::vector<double> x(X.size());
  for (std::size_t a = 0; a < X.size(); a += static_cast<std::size_t>(dim)) {
    Vec3 p = Vec3::Zero();
    for (int i = 0; i < dim; ++i)
      p[i] = X[a + static_cast<std::size_t>(i)];
    p = (F * p + d).eval();
    for (int i = 0; i < dim; ++i)
      x[a + static_cast<std::size_t>(i)] = p[i];
  }
  return x;
}

class ElementProbe {
public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param dt  length of every increment [s]
  ElementProbe(const ElementCase& element,
               mechanics::Material material,
               std::vector<double> X,
               double dt = 0.01)
      : kernel_(mechanics::element_kernel(element.kind, element.analysis)),
        material_(std::move(material)), dt_(dt), x_(std::move(X)),
        states_(static_cast<std::size_t>(mechanics::points_per_element(element.kind))),
        trial_(states_), volumes_(states_.size()), force_(size()), tangent_(size(), size()),
        nodes_(mechanics::nodes_per_element(element.kind)) {
    mechanics::point_volumes(element.kind, element.analysis, x_.data(), volumes_);
    for (mechanics::Index a = 0; a < nodes_; ++a)
      for (mechanics::Index b = 0; b < nodes_; ++b)
        blocks_.push_back(b);
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(x_.size()); }

  /// What its kernel is given and gives, for elements side by side.
  [[nodiscard]] mechanics::ElementInput input(const std::vector<double>& x) const {
    return {x_.data(), x.data(), volumes_, states_, dt_};
  }
  [[nodiscard]] mechanics::ElementOutput output(mechanics::BlockPlaces& places) {
    tangent_.setZero();
    places = tangent_places();
    return {force_.data(), &places, trial_, 0.0, {}};
  }
  [[nodiscard]] mechanics::ElementKernel kernel() const { return kernel_; }

  /// Evaluates forces, tangent and trial states at nodal positions.
  mechanics::ElementStatus evaluate(const std::vector<double>& x) {
    mechanics::BlockPlaces places{};
    mechanics::ElementOutput out = output(places);
    const mechanics::ElementInput in = input(x);
    const auto status = kernel_(material_, {&in, 1}, {&out, 1});
    plastic_increment_ = out.largest_plastic_increment;
    return status;
  }
  /// Evaluates and keeps the trial states.
  mechanics::ElementStatus commit(const std::vector<double>& x) {
    const auto status = evaluate(x);
    states_ = trial_;
    x_ = x;
    return status;
  }

  [[nodiscard]] const std::vector<double>& x() const { return x_; }
  [[nodiscard]] const Eigen::VectorXd& force() const { return force_; }
  [[nodiscard]] const Matrix& tangent() const { return tangent_; }
  [[nodiscard]] const std::vector<mechanics::PointState>& states() const { return states_; }
  [[nodiscard]] const std::vector<mechanics::PointState>& trial() const { return trial_; }
  [[nodiscard]] const std::vector<double>& volumes() const { return volumes_; }
  [[nodiscard]] double plastic_increment() const { return plastic_increment_; }

private:
  [[nodiscard]] mechanics::BlockPlaces tangent_places() {
    mechanics::BlockPlaces places{};
    for (mechanics::Index a = 0; a < nodes_; ++a) {
      places.rows[static_cast<std::size_t>(a)] = tangent_.data() + size() / nodes_ * a * size();
      places.apart[static_cast<std::size_t>(a)] = x_.size();
    }
    places.blocks = blocks_.data();
    return places;
  }

  mechanics::ElementKernel kernel_;
  mechanics::Material material_;
  double dt_;
  std::vector<double> x_;
  std::vector<mechanics::PointState> states_;
  std::vector<mechanics::PointState> trial_;
  std::vector<double> volumes_;
  Eigen::VectorXd force_;
  Matrix tangent_;
  mechanics::Index nodes_;
  std::vector<mechanics::Index> blocks_; ///< for each node all, in their order
  double plastic_increment_ = 0.0;
};

} // namespace billet::support
