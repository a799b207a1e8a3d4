#include "mechanics/element_kernel.h"

#include "mechanics/elements/elements.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace billet::mechanics {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Shape functions and their reference gradients at every integration point of an element.
template <class Element> struct PointTable {
  static constexpr int nodes = Element::Shape::nodes;
  static constexpr int dim = Element::Shape::dim;
  static constexpr int points = Element::Rule::points;
  using Gradient = Eigen::Matrix<double, nodes, dim>;

  std::array<Eigen::Matrix<double, nodes, 1>, points> N;
  std::array<Gradient, points> dN;
  std::array<double, points> weight;

  PointTable() {
    for (int g = 0; g < points; ++g) {
      const auto k = static_cast<std::size_t>(g);
      const auto xi = Element::Rule::point(g);
      const auto values = Element::Shape::values(xi);
      const auto gradients = Element::Shape::gradients(xi);
      weight[k] = Element::Rule::weight(g);
      for (int a = 0; a < nodes; ++a) {
        N[k][a] = values[static_cast<std::size_t>(a)];
        for (int i = 0; i < dim; ++i)
          dN[k](a, i) = gradients[static_cast<std::size_t>(a)][static_cast<std::size_t>(i)];
      }
    }
  }
};

template <class Element> const PointTable<Element>& point_table() {
  static const PointTable<Element> table;
  return table;
}

