// Contact of a part with itself: two blocks of one mesh, unlike in their elements, pressed
// together.

#include "contact/self/self_contact_term.h"
#include "mechanics/linear/coupled_solver.h"
#include "tests/support/contact_bench.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <tuple>

namespace billet::contact::self_contact_test {
namespace {

/// Two meshes as one; no node in common.
mechanics::Mesh together(mechanics::Mesh first, const mechanics::Mesh& second) {
  const mechanics::Index shift = first.n_points();
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (const mechanics::Index node : second.cells)
    first.cells.push_back(node + shift);
  return first;
}

/// A block above another one that is wider and has other elements.
mechanics::Mesh two_blocks(const BodyKind& body, double gap) {
  const mechanics::Mesh upper = bench_mesh(body);
  const mechanics::Mesh lower = mechanics::box_mesh(
      {body.kind, Vec3(0.7, -1.0 - gap, -0.2), Vec3(3.4, -gap, 1.2), {3, 1, 1}, {1, 1, 1}});
  return together(upper, lower);
}

class SelfBench {
public:
  SelfBench(mechanics::Mesh both,
            mechanics::Analysis analysis,
            const Friction& law,
            const ContactSettings& settings)
      : mesh(std::move(both)), pattern(mechanics::block_pattern(mesh)), friction(law),
        bulk(mesh, analysis, {{200e3, 0.3}, mechanics::Linear{150.0, 2e4}}, pattern),
        surface(mesh, bulk, pattern, mechanics::boundary_faces(mesh), settings),
        term(surface, bulk, friction), x(flat_positions(mesh)) {
    system.tangent.pattern = &pattern;
    system.tangent.values.resize(pattern.n_entries());
    system.residual.resize(x.size());
    bulk_system = system;
    term.start(x);
  }
  void assemble(const std::vector<double>& trial, double time) {
    bulk_system.clear();
    system.clear();
    ASSERT_TRUE(bulk.assemble({time_old, time, x, trial}, bulk_system).has_value());
    ASSERT_TRUE(term.assemble({time_old, time, x, trial}, system).has_value());
  }
  void commit(const std::vector<double>& trial, double time) {
    assemble(trial, time);
    bulk.commit({time_old, time, x, trial});
    term.commit({time_old, time, x, trial});
    x = trial;
    time_old = time;
  }
  /// The forces alone at a trial, and how many points have changed.
  [[nodiscard]] Eigen::VectorXd
  force_at(const std::vector<double>& trial, double time, int& changes) {
    system.clear();
    system.forces_only = true;
    EXPECT_TRUE(term.assemble({time_old, time, x, trial}, system).has_value());
    system.forces_only = false;
    changes += system.contact_changes;
    return force();
  }
  [[nodiscard]] Eigen::VectorXd force() const {
    return -Eigen::Map<const Eigen::VectorXd>(system.residual.data(), pattern.n_dofs());
  }
  [[nodiscard]] Eigen::MatrixXd tangent() const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(pattern.n_dofs(), pattern.n_dofs());
    for (const mechanics::Coupling& coupling : system.couplings)
      K(coupling.row, coupling.column) += coupling.value;
    return K;
  }
  [[nodiscard]] int count(Status status) const {
    int n = 0;
    for (const SelfTraction& traction : term.tractions())
      n += traction.law.status == status ? 1 : 0;
    return n;
  }

  mechanics::Mesh mesh;
  mechanics::BlockPattern pattern;
  Friction friction;
  mechanics::Bulk bulk;
  ContactSurface surface;
  SelfContactTerm term;
  std::vector<double> x;
  double time_old = 0.0;
  mechanics::System system, bulk_system;
};

/// All nodes shaken, and the upper block moved: it drifts over the other and down on it.
std::vector<double> shaken(const SelfBench& bench,
                           const BodyKind& body,
                           double size,
                           const Vec2& move,
                           std::mt19937& generator) {
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  std::vector<double> moved = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  const std::size_t upper = bench_mesh(body).points.size() * dim;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] += size * component(generator);
    if (i < upper && i % dim < 2)
      moved[i] += move[static_cast<Eigen::Index>(i % dim)];
  }
  return moved;
}

