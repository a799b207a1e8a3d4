#include "geometry/base/error.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace billet::mechanics::mesh_generators_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                               ElementKind::tet10};

std::vector<Vec3> nodes_of(const Mesh& mesh, Index element) {
  std::vector<Vec3> nodes;
  for (const Index node : mesh.cell(element))
    nodes.push_back(mesh.points[static_cast<std::size_t>(node)]);
  return nodes;
}

double total_measure(const Mesh& mesh) {
  double sum = 0.0;
  for (Index element = 0; element < mesh.n_elements(); ++element)
    sum += element_measure(mesh.kind, nodes_of(mesh, element));
  return sum;
}

double worst_quality(const Mesh& mesh) {
  const std::vector<double> qualities = element_qualities(mesh, mesh.points);
  return *std::min_element(qualities.begin(), qualities.end());
}

bool has_coincident_points(const Mesh& mesh) {
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : mesh.points)
    if (!places.insert({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}).second)
      return true;
  return false;
}

TEST(BoxMesh, is_sound_and_has_the_volume_of_the_box_for_every_kind) {
  for (const ElementKind kind : all_kinds) {
    const Mesh mesh = box_mesh({.kind = kind,
                                .low = {-1, 2, 3},
                                .high = {1, 5, 7},
                                .cells = {3, 4, 5},
                                .grading = {2, 0.5, 3}});
    EXPECT_TRUE(check_mesh(mesh, "", false).empty()) << name(kind);
    EXPECT_NEAR(total_measure(mesh), dimension(kind) == 2 ? 6.0 : 24.0, 1e-12) << name(kind);
    EXPECT_FALSE(has_coincident_points(mesh)) << name(kind);
  }
}

TEST(BoxMesh, has_the_expected_numbers_of_nodes_and_cells) {
  struct Expected {
    ElementKind kind;
    Index points, elements;
  };
  for (const Expected& expected :
       {Expected{ElementKind::quad4, 12, 6}, Expected{ElementKind::quad8, 29, 6},
        Expected{ElementKind::tri6, 35, 12}, Expected{ElementKind::hex8, 60, 24},
        Expected{ElementKind::hex20, 193, 24}, Expected{ElementKind::tet4, 60, 144},
        Expected{ElementKind::tet10, 315, 144}}) {
    const Mesh mesh = box_mesh({.kind = expected.kind, .cells = {2, 3, 4}});
    EXPECT_EQ(mesh.n_points(), expected.points) << name(expected.kind);
    EXPECT_EQ(mesh.n_elements(), expected.elements) << name(expected.kind);
  }
}

TEST(BoxMesh, the_last_cell_is_as_many_times_longer_as_the_grading_says) {
  const Mesh mesh = box_mesh(
      {.kind = ElementKind::quad4, .high = {10, 1, 0}, .cells = {5, 1, 1}, .grading = {4, 1, 1}});
  const auto x = [&](std::size_t i) { return mesh.points[i].x(); };
  EXPECT_NEAR((x(5) - x(4)) / (x(1) - x(0)), 4.0, 1e-12);
  EXPECT_NEAR((x(2) - x(1)) / (x(1) - x(0)), (x(3) - x(2)) / (x(2) - x(1)), 1e-12);
}

TEST(BoxMesh, one_cell_ignores_the_grading) {
  EXPECT_NEAR(total_measure(box_mesh({.kind = ElementKind::hex20, .grading = {3, 3, 3}})), 1.0,
              1e-14);
}

TEST(BoxMesh, the_named_sides_hold_exactly_the_nodes_on_them) {
  const Mesh mesh = box_mesh({.kind = ElementKind::hex20,
                              .low = {0.1, 0.2, 0.3},
                              .high = {0.7, 1.1, 1.3},
                              .cells = {2, 3, 4}});
  ASSERT_EQ(mesh.node_sets.size(), 6U);
  EXPECT_EQ(mesh.node_sets.at("x-min").size(), 4U * 5U + 3U * 5U + 4U * 4U);
  EXPECT_EQ(mesh.node_sets.at("z-max").size(), 3U * 4U + 2U * 4U + 3U * 3U);
  for (const Index node : mesh.node_sets.at("y-max"))
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(node)].y(), 1.1);
  for (const auto& [set, nodes] : mesh.node_sets)
    EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
}

