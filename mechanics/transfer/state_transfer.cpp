#include "mechanics/transfer/state_transfer.h"

#include "mechanics/bulk/bulk.h"
#include "mechanics/bulk/element_kernel.h"
#include "mechanics/elements/elements.h"
#include "mechanics/elements/mesh_locator.h"
#include "mechanics/numerics/spectral.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace billet::mechanics {

namespace {

/// Symmetric tensors as vectors of the same length: shears times the root of two. (M.34)
struct TensorComponents {
  int n; ///< 4 in the plane, 6 in space

  void write(const Mat3& A, double* out) const {
    for (int i = 0; i < n; ++i)
      out[i] = i < 3 ? A(i, i) : std::numbers::sqrt2 * A(row(i), column(i));
  }
  [[nodiscard]] Mat3 read(const double* in) const {
    Mat3 A = Mat3::Zero();
    for (int i = 0; i < n; ++i)
      A(row(i), column(i)) = A(column(i), row(i)) = i < 3 ? in[i] : in[i] / std::numbers::sqrt2;
    return A;
  }

private:
  static int row(int i) { return i < 3 ? i : std::array{0, 1, 0}[idx(i - 3)]; }
  static int column(int i) { return i < 3 ? i : std::array{1, 2, 2}[idx(i - 3)]; }
};

template <class Function> Mat3 of_principal_values(const Mat3& A, bool planar, Function f) {
  const Spectral S = planar ? spectral_plane(A) : spectral(A);
  const Vec3 values = S.values.unaryExpr(f);
  const Mat3 B = S.vectors * values.asDiagonal() * S.vectors.transpose();
  return 0.5 * (B + B.transpose());
}

/// Everything of a point that is transferred, in the order of its columns.
struct PointValues {
  Mat3 e = Mat3::Zero(); ///< deviator of the elastic strain [-]
  double mean = 0.0;     ///< a third of its trace [-]
  double plastic_strain = 0.0;
  double temperature = 0.0;
  double rate = 0.0;
};

/// Where each quantity stands in a row.
struct Columns {
  TensorComponents tensor;
  bool temperatures;
  bool rates;
  std::vector<int> groups;

  Columns(const StateField& from)
      : tensor{from.mesh->dimension() == 2 ? 4 : 6}, temperatures(!from.temperatures.empty()),
        rates(!from.plastic_rate.empty()), groups{tensor.n, 1, 1} {
    groups.resize(groups.size() + (temperatures ? 1 : 0) + (rates ? 1 : 0), 1);
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(std::accumulate(groups.begin(), groups.end(), 0));
  }
  void write(const PointValues& point, double* row) const {
    tensor.write(point.e, row);
    row += tensor.n;
    *row++ = point.mean;
    *row++ = point.plastic_strain;
    if (temperatures)
      *row++ = point.temperature;
    if (rates)
      *row++ = point.rate;
  }
  [[nodiscard]] PointValues read(const double* row) const {
    PointValues point;
    point.e = tensor.read(row);
    row += tensor.n;
    point.mean = *row++;
    point.plastic_strain = *row++;
    if (temperatures)
      point.temperature = *row++;
    if (rates)
      point.rate = *row++;
    return point;
  }
};

std::vector<double> rows_of(const StateField& from, const Columns& columns) {
  const bool planar = from.mesh->dimension() == 2;
  std::vector<double> rows(from.states.size() * columns.size());
  for (std::size_t k = 0; k < from.states.size(); ++k) {
    const Mat3 eps =
        of_principal_values(from.states[k].b_e, planar, [](double b) { return 0.5 * std::log(b); });
    PointValues point{.mean = eps.trace() / 3.0, .plastic_strain = from.states[k].plastic_strain};
    point.e = eps - point.mean * Mat3::Identity();
    point.temperature = columns.temperatures ? from.temperatures[k] : 0.0;
    point.rate = columns.rates ? from.plastic_rate[k] : 0.0;
    columns.write(point, &rows[k * columns.size()]);
  }
  return rows;
}

/// One value for each element, in its middle.
struct ElementMeans {
  std::vector<Vec3> middles;  ///< means over the volume [mm]
  std::vector<double> values; ///< a third of the logarithm of the mean dilatation [-]
};

/// Mean dilatations v / sum (dv / J) of elements that take their pressure from them. (M.38)
ElementMeans
mean_dilatations(const StateField& from, Analysis analysis, std::span<const Vec3> positions) {
  const Mesh& mesh = *from.mesh;
  const auto n = idx(points_per_element(mesh.kind));
  std::vector<double> local(idx(nodes_per_element(mesh.kind) * mesh.dimension()));
  std::vector<double> dv(n);
  ElementMeans means;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    gather(from.x, mesh.cell(e), mesh.dimension(), local.data());
    point_volumes(mesh.kind, analysis, local.data(), dv);
    double v = 0.0;
    double V0 = 0.0;
    Vec3 moment = Vec3::Zero();
    for (std::size_t k = 0; k < n; ++k) {
      v += dv[k];
      V0 += dv[k] / std::sqrt(from.states[idx(e) * n + k].b_e.determinant());
      moment += dv[k] * positions[idx(e) * n + k];
    }
    means.middles.emplace_back(moment / v);
    means.values.push_back(std::log(v / V0) / 3.0);
  }
  return means;
}