/// Everything one element kernel works with, on the stack.
template <class Element, Analysis analysis> struct Kernel {
  static constexpr int nodes = Element::Shape::nodes;
  static constexpr int dim = Element::Shape::dim;
  static constexpr int points = Element::Rule::points;
  static constexpr int size = nodes * dim;
  /// Strain components xx, yy, zz, xy, (yz, xz); shears are twice the tensor's.
  static constexpr int n_strains = dim == 2 ? 4 : 6;
  static constexpr bool planar = dim == 2;
  static constexpr bool axisymmetric = analysis == Analysis::axisymmetric;

  using Positions = Eigen::Matrix<double, nodes, dim, Eigen::RowMajor>;
  using Square = Eigen::Matrix<double, dim, dim>;
  using Gradient = Eigen::Matrix<double, nodes, dim>;
  using Moduli = Eigen::Matrix<double, n_strains, n_strains>;
  using StrainMatrix = Eigen::Matrix<double, n_strains, size, Eigen::RowMajor>;
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size, Eigen::RowMajor>;
  using Pairs = Eigen::Matrix<double, nodes, nodes, Eigen::RowMajor>;

  std::array<Gradient, points> gradient;                    ///< d N / d x, current
  std::array<Eigen::Matrix<double, nodes, 1>, points> hoop; ///< N / r, current
  std::array<double, points> volume;                        ///< current
  std::array<Mat3, points> b_pred;
  std::array<DeviatoricResponse, points> response;

  /// Volume of point g in a configuration; `J` receives d x / d xi, `r` the radius.
  static double measure(const Positions& x, int g, Square& J, double& r) {
    const auto& table = point_table<Element>();
    const auto k = static_cast<std::size_t>(g);
    J = x.transpose().lazyProduct(table.dN[k]);
    double v = J.determinant() * table.weight[k];
    if constexpr (axisymmetric) {
      r = table.N[k].dot(x.col(0));
      v *= full_turn * r;
    }
    return v;
  }

  /// Gradients, volumes and predictors at all points; false when the element is inverted.
  bool kinematics(const ElementInput& in) {
    const Eigen::Map<const Positions> x(in.x);
    const Eigen::Map<const Positions> x_old(in.x_old);
    const auto& table = point_table<Element>();
    for (int g = 0; g < points; ++g) {
      const auto k = static_cast<std::size_t>(g);
      Square J;
      Square J_old;
      double r = 1.0;
      double r_old = 1.0;
      volume[k] = measure(x, g, J, r);
      const double volume_old = measure(x_old, g, J_old, r_old);
      if (!(volume[k] > 0.0) || !(volume_old > 0.0) || !(r > 0.0))
        return false;
      gradient[k] = table.dN[k].lazyProduct(J.inverse().eval());
      Mat3 f = Mat3::Identity();
      f.template topLeftCorner<dim, dim>().noalias() = J * J_old.inverse();
      if constexpr (axisymmetric) {
        f(2, 2) = r / r_old;
        hoop[k] = table.N[k] / r;
      }
      const Mat3 fb = f * in.old[k].b_e;
      b_pred[k].noalias() = fb * f.transpose();
      b_pred[k] = 0.5 * (b_pred[k] + b_pred[k].transpose()).eval();
    }
    return true;
  }

  /// Strain components of the nodal unknowns at point k.
  StrainMatrix strain_matrix(std::size_t k) const {
    StrainMatrix B = StrainMatrix::Zero();
    const Gradient& d = gradient[k];
    for (int a = 0; a < nodes; ++a) {
      const int c = a * dim;
      B(0, c) = d(a, 0);
      B(1, c + 1) = d(a, 1);
      B(3, c) = d(a, 1);
      B(3, c + 1) = d(a, 0);
      if constexpr (dim == 3) {
        B(2, c + 2) = d(a, 2);
        B(4, c + 1) = d(a, 2);
        B(4, c + 2) = d(a, 1);
        B(5, c) = d(a, 2);
        B(5, c + 2) = d(a, 0);
      } else if constexpr (axisymmetric) {
        B(2, c) = hoop[k][a];
      }
    }
    return B;
  }

  /// Components that turn strains in space into strains in the principal axes.
  static Moduli to_principal(const Mat3& n) {
    Moduli T;
    constexpr std::array<std::array<int, 2>, 6> pair{
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    for (int row = 0; row < n_strains; ++row) {
      const auto [p, q] = pair[static_cast<std::size_t>(row)];
      const double engineering = row < 3 ? 1.0 : 2.0;
      for (int col = 0; col < n_strains; ++col) {
        const auto [i, j] = pair[static_cast<std::size_t>(col)];
        const double both = n(i, p) * n(j, q) + n(j, p) * n(i, q);
        T(row, col) = engineering * 0.5 * both;
      }
    }
    return T;
  }

  /// Deviatoric spatial moduli in space. (M.8)
  static Moduli moduli(const DeviatoricResponse& at) {
    const Moduli T = to_principal(at.predictor.vectors);
    Moduli DT;
    for (int a = 0; a < 3; ++a)
      DT.row(a) = at.normal_moduli(a, 0) * T.row(0) + at.normal_moduli(a, 1) * T.row(1) +
                  at.normal_moduli(a, 2) * T.row(2);
    for (int i = 3; i < n_strains; ++i)
      DT.row(i) = at.shear_moduli[i - 3] * T.row(i);
    return T.transpose().lazyProduct(DT);
  }

  /// Adds `scale` * (I (x) I * trace_part - 2 * unit_part * II) to moduli.
  static void add_pressure(Moduli& D, double trace_part, double unit_part) {
    D.template topLeftCorner<3, 3>().array() += trace_part;
    for (int i = 0; i < n_strains; ++i)
      D(i, i) -= (i < 3 ? 2.0 : 1.0) * unit_part;
  }

  /// Adds the products of stress and gradients at point k, one for each pair of nodes: `G` acts on
  /// each component alike, `hoops` on the radial one only.
  void add_geometric(Pairs& G, Pairs& hoops, std::size_t k, const Mat3& tau) const {
    const Gradient dt = gradient[k].lazyProduct(tau.template topLeftCorner<dim, dim>());
    for (int i = 0; i < dim; ++i)
      for (int a = 0; a < nodes; ++a)
        G.row(a) += dt(a, i) * gradient[k].col(i).transpose();
    if constexpr (axisymmetric)
      for (int a = 0; a < nodes; ++a)
        hoops.row(a) += tau(2, 2) * hoop[k][a] * hoop[k].transpose();
  }

  static void spread(Matrix& K, const Pairs& G, const Pairs& hoops) {
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) {
        for (int i = 0; i < dim; ++i)
          K(a * dim + i, b * dim + i) += G(a, b);
        if constexpr (axisymmetric)
          K(a * dim, b * dim) += hoops(a, b);
      }
  }

  /// Adds B^T DB at point k: every row of B^T has three entries at most, so whole rows of DB are
  /// summed up. `DB` holds dV D B.
  void add_material(Matrix& K, std::size_t k, const StrainMatrix& DB) const {
    const Gradient& d = gradient[k];
    for (int a = 0; a < nodes; ++a) {
      const int r = a * dim;
      if constexpr (dim == 3) {
        K.row(r) += d(a, 0) * DB.row(0) + d(a, 1) * DB.row(3) + d(a, 2) * DB.row(5);
        K.row(r + 1) += d(a, 1) * DB.row(1) + d(a, 0) * DB.row(3) + d(a, 2) * DB.row(4);
        K.row(r + 2) += d(a, 2) * DB.row(2) + d(a, 1) * DB.row(4) + d(a, 0) * DB.row(5);
      } else {
        K.row(r) += d(a, 0) * DB.row(0) + d(a, 1) * DB.row(3);
        if constexpr (axisymmetric)
          K.row(r) += hoop[k][a] * DB.row(2);
        K.row(r + 1) += d(a, 1) * DB.row(1) + d(a, 0) * DB.row(3);
      }
    }
  }

  /// Adds the nodal forces of the stress at point k.
  void add_force(Eigen::Map<Positions>& force, std::size_t k, const Mat3& tau) const {
    force += gradient[k].lazyProduct(tau.template topLeftCorner<dim, dim>());
    if constexpr (axisymmetric)
      force.col(0) += tau(2, 2) * hoop[k];
  }

  /// Nodal coefficients of the divergence at point k.
  Vector divergence(std::size_t k) const {
    Vector d;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        d[a * dim + i] = gradient[k](a, i) + (axisymmetric && i == 0 ? hoop[k][a] : 0.0);
    return d;
  }

  ElementStatus run(const Material& material, const ElementInput& in, ElementOutput& out) {
    if (!kinematics(in))
      return ElementStatus::inverted;
    if (!update(material, b_pred, in.old, planar, in.flow, response))
      return ElementStatus::no_return;
    Eigen::Map<Positions> force(out.force);
    force.setZero();
    Matrix K;
    Pairs G;
    Pairs hoops;
    if (out.tangent != nullptr) {
      K.setZero();
      G.setZero();
      hoops.setZero();
    }
    const double kappa = material.elasticity.bulk();
    const double V0 = std::accumulate(in.volumes.begin(), in.volumes.end(), 0.0);
    const double v = std::accumulate(volume.begin(), volume.end(), 0.0);
    const double theta = v / V0;
    Vector dilatation = Vector::Zero();
    for (std::size_t k = 0; k < points; ++k) {
      const DeviatoricResponse& at = response[k];
      out.trial[k] = at.state;
      out.largest_plastic_increment = std::max(out.largest_plastic_increment, at.plastic_increment);
      const double dV = in.volumes[k];
      // Pressure times J: of the element's mean dilatation, or of the point's own.
      const double p = Element::mean_dilatation ? kappa * std::log(theta) / theta * volume[k] / dV
                                                : kappa * at.log_J;
      const Mat3& n = at.predictor.vectors;
      Mat3 tau = n * at.s.asDiagonal() * n.transpose();
      tau.diagonal().array() += p;
      tau *= dV;
      add_force(force, k, tau);
      if (out.tangent == nullptr)
        continue;
      if constexpr (Element::mean_dilatation)
        dilatation += volume[k] * divergence(k);
      Moduli D = moduli(at);
      add_pressure(D, Element::mean_dilatation ? p : kappa, p);
      D *= dV;
      const StrainMatrix B = strain_matrix(k);
      StrainMatrix DB;
      for (int r = 0; r < n_strains; ++r) {
        DB.row(r) = D(r, 0) * B.row(0);
        for (int s = 1; s < n_strains; ++s)
          DB.row(r) += D(r, s) * B.row(s);
      }
      add_material(K, k, DB);
      add_geometric(G, hoops, k, tau);
    }
    if (out.tangent != nullptr) {
      spread(K, G, hoops);
      if constexpr (Element::mean_dilatation) {
        const double scale = kappa * (1.0 - std::log(theta)) / (theta * theta * V0);
        for (int r = 0; r < size; ++r)
          K.row(r) += scale * dilatation[r] * dilatation.transpose();
      }
      Eigen::Map<Matrix>(out.tangent) = K;
    }
    return ElementStatus::good;
  }
};

