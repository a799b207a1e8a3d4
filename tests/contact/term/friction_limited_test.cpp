// Points that keep changing between open, stick and slip, and get no more shear than pressure.
// (F.3)

#include "contact/term/contact_report.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace billet::contact::friction_limited_test {
namespace {

ContactBench bench_with(const BodyKind& body, double mu) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = mechanics::boundary_faces(mesh);
  return {std::move(mesh),
          body.analysis,
          bench_material(),
          one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Coulomb{mu})),
          {},
          faces};
}

std::vector<double> moved(const ContactBench& bench, double along, double down) {
  std::vector<double> x = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += i % dim == 0 ? along : i % dim == 1 ? -down : 0.0;
  return x;
}

/// Contact that opens and closes in one try until its points count as chattering.
void chatter(ContactBench& bench) {
  bench.commit(moved(bench, 0.0, 1e-4), 1.0);
  bench.term.restart();
  for (int i = 0; i <= chattering_changes; ++i)
    bench.assemble(moved(bench, 0.0, i % 2 == 0 ? -1e-2 : 0.0), 2.0);
}

TEST(FrictionLimited, IsToldWhereTheLawWouldGiveMoreShear) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, 10.0);
    chatter(bench);
    ASSERT_TRUE(bench.term.restart_friction_limited()) << body.name();
    bench.assemble(moved(bench, 0.0, 0.0), 2.0);
    EXPECT_FALSE(friction_limit_bears(bench.term)) << body.name() << ": nothing slides";
    bench.assemble(moved(bench, 1e-2, 0.0), 2.0);
    EXPECT_TRUE(friction_limit_bears(bench.term)) << body.name();
    bench.term.restart();
    bench.assemble(moved(bench, 1e-2, 0.0), 2.0);
    EXPECT_FALSE(friction_limit_bears(bench.term)) << body.name() << ": no point is limited";
  }
}

TEST(FrictionLimited, IsNotToldWhereTheLawAsksForLess) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = bench_with(body, 0.3);
    chatter(bench);
    ASSERT_TRUE(bench.term.restart_friction_limited()) << body.name();
    bench.assemble(moved(bench, 1e-2, 0.0), 2.0);
    EXPECT_FALSE(friction_limit_bears(bench.term)) << body.name();
  }
}

} // namespace
} // namespace billet::contact::friction_limited_test
