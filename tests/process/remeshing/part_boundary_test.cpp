// The boundary of a part with what hangs on it, and that it hangs there still on a new mesh.

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/elements/mesh_locator.h"
#include "process/remeshing/part_boundary.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace billet::process::part_boundary_test {
namespace {

constexpr double width = 8.0;
constexpr double height = 6.0;
constexpr double rounding = 1e-12; // of coordinates of order 10

/// A block on rollers to the left and below, pressed from above, free to the right; a tool may
/// touch it above and to the right.
Scene block(ElementKind kind, Analysis analysis = Analysis::plane_strain) {
  Scene scene;
  scene.part.analysis = analysis;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(width, height, 0), {4, 3, 1}, {1, 1, 1}});
  scene.material = billet_steel();
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0)};
  scene.part.loads.push_back(PressureOn{faces_on(scene.part.mesh, 1, height), TimeFunction(10.0)});
  scene.part.contact_faces = free_faces(scene.part.mesh, analysis);
  return scene;
}

PartBoundary boundary_of(const Scene& scene,
                         const std::vector<int>& touching,
                         const std::vector<std::string>& keep = {}) {
  const std::vector<double> x = mechanics::node_positions(scene.part.mesh);
  return part_boundary(scene.part, x, touching, keep);
}

PartBoundary untouched_boundary(const Scene& scene, const std::vector<std::string>& keep = {}) {
  return boundary_of(scene, std::vector<int>(scene.part.contact_faces.size(), -1), keep);
}

geometry::RemeshSizes sides_of(double size) {
  geometry::RemeshSizes sizes;
  sizes.min = 0.25 * size;
  sizes.max = size;
  return sizes;
}

/// The scene with its part meshed anew.
Scene with_mesh(Scene scene, RemeshedPart part) {
  scene.part.mesh = std::move(part.mesh);
  scene.part.supports = std::move(part.supports);
  scene.part.loads = std::move(part.loads);
  scene.part.contact_faces = std::move(part.contact_faces);
  return scene;
}

Scene meshed_anew(Scene scene, double size, const std::vector<std::string>& keep = {}) {
  RemeshedPart part = remesh_part(scene.part, untouched_boundary(scene, keep), sides_of(size), {});
  return with_mesh(std::move(scene), std::move(part));
}

double enclosed(const geometry::SideLoop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.corners.size(); ++i)
    twice += cross(loop.corners[i], loop.corners[(i + 1) % loop.corners.size()]);
  return 0.5 * twice;
}

/// Nodes of the boundary whose coordinate along `axis` is `value`.
std::vector<Index> boundary_nodes_at(const mechanics::Mesh& mesh, int axis, double value) {
  std::set<Index> nodes;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh))
    for (const Index a : face.nodes)
      if (std::abs(mesh.points[as_size(a)][axis] - value) < rounding)
        nodes.insert(a);
  return {nodes.begin(), nodes.end()};
}

double length(const mechanics::Mesh& mesh, const std::vector<mechanics::Face>& faces) {
  double sum = 0.0;
  for (const mechanics::Face& face : faces)
    sum += (mesh.points[as_size(face.nodes[1])] - mesh.points[as_size(face.nodes[0])]).norm();
  return sum;
}

// ------------------------------------------------------------ loops and parts

TEST(PartBoundary, IsALoopWithThePartOnItsLeft) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4, ElementKind::tri6}) {
    SCOPED_TRACE(mechanics::name(kind));
    const PartBoundary boundary = untouched_boundary(block(kind));
    ASSERT_EQ(boundary.loops.size(), 1u);
    const geometry::SideLoop& loop = boundary.loops[0];
    ASSERT_EQ(loop.corners.size(), 14u) << "4 + 3 + 4 + 3 sides";
    EXPECT_NEAR(enclosed(loop), width * height, rounding * width * height);
    for (std::size_t i = 0; i < loop.corners.size(); ++i) {
      const Vec2 middle = 0.5 * (loop.corners[i] + loop.corners[(i + 1) % loop.corners.size()]);
      EXPECT_LT((loop.middles[i] - middle).norm(), rounding * width);
    }
    EXPECT_EQ(boundary.sides.size(), 14u);
    for (const auto& [nodes, number] : boundary.sides)
      EXPECT_EQ(boundary.corners[as_size(number.loop)][as_size(number.side)], nodes.first);
  }
}

