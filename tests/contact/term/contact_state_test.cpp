#include "contact/term/contact_state.h"
#include "contact/term/contact_term.h"
#include "geometry/base/archive.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace billet::contact::contact_state_test {
namespace {

/// A body on a floor that it slides on, some increments old.
ContactBench sliding_bench(const BodyKind& body) {
  mechanics::Mesh mesh = bench_mesh(body);
  const auto faces = mechanics::boundary_faces(mesh);
  ContactBench bench(std::move(mesh), body.analysis, bench_material(),
                     one_tool(still_tool(geometry::make_plane({0, 0, 0}, {0, 1, 0}), Coulomb{0.1})),
                     {}, faces);
  return bench;
}

std::vector<double> moved(const ContactBench& bench, double along, double down) {
  std::vector<double> x = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += i % dim == 0   ? along
            : i % dim == 1 ? -down * (1.0 + 0.1 * static_cast<double>(i))
                           : 0.0;
  return x;
}

/// Two increments, then the middle of a third one.
void slide(ContactBench& bench) {
  bench.commit(moved(bench, 0.0, 1e-4), 1.0);
  bench.term.restart();
  bench.commit(moved(bench, 1e-2, 1e-5), 2.0);
  bench.term.restart();
  bench.term.predict(moved(bench, 1e-2, 1e-5));
  bench.assemble(moved(bench, 2e-3, 3e-5), 3.0);
  bench.term.augment();
  bench.term.stiffen(3.0);
}

mechanics::System assembled(ContactBench& bench, ContactTerm& term, const std::vector<double>& x) {
  mechanics::System system = bench.system;
  system.clear();
  EXPECT_TRUE(term.assemble({bench.time_old, 3.0, bench.x, x}, system).has_value());
  return system;
}

void expect_same(const mechanics::System& one,
                 const mechanics::System& other,
                 const std::string& where) {
  EXPECT_EQ(one.residual, other.residual) << where;
  EXPECT_EQ(one.tangent.values, other.tangent.values) << where;
  EXPECT_EQ(one.contact_changes, other.contact_changes) << where;
}

TEST(ContactState, CopiedWithinAnIncrementGivesTheSameSystem) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = sliding_bench(body);
    slide(bench);
    const std::vector<double> x = moved(bench, 5e-3, 4e-5);
    ContactTerm copy = bench.term;
    ContactTerm later = bench.term;
    const mechanics::System system = assembled(bench, bench.term, x);
    ASSERT_GT(*std::max_element(system.residual.begin(), system.residual.end()), 0.0);
    expect_same(system, assembled(bench, copy, x), body.name());
    bench.term.commit({bench.time_old, 3.0, bench.x, x});
    expect_same(system, assembled(bench, later, x), body.name() + ", after the other's commit");
  }
}

TEST(ContactState, StoredWithinAnIncrementGoesOnWithTheSameBits) {
  for (const BodyKind& body : body_kinds()) {
    ContactBench bench = sliding_bench(body);
    slide(bench);
    ArchiveWriter writer;
    writer(bench.term);
    const std::string bytes = writer.take();
    ContactTerm resumed(bench.surface, bench.bulk, bench.pattern, bench.tools, ContactBench::reach);
    ArchiveReader reader(bytes);
    reader(resumed);
    EXPECT_TRUE(reader.at_end());
    const std::vector<double> x = moved(bench, 5e-3, 4e-5);
    expect_same(assembled(bench, bench.term, x), assembled(bench, resumed, x), body.name());
    bench.term.commit({bench.time_old, 3.0, bench.x, x});
    resumed.commit({bench.time_old, 3.0, bench.x, x});
    EXPECT_EQ(bench.term.work().friction, resumed.work().friction) << body.name();
    EXPECT_EQ(bench.term.loads()[0].force, resumed.loads()[0].force) << body.name();
    ArchiveWriter one, other;
    one(bench.term);
    other(resumed);
    EXPECT_EQ(one.bytes(), other.bytes()) << body.name();
  }
}

} // namespace
} // namespace billet::contact::contact_state_test