template <class Element, Analysis analysis>
ElementStatus run_kernel(const Material& material, const ElementInput& in, ElementOutput& out) {
  Kernel<Element, analysis> kernel;
  return kernel.run(material, in, out);
}

template <class Element> ElementKernel kernel_of(Analysis analysis) {
  if constexpr (Element::Shape::dim == 3)
    return &run_kernel<Element, Analysis::solid>;
  else
    return analysis == Analysis::axisymmetric ? &run_kernel<Element, Analysis::axisymmetric>
                                              : &run_kernel<Element, Analysis::plane_strain>;
}

template <class Element, Analysis analysis>
double volumes_of(const double* x, std::span<double> out) {
  using K = Kernel<Element, analysis>;
  const Eigen::Map<const typename K::Positions> positions(x);
  double smallest = std::numeric_limits<double>::infinity();
  for (int g = 0; g < K::points; ++g) {
    typename K::Square J;
    double r = 1.0;
    const double v = K::measure(positions, g, J, r);
    out[static_cast<std::size_t>(g)] = v;
    smallest = std::min(smallest, v);
  }
  return smallest;
}

} // namespace

ElementKernel element_kernel(ElementKind kind, Analysis analysis) {
  return visit_element(kind, [&](auto element) { return kernel_of<decltype(element)>(analysis); });
}

