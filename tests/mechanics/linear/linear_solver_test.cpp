#include "mechanics/linear/linear_solver.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/figures.h"
#include "tests/support/tensors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace billet::mechanics::linear_solver_test {
namespace {

/// `skew`: too far from symmetric for the symmetric part to help.
enum class Sort { positive, indefinite, unsymmetric, skew };

std::unique_ptr<Factorization> cholmod_of(const BlockPattern& pattern,
                                          std::span<const Index> order) {
  return make_cholmod(std::make_shared<const Elimination>(pattern, order));
}

std::unique_ptr<Factorization> single_of(const BlockPattern& pattern,
                                         std::span<const Index> order) {
  return make_single(std::make_shared<const Elimination>(pattern, order));
}

/// A pattern, a matrix over it, the same matrix dense.
struct Problem {
  explicit Problem(Sort sort) {
    const auto n = static_cast<std::size_t>(pattern.n_dofs());
    const Eigen::MatrixXd random_part = Eigen::Map<Eigen::MatrixXd>(
        random.list(n * n, 1.0).data(), pattern.n_dofs(), pattern.n_dofs());
    matrix.values.resize(pattern.n_entries());
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      for (Index k = row(i); k < row(i + 1); ++k) {
        const Index j = pattern.columns[static_cast<std::size_t>(k)];
        const double sign = sort == Sort::skew && i < j ? -30.0 : sort == Sort::skew ? 30.0 : 1.0;
        double value = sort == Sort::unsymmetric
                           ? random_part(i, j)
                           : sign * random_part(std::min(i, j), std::max(i, j));
        if (i == j)
          value = sort == Sort::indefinite && i % 3 == 0 ? -30.0 : 30.0;
        matrix.values[static_cast<std::size_t>(k)] = value;
      }
    refresh();
    rhs = random.list(n, 1.0);
    x.resize(n);
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  [[nodiscard]] Index row(Index i) const { return pattern.row_start[static_cast<std::size_t>(i)]; }
  void refresh() {
    dense = Eigen::MatrixXd::Zero(pattern.n_dofs(), pattern.n_dofs());
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      for (Index k = row(i); k < row(i + 1); ++k)
        dense(i, pattern.columns[static_cast<std::size_t>(k)]) =
            matrix.values[static_cast<std::size_t>(k)];
  }
  /// Multiplies row and column i by `factor`.
  void scale(Index i, double factor) {
    for (Index a = 0; a < pattern.n_dofs(); ++a)
      for (Index k = row(a); k < row(a + 1); ++k) {
        const Index b = pattern.columns[static_cast<std::size_t>(k)];
        matrix.values[static_cast<std::size_t>(k)] *=
            (a == i ? factor : 1.0) * (b == i ? factor : 1.0);
      }
    refresh();
  }
  /// Relative error of x against the dense solution.
  [[nodiscard]] double error(const std::vector<double>& solution) const {
    const Eigen::VectorXd reference =
        dense.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(rhs.data(), pattern.n_dofs()));
    return (Eigen::Map<const Eigen::VectorXd>(solution.data(), reference.size()) - reference)
               .norm() /
           reference.norm();
  }

