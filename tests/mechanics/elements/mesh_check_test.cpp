#include "geometry/mesh3d/solid_quality.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace billet::mechanics::mesh_check_test {
namespace {

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet4,
                               ElementKind::tet10};

/// One cell from its corners, mid-side nodes in the middles.
std::vector<Vec3> cell(ElementKind kind, const std::vector<Vec3>& corners) {
  std::vector<Vec3> nodes = corners;
  if (is_quadratic(kind))
    for (const auto& [a, b] : element_edges(kind))
      nodes.emplace_back(
          0.5 * (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]));
  return nodes;
}

std::vector<Vec3> ideal(ElementKind kind) {
  const double h = std::sqrt(3.0) / 2.0;
  switch (kind) {
  case ElementKind::tri6:
    return cell(kind, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}});
  case ElementKind::tet4:
  case ElementKind::tet10:
    return cell(kind, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3, std::sqrt(2.0 / 3.0)}});
  case ElementKind::quad4:
  case ElementKind::quad8:
    return cell(kind, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  default:
    return cell(
        kind,
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
  }
}

Mesh one_cell(ElementKind kind, std::vector<Vec3> nodes) {
  Mesh mesh{.kind = kind, .points = std::move(nodes), .cells = {}, .node_sets = {}};
  for (Index i = 0; i < mesh.n_points(); ++i)
    mesh.cells.push_back(i);
  return mesh;
}

std::string complaints(const Mesh& mesh, bool axisymmetric = false) {
  std::string text;
  for (const Complaint& complaint : check_mesh(mesh, "part.msh", axisymmetric))
    text += complaint.text() + "\n";
  return text;
}

TEST(ElementQuality, aspect_is_the_longest_over_the_shortest_edge) {
  const std::vector<Vec3> flat{Vec3(0, 0, 0), Vec3(6, 0, 0), Vec3(6, 2, 0), Vec3(0, 2, 0)};
  EXPECT_NEAR(element_aspect(ElementKind::quad4, flat), 3.0, 1e-14);
  EXPECT_NEAR(element_quality(ElementKind::quad4, flat), 1.0, 1e-14) << "its angles are right";
  EXPECT_TRUE(std::isinf(element_aspect(ElementKind::quad4, std::vector<Vec3>(4, Vec3::Zero()))));
  const Mesh bricks =
      box_mesh({ElementKind::hex20, Vec3::Zero(), Vec3(4, 1, 2), {1, 1, 1}, {1, 1, 1}});
  EXPECT_NEAR(largest_aspect(bricks, bricks.points), 4.0, 1e-14);
}

TEST(ElementQuality, is_one_for_the_ideal_cell) {
  for (const ElementKind kind : all_kinds)
    EXPECT_NEAR(element_quality(kind, ideal(kind)), 1.0, 1e-14) << name(kind);
}

TEST(ElementQuality, does_not_see_size_place_or_turn) {
  const Mat3 turn = Eigen::Matrix3d{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::tet10}) {
    std::vector<Vec3> nodes = ideal(kind);
    nodes[1] += Vec3(0.1, 0.05, 0.02);
    const double before = element_quality(kind, nodes);
    for (Vec3& node : nodes)
      node = 1e-3 * (turn * node) + Vec3(5, 6, 7);
    EXPECT_NEAR(element_quality(kind, nodes), before, 1e-9) << name(kind);
  }
}

TEST(ElementQuality, of_a_rhombus_is_the_sine_of_its_angle) {
  const double angle = 0.6;
  const Vec3 side(std::cos(angle), std::sin(angle), 0.0);
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8}) {
    const auto nodes = cell(kind, {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX() + side, side});
    EXPECT_NEAR(element_quality(kind, nodes), std::sin(angle), 1e-14);
  }
}

