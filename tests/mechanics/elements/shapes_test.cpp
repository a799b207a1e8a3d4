// Shape functions, integration rules and faces.

#include "mechanics/elements/elements.h"
#include "mechanics/elements/shapes.h"
#include "mechanics/equilibrium/faces.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace billet::mechanics::shapes_test {
namespace {

template <class Shape> class Shapes : public testing::Test {
protected:
  static RefPoint<Shape::dim> random_point(support::Random& random) {
    RefPoint<Shape::dim> xi{};
    for (double& value : xi)
      value = random.number(-1.0, 1.0);
    return xi;
  }
};

using AllShapes = testing::Types<Line2, Line3, Quad4, Quad8, Hex8, Hex20, Tri3, Tri6, Tet4, Tet10>;
TYPED_TEST_SUITE(Shapes, AllShapes);

constexpr double rounding = 1e-14;

TYPED_TEST(Shapes, are_1_at_their_own_node_and_0_at_the_others) {
  for (std::size_t b = 0; b < TypeParam::corners.size(); ++b) {
    const auto N = TypeParam::values(TypeParam::corners[b]);
    for (std::size_t a = 0; a < N.size(); ++a)
      EXPECT_EQ(N[a], a == b ? 1.0 : 0.0) << a << " at node " << b;
  }
}

TYPED_TEST(Shapes, sum_to_1_and_reproduce_the_position) {
  support::Random random(1);
  for (int i = 0; i < 50; ++i) {
    const auto xi = this->random_point(random);
    const auto N = TypeParam::values(xi);
    double sum = 0.0;
    RefPoint<TypeParam::dim> position{};
    for (std::size_t a = 0; a < N.size(); ++a) {
      sum += N[a];
      for (std::size_t d = 0; d < position.size(); ++d)
        position[d] += N[a] * TypeParam::corners[a][d];
    }
    EXPECT_NEAR(sum, 1.0, rounding);
    for (std::size_t d = 0; d < position.size(); ++d)
      EXPECT_NEAR(position[d], xi[d], rounding);
  }
}

TYPED_TEST(Shapes, have_the_gradients_of_their_values) {
  support::Random random(2);
  // Central differences of polynomials of degree 3 in a variable: exact but for h^2 / 6 of it.
  constexpr double h = 1e-5;
  constexpr double tolerance = 1e-9;
  for (int i = 0; i < 20; ++i) {
    const auto xi = this->random_point(random);
    const auto dN = TypeParam::gradients(xi);
    for (std::size_t d = 0; d < xi.size(); ++d) {
      auto plus = xi;
      auto minus = xi;
      plus[d] += h;
      minus[d] -= h;
      const auto high = TypeParam::values(plus);
      const auto low = TypeParam::values(minus);
      for (std::size_t a = 0; a < dN.size(); ++a)
        EXPECT_NEAR(dN[a][d], (high[a] - low[a]) / (2.0 * h), tolerance);
    }
  }
}

/// Integral of x^p y^q over the square by a rule.
template <class Rule> double moment(int p, int q) {
  double sum = 0.0;
  for (int i = 0; i < Rule::points; ++i)
    sum += Rule::weight(i) * std::pow(Rule::point(i)[0], p) * std::pow(Rule::point(i)[1], q);
  return sum;
}

double exact_moment(int p, int q) {
  const auto line = [](int n) { return n % 2 == 0 ? 2.0 / (n + 1) : 0.0; };
  return line(p) * line(q);
}

TEST(Quadrature, gauss_rules_are_exact_to_degree_2n_minus_1_and_no_further) {
  for (int p = 0; p <= 5; ++p)
    for (int q = 0; q <= 5; ++q) {
      const double exact = exact_moment(p, q);
      EXPECT_NEAR((moment<GaussRule<2, 3>>(p, q)), exact, rounding);
      if (p <= 3 && q <= 3) {
        EXPECT_NEAR((moment<GaussRule<2, 2>>(p, q)), exact, rounding);
      }
      if (p <= 1 && q <= 1) {
        EXPECT_NEAR((moment<GaussRule<2, 1>>(p, q)), exact, rounding);
      }
    }
  EXPECT_GT(std::abs(moment<GaussRule<2, 2>>(4, 0) - exact_moment(4, 0)), 0.1);
  EXPECT_GT(std::abs(moment<GaussRule<2, 3>>(6, 0) - exact_moment(6, 0)), 0.01);
}

/// Integral of a product of powers of the coordinates over the reference simplex.
double exact_simplex_moment(const std::vector<int>& powers) {
  double product = 1.0;
  int sum = static_cast<int>(powers.size());
  for (const int p : powers) {
    product *= std::tgamma(p + 1.0);
    sum += p;
  }
  return product / std::tgamma(sum + 1.0);
}

template <class Rule> double simplex_moment(const std::vector<int>& powers) {
  double sum = 0.0;
  for (int i = 0; i < Rule::points; ++i) {
    double term = Rule::weight(i);
    for (std::size_t d = 0; d < powers.size(); ++d)
      term *= std::pow(Rule::point(i)[d], powers[d]);
    sum += term;
  }
  return sum;
}

/// Largest error of a rule over all monomials of a degree.
template <class Rule> double simplex_error(std::size_t dim, int degree) {
  double worst = 0.0;
  for (int p = 0; p <= degree; ++p)
    for (int q = 0; q <= degree - p; ++q) {
      std::vector<int> powers{p, q};
      if (dim == 3)
        powers.push_back(degree - p - q);
      else if (p + q != degree)
        continue;
      worst =
          std::max(worst, std::abs(simplex_moment<Rule>(powers) - exact_simplex_moment(powers)));
    }
  return worst;
}

template <class Rule> void check_simplex_rule(std::size_t dim, int degree) {
  for (int k = 0; k <= degree; ++k)
    EXPECT_LE(simplex_error<Rule>(dim, k), rounding) << dim << " " << k;
  EXPECT_GT(simplex_error<Rule>(dim, degree + 1), 1e-5) << dim;
}

TEST(Quadrature, simplex_rules_are_exact_to_their_degree_and_no_further) {
  check_simplex_rule<SimplexRule<2, 3>>(2, 2);
  check_simplex_rule<SimplexRule<2, 6>>(2, 4);
  check_simplex_rule<SimplexRule<3, 4>>(3, 2);
}

TEST(Elements, have_as_many_points_as_their_rule) {
  EXPECT_EQ(points_per_element(ElementKind::quad4), 4);
  EXPECT_EQ(points_per_element(ElementKind::quad8), 4);
  EXPECT_EQ(points_per_element(ElementKind::hex8), 8);
  EXPECT_EQ(points_per_element(ElementKind::hex20), 8);
  EXPECT_EQ(points_per_element(ElementKind::tri6), 3);
  EXPECT_EQ(points_per_element(ElementKind::tet4), 1);
  EXPECT_EQ(points_per_element(ElementKind::tet10), 4);
}

/// Positions of a face's nodes, flat.
template <class Shape> std::vector<double> face_nodes_of(support::Random& random) {
  std::vector<double> x;
  for (const auto& corner : Shape::corners) {
    const double curve = Shape::dim == 1 ? corner[0] * corner[0] : corner[0] * corner[1];
    x.push_back(3.0 + corner[0] + random.number(-0.1, 0.1));
    x.push_back((Shape::dim == 1 ? 0.3 * curve : corner[1]) + random.number(-0.1, 0.1));
    if (Shape::dim == 2)
      x.push_back(0.3 * curve + random.number(-0.1, 0.1));
  }
  return x;
}

template <class Shape> void check_measure(Analysis analysis) {
  support::Random random(5);
  std::vector<double> x = face_nodes_of<Shape>(random);
  RefPoint<Shape::dim> xi{};
  xi.fill(0.3);
  const FacePoint<Shape> at(analysis, x.data(), xi, 0.8);
  EXPECT_NEAR(at.measure, at.area.norm(), rounding * at.measure);
  constexpr double h = 1e-6;
  constexpr double tolerance = 1e-8;
  for (std::size_t a = 0; a < Shape::nodes; ++a)
    for (std::size_t d = 0; d < Shape::dim + 1; ++d) {
      double& entry = x[a * (Shape::dim + 1) + d];
      const double kept = entry;
      entry = kept + h;
      const double high = FacePoint<Shape>(analysis, x.data(), xi, 0.8).measure;
      entry = kept - h;
      const double low = FacePoint<Shape>(analysis, x.data(), xi, 0.8).measure;
      entry = kept;
      EXPECT_NEAR(at.dmeasure[a][static_cast<Eigen::Index>(d)], (high - low) / (2.0 * h),
                  tolerance * at.measure);
    }
}

TEST(Faces, the_derivative_of_the_measure_is_exact) {
  check_measure<Line2>(Analysis::plane_strain);
  check_measure<Line3>(Analysis::plane_strain);
  check_measure<Line2>(Analysis::axisymmetric);
  check_measure<Line3>(Analysis::axisymmetric);
  check_measure<Quad4>(Analysis::solid);
  check_measure<Quad8>(Analysis::solid);
  check_measure<Tri3>(Analysis::solid);
  check_measure<Tri6>(Analysis::solid);
}

TEST(Faces, area_vectors_point_out_of_the_body) {
  for (const ElementKind kind :
       {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6, ElementKind::hex8,
        ElementKind::hex20, ElementKind::tet4, ElementKind::tet10}) {
    const Mesh mesh = box_mesh({.kind = kind, .low = {-1, -1, -1}});
    const int dim = mesh.dimension();
    for (const Face& face : boundary_faces(mesh)) {
      std::vector<double> x;
      for (const Index node : face.nodes)
        for (int i = 0; i < dim; ++i)
          x.push_back(mesh.points[static_cast<std::size_t>(node)][i]);
      visit_face(kind, [&](auto shape) {
        using Shape = decltype(shape);
        const FacePoint<Shape> at(dim == 2 ? Analysis::plane_strain : Analysis::solid, x.data(),
                                  RefPoint<Shape::dim>{}, 1.0);
        EXPECT_GT(at.area.dot(at.position), 0.0) << name(kind);
      });
    }
  }
}

} // namespace
} // namespace billet::mechanics::shapes_test