TEST(BoxMesh, the_plane_has_four_sides_at_z_zero) {
  const Mesh mesh = box_mesh({.kind = ElementKind::quad8, .low = {0, 0, 5}, .high = {5, 7.5, 5}});
  EXPECT_EQ(mesh.node_sets.size(), 4U);
  for (const Vec3& point : mesh.points)
    EXPECT_EQ(point.z(), 0.0);
}

TEST(BoxMesh, impossible_boxes_are_refused) {
  const double nan = std::nan("");
  const BoxDomain good{.kind = ElementKind::hex8};
  const auto with = [&](auto change) {
    BoxDomain domain = good;
    change(domain);
    return domain;
  };
  EXPECT_THROW((void)box_mesh(with([](BoxDomain& d) { d.cells[1] = 0; })), Error);
  EXPECT_THROW((void)box_mesh(with([](BoxDomain& d) { d.cells[2] = -3; })), Error);
  EXPECT_THROW((void)box_mesh(with([](BoxDomain& d) { d.high.x() = 0.0; })), Error);
  EXPECT_THROW((void)box_mesh(with([](BoxDomain& d) { d.grading[0] = 0.0; })), Error);
  EXPECT_THROW((void)box_mesh(with([&](BoxDomain& d) { d.low.y() = nan; })), Error);
  EXPECT_THROW((void)box_mesh(with([](BoxDomain& d) { d.cells = {10000, 10000, 10000}; })), Error);
  EXPECT_THROW((void)box_mesh(with(
                   [](BoxDomain& d) { d.high.x() = std::numeric_limits<double>::infinity(); })),
               Error);
}

TEST(CylinderMesh, is_sound_and_good_for_every_sector_and_many_counts) {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10})
    for (const int sector : {90, 180, 360})
      for (const int n : {2, 3, 4, 5, 7, 10}) {
        const Mesh mesh = cylinder_mesh({.kind = kind,
                                         .radius = 5,
                                         .height = 4,
                                         .n_radius = n,
                                         .n_height = kind == ElementKind::tet10 ? n : 2,
                                         .sector = sector});
        EXPECT_TRUE(check_mesh(mesh, "", false).empty()) << name(kind) << sector << n;
        // That of tetrahedra is less in flat cells: no cell here is higher than it is wide.
        const double good = kind == ElementKind::tet10 ? 0.15 : 0.5;
        EXPECT_GT(worst_quality(mesh), good) << name(kind) << sector << " " << n;
        EXPECT_FALSE(has_coincident_points(mesh));
      }
}

TEST(CylinderMesh, has_nearly_the_volume_of_the_cylinder) {
  const double exact = std::acos(-1.0) * 25.0 * 4.0;
  for (const int sector : {90, 180, 360}) {
    const Mesh mesh = cylinder_mesh({.kind = ElementKind::hex20,
                                     .radius = 5,
                                     .height = 4,
                                     .n_radius = 4,
                                     .n_height = 3,
                                     .sector = sector});
    EXPECT_NEAR(total_measure(mesh) / (exact * sector / 360), 1.0, 5e-4);
  }
}

TEST(CylinderMesh, the_side_is_the_whole_round_boundary_and_lies_on_the_true_circle) {
  const Mesh mesh =
      cylinder_mesh({.kind = ElementKind::hex20, .radius = 3, .n_radius = 4, .sector = 360});
  const std::vector<Index>& side = mesh.node_sets.at("side");
  std::set<Index> expected;
  for (const Face& face : boundary_faces(mesh)) {
    bool flat = true;
    for (const Index node : face.nodes)
      flat = flat && mesh.points[static_cast<std::size_t>(node)].z() ==
                         mesh.points[static_cast<std::size_t>(face.nodes[0])].z();
    if (!flat)
      expected.insert(face.nodes.begin(), face.nodes.end());
  }
  EXPECT_EQ(std::vector<Index>(expected.begin(), expected.end()), side);
  for (const Index node : side) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 3.0, 1e-14);
  }
}