TEST(ElementQuality, is_minus_one_for_the_ideal_cell_turned_inside_out) {
  for (const ElementKind kind : all_kinds) {
    std::vector<Vec3> nodes = ideal(kind);
    for (Vec3& node : nodes)
      node.x() = -node.x();
    EXPECT_NEAR(element_quality(kind, nodes), -1.0, 1e-14) << name(kind);
    EXPECT_LT(element_measure(kind, nodes), 0.0);
    EXPECT_LT(smallest_jacobian(kind, nodes), 0.0);
  }
}

TEST(ElementQuality, is_zero_where_a_corner_is_flat) {
  const auto nodes = cell(ElementKind::quad4, {{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {0, 1, 0}});
  EXPECT_NEAR(element_quality(ElementKind::quad4, nodes), 0.0, 1e-15);
}

TEST(ElementQuality, falls_steadily_to_zero_as_a_mid_side_node_nears_the_quarter_point) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex20}) {
    const auto at = static_cast<std::size_t>(corners_per_element(kind));
    double before = 1.1;
    for (const double x : {0.5, 0.4, 0.3, 0.26, 0.25, 0.2}) {
      std::vector<Vec3> nodes = ideal(kind);
      nodes[at].x() = x;
      const double quality = element_quality(kind, nodes);
      EXPECT_LT(quality, before);
      EXPECT_NEAR(quality, std::min(1.0, 4.0 * x - 1.0), 1e-14);
      before = quality;
    }
  }
}

TEST(ElementQuality, of_a_tet10_is_the_one_that_remeshing_in_space_goes_by) {
  support::Random random{7};
  int turned = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vec3> nodes(10);
    std::array<Vec3, 4> corners;
    std::array<Vec3, 6> middles;
    constexpr std::array<std::array<std::size_t, 2>, 6> ends{
        {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    const auto off = [&](double size) {
      const std::vector<double> x = random.list(3, size);
      return Vec3(x[0], x[1], x[2]);
    };
    for (std::size_t a = 0; a < 4; ++a)
      nodes[a] = corners[a] =
          (a > 0 ? Vec3(Vec3::Unit(static_cast<int>(a) - 1)) : Vec3(Vec3::Zero())) + off(0.2);
    for (std::size_t e = 0; e < 6; ++e)
      nodes[4 + e] = middles[e] = 0.5 * (corners[ends[e][0]] + corners[ends[e][1]]) + off(0.1);
    const double quality = element_quality(ElementKind::tet10, nodes);
    turned += quality < 0.0 ? 1 : 0;
    EXPECT_NEAR(geometry::bent_quality(corners, middles), quality, 1e-14);
  }
  EXPECT_GT(turned, 0);
  EXPECT_LT(turned, 150);
}

TEST(ElementQuality, of_a_cell_that_is_nowhere_is_minus_one) {
  std::vector<Vec3> nodes = ideal(ElementKind::hex8);
  nodes[3].y() = std::nan("");
  EXPECT_EQ(element_quality(ElementKind::hex8, nodes), -1.0);
  EXPECT_EQ(element_quality(ElementKind::quad4, std::vector<Vec3>(4, Vec3::Zero())), 0.0);
}

TEST(ElementQuality, is_given_for_displaced_nodes_too) {
  const Mesh mesh = box_mesh({.kind = ElementKind::quad4, .cells = {2, 1, 1}});
  std::vector<Vec3> points = mesh.points;
  points[0] = Vec3(0.4, 0.9, 0.0);
  const std::vector<double> qualities = element_qualities(mesh, points);
  ASSERT_EQ(qualities.size(), 2U);
  EXPECT_LT(qualities[0], 0.0);
  EXPECT_NEAR(qualities[1], 1.0, 1e-14);
}

TEST(ElementMeasure, is_exact_for_curved_sides) {
  std::vector<Vec3> nodes = ideal(ElementKind::quad8);
  nodes[4].y() -= 0.3; // a parabola of height 0.3 over a chord of 1: area 2/3 * 0.3
  EXPECT_NEAR(element_measure(ElementKind::quad8, nodes), 1.2, 1e-14);
  std::vector<Vec3> triangle = cell(ElementKind::tri6, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  triangle[3].y() -= 0.3;
  EXPECT_NEAR(element_measure(ElementKind::tri6, triangle), 0.7, 1e-14);
  EXPECT_NEAR(element_measure(ElementKind::tet10, ideal(ElementKind::tet10)),
              1.0 / (6.0 * std::sqrt(2.0)), 1e-15);
}

TEST(CellsInSingleFile, are_bricks_of_hex20_with_all_other_faces_free) {
  const auto found = [](int ny, int nz, auto is_held) {
    const Mesh mesh = box_mesh(
        {.kind = ElementKind::hex20, .low = {0, 0, 0}, .high = {4, 1, 1}, .cells = {4, ny, nz}});
    std::vector<char> held;
    for (const Vec3& p : mesh.points)
      held.push_back(is_held(p) ? 1 : 0);
    return cells_in_single_file(mesh, held).size();
  };
  const auto nowhere = [](const Vec3&) { return false; };
  EXPECT_EQ(found(1, 1, nowhere), 4U);
  EXPECT_EQ(found(1, 1, [](const Vec3& p) { return p.x() == 0.0; }), 4U) << "a clamp at the end";
  EXPECT_EQ(found(1, 1, [](const Vec3& p) { return p.y() == 0.0; }), 0U) << "a plane of symmetry";
  EXPECT_EQ(found(2, 1, nowhere), 0U);
  EXPECT_EQ(found(1, 2, nowhere), 0U);
  const Mesh linear = box_mesh({.kind = ElementKind::hex8, .high = {4, 1, 1}, .cells = {4, 1, 1}});
  EXPECT_TRUE(cells_in_single_file(linear, std::vector<char>(linear.points.size())).empty());
}

TEST(CheckMesh, finds_nothing_wrong_with_a_good_mesh) {
  for (const ElementKind kind : all_kinds)
    EXPECT_EQ(complaints(one_cell(kind, ideal(kind)), true), "") << name(kind);
  EXPECT_NO_THROW(
      require_sound_mesh(one_cell(ElementKind::hex8, ideal(ElementKind::hex8)), "", true));
}

TEST(CheckMesh, names_an_inverted_element_and_its_centre) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad4, .high = {4, 1, 0}, .cells = {4, 1, 1}});
  std::swap(mesh.cells[9], mesh.cells[11]);
  const std::string text = complaints(mesh);
  EXPECT_NE(text.find("part.msh: element number 2 (counted from 0, quad4, centre (2.5, 0.5)) is "
                      "turned inside out"),
            std::string::npos)
      << text;
  EXPECT_THROW(require_sound_mesh(mesh, "", false), Error);
}

