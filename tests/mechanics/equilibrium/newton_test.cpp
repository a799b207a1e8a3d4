// Newton's method: quadratic convergence in plastic flow (VALIDATION ELT-07), what it prescribes
// and what it refuses.

#include "mechanics/bulk/bulk.h"
#include "mechanics/equilibrium/newton.h"
#include "mechanics/loads/loads.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/figures.h"
#include "tests/support/patch.h"
#include "tests/support/sample_materials.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace billet::mechanics::newton_test {
namespace {

using support::every_element;
using support::flat;

/// A block clamped at one end along y, the other end moved.
class Block {
public:
  Block(const support::ElementCase& element, const Material& material, NewtonSettings settings)
      : mesh_(box_mesh(
            {.kind = element.kind, .low = {1, 0, 0}, .high = {2, 1, 1}, .cells = {3, 3, 2}})),
        pattern_(block_pattern(mesh_)), bulk_(mesh_, element.analysis, material, pattern_),
        newton_(pattern_, SolverSettings{}, settings), X_(flat(mesh_)), x_(X_) {}
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  /// Moves the free end by `shift` from the start and solves.
  Outcome<NewtonReport> press(const Vec3& shift) {
    prescribed_ = {};
    for (Index node = 0; node < mesh_.n_points(); ++node) {
      const double y = mesh_.points[static_cast<std::size_t>(node)][1];
      if (y != 0.0 && y != 1.0)
        continue;
      for (int c = 0; c < mesh_.dimension(); ++c) {
        const Index i = node * mesh_.dimension() + c;
        prescribed_.unknowns.push_back(i);
        prescribed_.positions.push_back(X_[static_cast<std::size_t>(i)] +
                                        (y == 1.0 ? shift[c] : 0.0));
      }
    }
    ForceTerm* terms[] = {&bulk_};
    old_ = x_;
    return newton_.solve(terms, prescribed_, 0.0, 1.0, old_, x_);
  }
  /// Solves the same increment once more, from its solution disturbed at the free unknowns.
  Outcome<NewtonReport> again_from_nearby(double size, unsigned seed) {
    support::Random random(seed);
    std::vector<char> fixed(x_.size(), 0);
    for (const Index i : prescribed_.unknowns)
      fixed[static_cast<std::size_t>(i)] = 1;
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (fixed[i] == 0)
        x_[i] += random.number(-size, size);
    ForceTerm* terms[] = {&bulk_};
    return newton_.solve(terms, prescribed_, 0.0, 1.0, old_, x_);
  }
  void commit() { bulk_.commit({0.0, 1.0, old_, x_}); }