double point_volumes(ElementKind kind, Analysis analysis, const double* x, std::span<double> out) {
  return visit_element(kind, [&](auto element) {
    using Element = decltype(element);
    if constexpr (Element::Shape::dim == 3)
      return volumes_of<Element, Analysis::solid>(x, out);
    else
      return analysis == Analysis::axisymmetric
                 ? volumes_of<Element, Analysis::axisymmetric>(x, out)
                 : volumes_of<Element, Analysis::plane_strain>(x, out);
  });
}

double pressure_ratio(ElementKind kind,
                      std::span<const double> current,
                      std::span<const double> reference,
                      std::size_t point) {
  const bool mean = visit_element(kind, [](auto e) { return decltype(e)::mean_dilatation; });
  if (!mean)
    return current[point] / reference[point];
  return std::accumulate(current.begin(), current.end(), 0.0) /
         std::accumulate(reference.begin(), reference.end(), 0.0);
}

void strain_gradient(ElementKind kind,
                     Analysis analysis,
                     const double* x,
                     std::size_t point,
                     const Mat3& n,
                     std::span<double> out) {
  visit_element(kind, [&](auto element) {
    using Element = decltype(element);
    constexpr int dim = Element::Shape::dim;
    constexpr int nodes = Element::Shape::nodes;
    const auto& table = point_table<Element>();
    const Eigen::Map<const Eigen::Matrix<double, nodes, dim, Eigen::RowMajor>> positions(x);
    const Eigen::Matrix<double, dim, dim> J = positions.transpose() * table.dN[point];
    Eigen::Map<Eigen::Matrix<double, nodes, dim, Eigen::RowMajor>> gradient(out.data());
    gradient = table.dN[point] * J.inverse() * n.template topLeftCorner<dim, dim>();
    if (analysis == Analysis::axisymmetric)
      gradient.col(0) += n(2, 2) / table.N[point].dot(positions.col(0)) * table.N[point];
  });
}

} // namespace billet::mechanics