TEST(CheckMesh, names_elements_and_nodes_by_the_labels_of_their_file) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad4, .high = {4, 1, 0}, .cells = {4, 1, 1}});
  std::swap(mesh.cells[9], mesh.cells[11]);
  MeshLabels labels{{}, {1001, 1002, 1005, 1007}};
  for (Index node = 0; node < mesh.n_points(); ++node)
    labels.nodes.push_back(5000 + node);
  const auto says = [&](bool axisymmetric, const std::string& wanted) {
    const std::vector<Complaint> found = check_mesh(mesh, "part.inp", axisymmetric, labels);
    ASSERT_FALSE(found.empty());
    EXPECT_NE(found.front().text().find(wanted), std::string::npos) << found.front().text();
  };
  says(false, "part.inp: element 1005 (quad4, centre (2.5, 0.5)) is turned inside out");
  mesh.points[3].x() = -1.0;
  says(true, "part.inp: node 5003 at (-1, 0) has a negative radius");
  mesh.points[3].x() = 3.0;
  mesh.cells[1] = mesh.cells[0];
  says(false, "element 1001 (quad4, centre (0.25, 0.5)) has node 5000 twice");
}

TEST(CheckMesh, finds_a_mid_side_node_beyond_the_quarter) {
  std::vector<Vec3> nodes = ideal(ElementKind::hex20);
  nodes[9].y() = 0.8;
  const std::string text = complaints(one_cell(ElementKind::hex20, nodes));
  EXPECT_NE(text.find("beyond the quarter"), std::string::npos) << text;
}