  [[nodiscard]] const Newton& newton() const { return newton_; }
  [[nodiscard]] const Bulk& bulk() const { return bulk_; }
  [[nodiscard]] const Prescribed& prescribed() const { return prescribed_; }
  [[nodiscard]] const std::vector<double>& x() const { return x_; }

private:
  Mesh mesh_;
  BlockPattern pattern_;
  Bulk bulk_;
  Newton newton_;
  std::vector<double> X_;
  std::vector<double> x_;
  std::vector<double> old_;
  Prescribed prescribed_;
};

/// Orders of increments of plastic flow: the residual after one iteration against the one before,
/// from two distances to the solution. The tail of a single iteration says less: it has three
/// residuals at most between "points still find out whether they flow" and rounding.
std::vector<double> orders(const support::ElementCase& element, const AnyFlowLaw& flow) {
  constexpr double far = 3e-5; // strains of a tenth of the yield strain
  constexpr double close = 3e-6;
  Block block(element, {support::steel, flow}, {1e-10, 40, 1.0});
  std::vector<double> list;
  for (int i = 1; i <= 5; ++i) {
    EXPECT_TRUE(block.press(i * Vec3(0.015, -0.02, 0.0))) << element.name();
    EXPECT_GT(block.bulk().largest_plastic_increment(), 0.01);
    const auto residuals_from = [&](double distance) {
      EXPECT_TRUE(block.again_from_nearby(distance, static_cast<unsigned>(i)));
      const auto& records = block.newton().records();
      return std::pair(records.at(0).residual, records.at(1).residual);
    };
    const auto [before_far, after_far] = residuals_from(far);
    const auto [before_close, after_close] = residuals_from(close);
    list.push_back(std::log(after_far / after_close) / std::log(before_far / before_close));
    block.commit();
  }
  return list;
}

TEST(Newton, ELT_07_converges_quadratically_in_plastic_flow) {
  constexpr double smallest_order = 1.8; // VALIDATION
  for (const auto& element : every_element) {
    std::vector<double> list = orders(element, Linear{300.0, 500.0});
    for (const AnyFlowLaw& law :
         {AnyFlowLaw(Swift{700.0, 0.01, 0.2}), AnyFlowLaw(NortonHoff{300.0, 0.2, 0.1, 0.01, 0.0}),
          AnyFlowLaw(Perzyna{Linear{300.0, 500.0}, 1.0, 0.3}), AnyFlowLaw(support::steel_4340),
          AnyFlowLaw(support::hot_steel)})
      for (const double one : orders(element, law))
        list.push_back(one);
    std::sort(list.begin(), list.end());
    const double median = list[list.size() / 2];
    support::show("ELT-07",
                  fmt::format("{} median Newton order of {} ({:.2f} to {:.2f})", element.name(),
                              list.size(), list.front(), list.back()),
                  median, 2.0);
    EXPECT_GE(median, smallest_order) << element.name();
  }
}

// Equilibrium before, supports moved: the free residual can only grow in the first iteration, which
// is no reason to cut it.
TEST(Newton, takes_the_whole_first_step_when_supports_move) {
  for (const auto& element : every_element) {
    Block block(element, {support::steel, Linear{300.0, 500.0}}, {1e-9, 40, 1.0});
    for (int i = 1; i <= 5; ++i) {
      ASSERT_TRUE(block.press(i * Vec3(0.01, -0.02, 0.0)));
      EXPECT_EQ(block.newton().records().at(1).step, 1.0) << element.name() << " " << i;
      block.commit();
    }
  }
}

TEST(Newton, puts_prescribed_unknowns_to_the_bit) {
  for (const auto& element : every_element) {
    Block block(element, {support::steel, Linear{300.0, 500.0}}, {1e-6, 24, 1.0});
    ASSERT_TRUE(block.press(Vec3(0.013, -0.0271, 0.0)));
    for (std::size_t k = 0; k < block.prescribed().unknowns.size(); ++k)
      EXPECT_EQ(block.x()[static_cast<std::size_t>(block.prescribed().unknowns[k])],
                block.prescribed().positions[k]);
    EXPECT_EQ(block.newton().records().front().iteration, 0);
    EXPECT_LE(block.newton().records().back().residual, 1e-6);
  }
}

TEST(Newton, solves_an_elastic_increment_within_rounding_of_the_same_in_two) {
  for (const auto& element : every_element) {
    const Material elastic{support::steel, Elastic{}};
    Block once(element, elastic, {1e-11, 30, 1.0});
    Block twice(element, elastic, {1e-11, 30, 1.0});
    ASSERT_TRUE(once.press(Vec3(0.0, -0.2, 0.0)));
    ASSERT_TRUE(twice.press(Vec3(0.05, 0.1, 0.0)));
    twice.commit();
    ASSERT_TRUE(twice.press(Vec3(0.0, -0.2, 0.0)));
    double worst = 0.0;
    for (std::size_t i = 0; i < once.x().size(); ++i)
      worst = std::max(worst, std::abs(once.x()[i] - twice.x()[i]));
    EXPECT_LE(worst, 1e-10) << element.name(); // Hencky elasticity has no path
  }
}

TEST(Newton, does_nothing_where_there_is_nothing_to_do) {
  Block block(every_element[0], {support::steel, Linear{300.0, 500.0}}, {1e-6, 24, 1.0});
  const auto report = block.press(Vec3::Zero());
  ASSERT_TRUE(report);
  EXPECT_EQ(report->iterations, 0);
}

TEST(Newton, reports_an_increment_that_has_no_solution) {
  // The block is pressed through itself.
  Block block(every_element[1], {support::steel, Linear{300.0, 500.0}}, {1e-6, 24, 1.0});
  const auto report = block.press(Vec3(0.0, -1.3, 0.0));
  ASSERT_FALSE(report);
  EXPECT_FALSE(report.error().reason.empty());
  EXPECT_GE(block.newton().worst_unknown(), 0);
}

/// A force on an unknown that jumps from one sense to the other where it passes a place.
class Jump final : public ForceTerm {
public:
  Jump(std::size_t unknown, double place, double force)
      : unknown_(unknown), place_(place), force_(force) {}
  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override {
    system.residual[unknown_] += trial.x[unknown_] < place_ ? -force_ : force_;
    return Assembled{};
  }
  void commit(const Trial& /*trial*/) override {}
  [[nodiscard]] bool nonsmooth() const override { return true; }

private:
  std::size_t unknown_;
  double place_, force_;
};

TEST(Newton, does_not_take_a_short_step_of_its_search_for_rounding) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad4, .cells = {3, 3, 1}});
  constexpr double origin = 100.0; // the rounding of coordinates is that of a large part
  for (Vec3& x : mesh.points)
    x[1] += origin;
  const BlockPattern pattern = block_pattern(mesh);
  Bulk bulk(mesh, Analysis::plane_strain, {support::steel, Elastic{}}, pattern);
  const std::vector<double> start = flat(mesh);
  const std::size_t last = start.size() - 1; // of the corner at (1, 1)
  Prescribed foot;
  for (Index node = 0; node < mesh.n_points(); ++node)
    if (mesh.points[static_cast<std::size_t>(node)][1] == origin)
      for (int c = 0; c < 2; ++c) {
        foot.unknowns.push_back(2 * node + c);
        foot.positions.push_back(start[idx(2 * node + c)]);
      }
  for (const double share : {8e-3, 1e-3, 1e-5}) { // of the scale of forces
    constexpr double scale = 1e4;
    Jump jump(last, start[last] + 1e-6 * share, share * scale);
    ForceTerm* terms[] = {&bulk, &jump};
    Newton newton(pattern, SolverSettings{}, {1e-6, 24, scale});
    std::vector<double> x = start;
    for (const Continuation way : {Continuation::none, Continuation::more_iterations}) {
      const auto report = newton.solve(terms, foot, 0.0, 1.0, start, x, way);
      EXPECT_FALSE(report) << share << ": " << report->residual;
    }
  }
}