TEST(PartBoundary, AFoldWhoseWallsCrossIsWelded) {
  const Scene scene = block(ElementKind::quad4);
  std::vector<double> x = mechanics::node_positions(scene.part.mesh);
  const auto move = [&](const Vec2& from, const Vec2& to) {
    for (std::size_t i = 0; i < x.size(); i += 2)
      if ((Vec2(x[i], x[i + 1]) - from).norm() < rounding)
        std::tie(x[i], x[i + 1]) = std::pair(to.x(), to.y());
  };
  move({4.0, height}, {5.0, 4.5});
  move({2.0, height}, {6.5, 6.3}); // over the node at (6, 6)
  PartBoundary boundary =
      part_boundary(scene.part, x, std::vector<int>(scene.part.contact_faces.size(), -1), {});
  const PartBoundary folded = boundary;
  EXPECT_THROW(static_cast<void>(remesh_part(scene.part, boundary, sides_of(1.0), {})), Error);
  const auto folds = weld_folds(boundary, 0.0, 0.25);
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_NEAR(folds[0].at.x(), 6.25, rounding);
  EXPECT_NEAR(folds[0].at.y(), 6.0, rounding);
  EXPECT_LT(boundary.sides.size(), folded.sides.size());
  for (const auto& [nodes, number] : boundary.sides) {
    const Index first = boundary.corners[as_size(number.loop)][as_size(number.side)];
    EXPECT_TRUE(first == nodes.first || first == -1);
  }
  // All that hangs on the other sides is there on the new mesh, whose contact finds its past.
  const RemeshedPart part = remesh_part(scene.part, boundary, sides_of(1.0), {});
  EXPECT_NEAR(part.measure, enclosed(boundary.loops[0]), 1e-9);
  EXPECT_EQ(part.supports.size(), scene.part.supports.size());
  for (const Support& support : part.supports)
    EXPECT_GE(support.nodes.size(), 5u);
  const ContactStops stops(boundary, scene.part.contact_faces, std::vector<double>{-0.577, 0.577});
  for (const auto& source : point_sources(stops, part.places, std::vector<double>{0.0}))
    EXPECT_LT(source.nearest(), 2 * scene.part.contact_faces.size());
}

TEST(PartBoundary, IsWhereThePartIsNow) {
  const Scene scene = block(ElementKind::quad8);
  std::vector<double> x = mechanics::node_positions(scene.part.mesh);
  for (std::size_t i = 0; i < x.size(); i += 2)
    x[i] += 0.1 * x[i + 1] * x[i + 1];
  const std::vector<int> touching(scene.part.contact_faces.size(), -1);
  const geometry::SideLoop loop = part_boundary(scene.part, x, touching, {}).loops[0];
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    const Vec2& a = loop.corners[i];
    const Vec2& m = loop.middles[i];
    EXPECT_TRUE(std::abs(a.x() - 0.1 * a.y() * a.y()) < width * (1.0 + rounding));
    if (m.x() < 0.11 * m.y() * m.y() && m.y() > 0.0) { // on what was the left side
      EXPECT_NEAR(m.x(), 0.1 * m.y() * m.y(), rounding * width) << "middles bend";
    }
  }
}

