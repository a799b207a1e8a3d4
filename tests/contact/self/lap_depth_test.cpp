// Depth of laps in space: two blocks that are one behind a root, the walls of their slit marked.

#include "contact/self/laps.h"
#include "contact/self/self_search.h"
#include "mechanics/bulk/bulk.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace billet::contact::lap_depth_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;

/// Where the blocks' slit at y = 0 reaches, and how much of it has met.
struct Slit {
  double root = 4.0;  ///< the blocks are one below this x [mm]
  double mouth = 7.0; ///< they end there [mm]
  double width = 20.0;
  double met_from = -HUGE_VAL; ///< x at which marks begin [mm]
  double open_from = HUGE_VAL; ///< x at which the walls do not touch any more [mm]
  bool walled = false;         ///< planes of symmetry at both ends of the width
};

mechanics::Mesh slit_block(ElementKind kind, const Slit& slit) {
  const std::array<int, 3> cells{static_cast<int>(slit.mouth), 2, static_cast<int>(slit.width)};
  mechanics::Mesh both =
      mechanics::box_mesh({kind, Vec3(0, 0, 0), Vec3(slit.mouth, 2, slit.width), cells, {1, 1, 1}});
  const mechanics::Mesh below = mechanics::box_mesh(
      {kind, Vec3(0, -2, 0), Vec3(slit.mouth, 0, slit.width), cells, {1, 1, 1}});
  std::vector<Index> number;
  for (const Vec3& p : below.points) {
    const auto same = std::find_if(both.points.begin(), both.points.end(),
                                   [&](const Vec3& q) { return (p - q).norm() < 1e-9; });
    const bool one = p.x() < slit.root + 1e-9 && same != both.points.end();
    number.push_back(one ? static_cast<Index>(same - both.points.begin()) : both.n_points());
    if (!one)
      both.points.push_back(p);
  }
  for (const Index node : below.cells)
    both.cells.push_back(number[static_cast<std::size_t>(node)]);
  return both;
}

/// All nodes of a face have this coordinate in common.
bool lies_across(const mechanics::Mesh& mesh, const mechanics::Face& face, Index axis) {
  const auto at = [&](Index node) { return mesh.points[static_cast<std::size_t>(node)][axis]; };
  return std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index node) {
    return std::abs(at(node) - at(face.nodes.front())) < 1e-9;
  });
}

std::vector<Lap> laps_of(ElementKind kind, const Slit& slit) {
  const mechanics::Mesh mesh = slit_block(kind, slit);
  const mechanics::BlockPattern pattern = mechanics::block_pattern(mesh);
  const mechanics::Bulk bulk(mesh, mechanics::Analysis::solid, bench_material(), pattern);
  std::vector<mechanics::Face> faces = mechanics::boundary_faces(mesh);
  if (slit.walled)
    faces.erase(std::remove_if(faces.begin(), faces.end(),
                               [&](const auto& face) { return lies_across(mesh, face, 2); }),
                faces.end());
  const std::vector<double> x = flat_positions(mesh);
  const ContactSurface surface(mesh, bulk, pattern, faces, {});
  std::array<std::vector<Index>, 2> walls; // the upper block's and the lower one's
  const auto is_upper = [&](const mechanics::Face& face) {
    return face.element < mesh.n_elements() / 2;
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (std::abs(mesh.points[static_cast<std::size_t>(faces[f].nodes.front())].y()) < 1e-9 &&
        lies_across(mesh, faces[f], 1))
      walls[is_upper(faces[f]) ? 0 : 1].push_back(static_cast<Index>(f));
  SelfContactState state;
  state.points.resize(surface.n_points());
  state.laps_since = {0.0};
  std::vector<Vec3> at(surface.n_points());
  surface.positions(x, at);
  const auto n = static_cast<std::size_t>(surface.points());
  for (std::size_t side = 0; side < 2; ++side)
    for (const Index face : walls[side])
      for (std::size_t k = static_cast<std::size_t>(face) * n;
           k < static_cast<std::size_t>(face + 1) * n; ++k)
        if (at[k].x() > slit.met_from) {
          SelfPoint& point = state.points[k];
          point.lap = 0;
          if (at[k].x() > slit.open_from)
            continue;
          const SelfFoot foot = find_foot(surface, x, walls[1 - side], at[k]);
          point.face = foot.face;
          point.xi = foot.place.xi;
        }
  return laps(surface, state, x);
}

double depth_of(ElementKind kind, const Slit& slit) {
  const std::vector<Lap> found = laps_of(kind, slit);
  EXPECT_EQ(found.size(), 1U);
  return found.at(0).depth;
}

class LapDepthInSpace : public testing::TestWithParam<ElementKind> {};

TEST_P(LapDepthInSpace, IsThatFromTheMouthToTheRoot) {
  EXPECT_NEAR(depth_of(GetParam(), {4.0, 7.0, 20.0}), 3.0, 0.3);
}

/// The sides of a lap may be open: a slab's, or a thin sector's between planes of symmetry.
TEST_P(LapDepthInSpace, OfOneDeeperThanLongIsNotItsLength) {
  EXPECT_NEAR(depth_of(GetParam(), {2.0, 12.0, 2.0}), 10.0, 0.3);
  Slit sector{2.0, 12.0, 2.0};
  sector.walled = true;
  EXPECT_NEAR(depth_of(GetParam(), sector), 10.0, 0.3);
}

/// What is left of it at the root closed, or nothing: the walls have met all the same.
TEST_P(LapDepthInSpace, StaysWhereItOpensAgain) {
  for (const double open_from : {0.0, 5.5}) {
    Slit slit{4.0, 7.0, 20.0};
    slit.open_from = open_from;
    EXPECT_NEAR(depth_of(GetParam(), slit), 3.0, 0.3) << open_from;
  }
}

/// A hollow at the root, and blocks that are apart: what has met is measured from mouth to mouth.
TEST_P(LapDepthInSpace, LeavesOutAHollowAtTheRoot) {
  Slit slit{1.0, 8.0, 20.0};
  slit.met_from = 4.0;
  EXPECT_NEAR(depth_of(GetParam(), slit), 4.0, 0.3);
  Slit apart{-1.0, 4.0, 20.0};
  EXPECT_NEAR(depth_of(GetParam(), apart), 4.0, 0.3);
}

/// Walls that hang together at one end only of a long lap.
TEST_P(LapDepthInSpace, DoesNotGoAlongALongLap) {
  Slit slit{-1.0, 4.0, 20.0};
  slit.walled = true;
  EXPECT_NEAR(depth_of(GetParam(), slit), 4.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         LapDepthInSpace,
                         testing::Values(ElementKind::hex8, ElementKind::hex20, ElementKind::tet10),
                         [](const auto& kind) { return std::string(mechanics::name(kind.param)); });

} // namespace
} // namespace billet::contact::lap_depth_test
