// The mixed contact element of the paper, built from its equations 11-15, against the point rules
// of the program (VALIDATION NUM-02): on flat faces both give the same stiffness and force.
//
// On linear faces the program has one rule, 2 points a direction, for both forms (C.12). Eq 15
// with a stress of the order of the displacement gives the same.
//
// On a triangle M_c is of degree 3, beyond the rule of 3 points; with all integrals by that rule
// eqs 14 and 15 give the program's element (C.25).

#include "mechanics/elements/shapes.h"
#include "tests/support/contact_bench.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

namespace billet::contact::mixed_element_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// M_c, X_c / Kp^-1 and V_F of one scalar component on a flat face of unit Jacobian.
struct Paper {
  MatrixXd M;    ///< int P^T N dA
  MatrixXd X;    ///< int P^T P dA
  VectorXd P1;   ///< int P^T dA: V_F of a tool displaced by one
  MatrixXd full; ///< int N^T N dA: the compatible element

  [[nodiscard]] MatrixXd stiffness() const { return M.transpose() * X.ldlt().solve(M); }
  [[nodiscard]] VectorXd force() const { return M.transpose() * X.ldlt().solve(P1); }
};

/// Contact stress linear in each direction: one order lower than the displacement of quadratic
/// faces, of the same order on linear ones.
std::array<double, 2> stress_line(double xi) { return {0.5 * (1.0 - xi), 0.5 * (1.0 + xi)}; }

template <class Shape> VectorXd stress_shapes(const mechanics::RefPoint<Shape::dim>& xi) {
  if constexpr (is_triangle<Shape>)
    return Eigen::Vector3d(1.0 - xi[0] - xi[1], xi[0], xi[1]);
  const auto along = stress_line(xi[0]);
  if constexpr (Shape::dim == 1)
    return Eigen::Vector2d(along[0], along[1]);
  else {
    const auto across = stress_line(xi[1]);
    return Eigen::Vector4d(along[0] * across[0], along[1] * across[0], along[0] * across[1],
                           along[1] * across[1]);
  }
}

/// Integrates over each half (quarter) with three Gauss points a direction: exact to degree 5.
template <class Shape> Paper paper_element() {
  constexpr int stresses = Shape::dim == 1 ? 2 : 4;
  const std::array<double, 3> gauss{-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
  const std::array<double, 3> weights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  Paper e{MatrixXd::Zero(stresses, Shape::nodes), MatrixXd::Zero(stresses, stresses),
          VectorXd::Zero(stresses), MatrixXd::Zero(Shape::nodes, Shape::nodes)};
  const int rows = Shape::dim == 1 ? 1 : 6;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto place = [&](int k) {
        return 0.5 * gauss[static_cast<std::size_t>(k % 3)] + (k < 3 ? -0.5 : 0.5);
      };
      const auto half = [&](int k) { return 0.5 * weights[static_cast<std::size_t>(k % 3)]; };
      mechanics::RefPoint<Shape::dim> xi{};
      xi[0] = place(i);
      double w = half(i);
      if constexpr (Shape::dim == 2) {
        xi[1] = place(j);
        w *= half(j);
      }
      const auto values = Shape::values(xi);
      const VectorXd N = Eigen::Map<const VectorXd>(values.data(), Shape::nodes);
      const VectorXd P = stress_shapes<Shape>(xi);
      e.M += w * P * N.transpose();
      e.X += w * P * P.transpose();
      e.P1 += w * P;
      e.full += w * N * N.transpose();
    }
  return e;
}

/// Adds the integrals of a face by a rule, `jacobian` its area over that of the reference.
template <class Shape, class Rule> void add_integrals(Paper& e, double jacobian) {
  for (int i = 0; i < Rule::points; ++i) {
    const auto values = Shape::values(Rule::point(i));
    const VectorXd N = Eigen::Map<const VectorXd>(values.data(), Shape::nodes);
    const VectorXd P = stress_shapes<Shape>(Rule::point(i));
    const double w = jacobian * Rule::weight(i);
    e.M += w * P * N.transpose();
    e.X += w * P * P.transpose();
    e.P1 += w * P;
    e.full += w * N * N.transpose();
  }
}