TEST(PartBoundary, ChangesItsPartWhereOtherThingsHang) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4, ElementKind::tri6}) {
    SCOPED_TRACE(mechanics::name(kind));
    const Scene scene = block(kind);
    const PartBoundary boundary = untouched_boundary(scene);
    ASSERT_EQ(boundary.attachments.size(), 4u);
    const geometry::SideLoop& loop = boundary.loops[0];
    std::vector<std::string> sets;
    for (const auto& [name, nodes] : scene.part.mesh.node_sets)
      sets.push_back(name);
    for (std::size_t i = 0; i < loop.corners.size(); ++i) {
      const Vec2& at = loop.middles[i];
      const Attachment& a = boundary.attachments[as_size(loop.part[i])];
      const bool left = at.x() < rounding, below = at.y() < rounding;
      const bool above = at.y() > height - rounding, right = at.x() > width - rounding;
      EXPECT_EQ(a.supports, (std::vector<char>{left, below}));
      EXPECT_EQ(a.loads, (std::vector<char>{above}));
      EXPECT_EQ(a.contact, above || right);
      EXPECT_EQ(a.tool, -1);
      for (std::size_t s = 0; s < sets.size(); ++s)
        EXPECT_EQ(a.sets[s] != 0, (sets[s] == "x-min" && left) || (sets[s] == "y-min" && below) ||
                                      (sets[s] == "x-max" && right) ||
                                      (sets[s] == "y-max" && above))
            << sets[s];
      EXPECT_EQ(loop.hold[i] != 0, left || below) << "rollers keep nodes on their lines";
      EXPECT_EQ(loop.keep[i], 0) << "corners between parts stay anyway";
    }
  }
}

TEST(PartBoundary, ChangesItsPartWhereAToolBeginsToTouch) {
  const Scene scene = block(ElementKind::quad8);
  std::vector<int> touching;
  for (const mechanics::Face& face : scene.part.contact_faces) {
    double x = 0.0, y = 0.0;
    for (const Index a : face.nodes) {
      x += scene.part.mesh.points[as_size(a)].x() / 3.0;
      y += scene.part.mesh.points[as_size(a)].y() / 3.0;
    }
    touching.push_back(y > height - rounding && x < 0.5 * width ? 1 : -1);
  }
  const PartBoundary boundary = boundary_of(scene, touching);
  EXPECT_EQ(boundary.attachments.size(), 5u) << "the top is in two parts";
  const geometry::SideLoop& loop = boundary.loops[0];
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    const bool touched = loop.middles[i].y() > height - rounding && loop.middles[i].x() < 4.0;
    EXPECT_EQ(boundary.attachments[as_size(loop.part[i])].tool, touched ? 1 : -1);
    if (touched) {
      EXPECT_NE(loop.hold[i], 0);
    }
  }
}

/// The block's contact faces above: touched up to `end`, from `begin` on.
std::vector<int> touched_above(const Scene& scene, double begin, double end) {
  std::vector<int> touching;
  for (const mechanics::Face& face : scene.part.contact_faces) {
    const Vec3 middle = 0.5 * (scene.part.mesh.points[as_size(face.nodes[0])] +
                               scene.part.mesh.points[as_size(face.nodes[1])]);
    const bool touched = middle.y() > height - rounding && middle.x() > begin && middle.x() < end;
    touching.push_back(touched ? 1 : -1);
  }
  return touching;
}

TEST(ContactZones, AreTheSidesInTurnThatAToolTouches) {
  const Scene scene = block(ElementKind::quad8);
  EXPECT_TRUE(contact_zones(untouched_boundary(scene)).empty());

  const PartBoundary boundary = boundary_of(scene, touched_above(scene, 0.0, 4.0));
  const std::vector<ContactZone> zones = contact_zones(boundary);
  ASSERT_EQ(zones.size(), 1u);
  EXPECT_EQ(zones[0].n_sides, 2u);
  EXPECT_EQ(zones[0].tool, 1);
  EXPECT_NEAR(zones[0].length, 4.0, rounding);
  EXPECT_TRUE(zones[0].ends_in_side);
  EXPECT_TRUE(zones[0].too_short());
  EXPECT_TRUE(zones[0].longest);
  EXPECT_NEAR(size_in_zone(zones[0].length), 4.0 / 6.0, rounding);
  const Vec2& begin = boundary.loops[0].corners[zones[0].first];
  EXPECT_NEAR((begin - Vec2(4.0, height)).norm(), 0.0, rounding) << "the part is on the left";
}

