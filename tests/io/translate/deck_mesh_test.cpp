// Meshes of decks in the kinds of elements that a case has.

#include "geometry/base/error.h"
#include "io/translate/deck_mesh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace billet::io::deck_mesh_test {
namespace {

using Numbers = std::vector<DeckNumber>;

struct Element {
  const char* type;
  Numbers nodes;
};

Deck deck_of(const std::vector<Vec3>& points, const std::vector<Element>& elements) {
  Deck deck;
  for (std::size_t i = 0; i < points.size(); ++i)
    deck.nodes[static_cast<DeckNumber>(i + 1)] = points[i];
  for (std::size_t i = 0; i < elements.size(); ++i) {
    DeckElement& element = deck.elements[static_cast<DeckNumber>(i + 1)];
    element.type = elements[i].type;
    element.nodes = elements[i].nodes;
  }
  return deck;
}

DeckMesh only_body(const Deck& deck) { return mesh_of(deck, deck_bodies(deck).at(0)); }

/// Of all corners of tetrahedra or triangles.
double size_of(const DeckMesh& mesh, bool plane) {
  double sum = 0.0;
  for (const auto& [number, nodes] : mesh.elements) {
    const Vec3 &a = mesh.nodes.at(nodes[0]), &b = mesh.nodes.at(nodes[1]),
               &c = mesh.nodes.at(nodes[2]);
    const double size = plane ? (b - a).cross(c - a).z() / 2.0
                              : (b - a).cross(c - a).dot(mesh.nodes.at(nodes[3]) - a) / 6.0;
    EXPECT_GT(size, 0.0) << number;
    sum += size;
  }
  return sum;
}

/// A brick 2 x 1 x 1 with half of another one next to it, a wedge: numbers in no order.
const std::vector<Vec3> brick_and_wedge{{2, 0, 0}, {0, 0, 0}, {2, 1, 0}, {0, 1, 0}, {2, 0, 1},
                                        {0, 0, 1}, {2, 1, 1}, {0, 1, 1}, {3, 0, 0}, {3, 0, 1}};

TEST(DeckMesh, DividesWedgesAndBricksIntoTetrahedraThatFit) {
  const Deck deck =
      deck_of(brick_and_wedge, {{"C3D8", {2, 1, 3, 4, 6, 5, 7, 8}}, {"C3D6", {1, 9, 3, 5, 10, 7}}});
  const DeckMesh mesh = only_body(deck);
  EXPECT_EQ(mesh.element, "tet10");
  EXPECT_EQ(mesh.type, "C3D10");
  EXPECT_EQ(mesh.elements.size(), 6U + 3U);
  EXPECT_NEAR(size_of(mesh, false), 2.5, 1e-12);
  // Faces that are used once are those outside: five of the brick and four of the wedge.
  EXPECT_EQ(mesh.boundary.size(), 5U * 2U + 2U * 2U + 2U);
  EXPECT_NE(mesh.remark.find("C3D6, C3D8 are divided into tet10"), std::string::npos)
      << mesh.remark;
  for (const auto& [number, nodes] : mesh.elements)
    EXPECT_EQ(std::set<DeckNumber>(nodes.begin(), nodes.end()).size(), 10U);
}

TEST(DeckMesh, GivesSetsTheNewNodesOfTheirFacesOnly) {
  const Deck deck = deck_of(brick_and_wedge, {{"C3D8I", {2, 1, 3, 4, 6, 5, 7, 8}}});
  const DeckMesh mesh = only_body(deck);
  EXPECT_EQ(mesh.element, "hex20");
  EXPECT_EQ(mesh.added.size(), 12U);
  EXPECT_EQ(mesh.nodes.size(), 20U);
  const auto on_plane = [&](const Numbers& set, int axis, double at) {
    return std::all_of(set.begin(), set.end(),
                       [&](DeckNumber node) { return mesh.nodes.at(node)[axis] == at; });
  };
  const Numbers face = mesh.set_of({2, 4, 6, 8}); // x = 0
  EXPECT_EQ(face.size(), 8U);
  EXPECT_TRUE(on_plane(face, 0, 0.0));
  EXPECT_EQ(mesh.set_of({2, 1}).size(), 3U) << "an edge";
  // Both ends, not the edges between them: those hold nothing.
  EXPECT_EQ(mesh.set_of({2, 4, 6, 8, 1}).size(), 9U);
  EXPECT_EQ(mesh.set_of({2, 9}), (Numbers{2})) << "a node of no element is not there";
}

TEST(DeckMesh, GivesLinearTrianglesAndTetrahedraMiddleNodes) {
  const DeckMesh tetrahedron = only_body(deck_of(brick_and_wedge, {{"C3D4", {2, 1, 4, 6}}}));
  EXPECT_EQ(tetrahedron.element, "tet10");
  EXPECT_NEAR(size_of(tetrahedron, false), 2.0 / 6.0, 1e-12);
  const Deck plane = deck_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                             {{"CAX4", {1, 2, 3, 4}}, {"CAX3", {2, 5, 3}}});
  const DeckMesh mixed = only_body(plane);
  EXPECT_EQ(mixed.element, "tri6");
  EXPECT_EQ(mixed.type, "CAX6");
  EXPECT_NEAR(size_of(mixed, true), 1.5, 1e-12);
  EXPECT_EQ(mixed.boundary.size(), 5U);
}