/// Half of the square of 2 x 2. The rule is exact for the products of two shape functions.
template <> Paper paper_element<mechanics::Tri3>() {
  Paper e{MatrixXd::Zero(3, 3), MatrixXd::Zero(3, 3), VectorXd::Zero(3), MatrixXd::Zero(3, 3)};
  constexpr double jacobian = 4.0;
  add_integrals<mechanics::Tri3, mechanics::SimplexRule<2, 6>>(e, jacobian);
  return e;
}

/// Half of the square of 2 x 2; the compatible element by the rule of degree 4, exact.
template <> Paper paper_element<mechanics::Tri6>() {
  Paper e{MatrixXd::Zero(3, 6), MatrixXd::Zero(3, 3), VectorXd::Zero(3), MatrixXd::Zero(6, 6)};
  Paper exact = e;
  constexpr double jacobian = 4.0;
  add_integrals<mechanics::Tri6, mechanics::SimplexRule<2, 3>>(e, jacobian);
  add_integrals<mechanics::Tri6, mechanics::SimplexRule<2, 6>>(exact, jacobian);
  // What the rule of three points is exact for.
  EXPECT_LT((e.X - exact.X).norm(), 1e-14);
  EXPECT_LT((e.P1 - exact.P1).norm(), 1e-14);
  e.full = exact.full;
  return e;
}

/// One element of 2 x 1 (x 2) on a floor: a face of unit Jacobian, skewed in its own plane; of
/// tetrahedra one face of two.
ContactBench one_face(mechanics::ElementKind kind, Form form) {
  const bool solid = mechanics::dimension(kind) == 3;
  mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3(-1, 0, -1), Vec3(1, 1, 1), {1, 1, 1}, {1, 1, 1}});
  if (solid)
    for (Vec3& p : mesh.points)
      p[0] += 0.3 * p[2];
  auto faces = faces_at(mesh, 1, 0.0);
  faces.resize(1);
  return ContactBench(std::move(mesh),
                      solid ? mechanics::Analysis::solid : mechanics::Analysis::plane_strain,
                      bench_material(),
                      one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Sticking{})),
                      {form, 3.0, 2.0}, faces);
}