TEST(ContactZones, AreTooShortOnlyWhereTheyCanGrow) {
  const Scene scene = block(ElementKind::quad8);
  const std::vector<ContactZone> longer =
      contact_zones(boundary_of(scene, touched_above(scene, 0.0, 6.0)));
  ASSERT_EQ(longer.size(), 1u);
  EXPECT_EQ(longer[0].n_sides, 3u);
  EXPECT_FALSE(longer[0].too_short());

  std::vector<int> right; // a whole side of three, from corner to corner
  for (const mechanics::Face& face : scene.part.contact_faces)
    right.push_back(scene.part.mesh.points[as_size(face.nodes[0])].x() > width - rounding &&
                            scene.part.mesh.points[as_size(face.nodes[1])].x() > width - rounding
                        ? 0
                        : -1);
  const std::vector<ContactZone> whole = contact_zones(boundary_of(scene, right));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].n_sides, 3u);
  EXPECT_FALSE(whole[0].ends_in_side);
}

TEST(PartBoundary, HoldsTheAxisOfABodyOfRevolution) {
  Scene scene = block(ElementKind::quad8, Analysis::axisymmetric);
  scene.part.supports.clear();
  scene.part.mesh.node_sets.clear();
  for (const bool axisymmetric : {true, false}) {
    scene.part.analysis = axisymmetric ? Analysis::axisymmetric : Analysis::plane_strain;
    const geometry::SideLoop loop = untouched_boundary(scene).loops[0];
    for (std::size_t i = 0; i < loop.corners.size(); ++i)
      EXPECT_EQ(loop.hold[i] != 0, axisymmetric && loop.middles[i].x() < rounding);
  }
}

TEST(PartBoundary, KeepsNodesThatAloneCarrySomething) {
  Scene scene = block(ElementKind::quad4);
  const std::vector<Index> right = nodes_at(scene.part.mesh, 0, width);
  const Index held_node = right[1], set_node = right[2];
  scene.part.supports.push_back({{held_node}, 1, TimeFunction(0.0)});
  scene.part.mesh.node_sets["gauge"] = {set_node};
  const auto kept = [&](const PartBoundary& boundary) {
    std::set<Index> nodes;
    for (std::size_t i = 0; i < boundary.corners[0].size(); ++i)
      if (boundary.loops[0].keep[i] != 0)
        nodes.insert(boundary.corners[0][i]);
    return nodes;
  };
  EXPECT_EQ(kept(untouched_boundary(scene)), (std::set<Index>{held_node, set_node}));
  std::set<Index> asked(right.begin(), right.end());
  EXPECT_EQ(kept(untouched_boundary(scene, {"x-max"})), asked) << "`keep` keeps a whole set";
}

TEST(PartBoundary, OfAPartWithAHoleIsTwoLoops) {
  Scene scene;
  scene.part.mesh =
      mechanics::box_mesh({ElementKind::quad4, Vec3::Zero(), Vec3(3, 3, 0), {3, 3, 1}, {1, 1, 1}});
  scene.part.mesh.cells.erase(scene.part.mesh.cells.begin() + 16,
                              scene.part.mesh.cells.begin() + 20);
  scene.material = billet_steel();
  const PartBoundary boundary = untouched_boundary(scene);
  ASSERT_EQ(boundary.loops.size(), 2u);
  const double first = enclosed(boundary.loops[0]), second = enclosed(boundary.loops[1]);
  EXPECT_NEAR(std::max(first, second), 9.0, rounding * 9.0);
  EXPECT_NEAR(std::min(first, second), -1.0, rounding) << "the hole turns right";
  const RemeshedPart part = remesh_part(scene.part, boundary, sides_of(0.5), {});
  EXPECT_NEAR(part.measure, 8.0, 1e-10 * 8.0);
  EXPECT_NEAR(part.old_measure, 8.0, 1e-10 * 8.0);
}