constexpr double apart = 0.02; // [mm]
const Vec2 down(0.0, -0.04);

using Choice = std::tuple<int, Form>;

class SelfContactTangent : public testing::TestWithParam<Choice> {};

TEST_P(SelfContactTangent, AgreesWithDifferencesOfTheResidual) {
  const auto [kind, form] = GetParam();
  const BodyKind& body = body_kinds()[static_cast<std::size_t>(kind)];
  int stick = 0, slip = 0;
  double worst = 0.0;
  for (const NamedLaw& law : every_law())
    for (const double drift : {0.0, 0.05}) {
      const bool few = body.solid() && law.first != "coulomb" && law.first != "viscoplastic";
      if (law.second.tensor || few) // the laws are the same in space, and take long
        continue;
      SelfBench bench(two_blocks(body, apart), body.analysis, law.second,
                      {form, 1.0, 0.7, Method::penalty, {}, {}});
      std::mt19937 generator(18);
      bench.commit(shaken(bench, body, 2e-3, down, generator), 1.0);
      bench.commit(shaken(bench, body, 2e-3, {drift, 0.0}, generator), 2.0);
      const std::vector<double> trial = shaken(bench, body, 2e-3, {drift, 0.0}, generator);
      bench.assemble(trial, 3.0);
      const Eigen::MatrixXd K = bench.tangent();
      stick += bench.count(Status::stick);
      slip += bench.count(Status::slip);
      double best = std::numeric_limits<double>::infinity();
      for (const double h : {1e-7, 1e-6, 1e-8}) {
        Eigen::MatrixXd D(K.rows(), K.cols());
        int changes = 0;
        for (Eigen::Index j = 0; j < K.cols(); ++j) {
          std::vector<double> at = trial;
          at[static_cast<std::size_t>(j)] += h;
          const Eigen::VectorXd above = bench.force_at(at, 3.0, changes);
          at[static_cast<std::size_t>(j)] -= 2.0 * h;
          D.col(j) = (bench.force_at(at, 3.0, changes) - above) / (2.0 * h);
        }
        if (changes == 0)
          best = std::min(best, (D - K).norm() / K.norm());
        if (best < 1e-6)
          break;
      }
      EXPECT_LT(best, 1e-6) << body.name() << ' ' << law.first << " drift " << drift;
      worst = std::max(worst, best);
    }
  std::printf("%-20s %-10s stick %4d slip %4d: largest error %.1e (<= 1e-6)\n", body.name().c_str(),
              form == Form::mixed ? "mixed" : "compatible", stick, slip, worst);
  EXPECT_GT(stick, 0);
  EXPECT_GT(slip, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         SelfContactTangent,
                         testing::Combine(testing::Range(0, 10),
                                          testing::Values(Form::mixed, Form::compatible)));

class SelfContact : public testing::TestWithParam<int> {
protected:
  const BodyKind& body = body_kinds()[static_cast<std::size_t>(GetParam())];
};

/// In axisymmetry forces along the radius balance around the turn.
TEST_P(SelfContact, ForcesOfAPairAddUpToNothing) {
  SelfBench bench(two_blocks(body, apart), body.analysis, Coulomb{0.3},
                  {Form::mixed, 1.0, 0.7, Method::penalty, {}, {}});
  std::mt19937 generator(5);
  const int dim = bench.mesh.dimension();
  bench.commit(shaken(bench, body, 2e-3, down, generator), 1.0);
  bench.commit(shaken(bench, body, 2e-3, {0.03, 0.0}, generator), 2.0);
  bench.assemble(shaken(bench, body, 2e-3, {0.01, 0.0}, generator), 3.0);
  const Eigen::VectorXd force = bench.force();
  ASSERT_GT(force.norm(), 1.0);
  for (int d = 0; d < dim; ++d) {
    double sum = 0.0;
    for (Eigen::Index i = d; i < force.size(); i += dim)
      sum += force[i];
    EXPECT_LT(std::abs(sum), 1e-12 * force.norm());
  }
}

/// Pair and tools alike: what is carried along as one rigid body feels the same forces, turned.
TEST_P(SelfContact, ARigidMotionChangesNothing) {
  if (body.analysis == mechanics::Analysis::axisymmetric)
    GTEST_SKIP() << "it does not turn";
  const ContactSettings settings{Form::mixed, 1.0, 0.7, Method::penalty, {}, {}};
  SelfBench still(two_blocks(body, apart), body.analysis, Coulomb{0.3}, settings);
  SelfBench moved(two_blocks(body, apart), body.analysis, Coulomb{0.3}, settings);
  const int dim = still.mesh.dimension();
  const Vec3 axis = dim == 2 ? Vec3(0, 0, 1) : Vec3(0.3, 0.9, -0.4).normalized();
  const auto turned = [&](const std::vector<double>& x, double angle) {
    const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    std::vector<double> y = x;
    for (std::size_t i = 0; i < x.size(); i += static_cast<std::size_t>(dim)) {
      Vec3 v = Vec3::Zero();
      for (int d = 0; d < dim; ++d)
        v[d] = x[i + static_cast<std::size_t>(d)];
      v = R * v + angle * Vec3(10.0, -4.0, dim == 2 ? 0.0 : 3.0);
      for (int d = 0; d < dim; ++d)
        y[i + static_cast<std::size_t>(d)] = v[d];
    }
    return y;
  };
  std::mt19937 generator(7);
  double time = 0.0;
  for (int step = 1; step <= 4; ++step) {
    time += 1.0;
    const std::vector<double> x =
        shaken(still, body, 1e-3, step == 1 ? down : Vec2(0.004, 0.0), generator);
    still.commit(x, time);
    moved.commit(turned(x, 0.2 * step), time);
    const Eigen::VectorXd a = still.force(), b = moved.force();
    const Eigen::VectorXd carried = Eigen::Map<const Eigen::VectorXd>(
        turned({a.data(), a.data() + a.size()}, 0.2 * step).data(), a.size());
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(a.size());
    const std::vector<double> origin =
        turned(std::vector<double>(static_cast<std::size_t>(a.size()), 0.0), 0.2 * step);
    for (Eigen::Index i = 0; i < a.size(); ++i)
      shift[i] = origin[static_cast<std::size_t>(i)];
    EXPECT_LT((carried - shift - b).norm(), 1e-9 * a.norm()) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SelfContact, testing::Range(0, 10));

/// The lower face of a thin plate lies right behind the upper one, and is not met through it.
TEST(SelfContactSearch, AThinWallIsNoContact) {
  const BodyKind body = body_kinds()[1];
  mechanics::Mesh plate =
      mechanics::box_mesh({body.kind, Vec3(0, 0, 0), Vec3(10, 0.1, 1), {40, 1, 1}, {1, 1, 1}});
  SelfBench bench(plate, body.analysis, Frictionless{}, {});
  EXPECT_FALSE(bench.term.state().any_ahead);
  bench.commit(bench.x, 1.0);
  bench.commit(bench.x, 2.0);
  EXPECT_FALSE(bench.term.state().any_ahead);
  EXPECT_TRUE(bench.system.couplings.empty());
}

/// What goes through a face in one increment, faster than was looked ahead, is found.
TEST(SelfContactSearch, APassageIsFound) {
  const BodyKind body = body_kinds()[0];
  SelfBench bench(two_blocks(body, 3.0), body.analysis, Frictionless{}, {});
  const auto lifted = [&](double by) {
    std::vector<double> x = bench.x;
    for (std::size_t i = 13; i < x.size(); i += 2) // the lower block comes second
      x[i] += by;
    return x;
  };
  const std::vector<double> before = lifted(2.0), through = lifted(3.2);
  EXPECT_FALSE(bench.term.passage({0.0, 1.0, bench.x, before}).has_value());
  EXPECT_TRUE(bench.term.passage({0.0, 1.0, bench.x, through}).has_value());
}

} // namespace
} // namespace billet::contact::self_contact_test