TEST(CylinderMesh, the_cut_planes_of_a_sector_are_exact_and_named) {
  const Mesh quarter = cylinder_mesh({.sector = 90});
  ASSERT_TRUE(quarter.node_sets.contains("x-min"));
  ASSERT_TRUE(quarter.node_sets.contains("y-min"));
  EXPECT_EQ(quarter.node_sets.at("x-min").size(), quarter.node_sets.at("y-min").size());
  for (const Vec3& p : quarter.points) {
    EXPECT_GE(p.x(), 0.0);
    EXPECT_GE(p.y(), 0.0);
    EXPECT_FALSE(p.x() > 0.0 && p.x() < 1e-6) << "a node next to the cut plane, not on it";
  }
  const Mesh half = cylinder_mesh({.sector = 180});
  EXPECT_FALSE(half.node_sets.contains("x-min"));
  EXPECT_EQ(half.node_sets.at("y-min").size(), 2 * quarter.node_sets.at("y-min").size() - 9);
  const Mesh full = cylinder_mesh({.sector = 360});
  EXPECT_EQ(full.node_sets.size(), 3U);
}

TEST(CylinderMesh, a_radius_has_the_number_of_cells_asked_for) {
  for (const int n : {2, 3, 5, 8}) {
    const Mesh mesh =
        cylinder_mesh({.kind = ElementKind::hex8, .n_radius = n, .n_height = 1, .sector = 90});
    const auto on_axis = [&](Index node) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
      return p.y() == 0.0 && p.z() == 0.0;
    };
    Index count = 0;
    for (Index node = 0; node < mesh.n_points(); ++node)
      count += on_axis(node) ? 1 : 0;
    EXPECT_EQ(count, n + 1);
  }
}

TEST(CylinderMesh, a_quarter_is_symmetric_about_its_bisector) {
  const Mesh mesh = cylinder_mesh({.n_radius = 5, .sector = 90});
  // Compared in steps of 1e-12: the cosine and the sine of 45 degrees differ by a bit.
  const auto key = [](double x, double y, double z) {
    return std::array{std::round(1e12 * x), std::round(1e12 * y), std::round(1e12 * z)};
  };
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : mesh.points)
    places.insert(key(p.x(), p.y(), p.z()));
  for (const Vec3& p : mesh.points)
    EXPECT_TRUE(places.contains(key(p.y(), p.x(), p.z())));
}

TEST(CylinderMesh, impossible_cylinders_are_refused) {
  EXPECT_THROW((void)cylinder_mesh({.kind = ElementKind::quad8}), Error);
  EXPECT_THROW((void)cylinder_mesh({.kind = ElementKind::tri6}), Error);
  EXPECT_THROW((void)cylinder_mesh({.radius = 0.0}), Error);
  EXPECT_THROW((void)cylinder_mesh({.height = -1.0}), Error);
  EXPECT_THROW((void)cylinder_mesh({.n_radius = 1}), Error);
  EXPECT_THROW((void)cylinder_mesh({.n_height = 0}), Error);
  EXPECT_THROW((void)cylinder_mesh({.sector = 45}), Error);
  EXPECT_THROW((void)cylinder_mesh({.n_radius = 1000000, .n_height = 1000000}), Error);
}

TEST(QuadraticMesh, puts_one_node_in_the_middle_of_each_edge) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Index> corners{0, 1, 2, 0, 2, 3};
  const Mesh mesh = quadratic_mesh(ElementKind::tri6, points, corners);
  EXPECT_EQ(mesh.n_points(), 9);
  EXPECT_EQ(mesh.n_elements(), 2);
  EXPECT_EQ(mesh.cell(0)[5], mesh.cell(1)[3]);
  EXPECT_TRUE(check_mesh(mesh, "", false).empty());
}

} // namespace
} // namespace billet::mechanics::mesh_generators_test