/// Block of the tangent for one component over the nodes of the face.
MatrixXd face_block(const ContactBench& bench, int component) {
  const auto nodes = bench.surface.scatter().nodes(0);
  const int dim = bench.mesh.dimension();
  const MatrixXd K = bench.tangent();
  const auto n = static_cast<Eigen::Index>(nodes.size());
  MatrixXd block(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      block(a, b) = K(nodes[static_cast<std::size_t>(a)] * dim + component,
                      nodes[static_cast<std::size_t>(b)] * dim + component);
  return block;
}

std::vector<double> sunk(const ContactBench& bench, double depth) {
  std::vector<double> x = bench.x;
  for (std::size_t i = 1; i < x.size(); i += static_cast<std::size_t>(bench.mesh.dimension()))
    x[i] -= depth;
  return x;
}

Eigen::Index rank(const MatrixXd& matrix) {
  Eigen::FullPivLU<MatrixXd> lu(matrix);
  lu.setThreshold(1e-10); // rounding of entries of order 1
  return lu.rank();
}

template <class Shape> class MixedElement : public testing::Test {
public:
  static constexpr mechanics::ElementKind kind =
      std::is_same_v<Shape, mechanics::Line2>   ? mechanics::ElementKind::quad4
      : std::is_same_v<Shape, mechanics::Line3> ? mechanics::ElementKind::quad8
      : std::is_same_v<Shape, mechanics::Quad4> ? mechanics::ElementKind::hex8
      : std::is_same_v<Shape, mechanics::Tri3>  ? mechanics::ElementKind::tet4
      : std::is_same_v<Shape, mechanics::Tri6>  ? mechanics::ElementKind::tet10
                                                : mechanics::ElementKind::hex20;
};
using FaceShapes = testing::Types<mechanics::Line2,
                                  mechanics::Line3,
                                  mechanics::Quad4,
                                  mechanics::Quad8,
                                  mechanics::Tri3,
                                  mechanics::Tri6>;
TYPED_TEST_SUITE(MixedElement, FaceShapes);

TYPED_TEST(MixedElement, HasTheStiffnessOfThePointRule) {
  constexpr double tolerance = 1e-12;
  const Paper paper = paper_element<TypeParam>();
  for (const Form form : {Form::mixed, Form::compatible}) {
    ContactBench bench = one_face(TestFixture::kind, form);
    bench.assemble(sunk(bench, 1e-3), 1.0);
    const MatrixXd expected = form == Form::mixed ? paper.stiffness() : paper.full;
    const Penalty& K = bench.surface.penalty();
    const double normal = (face_block(bench, 1) / K.normal - expected).norm();
    const double tangent = (face_block(bench, 0) / K.tangent - expected).norm();
    std::printf("%-6s %-10s |k - k*| / Kp = %.1e, tangential %.1e (<= 1e-12)\n",
                std::string(mechanics::name(TestFixture::kind)).c_str(),
                form == Form::mixed ? "mixed" : "compatible", normal, tangent);
    EXPECT_LT(normal, tolerance);
    // The sheared face has tilted area derivatives of order p = 1e-3 Kp only in other blocks.
    EXPECT_LT(tangent, tolerance);
  }
}

TYPED_TEST(MixedElement, HasTheForceOfEquations14And15) {
  // q = X^-1 (M U - V_F), force M^T q: nodes displaced unevenly, floor lifted by 3e-8. So little
  // that the area keeps its size; the gap then has 8 digits.
  constexpr double tolerance = 1e-7, lift = 3e-8;
  const Paper paper = paper_element<TypeParam>();
  ContactBench bench = one_face(TestFixture::kind, Form::mixed);
  bench.tools[0].motion.offset = Vec3(0, lift, 0);
  std::vector<double> x = bench.x;
  const auto nodes = bench.surface.scatter().nodes(0);
  const int dim = bench.mesh.dimension();
  VectorXd U(TypeParam::nodes);
  for (Eigen::Index a = 0; a < U.size(); ++a) {
    U[a] = 1e-8 * std::cos(1.0 + 2.0 * static_cast<double>(a));
    x[as_size(nodes[static_cast<std::size_t>(a)] * dim + 1)] += U[a];
  }
  bench.assemble(x, 1.0);
  const VectorXd force = bench.force();
  const VectorXd expected =
      -bench.surface.penalty().normal * (paper.stiffness() * U - lift * paper.force());
  for (Eigen::Index a = 0; a < U.size(); ++a)
    EXPECT_NEAR(force[nodes[static_cast<std::size_t>(a)] * dim + 1], expected[a],
                tolerance * expected.norm());
}

TEST(MixedLine3, HasThePublishedCoefficients) {
  // num02_paper_mixed_element.csv; node order there: ends 1 and 3, middle 2.
  constexpr double tolerance = 1e-12;
  ContactBench mixed = one_face(mechanics::ElementKind::quad8, Form::mixed);
  mixed.assemble(sunk(mixed, 1e-3), 1.0);
  const MatrixXd k = face_block(mixed, 1) / mixed.surface.penalty().normal;
  ContactBench full = one_face(mechanics::ElementKind::quad8, Form::compatible);
  full.assemble(sunk(full, 1e-3), 1.0);
  const MatrixXd kf = face_block(full, 1) / full.surface.penalty().normal;
  std::printf("k11 %.12f (2/9) k22 %.12f (8/9) k12 %.12f (2/9) k13 %.12f (-1/9); full k11 %.12f "
              "(4/15)\n",
              k(0, 0), k(2, 2), k(0, 2), k(0, 1), kf(0, 0));
  EXPECT_NEAR(k(0, 0), 2.0 / 9.0, tolerance);
  EXPECT_NEAR(k(1, 1), 2.0 / 9.0, tolerance);
  EXPECT_NEAR(k(2, 2), 8.0 / 9.0, tolerance);
  EXPECT_NEAR(k(0, 2), 2.0 / 9.0, tolerance);
  EXPECT_NEAR(k(0, 1), -1.0 / 9.0, tolerance);
  EXPECT_NEAR(kf(0, 0), 4.0 / 15.0, tolerance);
  EXPECT_NEAR(kf(2, 2), 16.0 / 15.0, tolerance);
  EXPECT_NEAR(kf(0, 1), -1.0 / 15.0, tolerance);
  EXPECT_EQ(rank(k), 2);
  EXPECT_EQ(rank(kf), 3);
}

TEST(MixedTri3, HasThePointsOfAStressThatIsLinear) {
  // One sixth of the area at a corner with itself, one twelfth with another, as int N_a N_b dA is:
  // no mode of the face passes without energy, in either form. (C.12)
  constexpr double area = 2.0, tolerance = 1e-12;
  for (const Form form : {Form::mixed, Form::compatible}) {
    ContactBench bench = one_face(mechanics::ElementKind::tet4, form);
    bench.assemble(sunk(bench, 1e-3), 1.0);
    const MatrixXd k = face_block(bench, 1) / bench.surface.penalty().normal;
    EXPECT_EQ(rank(k), 3);
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        EXPECT_NEAR(k(a, b), area / (a == b ? 6.0 : 12.0), tolerance);
  }
}

TEST(MixedTri6, LetsTheCornersMoveWithoutEnergyAndNothingElse) {
  // u = 1 at the corners, 0 in the middles vanishes at the three points; so do two more quadratics.
  VectorXd mode = VectorXd::Zero(6);
  mode.head(3).setOnes();
  for (const Form form : {Form::mixed, Form::compatible}) {
    ContactBench bench = one_face(mechanics::ElementKind::tet10, form);
    bench.assemble(sunk(bench, 1e-3), 1.0);
    const MatrixXd k = face_block(bench, 1) / bench.surface.penalty().normal;
    EXPECT_EQ(rank(k), form == Form::mixed ? 3 : 6);
    if (form == Form::mixed) {
      EXPECT_NEAR(mode.dot(k * mode), 0.0, 1e-12);
    } else {
      EXPECT_GT(mode.dot(k * mode), 0.1);
    }
    // A uniform pressure: nothing at the corners, a third at each middle.
    const VectorXd force = k * VectorXd::Ones(6);
    EXPECT_NEAR(force.head(3).norm(), 0.0, 1e-12);
    EXPECT_NEAR(force[3], 2.0 / 3.0, 1e-12);
  }
}

TEST(MixedLine3, LetsTheAlternatingModePassWithoutEnergy) {
  // u = 2 at the ends, -1 in the middle vanishes at both points; the full rule resists it.
  const Eigen::Vector3d mode(2.0, 2.0, -1.0);
  for (const Form form : {Form::mixed, Form::compatible}) {
    ContactBench bench = one_face(mechanics::ElementKind::quad8, form);
    bench.assemble(sunk(bench, 1e-3), 1.0);
    const MatrixXd k = face_block(bench, 1) / bench.surface.penalty().normal;
    const double energy = mode.dot(k * mode);
    std::printf("%s: energy of the mode %.3e\n", form == Form::mixed ? "mixed" : "full", energy);
    if (form == Form::mixed) {
      EXPECT_NEAR(energy, 0.0, 1e-12);
    } else {
      EXPECT_GT(energy, 0.1);
    }
  }
}

} // namespace
} // namespace billet::contact::mixed_element_test
