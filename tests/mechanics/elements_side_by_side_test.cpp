// Elements that share a batch of points give what each gives alone.

#include "mechanics/bulk/element_kernel.h"
#include "tests/support/element_probe.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace billet::mechanics::elements_side_by_side_test {
namespace {

using support::ElementCase;
using support::ElementProbe;
using support::every_element;

const Material hardening_steel{support::steel, Swift{300.0, 0.01, 0.2}};

/// Elements of a kind, none like another, some flowing, some elastic, each with a past.
struct Group {
  std::vector<std::unique_ptr<ElementProbe>> probes;
  std::vector<std::vector<double>> x;

  explicit Group(const ElementCase& element) {
    for (int k = 0; k < elements_at_once(element.kind); ++k) {
      const auto X = support::distorted_nodes(element, 0.02 * (k + 1));
      auto probe = std::make_unique<ElementProbe>(element, hardening_steel, X);
      const double strain = k % 2 == 0 ? 0.01 * (k + 1) : 1e-4;
      const Vec3 stretches(1.0 + 0.4 * strain, 1.0 - strain, element.planar() ? 1.0 : 1.0 + strain);
      EXPECT_EQ(probe->commit(support::moved(X, element.dim(), stretches.asDiagonal())),
                ElementStatus::good);
      x.push_back(support::moved(probe->x(), element.dim(), stretches.asDiagonal()));
      probes.push_back(std::move(probe));
    }
  }

  ElementStatus evaluate(std::size_t count) {
    std::vector<ElementInput> in;
    std::vector<ElementOutput> out;
    std::vector<BlockPlaces> places(count);
    for (std::size_t k = 0; k < count; ++k) {
      in.push_back(probes[k]->input(x[k]));
      out.push_back(probes[k]->output(places[k]));
    }
    return probes[0]->kernel()(hardening_steel, in, out);
  }
};

double largest_difference(const std::vector<PointState>& a, const std::vector<PointState>& b) {
  double largest = 0.0;
  for (std::size_t g = 0; g < a.size(); ++g)
    largest = std::max({largest, (a[g].b_e - b[g].b_e).norm(),
                        std::abs(a[g].plastic_strain - b[g].plastic_strain)});
  return largest;
}

TEST(ElementsSideBySide, give_what_each_gives_alone) {
  for (const ElementCase& element : every_element) {
    // A place in a vector may be rounded unlike another; in space a point's decomposition may take
    // a turn more for another's sake.
    constexpr double rounding = 1e-13;
    Group alone(element);
    for (std::size_t k = 0; k < alone.probes.size(); ++k)
      ASSERT_EQ(alone.probes[k]->evaluate(alone.x[k]), ElementStatus::good);
    for (std::size_t count = 1; count <= alone.probes.size(); ++count) {
      Group together(element);
      ASSERT_EQ(together.evaluate(count), ElementStatus::good) << element.name();
      for (std::size_t k = 0; k < count; ++k) {
        const ElementProbe& one = *alone.probes[k];
        const ElementProbe& other = *together.probes[k];
        EXPECT_GT(one.force().norm(), 0.0);
        EXPECT_LE((one.force() - other.force()).norm(), rounding * one.force().norm())
            << element.name();
        EXPECT_LE((one.tangent() - other.tangent()).norm(), rounding * one.tangent().norm())
            << element.name();
        EXPECT_LE(largest_difference(one.trial(), other.trial()), rounding) << element.name();
      }
    }
  }
}

TEST(ElementsSideBySide, add_nothing_when_one_of_them_is_bad) {
  for (const ElementCase& element : every_element) {
    Group group(element);
    const std::size_t count = group.probes.size();
    group.x[count - 1] =
        support::moved(group.x[count - 1], element.dim(), Vec3(1, -1, 1).asDiagonal());
    EXPECT_EQ(group.evaluate(count), ElementStatus::inverted) << element.name();
    for (const auto& probe : group.probes)
      EXPECT_EQ(probe->tangent().norm(), 0.0) << element.name();
  }
}

TEST(ElementsSideBySide, have_the_volumes_that_each_has_alone) {
  for (const ElementCase& element : every_element) {
    const Group group(element);
    std::vector<double> x;
    std::vector<double> expected;
    for (const std::vector<double>& of_element : group.x) {
      std::vector<double> volumes(group.probes[0]->volumes().size());
      point_volumes(element.kind, element.analysis, of_element.data(), volumes);
      expected.insert(expected.end(), volumes.begin(), volumes.end());
      x.insert(x.end(), of_element.begin(), of_element.end());
    }
    std::vector<double> volumes(expected.size());
    point_volumes(element.kind, element.analysis, x.data(), volumes);
    EXPECT_EQ(volumes, expected) << element.name();
  }
}

} // namespace
} // namespace billet::mechanics::elements_side_by_side_test