  BlockPattern pattern = block_pattern(box_mesh({.kind = ElementKind::quad8, .cells = {5, 4, 1}}));
  support::Random random{17};
  SparseMatrix matrix{&pattern, {}};
  Eigen::MatrixXd dense;
  std::vector<double> rhs;
  std::vector<double> x;
};

constexpr double accuracy = 1e-11; // condition numbers here are below 100

TEST(LinearSolver, every_backend_agrees_with_the_dense_solution) {
  struct Backend {
    std::string name;
    Sort sort;
    std::unique_ptr<Factorization> (*make)(const BlockPattern&, std::span<const Index>);
  };
  const auto ldlt = [](const BlockPattern& p, std::span<const Index> o) {
    return make_mumps(p, o, true);
  };
  const auto lu = [](const BlockPattern& p, std::span<const Index> o) {
    return make_mumps(p, o, false);
  };
  const std::array<Backend, 7> backends{{{"cholmod", Sort::positive, &cholmod_of},
                                         {"mumps-ldlt", Sort::positive, ldlt},
                                         {"mumps-ldlt", Sort::indefinite, ldlt},
                                         {"mumps-lu", Sort::unsymmetric, lu},
                                         {"mumps-lu", Sort::indefinite, lu},
                                         {"umfpack", Sort::unsymmetric, &make_umfpack},
                                         {"umfpack", Sort::indefinite, &make_umfpack}}};
  for (const Backend& backend : backends) {
    Problem problem(backend.sort);
    const auto order = fill_reducing_order(problem.pattern);
    const auto factorization = backend.make(problem.pattern, order);
    for (int again = 0; again < 2; ++again) { // the analysis serves new values
      ASSERT_TRUE(factorization->factorize(problem.matrix)) << backend.name;
      problem.x = problem.rhs;
      factorization->solve(problem.x);
      support::show_error("solver", backend.name, problem.error(problem.x), accuracy);
      EXPECT_LE(problem.error(problem.x), accuracy) << backend.name;
      problem.scale(7, 1.5);
    }
  }
}

volatile std::sig_atomic_t signals = 0;

TEST(LinearSolver, a_signal_while_the_unknowns_are_ordered_reaches_the_program_and_spoils_nothing) {
  const BlockPattern pattern =
      block_pattern(box_mesh({.kind = ElementKind::hex8, .cells = {30, 30, 30}}));
  const auto before = std::signal(SIGTERM, [](int) { signals = signals + 1; });
  std::thread sender([here = ::pthread_self()] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50)); // METIS takes some hundred
    ::pthread_kill(here, SIGTERM);
  });
  std::vector<Index> order = fill_reducing_order(pattern);
  sender.join();
  std::signal(SIGTERM, before);
  EXPECT_EQ(signals, 1);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_EQ(order[i], static_cast<Index>(i));
}

/// Unit springs between all unknowns of neighbouring nodes, and to the ground one of `ground`.
SparseMatrix springs(const BlockPattern& pattern, double ground) {
  SparseMatrix matrix{&pattern, std::vector<double>(pattern.n_entries(), -1.0)};
  for (Index i = 0; i < pattern.n_dofs(); ++i) {
    const auto first = pattern.row_start[static_cast<std::size_t>(i)];
    const auto last = pattern.row_start[static_cast<std::size_t>(i) + 1];
    for (Index k = first; k < last; ++k)
      if (pattern.columns[static_cast<std::size_t>(k)] == i)
        matrix.values[static_cast<std::size_t>(k)] = last - first - 1 + ground;
  }
  return matrix;
}

TEST(LinearSolver, single_precision_serves_where_it_is_near_enough) {
  const BlockPattern pattern =
      block_pattern(box_mesh({.kind = ElementKind::hex8, .cells = {10, 10, 10}}));
  support::Random random{5};
  const std::vector<double> rhs = random.list(static_cast<std::size_t>(pattern.n_dofs()), 1.0);
  struct Expected {
    double ground;
    std::string_view method;
    double digits;
  };
  const auto exact = cholmod_of(pattern, fill_reducing_order(pattern));
  for (const double unit : {1e-30, 1.0, 1e30}) { // far beyond the squares of single precision
    LinearSolver solver(pattern, {});
    for (const auto& [ground, method, digits] :
         {Expected{1.0, "ldlt-single", 1e-8}, // a residual of 1e-10
          Expected{1e-9, "cholmod", 1e-4}}) { // a condition of 1e10, in double precision
      SparseMatrix matrix = springs(pattern, ground);
      for (double& value : matrix.values)
        value *= unit;
      std::vector<double> x(rhs.size()), reference = rhs;
      const auto report = solver.solve(matrix, true, rhs, x);
      ASSERT_TRUE(report);
      EXPECT_EQ(report->method, method) << ground << " " << unit;
      ASSERT_TRUE(exact->factorize(matrix));
      exact->solve(reference);
      double difference = 0.0, size = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        difference = std::max(difference, std::abs(x[i] - reference[i]));
        size = std::max(size, std::abs(reference[i]));
      }
      EXPECT_LE(difference, digits * size) << ground << " " << unit;
    }
  }
}

