#include "contact/term/shear_yield_tangent.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace billet::contact {

namespace {

/// d k / d x of the nodes of the parent element.
class ShearYieldGradient {
public:
  ShearYieldGradient(const mechanics::Bulk& bulk, int dim) : bulk_(&bulk), dim_(dim) {}

  /// False: the stress does not change.
  bool evaluate(FollowedStress followed, std::size_t bulk_point, std::span<const double> x) {
    const mechanics::MisesStress stress = bulk_->trial_stress(bulk_point);
    const double slope = followed == FollowedStress::yield ? stress.d_flow_stress : stress.d_stress;
    if (slope == 0.0)
      return false;
    nodes_ = bulk_->nodes_around(bulk_point);
    positions_.resize(nodes_.size() * idx(dim_));
    values_.resize(positions_.size());
    mechanics::gather(x, nodes_, dim_, positions_.data());
    mechanics::strain_gradient(bulk_->kind(), bulk_->analysis(), positions_.data(),
                               bulk_point % idx(bulk_->points()),
                               slope / std::numbers::sqrt3 * stress.direction, values_);
    return true;
  }

  [[nodiscard]] std::span<const Index> nodes() const { return nodes_; }
  /// By the components of the nodes, shape (nodes dim) [MPa/mm].
  [[nodiscard]] std::span<const double> values() const { return values_; }

private:
  const mechanics::Bulk* bulk_;
  int dim_;
  std::span<const Index> nodes_;
  std::vector<double> positions_;
  std::vector<double> values_;
};

/// The rows of a face's nodes, whose forces change with the stress in the parent element: summed
/// over the face's points before they go into the matrix.
class RowsOfFace {
public:
  RowsOfFace(const mechanics::BlockPattern& pattern, mechanics::System& system)
      : pattern_(&pattern), system_(&system) {}

  /// @param dtraction  what the traction at the point changes by with k [-]
  void add(const PointShares& shares, const Vec3& dtraction, const ShearYieldGradient& gradient) {
    if (!std::ranges::equal(rows_, shares.nodes) || !std::ranges::equal(columns_, gradient.nodes()))
      start(shares.nodes, gradient.nodes());
    const std::span<const double> slope = gradient.values();
    const auto dim = idx(pattern_->dim);
    for (std::size_t a = 0; a < rows_.size(); ++a)
      for (std::size_t i = 0; i < dim; ++i) {
        const double change = -shares.areas[a] * dtraction[static_cast<int>(i)];
        double* row = &values_[(a * dim + i) * slope.size()];
        for (std::size_t c = 0; c < slope.size(); ++c)
          row[c] += change * slope[c];
      }
  }

  /// Puts into the matrix what has been added.
  void put() {
    const int dim = pattern_->dim;
    const double* value = values_.data();
    for (const Index node : rows_)
      for (int i = 0; i < dim; ++i) {
        const Index row = node * dim + i;
        for (const Index neighbour : columns_) {
          const Index entry =
              pattern_->row_start[idx(row)] + pattern_->offset(node, neighbour) * dim;
          for (int j = 0; j < dim; ++j, ++value)
            if (*value != 0.0) {
              system_->tangent.values[idx(entry + j)] += *value;
              system_->tangent.unsymmetric.push_back({row, entry + j, *value});
            }
        }
      }
    rows_.clear();
    columns_.clear();
  }

private:
  void start(std::span<const Index> rows, std::span<const Index> columns) {
    put();
    rows_.assign(rows.begin(), rows.end());
    columns_.assign(columns.begin(), columns.end());
    const auto dim = idx(pattern_->dim);
    values_.assign(rows_.size() * columns_.size() * dim * dim, 0.0);
  }

  const mechanics::BlockPattern* pattern_;
  mechanics::System* system_;
  std::vector<Index> rows_, columns_; ///< nodes
  std::vector<double> values_;        ///< shape (rows dim, columns dim)
};

/// Adds the row of a tool's free degree of freedom, whose load changes by `dload`.
void add_row(int dim, double dload, const ShearYieldGradient& gradient, mechanics::Border& border) {
  for (std::size_t b = 0; b < gradient.nodes().size(); ++b)
    for (int j = 0; j < dim; ++j)
      border.row[idx(gradient.nodes()[b] * dim + j)] +=
          dload * gradient.values()[b * idx(dim) + idx(j)];
}

} // namespace

void add_shear_yield_tangent(const ContactView& contact,
                             const mechanics::Trial& trial,
                             mechanics::System& system) {
  const auto& [model, state] = contact;
  ShearYieldGradient gradient(*model.bulk, model.pattern->dim);
  RowsOfFace rows(*model.pattern, system);
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const std::optional<FollowedStress> followed = model.tools[t].friction.followed_stress();
    if (!followed)
      continue;
    const TrialContact& tool = state.tools[t].trial;
    for (std::size_t k = 0; k < tool.traction.size(); ++k) {
      if (tool.traction[k].dtraction_dk.isZero(0.0) ||
          !gradient.evaluate(*followed, model.surface->bulk_point(k), trial.x))
        continue;
      const Vec3 dT = tool.rotation * tool.traction[k].dtraction_dk;
      const PointShares shares = model.surface->shares(trial.x, k);
      rows.add(shares, dT, gradient);
      const double area = std::accumulate(shares.areas.begin(), shares.areas.end(), 0.0);
      for (std::size_t d = 0; d < model.drives.size(); ++d)
        if (model.drives[d].tool == t) {
          const DriveRate rate =
              model.drive_rate(model.drives[d], trial.time, trial.x, state.positions[k]);
          add_row(model.pattern->dim, area * dT.dot(rate.velocity), gradient, system.borders[d]);
        }
    }
  }
  rows.put();
}

} // namespace billet::contact
