#include "mechanics/element_kernel.h"

#include "mechanics/elements/elements.h"
#include "mechanics/lanes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace billet::mechanics {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// Shape functions and their reference gradients at every integration point of an element, node by
/// node and point by point.
template <class Element> struct PointTable {
  static constexpr int nodes = Element::Shape::nodes;
  static constexpr int dim = Element::Shape::dim;
  static constexpr int points = Element::Rule::points;

  std::array<Lanes<nodes>, points> N;
  std::array<std::array<Lanes<nodes>, dim>, points> dN; ///< by each reference coordinate
  std::array<Lanes<points>, nodes> N_at_points;
  std::array<std::array<Lanes<points>, dim>, nodes> dN_at_points;
  Lanes<points> weight;

  PointTable() {
    for (int g = 0; g < points; ++g) {
      const auto xi = Element::Rule::point(g);
      const auto values = Element::Shape::values(xi);
      const auto gradients = Element::Shape::gradients(xi);
      weight.set(g, Element::Rule::weight(g));
      for (int a = 0; a < nodes; ++a) {
        N[idx(g)].set(a, values[idx(a)]);
        N_at_points[idx(a)].set(g, values[idx(a)]);
        for (std::size_t i = 0; i < dim; ++i) {
          dN[idx(g)][i].set(a, gradients[idx(a)][i]);
          dN_at_points[idx(a)][i].set(g, gradients[idx(a)][i]);
        }
      }
    }
  }
};

template <class Element> const PointTable<Element>& point_table() {
  static const PointTable<Element> table;
  return table;
}

/// A square matrix at several points.
template <int dim, int points> using SquareLanes = std::array<std::array<Lanes<points>, dim>, dim>;

template <int points> Lanes<points> determinant(const SquareLanes<2, points>& A) {
  return A[0][0] * A[1][1] - A[0][1] * A[1][0];
}

/// The matrix of cofactors' transpose: the inverse times the determinant.
template <int points> SquareLanes<2, points> adjugate(const SquareLanes<2, points>& A) {
  return {{{A[1][1], -1.0 * A[0][1]}, {-1.0 * A[1][0], A[0][0]}}};
}

template <int points> SquareLanes<3, points> adjugate(const SquareLanes<3, points>& A) {
  SquareLanes<3, points> C;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t p = (j + 1) % 3;
      const std::size_t q = (j + 2) % 3;
      const std::size_t r = (i + 1) % 3;
      const std::size_t s = (i + 2) % 3;
      C[i][j] = A[p][r] * A[q][s] - A[p][s] * A[q][r];
    }
  return C;
}