// ------------------------------------------------------------- on a new mesh

void expect_all_hangs(const Scene& scene) {
  const mechanics::Mesh& mesh = scene.part.mesh;
  ASSERT_EQ(mesh.kind, ElementKind::tri6);
  EXPECT_EQ(mesh.node_sets.at("x-min"), boundary_nodes_at(mesh, 0, 0.0));
  EXPECT_EQ(mesh.node_sets.at("x-max"), boundary_nodes_at(mesh, 0, width));
  EXPECT_EQ(mesh.node_sets.at("y-min"), boundary_nodes_at(mesh, 1, 0.0));
  EXPECT_EQ(mesh.node_sets.at("y-max"), boundary_nodes_at(mesh, 1, height));
  EXPECT_EQ(mesh.node_sets.size(), 4u) << "no sets of the mesher's";
  ASSERT_EQ(scene.part.supports.size(), 2u);
  EXPECT_EQ(scene.part.supports[0].component, 0);
  EXPECT_EQ(scene.part.supports[0].nodes, boundary_nodes_at(mesh, 0, 0.0));
  EXPECT_EQ(scene.part.supports[1].component, 1);
  EXPECT_EQ(scene.part.supports[1].nodes, boundary_nodes_at(mesh, 1, 0.0));
  ASSERT_EQ(scene.part.loads.size(), 1u);
  const std::vector<mechanics::Face>& pressed = std::get<PressureOn>(scene.part.loads[0]).faces;
  for (const mechanics::Face& face : pressed)
    for (const Index a : face.nodes)
      EXPECT_NEAR(mesh.points[as_size(a)].y(), height, rounding * height);
  EXPECT_NEAR(length(mesh, pressed), width, rounding * width);
  EXPECT_NEAR(length(mesh, scene.part.contact_faces), width + height, rounding * width);
}

TEST(RemeshedPart, CarriesAllThatHungOnTheOldOne) {
  for (const Analysis analysis : {Analysis::plane_strain, Analysis::axisymmetric})
    for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4, ElementKind::tri6}) {
      SCOPED_TRACE(mechanics::name(kind));
      Scene scene = block(kind, analysis);
      for (const double size : {1.3, 0.9, 1.7, 1.1}) { // several in a row
        scene = meshed_anew(std::move(scene), size);
        expect_all_hangs(scene);
      }
    }
}

TEST(RemeshedPart, EnclosesWhatTheOldOneDid) {
  for (const Analysis analysis : {Analysis::plane_strain, Analysis::axisymmetric}) {
    const Scene scene = block(ElementKind::quad8, analysis);
    const RemeshedPart part = remesh_part(scene.part, untouched_boundary(scene), sides_of(1.1), {});
    const double exact =
        analysis == Analysis::axisymmetric ? 0.5 * width * width * height : width * height;
    EXPECT_NEAR(part.old_measure, exact, 1e-10 * exact);
    EXPECT_NEAR(part.measure, exact, 1e-10 * exact);
  }
}

