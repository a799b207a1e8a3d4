// Tools of a deck in space: what is curved, what stays flat, and which side is in contact.

#include "geometry/base/angle.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "geometry/surfaces/triangle_surface.h"
#include "io/case/read_case.h"
#include "io/tools/stl.h"
#include "io/tools/stl_tool.h"
#include "io/translate/deck_case.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace billet::io::deck_tools_test {

namespace {

using test::TemporaryFolder;

/// A cube of 10 mm below a tool, which `tool` makes with the surface SDIE and the node 900.
std::string pressed_cube(const std::string& tool) {
  return "*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,0,0,10\n6,10,0,10\n7,10,10,10\n"
         "8,0,10,10\n900,5,5,12\n*ELEMENT,TYPE=C3D8,ELSET=PART\n1,1,2,3,4,5,6,7,8\n"
         "*NSET,NSET=LOW\n1,2,3,4\n*SOLID SECTION,ELSET=PART,MATERIAL=M\n*MATERIAL,NAME=M\n"
         "*ELASTIC\n2e5,0.3\n*PLASTIC\n300,0\n*SURFACE,NAME=TOP\nPART,S2\n" +
         tool +
         "*SURFACE INTERACTION,NAME=I\n*FRICTION\n0.1\n*CONTACT PAIR,INTERACTION=I\nTOP,SDIE\n"
         "*BOUNDARY\nLOW,1,3\n*STEP,NLGEOM\n*STATIC\n0.1,1\n*BOUNDARY\n900,1,2\n900,3,3,-1\n*END "
         "STEP\n";
}

/// Facets of four nodes, one strip for each line of the chain (x, z), from y = -5 to 15; free
/// below.
std::string strips(const std::vector<std::array<double, 2>>& chain,
                   const std::string& side = "SPOS") {
  std::string nodes = "*NODE\n", elements = "*ELEMENT,TYPE=R3D4,ELSET=DIE\n";
  for (std::size_t i = 0; i < chain.size(); ++i)
    nodes += fmt::format("{},{:.12g},-5,{:.12g}\n{},{:.12g},15,{:.12g}\n", 100 + 2 * i, chain[i][0],
                         chain[i][1], 101 + 2 * i, chain[i][0], chain[i][1]);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    elements += fmt::format("{},{},{},{},{}\n", 100 + i, 100 + 2 * i, 101 + 2 * i, 103 + 2 * i,
                            102 + 2 * i);
  return nodes + elements + "*RIGID BODY,ELSET=DIE,REF NODE=900\n*SURFACE,NAME=SDIE\nDIE," + side +
         "\n";
}

std::string profile(const std::string& curves) {
  return "*SURFACE,TYPE=CYLINDER,NAME=SDIE\n0,5,10, 1,5,10\n0,6,10\n" + curves +
         "*RIGID BODY,ANALYTICAL SURFACE=SDIE,REF NODE=900\n";
}

/// The case of a deck, read back.
class Imported {
public:
  explicit Imported(const std::string& tool) {
    const auto deck = folder_.file("job.inp", pressed_cube(tool));
    const DeckCase made =
        case_of(read_deck(deck, {folder_.path(), false}), deck_units().front(), "job.inp");
    for (const DeckRemark& one : made.remarks)
      remarks += one.text + "\n";
    for (const DeckFile& file : made.files)
      (void)folder_.file(file.name, file.content);
    tool_ = read_case(folder_.path() / "case.toml").tools.at(0);
  }

  template <class Surface> [[nodiscard]] const Surface& surface() const {
    return std::get<Surface>(tool_.surface);
  }

  /// Gaps of points to the surface of triangles as a run takes it.
  [[nodiscard]] std::vector<double> gaps(const std::vector<Vec3>& points) const {
    const auto& stl = surface<StlSurface>();
    const StlTool mesh = tool_mesh(read_stl(stl.file.path), {1.0, false, stl.feature_angle});
    const geometry::SurfacePtr shape =
        stl.smooth
            ? geometry::make_smooth_triangle_surface(mesh.mesh, stl.feature_angle * degree).surface
            : geometry::make_triangle_surface(mesh.mesh);
    std::vector<geometry::Projection> found(points.size());
    shape->project(points, 100.0, found);
    std::vector<double> gaps;
    for (const geometry::Projection& one : found)
      gaps.push_back(one.gap);
    return gaps;
  }

