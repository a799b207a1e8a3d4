#include "mechanics/elements/mesh_locator.h"
#include "mechanics/mesh/mesh_generators.h"
#include "mechanics/transfer/rate_gradient.h"
#include "tests/support/transfer_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace billet::mechanics::rate_gradient_test {
namespace {

std::vector<RateGradient> gradients(const Mesh& mesh,
                                    const std::function<double(const Vec3&)>& rate) {
  const std::vector<Vec3> positions = integration_points(mesh, node_positions(mesh));
  std::vector<double> rates;
  for (const Vec3& x : positions)
    rates.push_back(rate(x));
  return rate_gradients(mesh, positions, rates, std::vector<double>(rates.size(), 0.7));
}

TEST(RateGradient, OfALinearFieldIsExact) {
  for (const ElementKind kind : support::transfer_kinds) {
    const bool plane = dimension(kind) == 2;
    const Vec3 steepness(0.3, 0.4, plane ? 0.0 : 1.2);
    double sum = 0.0, squares = 0.0;
    const auto rate = [&](const Vec3& x) {
      const double r = 2.0 + steepness.dot(x);
      sum += r;
      squares += r * r;
      return r;
    };
    const Mesh mesh = box_mesh({.kind = kind, .high = {2.0, 1.0, 1.0}, .cells = {4, 3, 2}});
    const std::vector<RateGradient> found = gradients(mesh, rate);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(mesh.n_elements())) << name(kind);
    for (const RateGradient& flow : found)
      EXPECT_NEAR(flow.length, squares / sum / steepness.norm(), 1e-10 * flow.length) << name(kind);
  }
}

TEST(RateGradient, DoesNotSeeLevelFlowOrMetalAtRest) {
  const Mesh mesh = box_mesh({.kind = ElementKind::tri6, .cells = {3, 3, 1}});
  for (const RateGradient& flow : gradients(mesh, [](const Vec3&) { return 5.0; }))
    EXPECT_GT(flow.length, 1e10);
  EXPECT_TRUE(gradients(mesh, [](const Vec3&) { return 0.0; }).empty());
}

TEST(RateGradient, IsThatOfTheFlowHoweverMuchRestsAroundIt) {
  const auto shear = [](const Vec3& x) { return std::max(0.0, 1.0 - x.x()); };
  const auto steepest = [&](int cells) {
    const auto length = static_cast<double>(cells) / 8.0;
    const Mesh mesh =
        box_mesh({.kind = ElementKind::quad8, .high = {length, 1.0, 0.0}, .cells = {cells, 2, 1}});
    double least = 1e300;
    for (const RateGradient& flow : gradients(mesh, shear))
      least = std::min(least, flow.length);
    return least;
  };
  EXPECT_NEAR(steepest(16), 2.0 / 3.0, 0.01); // the integral of (1 - x)^2 over that of 1 - x
  EXPECT_NEAR(steepest(80), steepest(16), 1e-12);
}

} // namespace
} // namespace billet::mechanics::rate_gradient_test