TEST(RemeshedPart, CarriesWhatHangsOnSingleNodes) {
  Scene scene = block(ElementKind::quad4);
  const std::vector<Index> right = nodes_at(scene.part.mesh, 0, width);
  const Vec3 held_at = scene.part.mesh.points[as_size(right[1])];
  const Vec3 gauge_at = scene.part.mesh.points[as_size(right[2])];
  scene.part.supports.push_back({{right[1]}, 1, TimeFunction(0.5)});
  scene.part.mesh.node_sets["gauge"] = {right[2]};
  for (const double size : {1.3, 0.9, 1.7}) {
    scene = meshed_anew(std::move(scene), size);
    ASSERT_EQ(scene.part.supports[2].nodes.size(), 1u);
    EXPECT_EQ(scene.part.mesh.points[as_size(scene.part.supports[2].nodes[0])], held_at)
        << "to the bit";
    EXPECT_EQ(scene.part.supports[2].displacement(0.0), 0.5);
    ASSERT_EQ(scene.part.mesh.node_sets.at("gauge").size(), 1u);
    EXPECT_EQ(scene.part.mesh.points[as_size(scene.part.mesh.node_sets.at("gauge")[0])], gauge_at);
  }
}

TEST(RemeshedPart, KeepsTheCornersOfASetIfAsked) {
  const Scene scene = block(ElementKind::quad4);
  std::set<double> wanted;
  for (const Index a : nodes_at(scene.part.mesh, 0, width))
    wanted.insert(scene.part.mesh.points[as_size(a)].y());
  const Scene kept = meshed_anew(block(ElementKind::quad4), 1.7, {"x-max"});
  std::set<double> found;
  for (const Index a : kept.part.mesh.node_sets.at("x-max"))
    found.insert(kept.part.mesh.points[as_size(a)].y());
  EXPECT_TRUE(std::includes(found.begin(), found.end(), wanted.begin(), wanted.end()));
}

TEST(RemeshedPart, HasAllItsNodesInWhatHeldThemAll) {
  Scene scene = block(ElementKind::quad8);
  std::vector<Index> all;
  for (Index a = 0; a < scene.part.mesh.n_points(); ++a)
    all.push_back(a);
  scene.part.mesh.node_sets["all"] = all;
  scene.part.supports.push_back({all, 1, TimeFunction(0.0)});
  const Scene anew = meshed_anew(std::move(scene), 1.1);
  EXPECT_EQ(anew.part.mesh.node_sets.at("all").size(), as_size(anew.part.mesh.n_points()));
  EXPECT_EQ(anew.part.supports[2].nodes.size(), as_size(anew.part.mesh.n_points()));
}

TEST(RemeshedPart, KeepsThePointsWhereToolsCeaseToTouch) {
  const Scene scene = block(ElementKind::quad8);
  std::vector<int> touching;
  for (const mechanics::Face& face : scene.part.contact_faces)
    touching.push_back(scene.part.mesh.points[as_size(face.nodes[2])].x() < 0.5 * width ? 1 : -1);
  const RemeshedPart part =
      remesh_part(scene.part, boundary_of(scene, touching), sides_of(0.7), {});
  ASSERT_EQ(part.places.size(), part.contact_faces.size());
  double touched = 0.0;
  for (const mechanics::Face& face : part.contact_faces)
    if (part.mesh.points[as_size(face.nodes[2])].x() < 0.5 * width)
      touched += length(part.mesh, {face});
  EXPECT_NEAR(touched, 0.5 * width, rounding * width) << "no face lies across the end of contact";
}

// ------------------------------------------------- sources of contact points

/// A contact surface with what it needs.
struct Surface {
  Surface(const mechanics::Mesh& mesh,
          const std::vector<mechanics::Face>& faces,
          contact::Form form)
      : pattern(mechanics::block_pattern(mesh)),
        bulk(mesh, Analysis::plane_strain, billet_steel(), pattern),
        of(mesh, bulk, pattern, faces, {.form = form}), points(of.n_points()) {
    of.positions(mechanics::node_positions(mesh), points);
  }
  mechanics::BlockPattern pattern;
  mechanics::Bulk bulk;
  contact::ContactSurface of;
  std::vector<Vec3> points;
};

constexpr double perimeter = 2.0 * (width + height);

