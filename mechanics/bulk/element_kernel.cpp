#include "mechanics/bulk/element_kernel.h"

#include "mechanics/bulk/point_table.h"
#include "mechanics/elements/elements.h"
#include "mechanics/numerics/simd_pack.h"

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

/// Everything the kernel works with, on the stack: elements side by side as far as their points go,
/// then one after the other.
template <class Element, Analysis analysis> struct Kernel {
  static constexpr int nodes = Element::Shape::nodes;
  static constexpr int dim = Element::Shape::dim;
  static constexpr int points = Element::Rule::points;
  static constexpr int elements = Places<Element>::elements;
  /// Strain components xx, yy, zz, xy, (yz, xz); shears are twice the tensor's.
  static constexpr int n_strains = dim == 2 ? 4 : 6;
  static constexpr bool planar = dim == 2;
  static constexpr bool axisymmetric = analysis == Analysis::axisymmetric;
  /// Derivatives that strains are made of: by each coordinate and, about an axis, N / r.
  static constexpr int slopes = axisymmetric ? dim + 1 : dim;

  using NodalRow = SimdPack<nodes>;
  using Square = SquarePack<dim>;
  using Slopes = std::array<NodalRow, slopes>;
  /// Of a batch of points, by the slopes of two displacements.
  using Factor = std::array<std::array<PointPack, slopes>, slopes>;
  using Vector = std::array<NodalRow, dim>; ///< of all nodes, component by component
  /// Moduli of a batch of points, on and above the diagonal.
  using Moduli = std::array<std::array<PointPack, n_strains>, n_strains>;
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

  using Inputs = std::array<const ElementInput*, elements>;
  using Positions = std::array<const double*, elements>;

  std::array<Slopes, points_at_once> slope; ///< d N / d x and N / r, current
  PointPack volume;                         ///< current
  TensorPack b_pred;
  DeviatoricResponse response;

  /// A number of each element at its points.
  template <class Function> static PointPack at_points(Function&& of_element) {
    if constexpr (elements == 1)
      return PointPack::constant(of_element(0));
    else
      return PointPack::of([&](int l) { return of_element(idx(Places<Element>::element(l))); });
  }

  /// Volumes of the points in a configuration; `J` receives d x / d xi, `r` the radius.
  static PointPack measure(const Positions& x, Square& J, PointPack& r) {
    const auto& table = point_table<Element>();
    J = {};
    r = {};
    for (int a = 0; a < nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) {
        const PointPack x_i = at_points([&](std::size_t e) { return x[e][idx(a * dim) + i]; });
        for (std::size_t j = 0; j < dim; ++j)
          J[i][j] += x_i * table.dN_at_points[idx(a)][j];
        if (axisymmetric && i == 0)
          r += x_i * table.N_at_points[idx(a)];
      }
    PointPack v = determinant(J) * table.weight;
    if constexpr (axisymmetric)
      v = full_turn * (v * r);
    return v;
  }

  /// Gradients, volumes and predictors at all points; false when an element is inverted.
  bool kinematics(const Inputs& in) {
    Positions x;
    Positions x_old;
    for (std::size_t e = 0; e < elements; ++e) {
      x[e] = in[e]->x;
      x_old[e] = in[e]->x_old;
    }
    Square J;
    Square J_old;
    PointPack r;
    PointPack r_old;
    volume = measure(x, J, r);
    const PointPack volume_old = measure(x_old, J_old, r_old);
    PointPack bad = unless_positive(volume) + unless_positive(volume_old);
    if constexpr (axisymmetric)
      bad += unless_positive(r);
    if (!all_zero(bad))
      return false;
    set_slopes(J, r);
    set_predictors(J, J_old, r / r_old, in);
    return true;
  }

  void set_slopes(const Square& J, [[maybe_unused]] const PointPack& r) {
    const auto& table = point_table<Element>();
    const Square C = adjugate(J);
    const PointPack per_volume = PointPack::constant(1.0) / determinant(J);
    for (std::size_t j = 0; j < dim; ++j)
      for (std::size_t i = 0; i < dim; ++i) {
        const PointPack inverse = C[i][j] * per_volume;
        for (int l = 0; l < elements * points; ++l) {
          const NodalRow part = inverse[l] * table.dN[idx(l % points)][i];
          slope[idx(l)][j] = i == 0 ? part : slope[idx(l)][j] + part;
        }
      }
    if constexpr (axisymmetric) {
      const PointPack per_radius = PointPack::constant(1.0) / r;
      for (int l = 0; l < elements * points; ++l)
        slope[idx(l)][dim] = per_radius[l] * table.N[idx(l % points)];
    }
  }

  /// b_e,pred = f b_e f^T with the deformation gradient f of the increment. (M.4)
  void set_predictors(const Square& J,
                      const Square& J_old,
                      [[maybe_unused]] const PointPack& radii,
                      const Inputs& in) {
    const Square C = adjugate(J_old);
    const PointPack per_volume = PointPack::constant(1.0) / determinant(J_old);
    SquarePack<3> f{};
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) {
        for (std::size_t l = 0; l < dim; ++l)
          f[i][j] += J[i][l] * C[l][j];
        f[i][j] = f[i][j] * per_volume;
      }
    if constexpr (dim == 2)
      f[2][2] = axisymmetric ? radii : PointPack::constant(1.0);
    SquarePack<3> b{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j)
        if (coupled(i, j))
          b[i][j] = b[j][i] = PointPack::of(
              [&](int l) { return state(in, l).b_e(static_cast<int>(i), static_cast<int>(j)); });
    const SquarePack<3> fb = product(f, b, false);
    const SquarePack<3> fbf = product(fb, f, true);
    for (std::size_t c = 0; c < tensor_components.size(); ++c) {
      const auto [i, j] = tensor_components[c];
      b_pred[c] = fbf[i][j];
    }
  }

  /// Committed state at a place of the batch.
  static const PointState& state(const Inputs& in, int place) {
    return in[idx(Places<Element>::element(place))]->old[idx(Places<Element>::point(place))];
  }

  /// Whether a tensor has more than a zero there: none couples a plane with what is across it.
  static constexpr bool coupled(std::size_t i, std::size_t j) {
    return !planar || (i == 2) == (j == 2);
  }

  /// A B, or A B^T.
  static SquarePack<3> product(const SquarePack<3>& A, const SquarePack<3>& B, bool transposed) {
    SquarePack<3> AB{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t l = 0; l < 3; ++l)
          if (coupled(i, l) && coupled(l, j))
            AB[i][j] += A[i][l] * (transposed ? B[j][l] : B[l][j]);
    return AB;
  }

  /// Deviatoric spatial moduli in space. (M.8)
  static Moduli moduli(const DeviatoricResponse& at) {
    const auto& axes = at.predictor.vectors;
    Moduli T; // turns strains in space into strains in the principal axes
    for (std::size_t row = 0; row < n_strains; ++row)
      for (std::size_t s = 0; s < n_strains; ++s) {
        const auto [p, q] = tensor_components[row];
        const auto [i, j] = tensor_components[s];
        T[row][s] =
            row < 3 ? axes[p][i] * axes[p][j] : axes[p][i] * axes[q][j] + axes[q][i] * axes[p][j];
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

  /// Kirchhoff stresses of a batch of points. [MPa]
  static TensorPack stresses(const TensorPack& deviator, const PointPack& p) {
    TensorPack tau = deviator;
    for (std::size_t i = 0; i < 3; ++i)
      tau[i] = tau[i] + p;
    return tau;
  }

  /// What the tangents of a batch of points are made of.
  struct PointModuli {
    PointPack trace; ///< moduli of the pressure: `trace` I (x) I - 2 `unit` II [MPa]
    PointPack unit;
    PointPack volume; ///< reference
    const Moduli* deviatoric;
    const TensorPack* tau; ///< Kirchhoff stresses times the volumes

    template <int s, int t> [[nodiscard]] PointPack at() const {
      PointPack value = (*deviatoric)[std::min(s, t)][std::max(s, t)];
      if constexpr (s < 3 && t < 3)
        value = value + trace;
      if constexpr (s == t)
        value = value - (s < 3 ? 2.0 : 1.0) * unit;
      return value;
    }
  };

  /// Strain component of the gradient of displacement i in direction l, or of the hoop.
  static constexpr std::size_t strain_of(std::size_t i, std::size_t l) {
    constexpr std::array<std::array<std::size_t, 3>, 3> component{
        {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    return l == dim ? 2 : component[i][l];
  }

  /// How many of the slopes displacement i has a strain of: only that along the radius has a
  /// hoop's.
  static constexpr std::size_t slopes_of(std::size_t i) { return i == 0 ? slopes : dim; }

  /// Derivative of the stress that works on displacement i by the gradient of displacement j, with
  /// the stress itself that turns with the gradients. (M.3), (M.8)
  template <std::size_t i, std::size_t j> static void set_factor(const PointModuli& D, Factor& A) {
    const auto set = [&]<std::size_t l, std::size_t m>() {
      constexpr std::size_t s = strain_of(i, l);
      constexpr std::size_t t = strain_of(j, m);
      A[l][m] = D.volume * D.template at<s, t>();
      if constexpr (i == j && (l == dim) == (m == dim))
        A[l][m] = A[l][m] + (*D.tau)[strain_of(l, m)];
    };
    [&]<std::size_t... k>(std::index_sequence<k...>) {
      (set.template operator()<k / slopes_of(j), k % slopes_of(j)>(), ...);
    }
    (std::make_index_sequence<slopes_of(i) * slopes_of(j)>());
  }

  /// Adds S A S^T of a point of a batch.
  template <std::size_t i, std::size_t j>
  static void add_product(Pairs& K, const Slopes& S, const Factor& A, int point) {
    Slopes SA{};
    for (std::size_t m = 0; m < slopes_of(j); ++m)
      for (std::size_t l = 0; l < slopes_of(i); ++l)
        SA[m] += A[l][m][point] * S[l];
    for (int a = 0; a < nodes; ++a)
      for (std::size_t m = 0; m < slopes_of(j); ++m)
        K[idx(a)] += SA[m][a] * S[m];
  }

  /// Calls `visit` with the number of each block and its components as constants.
  template <class Visit> static void for_each_block(Visit visit) {
    [&]<std::size_t... block>(std::index_sequence<block...>) {
      (visit.template operator()<block, idx(components[block].i), idx(components[block].j)>(), ...);
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

  /// Adds the nodal forces of the stress at a point of a batch.
  static void add_force(Vector& force, const Slopes& S, const TensorPack& tau, int point) {
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t l = 0; l < slopes_of(i); ++l)
        force[i] += tau[strain_of(i, l)][point] * S[l];
  }

  /// Adds `scale` times the nodal coefficients of the divergence at a point.
  static void add_divergence(Vector& sum, const Slopes& S, double scale) {
    for (std::size_t i = 0; i < dim; ++i)
      sum[i] += scale * S[i];
    if constexpr (axisymmetric)
      sum[0] += scale * S[dim];
  }

  static PointsBefore before(const Material& material, const Inputs& in, int count) {
    PointsBefore points_before{count, in[0]->dt, {}, {}};
    for (int l = 0; l < count; ++l) {
      const auto temperatures = in[idx(Places<Element>::element(l))]->temperatures;
      points_before.plastic_strain[idx(l)] = state(in, l).plastic_strain;
      points_before.temperature[idx(l)] = temperatures.empty()
                                              ? material.temperature
                                              : temperatures[idx(Places<Element>::point(l))];
    }
    return points_before;
  }

  /// Volumes of a whole element and what they say of its pressure. (M.12)
  struct Dilatation {
    double reference = 0.0; ///< volume [mm^3]
    double theta = 0.0;     ///< ratio of the current volume to it [-]
    double log_theta = 0.0;
  };

  [[nodiscard]] Dilatation dilatation(const ElementInput& in, int first) const {
    Dilatation of;
    double v = 0.0;
    for (int g = 0; g < points; ++g) {
      of.reference += in.volumes[idx(g)];
      v += volume[first + g];
    }
    of.theta = v / of.reference;
    of.log_theta = std::log(of.theta);
    return of;
  }

  ElementStatus
  run(const Material& material, std::span<const ElementInput> given, std::span<ElementOutput> out) {
    Inputs in; // beyond the last element its own once more
    for (std::size_t e = 0; e < elements; ++e)
      in[e] = &given[std::min(e, given.size() - 1)];
    if (!kinematics(in))
      return ElementStatus::inverted;
    const int count = points * static_cast<int>(given.size());
    if (!update(material, b_pred, before(material, in, count), planar, response))
      return ElementStatus::no_return;
    const double kappa = material.elasticity.bulk();
    std::array<Dilatation, elements> whole;
    if constexpr (Element::mean_dilatation)
      for (std::size_t e = 0; e < given.size(); ++e)
        whole[e] = dilatation(given[e], static_cast<int>(e) * points);
    const PointPack dV = PointPack::of([&](int l) {
      return in[idx(Places<Element>::element(l))]->volumes[idx(Places<Element>::point(l))];
    });
    // Pressures times J: of the element's mean dilatation, or of the points' own.
    const PointPack p = Element::mean_dilatation
                            ? at_points([&](std::size_t e) {
                                return kappa * whole[e].log_theta / whole[e].theta;
                              }) * volume /
                                  dV
                            : kappa * response.log_J;
    TensorPack tau = stresses(response.deviator, p);
    for (PointPack& component : tau)
      component = dV * component;
    std::array<Factor, components.size()> A;
    if (out[0].tangent != nullptr) {
      const Moduli D = moduli(response);
      const PointPack trace = Element::mean_dilatation ? p : PointPack::constant(kappa);
      for_each_block([&]<std::size_t block, std::size_t i, std::size_t j>() {
        set_factor<i, j>({trace, p, dV, &D, &tau}, A[block]);
      });
    }
    const PointPack energies = shape_energies(material.elasticity, response.s);
    for (std::size_t e = 0; e < given.size(); ++e) {
      put_points(static_cast<int>(e) * points, energies, out[e]);
      put_forces(static_cast<int>(e) * points, tau, out[e]);
      if (out[e].tangent != nullptr)
        put_tangent(static_cast<int>(e) * points, A, kappa, whole[e], out[e]);
    }
    return ElementStatus::good;
  }

  /// Writes what an element's points have come to, the first of them at a place of the batch.
  void put_points(int first, const PointPack& energies, ElementOutput& out) const {
    for (int g = 0; g < points; ++g) {
      response.put_state(first + g, out.trial[idx(g)]);
      if (!out.shape_energies.empty())
        out.shape_energies[idx(g)] = energies[first + g];
      out.largest_plastic_increment =
          std::max(out.largest_plastic_increment, response.plastic_increment[idx(first + g)]);
    }
  }

  void put_forces(int first, const TensorPack& tau, ElementOutput& out) const {
    Vector force{};
#pragma GCC unroll 8
    for (int g = 0; g < points; ++g)
      add_force(force, slope[idx(first + g)], tau, first + g);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        out.force[a * dim + i] = force[idx(i)][a];
  }

  void put_tangent(int first,
                   const std::array<Factor, components.size()>& A,
                   [[maybe_unused]] double kappa,
                   [[maybe_unused]] const Dilatation& whole,
                   const ElementOutput& out) const {
    Blocks K;
    // Block by block: the sums of one stay in the processor's registers.
    for_each_block([&]<std::size_t block, std::size_t i, std::size_t j>() {
      Pairs sum{};
      for (int l = first; l < first + points; ++l)
        add_product<i, j>(sum, slope[idx(l)], A[block], l);
      K[block] = sum;
    });
    if constexpr (Element::mean_dilatation) {
      Vector divergence{};
      for (int l = first; l < first + points; ++l)
        add_divergence(divergence, slope[idx(l)], volume[l]);
      add_dyad(K, kappa * (1.0 - whole.log_theta) / (whole.theta * whole.theta * whole.reference),
               divergence);
    }
    add_to(*out.tangent, K);
  }
};

template <class Element, Analysis analysis>
ElementStatus run_kernel(const Material& material,
                         std::span<const ElementInput> in,
                         std::span<ElementOutput> out) {
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
void volumes_of(const double* x, std::span<double> out) {
  using K = Kernel<Element, analysis>;
  const std::size_t count = out.size() / K::points;
  typename K::Positions positions; // beyond the last element its own once more
  for (std::size_t e = 0; e < positions.size(); ++e)
    positions[e] = x + std::min(e, count - 1) * (K::nodes * K::dim);
  typename K::Square J;
  PointPack r;
  const PointPack v = K::measure(positions, J, r);
  for (std::size_t l = 0; l < out.size(); ++l)
    out[l] = v[static_cast<int>(l)];
}

} // namespace

ElementKernel element_kernel(ElementKind kind, Analysis analysis) {
  return visit_element(kind, [&](auto element) { return kernel_of<decltype(element)>(analysis); });
}

int elements_at_once(ElementKind kind) {
  return visit_element(kind, [](auto element) { return Places<decltype(element)>::elements; });
}

void point_volumes(ElementKind kind, Analysis analysis, const double* x, std::span<double> out) {
  return visit_element(kind, [&](auto element) {
    using Element = decltype(element);
    if constexpr (Element::Shape::dim == 3)
      volumes_of<Element, Analysis::solid>(x, out);
    else if (analysis == Analysis::axisymmetric)
      volumes_of<Element, Analysis::axisymmetric>(x, out);
    else
      volumes_of<Element, Analysis::plane_strain>(x, out);
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