/// Whether no point of an element has flowed.
std::vector<char> elements_at_rest(const StateField& from) {
  const auto n = idx(points_per_element(from.mesh->kind));
  std::vector<char> rest(idx(from.mesh->n_elements()), 1);
  for (std::size_t k = 0; k < from.states.size(); ++k)
    if (from.states[k].plastic_strain > 0.0)
      rest[k / n] = 0;
  return rest;
}

/// Shortens the deviator to what the flow stress allows; true if it was longer by more than
/// rounding. (M.39)
bool put_back(PointValues& point, const Material& material, const Columns& columns) {
  if (follows_rate(material.flow) && !columns.rates)
    return false;
  const double temperature = columns.temperatures ? point.temperature : material.temperature;
  const double flow_stress =
      yield_stress(material.flow, {point.plastic_strain, point.rate, temperature});
  const double q = std::sqrt(6.0) * material.elasticity.shear() * point.e.norm();
  if (!(q > flow_stress))
    return false;
  point.e *= flow_stress / q;
  constexpr double rounding = 1e-10;
  return q > flow_stress * (1.0 + rounding);
}

/// True if all points of an element lie where old ones do.
bool unchanged(std::span<const Index> coincident) {
  return std::all_of(coincident.begin(), coincident.end(), [](Index p) { return p >= 0; });
}

/// Transfer between two given meshes.
class Transfer {
public:
  Transfer(const StateField& from, const Mesh& to, const Material& material)
      : from_(from), material_(material), columns_(from), targets_(target_points(to)),
        positions_(integration_points(*from.mesh, from.x)),
        at_(MeshLocator(*from.mesh, from.x).locate(targets_)),
        per_element_(idx(points_per_element(to.kind))) {}

  TransferredState run(Analysis analysis, TransferMethod method) {
    const std::vector<double> rows = rows_of(from_, columns_);
    TransferredField field =
        transfer_field({from_.mesh, positions_, rows, columns_.groups}, targets_, at_, method);
    if (visit_element(from_.mesh->kind, [](auto e) { return decltype(e)::mean_dilatation; }))
      take_means(analysis, method, field);
    return states(field);
  }

private:
  static std::vector<Vec3> target_points(const Mesh& to) {
    return integration_points(to, node_positions(to));
  }

  /// Puts the mean dilatations of the elements in the place of the points' own traces.
  void take_means(Analysis analysis, TransferMethod method, TransferredField& field) const {
    const ElementMeans means = mean_dilatations(from_, analysis, positions_);
    constexpr std::array one{1};
    const TransferredField mean =
        transfer_field({from_.mesh, means.middles, means.values, one}, targets_, at_, method);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      field.values[i * columns_.size() + idx(columns_.tensor.n)] = mean.values[i];
      field.limited[i] |= mean.limited[i];
    }
  }

  TransferredState states(const TransferredField& field) const {
    TransferredState out;
    out.states.resize(targets_.size());
    out.temperatures.resize(columns_.temperatures ? targets_.size() : 0);
    out.plastic_rate.resize(columns_.rates ? targets_.size() : 0);
    const std::vector<char> rest = elements_at_rest(from_);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const auto whole =
          std::span(field.coincident).subspan(i / per_element_ * per_element_, per_element_);
      if (unchanged(whole)) {
        copy(idx(field.coincident[i]), i, out);
        continue;
      }
      PointValues point = columns_.read(&field.values[i * columns_.size()]);
      if (rest[idx(at_[i].element)] != 0)
        point.plastic_strain = 0.0;
      finish(point, i, out);
      out.limited += field.limited[i];
    }
    return out;
  }

  void copy(std::size_t old, std::size_t i, TransferredState& out) const {
    out.states[i] = from_.states[old];
    if (columns_.temperatures)
      out.temperatures[i] = from_.temperatures[old];
    if (columns_.rates)
      out.plastic_rate[i] = from_.plastic_rate[old];
  }

  void finish(PointValues point, std::size_t i, TransferredState& out) const {
    point.plastic_strain = std::max(point.plastic_strain, 0.0);
    point.rate = std::max(point.rate, 0.0);
    out.returned += put_back(point, material_, columns_) ? 1 : 0;
    const Mat3 eps = point.e + point.mean * Mat3::Identity();
    out.states[i].b_e = of_principal_values(eps, from_.mesh->dimension() == 2,
                                            [](double e) { return std::exp(2.0 * e); });
    out.states[i].plastic_strain = point.plastic_strain;
    if (columns_.temperatures)
      out.temperatures[i] = point.temperature;
    if (columns_.rates)
      out.plastic_rate[i] = point.rate;
  }

  const StateField& from_;
  const Material& material_;
  Columns columns_;
  std::vector<Vec3> targets_;
  std::vector<Vec3> positions_;
  std::vector<MeshLocation> at_;
  std::size_t per_element_;
};

} // namespace

TransferredState transfer_state(const StateField& from,
                                const Mesh& to,
                                Analysis analysis,
                                const Material& material,
                                TransferMethod method) {
  return Transfer(from, to, material).run(analysis, method);
}

} // namespace billet::mechanics