  std::string remarks;

private:
  TemporaryFolder folder_;
  Tool tool_;
};

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

constexpr double stl_digits = 1e-7; // of coordinates up to 20 mm, written with nine digits [mm]

TEST(DeckTools, an_edge_of_rigid_elements_that_stands_alone_stays_sharp) {
  const double rise = 15.0 * std::tan(20.0 * degree);
  const Imported made(strips({{-5.0, 10.5}, {5.0, 10.5}, {20.0, 10.5 + rise}}));
  EXPECT_FALSE(made.surface<StlSurface>().smooth);
  expect_in(made.remarks, "stay flat: edges that turn by 20 degrees and more stand alone");
  EXPECT_NEAR(made.gaps({Vec3(4.9, 5.0, 10.0)})[0], 0.5, stl_digits);
}

/// An arc of radius 20 about (5, 30) from 150 degrees, in steps.
std::vector<std::array<double, 2>> arc(double from, double to, int n) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i <= n; ++i) {
    const double at = (from + (to - from) * i / n) * degree;
    points.push_back({5.0 + 20.0 * std::cos(at), 30.0 + 20.0 * std::sin(at)});
  }
  return points;
}

TEST(DeckTools, rigid_elements_that_turn_alike_are_curved_and_the_log_says_by_how_much) {
  const Imported made(strips(arc(225.0, 315.0, 15)));
  EXPECT_TRUE(made.surface<StlSurface>().smooth);
  expect_in(made.remarks, "turn alike by up to 6 degrees: they are curved (smooth = true), by up "
                          "to 0.027 mm (chord error)");
  constexpr double curved = 1e-5;   // a hundredth of the facets' 20 (1 - cos 3 deg), and far less
  const double at = 272.0 * degree; // between nodes
  const Vec3 out(std::cos(at), 0.0, std::sin(at));
  EXPECT_NEAR(made.gaps({Vec3(5.0, 5.0, 30.0) + 20.5 * out})[0], 0.5, curved);
}

TEST(DeckTools, edges_between_curved_parts_stay_sharp) {
  std::vector<std::array<double, 2>> chain = arc(240.0, 300.0, 10);
  const auto [x, z] = chain.back();
  const double slope = (30.0 - 20.0) * degree; // the arc ends with 30 degrees, its chord with 27
  chain.push_back({x + 10.0 * std::cos(slope), z + 10.0 * std::sin(slope)});
  const Imported made(strips(chain));
  EXPECT_TRUE(made.surface<StlSurface>().smooth);
  EXPECT_GT(made.surface<StlSurface>().feature_angle, 6.0);
  EXPECT_LT(made.surface<StlSurface>().feature_angle, 17.0);
  expect_in(made.remarks, "edges that turn by 17 degrees and more stand alone and stay sharp");
}

TEST(DeckTools, the_four_edges_of_a_blunt_pyramid_stand_alone) {
  const Imported made("*NODE\n100,-5,-5,12\n101,15,-5,12\n102,15,15,12\n103,-5,15,12\n"
                      "104,5,5,10.5\n*ELEMENT,TYPE=R3D3,ELSET=DIE\n100,101,100,104\n"
                      "101,102,101,104\n102,103,102,104\n103,100,103,104\n"
                      "*RIGID BODY,ELSET=DIE,REF NODE=900\n*SURFACE,NAME=SDIE\nDIE,SPOS\n");
  EXPECT_FALSE(made.surface<StlSurface>().smooth);
  EXPECT_NEAR(made.gaps({Vec3(5.0, 5.0, 10.0)})[0], 0.5, stl_digits);
}

TEST(DeckTools, a_swept_profile_of_lines_is_exact) {
  const double rise = 15.0 * std::tan(20.0 * degree);
  const Imported made(
      profile(fmt::format("START,20,{:.10g}\nLINE,5,0.5\nLINE,-5,0.5\n", 0.5 + rise)));
  EXPECT_FALSE(made.surface<StlSurface>().smooth);
  EXPECT_EQ(made.remarks, "");
  const std::vector<double> gaps = made.gaps({{4.9, 5.0, 10.0}, {0.0, 0.0, 10.0}});
  EXPECT_NEAR(gaps[0], 0.5, stl_digits);
  EXPECT_NEAR(gaps[1], 0.5, stl_digits);
}