TEST(LinearSolver, a_fair_factorization_in_single_precision_is_iterated_to_the_end) {
  // A residual of 1e-3 would leave the motion of the whole body wrong by what single precision is.
  const BlockPattern pattern =
      block_pattern(box_mesh({.kind = ElementKind::hex8, .cells = {10, 10, 10}}));
  const SparseMatrix soft = springs(pattern, 1e-4);
  std::vector<double> rhs(static_cast<std::size_t>(pattern.n_dofs()), 1.0);
  rhs.front() = 2.0;
  std::vector<double> x(rhs.size()), reference = rhs;
  LinearSolver solver(pattern, {});
  const auto report = solver.solve(soft, true, rhs, x, {1e-3});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->method, "ldlt-single");
  EXPECT_LE(report->relative_residual, 1e-10);
  const auto single = single_of(pattern, fill_reducing_order(pattern));
  const auto exact = cholmod_of(pattern, fill_reducing_order(pattern));
  std::vector<double> rough = rhs;
  ASSERT_TRUE(single->factorize(soft) && exact->factorize(soft));
  single->solve(rough);
  exact->solve(reference);
  EXPECT_GT(std::abs(rough[0] / reference[0] - 1.0), 1e-3); // of little use alone
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_NEAR(x[i], reference[i], 1e-7 * reference[i]);
}

TEST(LinearSolver, single_precision_waits_longer_each_time_it_has_failed) {
  const BlockPattern pattern =
      block_pattern(box_mesh({.kind = ElementKind::hex8, .cells = {6, 6, 6}}));
  const SparseMatrix soft = springs(pattern, 1e-9);
  std::vector<double> rhs(static_cast<std::size_t>(pattern.n_dofs()), 0.0);
  rhs.front() = 1.0; // moves the whole body
  std::vector<double> x(rhs.size());
  LinearSolver solver(pattern, {});
  std::vector<long> tried;
  for (int system = 0; system < 12; ++system) {
    const long before = solver.work().factorizations;
    ASSERT_TRUE(solver.solve(soft, true, rhs, x));
    if (solver.work().factorizations == before + 2)
      tried.push_back(system);
  }
  EXPECT_EQ(tried, (std::vector<long>{0, 1, 4, 11})); // after 0, 2, 6 others
}

TEST(LinearSolver, every_backend_factorizes_anew_after_it_has_given_its_memory_back) {
  using Make = std::unique_ptr<Factorization> (*)(const BlockPattern&, std::span<const Index>);
  const Make ldlt = [](const BlockPattern& p, std::span<const Index> o) {
    return make_mumps(p, o, true);
  };
  const Make lu = [](const BlockPattern& p, std::span<const Index> o) {
    return make_mumps(p, o, false);
  };
  Problem problem(Sort::positive);
  const auto order = fill_reducing_order(problem.pattern);
  for (const Make make : {Make(&cholmod_of), Make(&single_of), ldlt, lu, Make(&make_single_mumps),
                          Make(&make_umfpack)}) {
    const auto factorization = make(problem.pattern, order);
    std::vector<double> first;
    for (int turn = 0; turn < 3; ++turn) {
      ASSERT_TRUE(factorization->factorize(problem.matrix));
      problem.x = problem.rhs;
      factorization->solve(problem.x);
      if (turn == 0)
        first = problem.x;
      EXPECT_EQ(problem.x, first); // to the bit
      factorization->release();
      factorization->release(); // nothing left: no harm
    }
  }
}