/// Way around the block to a point of its boundary, from (0, 0) along y = 0.
double way_to(const Vec3& p) {
  if (p.y() < rounding)
    return p.x();
  if (p.x() > width - rounding)
    return width + p.y();
  return p.y() > height - rounding ? 2.0 * width + height - p.x() : perimeter - p.y();
}

double ahead(double from, double to) { return std::fmod(to - from + perimeter, perimeter); }

TEST(PointSources, LieOnEitherSideOfTheNewPoint) {
  for (const contact::Form form : {contact::Form::mixed, contact::Form::compatible})
    for (const ElementKind kind : {ElementKind::quad8, ElementKind::quad4, ElementKind::tri6}) {
      SCOPED_TRACE(mechanics::name(kind));
      Scene scene = block(kind);
      scene.part.contact_faces =
          mechanics::boundary_faces(scene.part.mesh); // all around, without an end
      const PartBoundary boundary = untouched_boundary(scene);
      const Surface old(scene.part.mesh, scene.part.contact_faces, form);
      const ContactStops stops(boundary, scene.part.contact_faces, old.of.line_coordinates());
      const RemeshedPart part = remesh_part(scene.part, boundary, sides_of(0.7), {});
      const Surface anew(part.mesh, part.contact_faces, form);
      const std::vector<contact::PointSource> sources =
          point_sources(stops, part.places, anew.of.line_coordinates());
      ASSERT_EQ(sources.size(), anew.points.size());
      double widest = 0.0;
      int at_corners = 0;
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (sources[k].points[0] == sources[k].points[1]) {
          // Next to a corner: what lies round it has nothing to say.
          ++at_corners;
          const Vec3 off = anew.points[k] - old.points[sources[k].points[0]];
          EXPECT_LT(std::min(std::abs(off[0]), std::abs(off[1])), rounding) << "on the same edge";
          EXPECT_LT(off.norm(), 1.0);
          continue;
        }
        const double first = way_to(old.points[sources[k].points[0]]);
        const double second = way_to(old.points[sources[k].points[1]]);
        widest = std::max(widest, ahead(first, second));
        ASSERT_GE(sources[k].weights[1], 0.0);
        ASSERT_LE(sources[k].weights[1], 1.0);
        const double there = first + sources[k].weights[1] * ahead(first, second);
        EXPECT_NEAR(std::remainder(there - way_to(anew.points[k]), perimeter), 0.0,
                    1e-9 * perimeter)
            << k;
      }
      EXPECT_LT(widest, 2.0) << "neighbours: no two are farther apart than a side is long";
      EXPECT_GE(at_corners, 8) << "four corners, two edges each";
    }
}

TEST(PointSources, BeyondTheLastPointAreThatPoint) {
  Scene scene = block(ElementKind::quad8);
  scene.part.contact_faces = faces_on(scene.part.mesh, 1, height);
  const PartBoundary boundary = untouched_boundary(scene);
  const Surface old(scene.part.mesh, scene.part.contact_faces, contact::Form::mixed);
  const ContactStops stops(boundary, scene.part.contact_faces, old.of.line_coordinates());
  const RemeshedPart part = remesh_part(scene.part, boundary, sides_of(0.5), {});
  const Surface anew(part.mesh, part.contact_faces, contact::Form::mixed);
  const std::vector<contact::PointSource> sources =
      point_sources(stops, part.places, anew.of.line_coordinates());
  int beyond = 0;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const Vec3& nearest = old.points[sources[k].points[sources[k].weights[1] < 0.5 ? 0 : 1]];
    for (const Vec3& other : old.points)
      EXPECT_LE((anew.points[k] - nearest).norm(), (anew.points[k] - other).norm() + 1e-9);
    const double gap =
        ahead(way_to(old.points[sources[k].points[0]]), way_to(old.points[sources[k].points[1]]));
    beyond += gap > width ? 1 : 0; // the long way around where nothing touches
  }
  EXPECT_GE(beyond, 2);
}

} // namespace
} // namespace billet::process::part_boundary_test