/// Four unknowns on springs of stiffness 1, and three unilateral supports. From zero Newton's whole
/// steps go to and fro between two sets of supports that bear, for ever.
class GoesToAndFro final : public ForceTerm {
public:
  GoesToAndFro(std::vector<Index> unknowns, std::vector<double> start)
      : unknowns_(std::move(unknowns)), start_(std::move(start)) {}
  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override {
    const Eigen::Vector4d load(-0.2, -0.2, 1.7, 0.8);
    Eigen::Matrix<double, 3, 4> gaps;
    gaps << -1.7, -2.7, 1.5, -0.8, -1.0, 0.8, -0.2, -0.3, -0.2, -1.4, 0.1, 1.7;
    Eigen::Matrix<double, 4, 3> pushes;
    pushes << -0.1, 1.4, -1.1, -1.4, 1.4, -0.8, -1.0, 0.2, 1.3, -0.1, 0.8, -0.5;
    Eigen::Vector4d u;
    for (Index i = 0; i < 4; ++i)
      u[i] = trial.x[idx(unknowns_[idx(i)])] - start_[idx(unknowns_[idx(i)])];
    const Eigen::Vector3d g = gaps * u;
    const Eigen::Vector3d bears = (g.array() > 0.0).cast<double>();
    const Eigen::Vector4d force = u - load + pushes * bears.cwiseProduct(g);
    const Eigen::Matrix4d tangent =
        Eigen::Matrix4d::Identity() + pushes * bears.asDiagonal() * gaps;
    for (Index i = 0; i < 4; ++i) {
      const Index row = unknowns_[idx(i)];
      system.residual[idx(row)] += force[i];
      for (Index j = 0; j < 4; ++j)
        system.tangent.values[idx(system.tangent.pattern->entry(row, unknowns_[idx(j)]))] +=
            tangent(i, j);
    }
    system.symmetric = false;
    return Assembled{};
  }
  void commit(const Trial& /*trial*/) override {}
  [[nodiscard]] bool nonsmooth() const override { return true; }

private:
  std::vector<Index> unknowns_;
  std::vector<double> start_;
};

