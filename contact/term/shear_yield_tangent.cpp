#include "contact/term/shear_yield_tangent.h"

#include <numbers>
#include <numeric>
#include <optional>
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
  /// By component `j` of node `b` of the element [MPa/mm].
  [[nodiscard]] double operator()(std::size_t b, int j) const {
    return values_[b * idx(dim_) + idx(j)];
  }

private:
  const mechanics::Bulk* bulk_;
  int dim_;
  std::span<const Index> nodes_;
  std::vector<double> positions_;
  std::vector<double> values_;
};

/// Adds the rows of a node whose force changes by `dforce` with the stress.
void add_row(const mechanics::BlockPattern& pattern,
             Index node,
             const Vec3& dforce,
             const ShearYieldGradient& gradient,
             mechanics::System& system) {
  const int dim = pattern.dim;
  for (std::size_t b = 0; b < gradient.nodes().size(); ++b) {
    const Index column = pattern.offset(node, gradient.nodes()[b]) * dim;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) {
        const Index row = node * dim + i;
        const Index entry = pattern.row_start[idx(row)] + column + j;
        const double value = dforce[i] * gradient(b, j);
        system.tangent.values[idx(entry)] += value;
        system.tangent.unsymmetric.push_back({row, entry, value});
      }
  }
}

/// Adds the row of a tool's free degree of freedom, whose load changes by `dload`.
void add_row(int dim, double dload, const ShearYieldGradient& gradient, mechanics::Border& border) {
  for (std::size_t b = 0; b < gradient.nodes().size(); ++b)
    for (int j = 0; j < dim; ++j)
      border.row[idx(gradient.nodes()[b] * dim + j)] += dload * gradient(b, j);
}

} // namespace

void add_shear_yield_tangent(const ContactView& contact,
                             const mechanics::Trial& trial,
                             mechanics::System& system) {
  const auto& [model, state] = contact;
  ShearYieldGradient gradient(*model.bulk, model.pattern->dim);
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
      for (std::size_t a = 0; a < shares.nodes.size(); ++a)
        add_row(*model.pattern, shares.nodes[a], -shares.areas[a] * dT, gradient, system);
      const double area = std::accumulate(shares.areas.begin(), shares.areas.end(), 0.0);
      for (std::size_t d = 0; d < model.drives.size(); ++d)
        if (model.drives[d].tool == t) {
          const DriveRate rate =
              model.drive_rate(model.drives[d], trial.time, trial.x, state.positions[k]);
          add_row(model.pattern->dim, area * dT.dot(rate.velocity), gradient, system.borders[d]);
        }
    }
  }
}

} // namespace billet::contact