template <int points> Lanes<points> determinant(const SquareLanes<3, points>& A) {
  Lanes<points> sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum += A[0][i] * (A[1][j] * A[2][k] - A[1][k] * A[2][j]);
  }
  return sum;
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
  /// Derivatives that strains are made of: by each coordinate and, about an axis, N / r.
  static constexpr int slopes = axisymmetric ? dim + 1 : dim;

  using NodalRow = Lanes<nodes>;
  using AtPoints = Lanes<points>;
  using Square = SquareLanes<dim, points>;
  using Slopes = std::array<NodalRow, slopes>;
  using Factor = std::array<std::array<double, slopes>, slopes>;
  using Vector = std::array<NodalRow, dim>; ///< of all nodes, component by component
  /// Moduli of a batch of points, on and above the diagonal.
  using Moduli = std::array<std::array<PointLanes, n_strains>, n_strains>;
  static constexpr std::size_t batches =
      static_cast<std::size_t>((points + points_at_once - 1) / points_at_once);
  using Pairs = std::array<NodalRow, nodes>;
  /// Tangent of displacement i by displacement j, i <= j, for each pair of nodes.
  using Blocks = std::array<Pairs, static_cast<std::size_t>(dim*(dim + 1) / 2)>;
  struct Components {
    int i;
    int j;
  };
  static constexpr std::array<Components, std::tuple_size_v<Blocks>> components = [] {
    std::array<Components, std::tuple_size_v<Blocks>> all{};
    std::size_t n = 0;
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        all[n++] = {i, j};
    return all;
  }();

  std::array<Slopes, points> slope; ///< d N / d x and N / r, current
  AtPoints volume;                  ///< current
  std::array<TensorLanes, batches> b_pred;
  std::array<DeviatoricResponse, batches> response;

  /// Volumes of the points in a configuration; `J` receives d x / d xi, `r` the radius.
  static AtPoints measure(const double* x, Square& J, AtPoints& r) {
    const auto& table = point_table<Element>();
    J = {};
    for (int a = 0; a < nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j)
          J[i][j] += x[idx(a * dim) + i] * table.dN_at_points[idx(a)][j];
    AtPoints v = determinant<points>(J) * table.weight;
    if constexpr (axisymmetric) {
      r = {};
      for (int a = 0; a < nodes; ++a)
        r += x[a * dim] * table.N_at_points[idx(a)];
      v = full_turn * (v * r);
    }
    return v;
  }

  /// Gradients, volumes and predictors at all points; false when the element is inverted.
  bool kinematics(const ElementInput& in) {
    Square J;
    Square J_old;
    AtPoints r;
    AtPoints r_old;
    volume = measure(in.x, J, r);
    const AtPoints volume_old = measure(in.x_old, J_old, r_old);
    for (int g = 0; g < points; ++g)
      if (!(volume[g] > 0.0) || !(volume_old[g] > 0.0) || (axisymmetric && !(r[g] > 0.0)))
        return false;
    set_slopes(J, r);
    set_predictors(J, J_old, r / r_old, in.old);
    return true;
  }

  void set_slopes(const Square& J, [[maybe_unused]] const AtPoints& r) {
    const auto& table = point_table<Element>();
    const Square C = adjugate<points>(J);
    const AtPoints per_volume = AtPoints::constant(1.0) / determinant<points>(J);
    for (std::size_t j = 0; j < dim; ++j)
      for (std::size_t i = 0; i < dim; ++i) {
        const AtPoints inverse = C[i][j] * per_volume;
        for (int g = 0; g < points; ++g) {
          const NodalRow part = inverse[g] * table.dN[idx(g)][i];
          slope[idx(g)][j] = i == 0 ? part : slope[idx(g)][j] + part;
        }
      }
    if constexpr (axisymmetric)
      for (int g = 0; g < points; ++g)
        slope[idx(g)][dim] = (1.0 / r[g]) * table.N[idx(g)];
  }

  /// b_e,pred = f b_e f^T with the deformation gradient f of the increment. (M.4)
  void set_predictors(const Square& J,
                      const Square& J_old,
                      [[maybe_unused]] const AtPoints& radii,
                      std::span<const PointState> old) {
    const Square C = adjugate<points>(J_old);
    const AtPoints per_volume = AtPoints::constant(1.0) / determinant<points>(J_old);
    SquareLanes<3, points> f{};
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) {
        for (std::size_t l = 0; l < dim; ++l)
          f[i][j] += J[i][l] * C[l][j];
        f[i][j] = f[i][j] * per_volume;
      }
    if constexpr (dim == 2)
      f[2][2] = axisymmetric ? radii : AtPoints::constant(1.0);
    SquareLanes<3, points> b{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        if (coupled(i, j))
          b[i][j] = b[j][i] = AtPoints::of(
              [&](int g) { return old[idx(g)].b_e(static_cast<int>(i), static_cast<int>(j)); });
    const SquareLanes<3, points> fb = product(f, b, false);
    const SquareLanes<3, points> fbf = product(fb, f, true);
    for (std::size_t k = 0; k < batches; ++k)
      for (std::size_t c = 0; c < tensor_components.size(); ++c) {
        const auto [i, j] = tensor_components[c];
        b_pred[k][c] = batch(fbf[i][j], k);
      }
  }

  /// Numbers of the points of a batch; beyond the last point its own once more.
  static PointLanes batch(const AtPoints& all, std::size_t k) {
    if constexpr (points == points_at_once)
      return all;
    else
      return PointLanes::of([&](int l) {
        return all[std::min(static_cast<int>(k) * points_at_once + l, points - 1)];
      });
  }

  /// Whether a tensor has more than a zero there: none couples a plane with what is across it.
  static constexpr bool coupled(std::size_t i, std::size_t j) {
    return !planar || (i == 2) == (j == 2);
  }

  /// A B, or A B^T.
  static SquareLanes<3, points>
  product(const SquareLanes<3, points>& A, const SquareLanes<3, points>& B, bool transposed) {
    SquareLanes<3, points> AB{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t l = 0; l < 3; ++l)
          if (coupled(i, l) && coupled(l, j))
            AB[i][j] += A[i][l] * (transposed ? B[j][l] : B[l][j]);
    return AB;
  }

  /// Deviatoric spatial moduli in space. (M.8)
  static Moduli moduli(const DeviatoricResponse& at) {
    Moduli T; // turns strains in space into strains in the principal axes
    for (std::size_t row = 0; row < n_strains; ++row)
      for (std::size_t s = 0; s < n_strains; ++s) {
        const auto [p, q] = tensor_components[row];
        const auto [i, j] = tensor_components[s];
        T[row][s] = row < 3 ? at.axes[i][p] * at.axes[j][p]
                            : at.axes[i][p] * at.axes[j][q] + at.axes[i][q] * at.axes[j][p];
      }
    // In the plane strain components follow the same rule: 2 is the one across it.
    Moduli DT{};
    for (std::size_t s = 0; s < n_strains; ++s) {
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          if (coupled(b, s))
            DT[a][s] += at.normal_moduli[a][b] * T[b][s];
      for (std::size_t i = 3; i < n_strains; ++i)
        if (coupled(i, s))
          DT[i][s] = at.shear_moduli[i - 3] * T[i][s];
    }
    Moduli D{};
    for (std::size_t s = 0; s < n_strains; ++s)
      for (std::size_t t = s; t < n_strains; ++t)
        for (std::size_t p = 0; p < n_strains; ++p)
          if (coupled(p, s))
            D[s][t] += T[p][s] * DT[p][t];
    return D;
  }

  /// Moduli of one point: the deviator's and those of the pressure,
  /// `trace` I (x) I - 2 `unit` II.
  struct PointModuli {
    const Moduli* deviatoric;
    int point; ///< in its batch
    double trace;
    double unit;

    template <int s, int t> [[nodiscard]] double at() const {
      double value = (*deviatoric)[std::min(s, t)][std::max(s, t)][point];
      if constexpr (s < 3 && t < 3)
        value += trace;
      if constexpr (s == t)
        value -= s < 3 ? 2.0 * unit : unit;
      return value;
    }
  };

  /// Strain component of the gradient of displacement i in direction l; none: it has none.
  static constexpr int strain_of(int i, int l) {
    constexpr int none = -1;
    constexpr std::array<std::array<int, 3>, 3> component{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    if (l == dim) // the hoop's
      return i == 0 ? 2 : none;
    return component[idx(i)][idx(l)];
  }

  /// Derivative of the stress that works on displacement i by the gradient of displacement j, with
  /// the stress itself that turns with the gradients. (M.3), (M.8)
  template <int i, int j>
  static Factor stiffness(const PointModuli& D, const Mat3& tau, double volume_at) {
    Factor A{};
    const auto set = [&]<int l, int m>() {
      constexpr int s = strain_of(i, l);
      constexpr int t = strain_of(j, m);
      if constexpr (s >= 0 && t >= 0)
        A[l][m] = volume_at * D.template at<s, t>() + (i == j ? tau(l, m) : 0.0);
    };
    [&]<int... k>(std::integer_sequence<int, k...>) {
      (set.template operator()<k / slopes, k % slopes>(), ...);
    }
    (std::make_integer_sequence<int, slopes * slopes>());
    return A;
  }

  /// Adds S A S^T.
  static void add_product(Pairs& K, const Slopes& S, const Factor& A) {
    Slopes SA{};
    for (std::size_t m = 0; m < slopes; ++m)
      for (std::size_t l = 0; l < slopes; ++l)
        SA[m] += A[l][m] * S[l];
    for (int a = 0; a < nodes; ++a)
      for (std::size_t m = 0; m < slopes; ++m)
        K[idx(a)] += SA[m][a] * S[m];
  }

  /// Adds what a point gives to the tangent.
  ///
  /// @param tau  Kirchhoff stress times the reference volume
  static void add_stiffness(Blocks& K,
                            const Slopes& S,
                            const PointModuli& D,
                            const Mat3& tau,
                            double volume_at) {
    [&]<std::size_t... block>(std::index_sequence<block...>) {
      (add_product(K[block], S,
                   stiffness<components[block].i, components[block].j>(D, tau, volume_at)),
       ...);
    }
    (std::make_index_sequence<components.size()>());
  }

  /// Adds scale d (x) d.
  static void add_dyad(Blocks& K, double scale, const Vector& d) {
    for (std::size_t block = 0; block < K.size(); ++block) {
      const auto [i, j] = components[block];
      for (int a = 0; a < nodes; ++a)
        K[block][idx(a)] += (scale * d[idx(i)][a]) * d[idx(j)];
    }
  }

  /// Adds the blocks, of which those below the diagonal follow by symmetry, node by node.
  static void add_to(const BlockPlaces& places, const Blocks& K) {
    const Index* block = places.blocks;
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) {
        double* at = places.rows[idx(a)] + idx(*block++) * dim;
        for (std::size_t k = 0; k < K.size(); ++k) {
          const auto [i, j] = components[k];
          at[idx(i) * places.apart[idx(a)] + idx(j)] += K[k][idx(a)][b];
          if (i != j)
            at[idx(j) * places.apart[idx(a)] + idx(i)] += K[k][idx(b)][a];
        }
      }
  }

  /// Kirchhoff stress of a point of a batch.
  static Mat3 stress(const TensorLanes& deviator, double p, int point) {
    Mat3 tau;
    for (std::size_t k = 0; k < deviator.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(tensor_components[k][0]);
      const auto j = static_cast<Eigen::Index>(tensor_components[k][1]);
      tau(i, j) = tau(j, i) = deviator[k][point] + (i == j ? p : 0.0);
    }
    return tau;
  }

  /// Adds the nodal forces of the stress at a point.
  static void add_force(Vector& force, const Slopes& S, const Mat3& tau) {
    for (int i = 0; i < dim; ++i)
      for (int l = 0; l < dim; ++l)
        force[idx(i)] += tau(l, i) * S[idx(l)];
    if constexpr (axisymmetric)
      force[0] += tau(2, 2) * S[dim];
  }

  /// Adds `scale` times the nodal coefficients of the divergence at a point.
  static void add_divergence(Vector& sum, const Slopes& S, double scale) {
    for (std::size_t i = 0; i < dim; ++i)
      sum[i] += scale * S[i];
    if constexpr (axisymmetric)
      sum[0] += scale * S[dim];
  }

  ElementStatus run(const Material& material, const ElementInput& in, ElementOutput& out) {
    if (!kinematics(in))
      return ElementStatus::inverted;
    if (!update(material, b_pred, in.old, planar, in.flow, response))
      return ElementStatus::no_return;
    Vector force{};
    Vector dilatation{};
    Blocks K{};
    const double kappa = material.elasticity.bulk();
    const double V0 = std::accumulate(in.volumes.begin(), in.volumes.end(), 0.0);
    double v = 0.0;
    for (int g = 0; g < points; ++g)
      v += volume[g];
    const double theta = v / V0;
    const double log_theta = std::log(theta);
    for (std::size_t k = 0; k < batches; ++k) {
      const DeviatoricResponse& at = response[k];
      const PointLanes energies = shape_energies(material.elasticity, at.s);
      const Moduli D = out.tangent == nullptr ? Moduli() : moduli(at);
      const int first = static_cast<int>(k) * points_at_once;
      for (int l = 0; l < std::min(points_at_once, points - first); ++l) {
        const int g = first + l;
        at.put_state(l, out.trial[idx(g)]);
        if (!out.shape_energies.empty())
          out.shape_energies[idx(g)] = energies[l];
        out.largest_plastic_increment =
            std::max(out.largest_plastic_increment, at.plastic_increment[idx(l)]);
        const double dV = in.volumes[idx(g)];
        // Pressure times J: of the element's mean dilatation, or of the point's own.
        const double p = Element::mean_dilatation ? kappa * log_theta / theta * volume[g] / dV
                                                  : kappa * at.log_J[l];
        const Mat3 tau = dV * stress(at.deviator, p, l);
        add_force(force, slope[idx(g)], tau);
        if (out.tangent == nullptr)
          continue;
        if constexpr (Element::mean_dilatation)
          add_divergence(dilatation, slope[idx(g)], volume[g]);
        add_stiffness(K, slope[idx(g)], {&D, l, Element::mean_dilatation ? p : kappa, p}, tau, dV);
      }
    }
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        out.force[a * dim + i] = force[idx(i)][a];
    if (out.tangent != nullptr) {
      if constexpr (Element::mean_dilatation)
        add_dyad(K, kappa * (1.0 - log_theta) / (theta * theta * V0), dilatation);
      add_to(*out.tangent, K);
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
  typename K::Square J;
  typename K::AtPoints r;
  const typename K::AtPoints v = K::measure(x, J, r);
  double smallest = std::numeric_limits<double>::infinity();
  for (int g = 0; g < K::points; ++g) {
    out[idx(g)] = v[g];
    smallest = std::min(smallest, v[g]);
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

bool has_mean_dilatation(ElementKind kind) {
  return visit_element(kind, [](auto element) { return decltype(element)::mean_dilatation; });
}

double pressure_ratio(ElementKind kind,
                      std::span<const double> current,
                      std::span<const double> reference,
                      std::size_t point) {
  if (!has_mean_dilatation(kind))
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
    Eigen::Matrix<double, nodes, dim> dN;
    Eigen::Matrix<double, nodes, 1> N;
    for (int a = 0; a < nodes; ++a) {
      N[a] = table.N[point][a];
      for (int i = 0; i < dim; ++i)
        dN(a, i) = table.dN[point][idx(i)][a];
    }
    const Eigen::Matrix<double, dim, dim> J = positions.transpose() * dN;
    Eigen::Map<Eigen::Matrix<double, nodes, dim, Eigen::RowMajor>> gradient(out.data());
    gradient = dN * J.inverse() * n.template topLeftCorner<dim, dim>();
    if (analysis == Analysis::axisymmetric)
      gradient.col(0) += n(2, 2) / N.dot(positions.col(0)) * N;
  });
}

} // namespace billet::mechanics