/// Bricks that collapse, into wedges and quadrilaterals into triangles.
TEST(DeckMesh, DividesElementsThatCollapse) {
  const DeckMesh bricks =
      only_body(deck_of(brick_and_wedge, {{"C3D8I", {2, 1, 3, 4, 6, 5, 7, 8}},
                                          {"C3D8I", {1, 9, 3, 3, 5, 10, 7, 7}}}));
  EXPECT_EQ(bricks.element, "tet10");
  EXPECT_NEAR(size_of(bricks, false), 2.5, 1e-12);
  const DeckMesh plane = only_body(deck_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                                           {{"CPE4I", {1, 2, 3, 4}}, {"CPE4I", {2, 5, 3, 3}}}));
  EXPECT_EQ(plane.element, "tri6");
  EXPECT_NEAR(size_of(plane, true), 1.5, 1e-12);
}

/// Curved edges of quadratic elements keep their own nodes.
TEST(DeckMesh, KeepsTheMiddleNodesOfTheDeck) {
  const std::vector<Vec3> points{{0, 0, 0},   {1, 0, 0},      {1, 1, 0},    {0, 1, 0},
                                 {2, 0, 0},   {0.5, -0.1, 0}, {1, 0.5, 0},  {0.5, 1, 0},
                                 {0, 0.5, 0}, {1.5, 0, 0},    {1.5, 0.6, 0}};
  const DeckMesh mesh = only_body(
      deck_of(points, {{"CPE8", {1, 2, 3, 4, 6, 7, 8, 9}}, {"CPE6", {2, 5, 3, 10, 11, 7}}}));
  EXPECT_EQ(mesh.element, "tri6");
  EXPECT_EQ(mesh.added.size(), 1U) << "on the diagonal";
  EXPECT_EQ(mesh.nodes.size(), 12U);
  EXPECT_EQ(mesh.nodes.at(6), Vec3(0.5, -0.1, 0));
}

/// A load on nodes acts on every face between them: both sides of a column one element wide take
/// its top with them.
TEST(DeckMesh, PutsFacesThatWouldTakeInAnotherIntoDifferentSets) {
  std::vector<Vec3> points;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 2; ++x)
      points.emplace_back(x, y, 0);
  const DeckMesh column =
      only_body(deck_of(points, {{"CPE4", {1, 2, 4, 3}}, {"CPE4", {3, 4, 6, 5}}}));
  const auto sets = column.sets_of_faces({{2, 4}, {1, 3}, {4, 6}, {3, 5}});
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0], (Numbers{2, 4, 6}));
  EXPECT_EQ(sets[1], (Numbers{1, 3, 5}));
  EXPECT_EQ(column.sets_of_faces({{2, 4}, {4, 6}, {5, 6}}).size(), 1U);

  const DeckMesh brick = only_body(deck_of(brick_and_wedge, {{"C3D8", {2, 1, 3, 4, 6, 5, 7, 8}}}));
  EXPECT_EQ(brick.sets_of_faces({{2, 1, 3, 4}, {6, 5, 7, 8}}).size(), 2U);
  const DeckMesh quadratic =
      only_body(deck_of(brick_and_wedge, {{"C3D8I", {2, 1, 3, 4, 6, 5, 7, 8}}}));
  EXPECT_EQ(quadratic.sets_of_faces({{2, 1, 3, 4}}).at(0).size(), 8U);
  const DeckMesh divided = only_body(deck_of(
      brick_and_wedge, {{"C3D8", {2, 1, 3, 4, 6, 5, 7, 8}}, {"C3D6", {1, 9, 3, 5, 10, 7}}}));
  EXPECT_EQ(divided.sets_of_faces({{2, 1, 3, 4}}).at(0).size(), 9U) << "the diagonal's too";
  EXPECT_TRUE(divided.sets_of_faces({}).empty());
}

TEST(DeckMesh, RefusesWhatIsNoSolid) {
  const Deck deck =
      deck_of(brick_and_wedge, {{"C3D8", {2, 1, 3, 4, 6, 5, 7, 8}}, {"S4", {2, 1, 3, 4}}});
  try {
    (void)only_body(deck);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("S4"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace billet::io::deck_mesh_test
