// What must not change the answer: numbers of nodes, mirror images, rotations, threads.
// VALIDATION NUM-05.

#include "tests/support/figures.h"
#include "tests/support/problems.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace billet::process::mechanics_invariance_test {
namespace {

using mechanics::Analysis;
using mechanics::ElementKind;

/// How the scene is described; the physics is the same.
struct Telling {
  Mat3 Q = Mat3::Identity(); ///< orthogonal; a reflection mirrors the mesh
  bool renumbered = false;
};

/// Local numbers of a cell seen in a mirror across x: corners and mid-sides swap.
std::vector<std::size_t> mirrored_order(ElementKind kind) {
  switch (kind) {
  case ElementKind::quad4:
    return {1, 0, 3, 2};
  case ElementKind::quad8:
    return {1, 0, 3, 2, 4, 7, 6, 5};
  case ElementKind::tri6:
    return {1, 0, 2, 3, 5, 4};
  case ElementKind::tet10:
    return {1, 0, 2, 3, 4, 6, 5, 8, 7, 9};
  case ElementKind::hex8:
    return {1, 0, 3, 2, 5, 4, 7, 6};
  default:
    return {1, 0, 3, 2, 5, 4, 7, 6, 8, 11, 10, 9, 12, 15, 14, 13, 17, 16, 19, 18};
  }
}

/// New number of each node: a fixed shuffle.
std::vector<Index> shuffle(Index n) {
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  support::Random random(99);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(random.number(0.0, static_cast<double>(i)))]);
  return order;
}

mechanics::Mesh
told(mechanics::Mesh mesh, const Telling& telling, const std::vector<Index>& number) {
  mechanics::Mesh result{mesh.kind, mesh.points, mesh.cells, {}};
  for (std::size_t a = 0; a < mesh.points.size(); ++a)
    result.points[static_cast<std::size_t>(number[a])] = telling.Q * mesh.points[a];
  const bool mirrored = telling.Q.determinant() < 0.0;
  const auto order = mirrored_order(mesh.kind);
  const auto size = order.size();
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
    const std::size_t from = mirrored ? i - i % size + order[i % size] : i;
    result.cells[i] = number[static_cast<std::size_t>(mesh.cells[from])];
  }
  for (const auto& [name, nodes] : mesh.node_sets)
    for (const Index node : nodes)
      result.node_sets[name].push_back(number[static_cast<std::size_t>(node)]);
  return result;
}

/// What holds the block at its bottom (y = 0).
enum class Below { clamp, die };

/// A block pressed and dragged along x by a flat die with friction on its top. Between two dies
/// nothing else holds it, and all that touches has a gap that is zero but for rounding.
Scene block(ElementKind kind,
            const Telling& telling,
            const std::vector<Index>& number,
            Below below = Below::clamp) {
  const bool solid = mechanics::dimension(kind) == 3;
  Scene scene;
  scene.part.analysis = solid ? Analysis::solid : Analysis::plane_strain;
  const auto mesh =
      mechanics::box_mesh({.kind = kind,
                           .high = {3, 2, 2},
                           .cells = solid ? std::array{3, 2, 2} : std::array{6, 5, 1}});
  std::vector<mechanics::Face> top;
  scene.part.mesh = told(mesh, telling, number);
  const Mat3 back = telling.Q.transpose();
  scene.part.contact_faces = support::faces_where(scene.part.mesh, [&](const Vec3& p) {
    return std::abs(std::abs((back * p)[1] - 1.0) - 1.0) < 1e-9;
  });
  scene.material = {{200e3, 0.3}, mechanics::Linear{300.0, 500.0}};
  contact::Tool die;
  die.name = "die";
  const Vec3 normal(0.0, -1.0, 0.0);
  die.surface = geometry::make_plane(telling.Q * Vec3(0, 2, 0), telling.Q * normal);
  die.motion.velocity = telling.Q * Vec3(0.2, -1.0, solid ? 0.1 : 0.0);
  die.friction = contact::Coulomb{0.2};
  scene.tools.push_back(std::move(die));
  if (below == Below::die) {
    contact::Tool anvil;
    anvil.name = "anvil";
    anvil.surface = geometry::make_plane(Vec3::Zero(), telling.Q * -normal);
    anvil.friction = contact::Sticking{};
    scene.tools.push_back(std::move(anvil));
  } else {
    for (int c = 0; c < scene.part.mesh.dimension(); ++c)
      support::support(scene, "y-min", c);
  }
  scene.touch.assign(scene.tools.size(), 0);
  scene.touch.front() = 1;
  support::one_stage(scene, 0.3, 10);
  return scene;
}