TEST(LinearSolver, single_precision_has_seven_digits_in_any_unit) {
  constexpr double digits = 1e-5;
  struct Backend {
    Sort sort;
    std::unique_ptr<Factorization> (*make)(const BlockPattern&, std::span<const Index>);
  };
  for (const auto& [sort, make] :
       {Backend{Sort::skew, &make_single_mumps}, Backend{Sort::positive, &single_of},
        Backend{Sort::indefinite, &single_of}})
    for (const double unit : {1.0, 1e30, 1e-30, 1e60}) {
      Problem problem(sort);
      for (double& value : problem.matrix.values)
        value *= unit;
      problem.refresh();
      const auto factorization = make(problem.pattern, fill_reducing_order(problem.pattern));
      ASSERT_TRUE(factorization->factorize(problem.matrix));
      problem.x = problem.rhs;
      factorization->solve(problem.x);
      EXPECT_LE(problem.error(problem.x), digits) << unit;
      EXPECT_EQ(factorization->cost().entry_size, sizeof(float));
    }
}

TEST(LinearSolver, chooses_by_what_the_matrix_is) {
  struct Expected {
    Sort sort;
    SolverChoice choice;
    std::string_view method;
  };
  for (const Expected& expected :
       {Expected{Sort::positive, SolverChoice::automatic, "ldlt-single"},
        Expected{Sort::positive, SolverChoice::cholmod, "cholmod"},
        Expected{Sort::indefinite, SolverChoice::automatic, "ldlt-single"},
        Expected{Sort::indefinite, SolverChoice::cholmod, "mumps-ldlt"},
        Expected{Sort::positive, SolverChoice::mumps, "mumps-ldlt"},
        Expected{Sort::unsymmetric, SolverChoice::automatic, "ldlt-single"},
        Expected{Sort::unsymmetric, SolverChoice::cholmod, "cholmod-gmres"},
        Expected{Sort::unsymmetric, SolverChoice::mumps, "mumps-lu"},
        Expected{Sort::skew, SolverChoice::automatic, "mumps-lu"},
        Expected{Sort::unsymmetric, SolverChoice::umfpack, "umfpack"},
        Expected{Sort::indefinite, SolverChoice::umfpack, "umfpack"}}) {
    Problem problem(expected.sort);
    LinearSolver solver(problem.pattern, {expected.choice});
    const auto report = solver.solve(
        problem.matrix, expected.sort == Sort::positive || expected.sort == Sort::indefinite,
        problem.rhs, problem.x);
    ASSERT_TRUE(report) << report.error().reason;
    EXPECT_EQ(report->method, expected.method);
    constexpr double exact = 1e-10; // residual at which an iteration ends
    const bool iterated = expected.method == "cholmod-gmres" || expected.method == "ldlt-single";
    EXPECT_LE(problem.error(problem.x), iterated ? 2.0 * exact : accuracy) << expected.method;
    EXPECT_LE(report->relative_residual, exact);
  }
}

TEST(LinearSolver, takes_away_the_coupling_that_it_is_told_of) {
  // Slip couples the tangential equation of a stiff spring to its pressure: with that coupling the
  // symmetric part is indefinite.
  Problem problem(Sort::positive);
  std::vector<EntryPart> coupling;
  for (Index i = 0; i + 1 < problem.pattern.n_dofs(); i += 6) {
    const Index row = i + 1;
    for (Index k = problem.row(i); k < problem.row(i + 1); ++k)
      if (problem.pattern.columns[static_cast<std::size_t>(k)] == i)
        problem.matrix.values[static_cast<std::size_t>(k)] = 3e4;
    for (Index k = problem.row(row); k < problem.row(row + 1); ++k)
      if (problem.pattern.columns[static_cast<std::size_t>(k)] == i)
        coupling.push_back({row, k, 0.3 * 3e4});
  }
  for (const EntryPart& part : coupling)
    problem.matrix.values[static_cast<std::size_t>(part.entry)] += part.value;
  problem.refresh();
  LinearSolver untold(problem.pattern, {});
  ASSERT_TRUE(untold.solve(problem.matrix, false, problem.rhs, problem.x));
  problem.matrix.unsymmetric = coupling;
  LinearSolver told(problem.pattern, {});
  const auto with = told.solve(problem.matrix, false, problem.rhs, problem.x);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->method, "ldlt-single");
  EXPECT_EQ(told.work().nearly_symmetric, 1);
  EXPECT_LE(told.work().substitutions, 8);
  EXPECT_GT(untold.work().substitutions, 2 * told.work().substitutions);
  constexpr double digits = 1e-8; // a residual of 1e-10 at a condition of 1e3
  EXPECT_LE(problem.error(problem.x), digits);
  std::vector<double> again(problem.x.size());
  ASSERT_TRUE(told.solve_again(problem.matrix, false, problem.rhs, again, 0.0));
  EXPECT_LE(problem.error(again), digits);
  EXPECT_EQ(told.work().factorizations, 1);
}