TEST(Newton, leaves_two_sets_of_contacts_that_lead_to_each_other) {
  const Mesh mesh = box_mesh({.kind = ElementKind::quad4, .cells = {1, 1, 1}});
  const BlockPattern pattern = block_pattern(mesh);
  const std::vector<double> start = flat(mesh);
  Prescribed held;
  std::vector<Index> free;
  for (Index i = 0; i < pattern.n_dofs(); ++i) {
    if (mesh.points[idx(i / 2)][1] != 0.0) {
      free.push_back(i);
      continue;
    }
    held.unknowns.push_back(i);
    held.positions.push_back(start[idx(i)]);
  }
  GoesToAndFro supports(free, start);
  ForceTerm* terms[] = {&supports};
  constexpr double scale = 1e3; // residuals that are not hopeless
  Newton newton(pattern, SolverSettings{}, {1e-9, 24, scale, 1e6});
  std::vector<double> x = start;
  const auto report = newton.solve(terms, held, 0.0, 1.0, start, x);
  ASSERT_TRUE(report);
  EXPECT_LE(report->residual, 1e-9);
  const auto& records = newton.records();
  ASSERT_GT(records.size(), 6U);
  for (const std::size_t there : {3U, 5U})
    EXPECT_NEAR(scale * records[there].residual, 1.228525, 1e-5);
  for (const std::size_t back : {2U, 4U})
    EXPECT_NEAR(scale * records[back].residual, 1.141249, 1e-5);
}

/// Passes on to the bulk and counts what is asked for.
class Counted final : public ForceTerm {
public:
  explicit Counted(Bulk& bulk) : bulk_(&bulk) {}
  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override {
    ++(system.forces_only ? forces : whole);
    return bulk_->assemble(trial, system);
  }
  void commit(const Trial& trial) override { bulk_->commit(trial); }

  int forces = 0;
  int whole = 0;

private:
  Bulk* bulk_;
};

TEST(Newton, makes_no_tangent_in_what_it_expects_to_be_the_last_trial) {
  const Mesh mesh = box_mesh({.kind = ElementKind::quad4, .cells = {3, 3, 1}});
  const BlockPattern pattern = block_pattern(mesh);
  Bulk bulk(mesh, Analysis::plane_strain, {support::steel, Elastic{}}, pattern);
  Counted counted(bulk);
  ForceTerm* terms[] = {&counted};
  Prescribed prescribed;
  const std::vector<double> start = flat(mesh);
  const auto move = [&](double shift) {
    prescribed = {};
    for (Index node = 0; node < mesh.n_points(); ++node)
      for (int c = 0; c < 2; ++c) {
        const double y = mesh.points[static_cast<std::size_t>(node)][1];
        if (y != 0.0 && y != 1.0)
          continue;
        const Index i = 2 * node + c;
        prescribed.unknowns.push_back(i);
        prescribed.positions.push_back(start[static_cast<std::size_t>(i)] +
                                       (y == 1.0 && c == 1 ? shift : 0.0));
      }
  };
  Newton newton(pattern, SolverSettings{}, {1e-10, 20, 1.0});
  std::vector<double> x = start;
  move(-0.1);
  const auto report = newton.solve(terms, prescribed, 0.0, 1.0, start, x);
  ASSERT_TRUE(report);
  EXPECT_EQ(counted.forces, 1);
  // A trial for each iteration and one for the guess: none was made twice.
  EXPECT_EQ(counted.forces + counted.whole, report->iterations + 1);
  // The solution is one: what a whole evaluation says of it.
  System system = {};
  system.tangent.pattern = &pattern;
  system.tangent.values.resize(pattern.n_entries());
  system.residual.resize(start.size());
  ASSERT_TRUE(bulk.assemble({0.0, 1.0, start, x}, system));
  double largest = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (std::find(prescribed.unknowns.begin(), prescribed.unknowns.end(), static_cast<Index>(i)) ==
        prescribed.unknowns.end())
      largest = std::max(largest, std::abs(system.residual[i]));
  EXPECT_LE(largest, 1e-10 * report->force_scale);
}

} // namespace
} // namespace billet::mechanics::newton_test