TEST(CheckMesh, finds_a_cell_without_volume) {
  std::vector<Vec3> nodes = ideal(ElementKind::hex8);
  for (Vec3& node : nodes)
    node.z() = 0.0;
  EXPECT_NE(complaints(one_cell(ElementKind::hex8, nodes)).find("collapsed"), std::string::npos);
}

TEST(CheckMesh, finds_wrong_node_numbers_and_numbers_given_twice) {
  Mesh mesh = one_cell(ElementKind::quad4, ideal(ElementKind::quad4));
  mesh.cells[2] = 7;
  EXPECT_NE(complaints(mesh).find("names node 7"), std::string::npos);
  mesh.cells[2] = -1;
  EXPECT_NE(complaints(mesh).find("names node -1"), std::string::npos);
  mesh.cells[2] = 1;
  EXPECT_NE(complaints(mesh).find("has node number 1 (counted from 0) twice"), std::string::npos);
  mesh.cells.pop_back();
  EXPECT_NE(complaints(mesh).find("whole quad4"), std::string::npos);
  EXPECT_NE(complaints(Mesh{}).find("no elements"), std::string::npos);
  mesh = one_cell(ElementKind::quad4, ideal(ElementKind::quad4));
  mesh.node_sets["top"] = {2, 4};
  EXPECT_NE(complaints(mesh).find("\"top\""), std::string::npos);
}

TEST(CheckMesh, finds_coordinates_that_are_no_numbers_or_off_the_plane) {
  Mesh mesh = one_cell(ElementKind::quad4, ideal(ElementKind::quad4));
  mesh.points[1].z() = 0.5;
  EXPECT_NE(complaints(mesh).find("not in the plane"), std::string::npos);
  mesh.points[1].z() = std::nan("");
  EXPECT_NE(complaints(mesh).find("not a number"), std::string::npos);
}

TEST(CheckMesh, a_negative_radius_is_wrong_only_in_an_axisymmetric_scene) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad8, .low = {-1, 0, 0}, .high = {1, 1, 0}});
  EXPECT_EQ(complaints(mesh, false), "");
  EXPECT_NE(complaints(mesh, true).find("negative radius"), std::string::npos);
  for (Vec3& point : mesh.points)
    point.x() += 1.0 - 1e-13;
  EXPECT_EQ(complaints(mesh, true), "") << "rounding is not a mistake";
}

TEST(CheckMesh, spells_out_ten_complaints_of_a_sort_and_counts_the_rest) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad4, .cells = {25, 1, 1}});
  for (std::size_t i = 0; i < mesh.cells.size(); i += 4)
    std::swap(mesh.cells[i + 1], mesh.cells[i + 3]);
  EXPECT_EQ(check_mesh(mesh, "", false).size(), 11U);
  EXPECT_NE(complaints(mesh).find("and 15 more"), std::string::npos);
}

TEST(CheckMesh, nodes_without_an_element_are_found_and_can_be_dropped) {
  Mesh mesh = box_mesh({.kind = ElementKind::quad4});
  mesh.points.insert(mesh.points.begin(), Vec3(9, 9, 0));
  for (Index& node : mesh.cells)
    ++node;
  mesh.node_sets = {{"a", {0, 1, 4}}};
  EXPECT_NE(complaints(mesh).find("1 nodes belong to no element"), std::string::npos);
  EXPECT_EQ(drop_unused_points(mesh), 1);
  EXPECT_EQ(complaints(mesh), "");
  EXPECT_EQ(mesh.node_sets.at("a"), (std::vector<Index>{0, 3}));
  EXPECT_EQ(drop_unused_points(mesh), 0);
}

} // namespace
} // namespace billet::mechanics::mesh_check_test