/// Every row with a coupling of its own is a direction in which matrix and symmetric part differ:
/// the residual hardly falls before all of them are known.
TEST(LinearSolver, has_patience_with_a_neighbour_that_differs_in_many_directions) {
  Problem problem(Sort::positive);
  const auto entry = [&](Index row, Index column) -> double& {
    for (Index k = problem.row(row); k < problem.row(row + 1); ++k)
      if (problem.pattern.columns[static_cast<std::size_t>(k)] == column)
        return problem.matrix.values[static_cast<std::size_t>(k)];
    throw std::logic_error("the rows are not coupled");
  };
  Index coupled = 0;
  for (Index i = 0; i + 1 < problem.pattern.n_dofs() && coupled < 12; i += 3, ++coupled) {
    const double size = std::sqrt(entry(i, i) * entry(i + 1, i + 1));
    entry(i, i + 1) += (0.6 + 0.05 * static_cast<double>(coupled)) * size;
    entry(i + 1, i) -= (0.6 + 0.05 * static_cast<double>(coupled)) * size;
  }
  problem.refresh();
  LinearSolver solver(problem.pattern, {});
  const auto report = solver.solve(problem.matrix, false, problem.rhs, problem.x);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->method, "ldlt-single");
  EXPECT_GT(solver.work().substitutions, 10);
  constexpr double digits = 1e-8;
  EXPECT_LE(problem.error(problem.x), digits);
}

/// A matrix that is nearly skew, with so many operations an entry that LU is tried in single
/// precision first.
struct LargeProblem {
  static constexpr double diagonal = 10.0; ///< singular values 4 to 55

  LargeProblem() {
    support::Random random{5};
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      for (Index k = row(i); k < row(i + 1); ++k) {
        const Index j = pattern.columns[static_cast<std::size_t>(k)];
        const double part = random.list(1, 1.0)[0];
        matrix.values.push_back(i == j ? diagonal : i < j ? 1.0 + part : -1.0 + part);
      }
    solution = random.list(static_cast<std::size_t>(pattern.n_dofs()), 1.0);
  }
  LargeProblem(const LargeProblem&) = delete;
  LargeProblem& operator=(const LargeProblem&) = delete;

