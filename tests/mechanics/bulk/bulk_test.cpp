#include "mechanics/bulk/bulk.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/figures.h"
#include "tests/support/patch.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <numbers>
#include <numeric>

namespace billet::mechanics::bulk_test {
namespace {

using support::every_element;
using support::flat;

/// A bulk on a mesh, with a system to assemble into.
struct Body {
  Body(Mesh mesh_in, Analysis analysis, const Material& material)
      : mesh(std::move(mesh_in)), pattern(block_pattern(mesh)),
        bulk(mesh, analysis, material, pattern),
        X(flat(mesh)), system{{&pattern, std::vector<double>(pattern.n_entries())},
                              std::vector<double>(X.size())} {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  [[nodiscard]] Outcome<Assembled> assemble(const std::vector<double>& x) {
    system.clear();
    return bulk.assemble({0.0, 1.0, X, x}, system);
  }
  void commit(const std::vector<double>& x) {
    ASSERT_TRUE(assemble(x));
    bulk.commit({0.0, 1.0, X, x});
  }
  /// Positions with random displacements of up to `half`.
  [[nodiscard]] std::vector<double> shaken(unsigned seed, double half) const {
    support::Random random(seed);
    std::vector<double> x = X;
    for (double& value : x)
      value += random.number(-half, half);
    return x;
  }

  Mesh mesh;
  BlockPattern pattern;
  Bulk bulk;
  std::vector<double> X;
  System system;
};

Mesh small_mesh(ElementKind kind) {
  return box_mesh({.kind = kind, .low = {1, 0, 0}, .high = {3, 2, 2}, .cells = {2, 2, 2}});
}

const Material elastic_steel{support::steel, Elastic{}};
const Material plastic_steel{support::steel, Linear{300.0, 500.0}};

TEST(Bulk, forces_of_an_elastic_body_are_the_gradient_of_its_energy) {
  constexpr double tolerance = 1e-7; // central differences of an energy
  for (const auto& element : every_element) {
    Body body(small_mesh(element.kind), element.analysis, elastic_steel);
    // Tetrahedra are half as large as the hexahedra.
    const std::vector<double> x = body.shaken(1, element.kind == ElementKind::tet10 ? 0.02 : 0.05);
    const std::vector<double> direction = support::Random(2).list(x.size(), 1.0);
    ASSERT_TRUE(body.assemble(x));
    const double power =
        std::inner_product(direction.begin(), direction.end(), body.system.residual.begin(), 0.0);
    const auto energy = [&](double h) {
      Body fresh(small_mesh(element.kind), element.analysis, elastic_steel);
      std::vector<double> moved = x;
      for (std::size_t i = 0; i < x.size(); ++i)
        moved[i] += h * direction[i];
      fresh.commit(moved);
      return fresh.bulk.elastic_energy(moved).sum();
    };
    constexpr double h = 1e-5;
    const double difference = (energy(h) - energy(-h)) / (2.0 * h);
    support::show("bulk", element.name() + " dE", difference, power);
    EXPECT_NEAR(difference, power, tolerance * std::abs(power)) << element.name();
    EXPECT_TRUE(body.system.symmetric);
    EXPECT_LE(body.system.tangent.asymmetry(), 1e-13);
  }
}

TEST(Bulk, the_volume_is_that_of_the_body) {
  for (const auto& element : every_element) {
    Body body(small_mesh(element.kind), element.analysis, elastic_steel);
    const double exact = element.analysis == Analysis::axisymmetric ? std::numbers::pi * 8.0 * 2.0
                         : element.planar()                         ? 4.0
                                                                    : 8.0;
    EXPECT_NEAR(body.bulk.volume(body.X), exact, 1e-12) << element.name();
    const Mat3 F = Vec3(1.1, 0.7, 1.2).asDiagonal();
    const double ratio = element.analysis == Analysis::axisymmetric ? 1.1 * 1.1 * 0.7
                         : element.planar()                         ? 1.1 * 0.7
                                                                    : 1.1 * 0.7 * 1.2;
    EXPECT_NEAR(body.bulk.volume(support::moved(body.X, element.dim(), F)), exact * ratio, 1e-12);
  }
}

TEST(Bulk, only_commit_changes_the_history) {
  for (const auto& element : every_element) {
    Body body(small_mesh(element.kind), element.analysis, plastic_steel);
    const std::vector<double> x = body.shaken(3, 0.05);
    ASSERT_TRUE(body.assemble(x));
    EXPECT_GT(body.bulk.largest_plastic_increment(), 0.0);
    EXPECT_EQ(body.bulk.states()[0].plastic_strain, 0.0);
    EXPECT_EQ(body.bulk.plastic_work(), 0.0);
    const std::vector<double> first = body.system.residual;
    const std::vector<double> values = body.system.tangent.values;
    ASSERT_TRUE(body.assemble(body.shaken(4, 0.05)));
    ASSERT_TRUE(body.assemble(x)); // repeats to the bit
    EXPECT_EQ(first, body.system.residual);
    EXPECT_EQ(values, body.system.tangent.values);
    body.bulk.commit({0.0, 1.0, body.X, x});
    EXPECT_GT(body.bulk.states()[0].plastic_strain, 0.0);
    EXPECT_GT(body.bulk.plastic_work(), 0.0);
  }
}

TEST(Bulk, plastic_work_is_summed_over_the_reference_volume) {
  Body body(small_mesh(ElementKind::hex8), Analysis::solid, plastic_steel);
  body.commit(support::moved(body.X, 3, Vec3(1.1, 0.953, 0.953).asDiagonal()));
  const double strain = body.bulk.states()[0].plastic_strain;
  const double exact = 8.0 * (300.0 * strain + 0.5 * 500.0 * strain * strain);
  EXPECT_NEAR(body.bulk.plastic_work(), exact, 1e-10 * exact);
}

TEST(Bulk, names_the_first_inverted_element_and_recovers) {
  Body body(small_mesh(ElementKind::quad4), Analysis::plane_strain, elastic_steel);
  ASSERT_TRUE(body.assemble(body.X));
  std::vector<double> x = body.X;
  // The corner of the last element through its opposite corner.
  const auto corner = static_cast<std::size_t>(body.mesh.cell(3)[2]) * 2;
  x[corner] -= 1.5;
  x[corner + 1] -= 1.5;
  const auto outcome = body.assemble(x);
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().reason.find("element 3 "), std::string::npos) << outcome.error().reason;
  EXPECT_TRUE(body.assemble(body.X));
}

// Enough elements for several tasks in each colour.
TEST(Bulk, NUM_05_assembles_the_same_bits_with_1_and_2_threads) {
  for (const ElementKind kind :
       {ElementKind::quad8, ElementKind::hex8, ElementKind::tri6, ElementKind::tet10}) {
    const Mesh mesh = box_mesh({.kind = kind, .cells = {20, 20, dimension(kind) == 3 ? 3 : 1}});
    const Analysis analysis = dimension(kind) == 3 ? Analysis::solid : Analysis::plane_strain;
    std::vector<std::vector<double>> residuals;
    std::vector<std::vector<double>> tangents;
    for (const std::size_t threads : {1U, 2U, 2U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Body body(mesh, analysis, plastic_steel);
      ASSERT_TRUE(body.assemble(body.shaken(5, 0.003)));
      EXPECT_GT(body.bulk.largest_plastic_increment(), 0.0);
      residuals.push_back(body.system.residual);
      tangents.push_back(body.system.tangent.values);
    }
    for (std::size_t i = 1; i < residuals.size(); ++i) {
      EXPECT_EQ(residuals[i], residuals[0]) << name(kind);
      EXPECT_EQ(tangents[i], tangents[0]) << name(kind);
    }
  }
}

} // namespace
} // namespace billet::mechanics::bulk_test