TEST(DeckTools, lines_of_a_swept_profile_with_arcs_stay_straight_and_corners_sharp) {
  // From the right: a slope of 15 degrees, a corner, a line, a tangent arc of radius 5 upwards.
  const double rise = 15.0 * std::tan(15.0 * degree);
  const Imported made(profile(
      fmt::format("START,20,{:.10g}\nLINE,5,0.5\nLINE,0,0.5\nCIRCL,-5,5.5,0,5.5\n", 0.5 + rise)));
  const auto& stl = made.surface<StlSurface>();
  EXPECT_TRUE(stl.smooth);
  EXPECT_LT(stl.feature_angle, 15.0);
  expect_in(made.remarks, "its arcs are drawn as facets of 2 degrees and less and curved");
  const double at = 227.1 * degree; // in a facet of the arc
  const std::vector<double> gaps =
      made.gaps({{4.99, 5.0, 10.0},
                 {0.01, 3.0, 10.0},
                 {5.0 + 2.0 * std::cos(15.0 * degree) + 0.5 * std::sin(15.0 * degree), 5.0,
                  10.5 + 2.0 * std::sin(15.0 * degree) - 0.5 * std::cos(15.0 * degree)},
                 {5.5 * std::cos(at), 5.0, 15.5 + 5.5 * std::sin(at)}});
  for (const double gap : gaps)
    EXPECT_NEAR(gap, 0.5, stl_digits);
}

TEST(DeckTools, arcs_next_to_very_blunt_corners_are_drawn_as_planes) {
  const double rise = 15.0 * std::tan(0.2 * degree);
  const Imported made(profile(
      fmt::format("START,20,{:.10g}\nLINE,5,0.5\nLINE,0,0.5\nCIRCL,-5,5.5,0,5.5\n", 0.5 + rise)));
  EXPECT_FALSE(made.surface<StlSurface>().smooth);
  expect_in(made.remarks, "its arcs are drawn as planes of 0.5 degrees, 4.8e-05 mm off at most");
}

TEST(DeckTools, a_swept_circle_is_a_cylinder) {
  const Imported roll(
      profile("START,5,0.5\nCIRCL,10,5.5,5,5.5\nCIRCL,5,10.5,5,5.5\nCIRCL,0,5.5,5,5.5\n"
              "CIRCL,5,0.5,5,5.5\n"));
  EXPECT_EQ(roll.surface<CylinderSurface>().radius, 5.0);
  EXPECT_EQ(roll.surface<CylinderSurface>().point, Vec3(5.0, 5.0, 15.5));
  EXPECT_TRUE(roll.surface<CylinderSurface>().inside); // free on the left, turning left
  const Imported other(
      profile("START,5,0.5\nCIRCL,0,5.5,5,5.5\nCIRCL,5,10.5,5,5.5\nCIRCL,10,5.5,5,5.5\n"
              "CIRCL,5,0.5,5,5.5\n"));
  EXPECT_FALSE(other.surface<CylinderSurface>().inside);
  EXPECT_EQ(other.remarks, "");
}

TEST(DeckTools, rigid_elements_are_in_contact_with_the_side_that_their_surface_names) {
  const std::vector<std::array<double, 2>> below{{-5.0, 10.5}, {15.0, 10.5}};
  const std::vector<std::array<double, 2>> turned{{15.0, 10.5}, {-5.0, 10.5}};
  const std::vector<Vec3> part{{5.0, 5.0, 10.0}};
  EXPECT_NEAR(Imported(strips(below)).gaps(part)[0], 0.5, stl_digits);
  EXPECT_NEAR(Imported(strips(turned, "SNEG")).gaps(part)[0], 0.5, stl_digits);
  EXPECT_NEAR(Imported(strips(below, "SNEG")).gaps(part)[0], -0.5, stl_digits);
  const Imported both(strips(below) + "DIE,SNEG\n");
  EXPECT_NEAR(both.gaps(part)[0], 0.5, stl_digits);
  expect_in(both.remarks, "in contact with both of its sides: the tool has the side SPOS only");
}

} // namespace

} // namespace billet::io::deck_tools_test