  [[nodiscard]] Index row(Index i) const { return pattern.row_start[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::vector<double> rhs() const {
    std::vector<double> product(solution.size());
    matrix.multiply(solution, product);
    return product;
  }
  /// Makes unknowns 0 and 1 a system of their own whose determinant single precision cannot see.
  void couple_two_nearly_alike() {
    for (Index i = 0; i < pattern.n_dofs(); ++i)
      for (Index k = row(i); k < row(i + 1); ++k) {
        const Index j = pattern.columns[static_cast<std::size_t>(k)];
        if (i < 2 && j < 2)
          matrix.values[static_cast<std::size_t>(k)] =
              i == 1 && j == 1 ? 30.0 * (1.0 + 1e-9) : 30.0;
        else if (i < 2 || j < 2)
          matrix.values[static_cast<std::size_t>(k)] = 0.0;
      }
  }

  BlockPattern pattern = block_pattern(box_mesh({.kind = ElementKind::hex8, .cells = {9, 9, 9}}));
  SparseMatrix matrix{&pattern, {}};
  std::vector<double> solution;
};

/// |a - b| / |b|
double relative_distance(const std::vector<double>& a, const std::vector<double>& b) {
  const Eigen::Map<const Eigen::VectorXd> of_a(a.data(), static_cast<Index>(a.size())),
      of_b(b.data(), static_cast<Index>(b.size()));
  return (of_a - of_b).norm() / of_b.norm();
}

TEST(LinearSolver, large_unsymmetric_systems_are_solved_around_single_precision) {
  LargeProblem problem;
  LinearSolver solver(problem.pattern, {});
  const std::vector<double> rhs = problem.rhs();
  std::vector<double> x(rhs.size());
  const auto report = solver.solve(problem.matrix, false, rhs, x);
  ASSERT_TRUE(report) << report.error().reason;
  EXPECT_EQ(report->method, "mumps-lu-gmres");
  EXPECT_LE(report->relative_residual, 1e-10);
  constexpr double digits = 1.4e-9; // a residual of 1e-10 at a condition of 14
  EXPECT_LE(relative_distance(x, problem.solution), digits);
  ASSERT_TRUE(solver.solve_again(problem.matrix, false, rhs, x, 0.0));
  EXPECT_EQ(solver.work().last_method, "mumps-lu-gmres");
  EXPECT_LE(relative_distance(x, problem.solution), digits);
}

TEST(LinearSolver, double_precision_stands_in_where_single_fails) {
  LargeProblem problem;
  problem.couple_two_nearly_alike();
  LinearSolver solver(problem.pattern, {});
  const std::vector<double> rhs = problem.rhs();
  std::vector<double> x(rhs.size());
  for (int turn = 0; turn < 2; ++turn) {
    const auto report = solver.solve(problem.matrix, false, rhs, x);
    ASSERT_TRUE(report) << report.error().reason;
    EXPECT_EQ(report->method, "mumps-lu");
    EXPECT_LE(report->relative_residual, 1e-10);
  }
}

TEST(LinearSolver, comes_back_to_cholmod_after_an_indefinite_matrix) {
  Problem indefinite(Sort::indefinite);
  Problem positive(Sort::positive);
  LinearSolver solver(positive.pattern, {SolverChoice::cholmod});
  ASSERT_TRUE(solver.solve(indefinite.matrix, true, indefinite.rhs, indefinite.x));
  const auto report = solver.solve(positive.matrix, true, positive.rhs, positive.x);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->method, "cholmod");
  EXPECT_LE(positive.error(positive.x), accuracy);
}

/// Takes away what couples every n-th unknown with others.
std::vector<char> constrain_every_nth(Problem& problem, Index n) {
  std::vector<char> constrained(idx(problem.pattern.n_dofs()));
  for (Index i = 0; i < problem.pattern.n_dofs(); i += n)
    constrained[idx(i)] = 1;
  for (Index i = 0; i < problem.pattern.n_dofs(); ++i)
    for (Index k = problem.row(i); k < problem.row(i + 1); ++k) {
      const Index j = problem.pattern.columns[idx(k)];
      if (i != j && (constrained[idx(i)] != 0 || constrained[idx(j)] != 0))
        problem.matrix.values[idx(k)] = 0.0;
    }
  problem.refresh();
  return constrained;
}

TEST(LinearSolver, leaves_unknowns_that_stand_alone_out_of_its_factorizations) {
  for (const SolverChoice choice : {SolverChoice::automatic, SolverChoice::cholmod}) {
    Problem whole(Sort::positive);
    LinearSolver solver(whole.pattern, {choice});
    ASSERT_TRUE(solver.solve(whole.matrix, true, whole.rhs, whole.x));
    const double flops = solver.work().last_flops;
    for (const Index n : {Index{3}, Index{5}, Index{5}}) {
      Problem problem(Sort::positive);
      const std::vector<char> constrained = constrain_every_nth(problem, n);
      solver.set_constrained(constrained);
      ASSERT_TRUE(solver.solve(problem.matrix, true, problem.rhs, problem.x, {1e-10}));
      EXPECT_LE(problem.error(problem.x), 2e-10);
      EXPECT_LT(solver.work().last_flops, 0.9 * flops);
    }
    solver.set_constrained(std::vector<char>(idx(whole.pattern.n_dofs())));
    ASSERT_TRUE(solver.solve(whole.matrix, true, whole.rhs, whole.x));
    EXPECT_LE(whole.error(whole.x), 2e-10);
    EXPECT_EQ(solver.work().last_flops, flops);
  }
}

TEST(LinearSolver, gives_the_exact_reason_for_a_singular_matrix) {
  for (const SolverChoice choice :
       {SolverChoice::automatic, SolverChoice::cholmod, SolverChoice::mumps, SolverChoice::umfpack})
    for (const Sort sort : {Sort::positive, Sort::unsymmetric}) {
      Problem problem(sort);
      problem.scale(11, 0.0); // an unknown that nothing holds
      LinearSolver solver(problem.pattern, {choice});
      const auto report =
          solver.solve(problem.matrix, sort == Sort::positive, problem.rhs, problem.x);
      ASSERT_FALSE(report) << static_cast<int>(choice);
      EXPECT_NE(report.error().reason.find("singular"), std::string::npos) << report.error().reason;
    }
}

TEST(LinearSolver, refuses_values_that_are_not_finite) {
  for (const SolverChoice choice :
       {SolverChoice::automatic, SolverChoice::mumps, SolverChoice::umfpack}) {
    Problem problem(Sort::positive);
    problem.matrix.values[5] = std::numeric_limits<double>::quiet_NaN();
    LinearSolver solver(problem.pattern, {choice});
    EXPECT_FALSE(solver.solve(problem.matrix, false, problem.rhs, problem.x))
        << static_cast<int>(choice);
  }
}

TEST(LinearSolver, bears_unknowns_of_very_different_stiffness) {
  for (const Sort sort : {Sort::positive, Sort::unsymmetric}) {
    Problem problem(sort);
    for (Index i = 0; i < problem.pattern.n_dofs(); i += 3)
      problem.scale(i, i % 2 == 0 ? 1e4 : 1e-4);
    LinearSolver solver(problem.pattern, {});
    const auto report =
        solver.solve(problem.matrix, sort == Sort::positive, problem.rhs, problem.x);
    ASSERT_TRUE(report) << report.error().reason;
    // Condition 1e16: only the backward error can be small.
    const Eigen::Map<const Eigen::VectorXd> x(problem.x.data(), problem.pattern.n_dofs());
    const Eigen::Map<const Eigen::VectorXd> b(problem.rhs.data(), x.size());
    constexpr double rounding = 1e-14;
    EXPECT_LE((problem.dense * x - b).norm(), rounding * problem.dense.norm() * x.norm());
  }
}

TEST(LinearSolver, solves_for_a_right_hand_side_of_zero) {
  Problem problem(Sort::positive);
  std::fill(problem.rhs.begin(), problem.rhs.end(), 0.0);
  LinearSolver solver(problem.pattern, {});
  ASSERT_TRUE(solver.solve(problem.matrix, true, problem.rhs, problem.x));
  for (const double value : problem.x)
    EXPECT_EQ(value, 0.0);
}

/// Threads of this process, as the system counts them.
std::ptrdiff_t threads() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST(LinearSolver, factorizes_in_the_thread_that_asks) {
  // CHOLMOD would share its loops among four, where its OpenMP regions are not ours.
  const Problem problem(Sort::positive);
  const auto cholmod = cholmod_of(problem.pattern, fill_reducing_order(problem.pattern));
  const std::ptrdiff_t before = threads();
  ASSERT_GE(before, 1);
  ASSERT_TRUE(cholmod->factorize(problem.matrix));
  EXPECT_EQ(threads(), before);
}

} // namespace
} // namespace billet::mechanics::linear_solver_test