struct Result {
  std::vector<int> iterations;
  std::vector<double> positions; ///< numbered and turned back
  Vec3 force = Vec3::Zero();
  std::vector<double> raw; ///< as computed
};

Result
pressed(ElementKind kind, const Telling& telling, Index n_points, Below below = Below::clamp) {
  std::vector<Index> number(static_cast<std::size_t>(n_points));
  std::iota(number.begin(), number.end(), 0);
  if (telling.renumbered)
    number = shuffle(n_points);
  Process process(block(kind, telling, number, below));
  support::Recorder recorder;
  support::run_to_end(process, recorder);
  Result result;
  for (const auto& report : recorder.reports)
    result.iterations.push_back(report.iterations);
  const Mat3 back = telling.Q.transpose();
  for (const Index node : number) {
    const Vec3 p = back * (process.view().mesh().points[static_cast<std::size_t>(node)] +
                           support::displacement(process, node));
    result.positions.insert(result.positions.end(), p.begin(), p.end());
  }
  result.force = back * process.view().contact()->loads()[0].force;
  result.raw.assign(process.view().positions().begin(), process.view().positions().end());
  EXPECT_GT(process.view().state.energy.friction, 0.0);
  EXPECT_GT(process.view().state.energy.plastic, 0.0);
  return result;
}

Index n_points(ElementKind kind) {
  const std::vector<Index> number(10000); // more than there are; only counted
  std::vector<Index> identity(number.size());
  std::iota(identity.begin(), identity.end(), 0);
  return block(kind, {}, identity).part.mesh.n_points();
}

constexpr double tolerance = 1e-9; // VALIDATION NUM-05
constexpr std::array kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                           ElementKind::hex8,  ElementKind::hex20, ElementKind::tet10};

void check_same(ElementKind kind,
                const std::string& what,
                const Telling& telling,
                Below below = Below::clamp) {
  const Index n = n_points(kind);
  const Result reference = pressed(kind, {}, n, below);
  const Result result = pressed(kind, telling, n, below);
  EXPECT_EQ(result.iterations, reference.iterations) << what;
  ASSERT_EQ(result.positions.size(), reference.positions.size());
  double worst = (result.force - reference.force).norm() / reference.force.norm();
  for (std::size_t i = 0; i < result.positions.size(); ++i)
    worst = std::max(worst, std::abs(result.positions[i] - reference.positions[i]));
  support::show_error("NUM-05", std::string(mechanics::name(kind)) + " " + what, worst, tolerance);
  EXPECT_LE(worst, tolerance) << what;
}

TEST(Invariance, NUM_05_numbers_of_nodes_do_not_matter) {
  for (const ElementKind kind : kinds)
    check_same(kind, "renumbered", {Mat3::Identity(), true});
}

TEST(Invariance, NUM_05_a_mirror_image_behaves_like_the_original) {
  for (const ElementKind kind : kinds)
    check_same(kind, "mirrored", {Vec3(-1, 1, 1).asDiagonal(), false});
}

TEST(Invariance, NUM_05_a_model_turned_by_37_degrees_behaves_like_the_original) {
  for (const ElementKind kind : kinds) {
    const Vec3 axis = mechanics::dimension(kind) == 2 ? Vec3::UnitZ().eval() : Vec3(0.3, -1.0, 0.5);
    check_same(kind, "turned 37 deg", {support::rotation(axis, 37.0 * support::degree), false});
  }
}

TEST(Invariance, NUM_05_a_block_that_lies_between_two_dies_does_not_see_the_rounding_of_its_gaps) {
  const Mat3 turned = support::rotation(Vec3::UnitZ(), 37.0 * support::degree);
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::tri6, ElementKind::hex8})
    check_same(kind, "between dies, turned 37 deg", {turned, false}, Below::die);
}

TEST(Invariance, NUM_05_1_and_2_threads_give_the_same_bits) {
  for (const ElementKind kind : kinds) {
    std::vector<Result> results;
    for (const std::size_t threads : {1U, 2U}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      results.push_back(pressed(kind, {}, n_points(kind)));
    }
    EXPECT_EQ(results[0].raw, results[1].raw) << mechanics::name(kind);
    EXPECT_EQ(results[0].force, results[1].force);
  }
}

} // namespace
} // namespace billet::process::mechanics_invariance_test
