// FRM-07: a flat punch goes into a perfectly plastic block (Prandtl 1920, Hill 1950), in plane
// strain; the limit is (2 + pi) k. Half width 1, half model of a block 10 x 10.
//
// The punch's edge is a line that no mesh resolves: the pressure comes down to the limit with the
// first power of the element size, so single meshes are compared with an independent program
// (frm07_prandtl_mesh_study.csv, quad8 of 2 x 2 points) and the limit with what they extrapolate
// to.

#include "contact/faces/pressure_oscillation.h"
#include "geometry/surfaces/profile.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/figures.h"
#include "tests/support/problems.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace billet::process::forming_punch_test {
namespace {

constexpr double yield = 200.0;                                // [MPa]
const double twice_shear_yield = 2.0 * yield / std::sqrt(3.0); // 2k [MPa]
constexpr double prandtl = 1.0 + 0.5 * std::numbers::pi;       // limit of p / 2k
constexpr double size = 10.0;                                  // of the block [mm]

/// Elements of 1/n under the punch and as deep, from there on growing outwards; the meshes for n,
/// 2n, 4n are in one another.
mechanics::Mesh block(ElementKind kind, int n) {
  constexpr double even = 1.0;
  constexpr double grown = 2.25;
  const int cells = static_cast<int>(std::lround((even + grown) * n));
  const auto place = [&](double nodes) { // coordinate after so many elements
    const double s = nodes / n;
    return s <= even ? s : even + (size - even) * std::expm1(s - even) / std::expm1(grown);
  };
  mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(cells, cells, 0), {cells, cells, 1}});
  const auto corner_or_middle = [&](double coordinate) {
    const double nodes = 0.5 * std::round(2.0 * coordinate); // without its rounding
    return 0.5 * (place(std::floor(nodes)) + place(std::ceil(nodes)));
  };
  for (Vec3& p : mesh.points)
    p = Vec3(corner_or_middle(p[0]), -corner_or_middle(cells - p[1]), 0.0);
  return mesh;
}

/// How the block is pressed over the half width.
enum class Punch {
  nodes, ///< its nodes go down with the punch, as in the reference
  sharp, ///< a tool with an edge
};

/// E = 1000 yield, nu = 0.49. The punch goes down by 1 mm/s.
Scene indented(ElementKind kind,
               int n,
               Punch punch,
               const contact::Friction& friction,
               double end) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh = block(kind, n);
  scene.material = {{1000.0 * yield, 0.49}, mechanics::Perfect{yield}};
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 0, size),
                         held(scene.part.mesh, 1, -size)};
  const std::vector<Index> top = nodes_at(scene.part.mesh, 1, 0.0);
  if (punch == Punch::nodes) {
    constexpr double rounding = 1e-9;
    std::vector<Index> under;
    for (const Index a : top)
      if (scene.part.mesh.points[as_size(a)][0] <= 1.0 + rounding)
        under.push_back(a);
    scene.part.supports.push_back({under, 0, TimeFunction(0.0)});
    scene.part.supports.push_back({under, 1, TimeFunction({{0.0, 0.0}, {end, -end}})});
  } else {
    const std::array<Vec2, 4> corners{Vec2(-2, 0), Vec2(1, 0), Vec2(1, 2), Vec2(-2, 2)};
    scene.tools.push_back(moving_tool("punch",
                                      geometry::make_profile(geometry::polygon(corners, true)),
                                      -Vec3::UnitY(), friction));
    scene.touch = {0};
    scene.part.contact_faces = faces_on(scene.part.mesh, 1, 0.0);
    // In mixed form the outermost face loses one point, then the other: without friction p falls by
    // 9 % at 0.047 on quad8, n = 16, and tri6 under sticking do not converge beyond 0.02.
    scene.contact.form = contact::Form::compatible;
  }
  scene.stages.push_back({"press", end, std::vector<char>(scene.tools.size(), 1), false});
  scene.increments.first = scene.increments.max = 5e-4;
  scene.landing_times = {0.01, 0.02, 0.03};
  return scene;
}

/// Mean pressure over 2k as the punch goes down.
class PressureCurve {
public:
  PressureCurve(ElementKind kind,
                int n,
                Punch punch,
                const contact::Friction& friction,
                double end) {
    Process process(indented(kind, n, punch, friction, end));
    support::Recorder recorder([&](const auto& now, const IncrementReport& report) {
      curve_.emplace_back(report.time, force(now) / twice_shear_yield);
    });
    support::run_to_end(process, recorder);
    fmt::print("[FRM-07] {} n = {}: {} increments, {} iterations, {} cut-backs\n",
               mechanics::name(kind), n, process.view().state.increment,
               process.view().state.counters.iterations, process.view().state.counters.cutbacks);
    EXPECT_LT(process.view().state.energy.error(), 5e-3);
  }

  [[nodiscard]] double at(double penetration) const {
    for (const auto& [depth, pressure] : curve_)
      if (depth >= penetration * (1.0 - 1e-9))
        return pressure;
    ADD_FAILURE() << "the punch did not come to " << penetration;
    return 0.0;
  }

private:
  static double force(const Run& process) {
    if (process.contact() != nullptr)
      return process.contact()->loads()[0].force[1];
    double sum = 0.0;
    for (const Index a : process.part().supports.back().nodes)
      sum -= process.state.reactions[as_size(2 * a + 1)];
    return sum;
  }

  std::vector<std::pair<double, double>> curve_;
};

/// What three meshes, each twice as fine, lead to if their errors shrink by a constant factor.
double extrapolated(const std::array<double, 3>& p) {
  const double ratio = (p[1] - p[2]) / (p[0] - p[1]);
  return p[2] - (p[1] - p[2]) * ratio / (1.0 - ratio);
}

/// Rows of frm07_prandtl_mesh_study.csv at penetrations of 0.02 and 0.03.
struct Row {
  int n;
  std::array<double, 2> pressure;
};
constexpr std::array mesh_study{Row{4, {2.8637185, 2.9456632}}, Row{8, {2.7475753, 2.798159}},
                                Row{16, {2.6866218, 2.7121498}}};

void expect_row(const PressureCurve& curve, const Row& row) {
  constexpr double tolerance = 0.02; // VALIDATION
  for (const std::size_t i : {0U, 1U}) {
    const double depth = i == 0 ? 0.02 : 0.03;
    support::show("FRM-07", fmt::format("quad8 n = {} at {}: p/2k", row.n, depth), curve.at(depth),
                  row.pressure[i]);
    EXPECT_NEAR(curve.at(depth), row.pressure[i], tolerance * row.pressure[i]) << row.n;
  }
}

TEST(Punch, FRM_07_has_the_pressures_of_an_independent_program_mesh_by_mesh) {
  for (const Row& row : {mesh_study[0], mesh_study[1]})
    expect_row({ElementKind::quad8, row.n, Punch::nodes, {}, 0.03}, row);
}

TEST(Punch, FRM_07_by_contact_is_between_the_limit_and_the_reference) {
  for (const Row& row : {mesh_study[0], mesh_study[1]}) {
    const PressureCurve curve(ElementKind::quad8, row.n, Punch::sharp, contact::Sticking{}, 0.02);
    support::show("FRM-07", fmt::format("contact, n = {}: p/2k", row.n), curve.at(0.02),
                  row.pressure[0]);
    // Contact acts at points within the faces: the edge reaches less far than one of nodes.
    EXPECT_LT(curve.at(0.02), row.pressure[0]) << row.n;
    EXPECT_GT(curve.at(0.02), prandtl) << row.n;
  }
}

/// Compares what three meshes lead to with the limit.
///
/// @return by which share the pressure on the finest grows from 0.02 to 0.05 [-]
double check_limit(const std::string& name,
                   ElementKind kind,
                   Punch punch,
                   const contact::Friction& friction) {
  std::array<double, 3> pressures{};
  double growth = 0.0;
  for (const std::size_t i : {0U, 1U, 2U}) {
    const Row& row = mesh_study[i];
    const PressureCurve curve(kind, row.n, punch, friction, 0.05);
    pressures[i] = curve.at(0.02);
    growth = curve.at(0.05) / curve.at(0.02) - 1.0;
    fmt::print("[FRM-07] {} n = {}: p/2k = {:.4f} at 0.02, {:.2f} % more at 0.05\n", name, row.n,
               pressures[i], 100.0 * growth);
    if (punch == Punch::nodes && kind == ElementKind::quad8) {
      expect_row(curve, row);
    }
  }
  constexpr double tolerance = 0.03; // VALIDATION
  const double p = extrapolated(pressures);
  support::show("FRM-07", name + " extrapolated: p/2k", p, prandtl);
  EXPECT_NEAR(p, prandtl, tolerance * prandtl) << name;
  return growth;
}

constexpr double slow = 0.03; // VALIDATION: growth on the finest mesh, of quad8

/// A bar of n elements over its height of 3 under a round punch of radius 2 that rubs at half the
/// shear yield stress.
Scene under_round_punch(ElementKind kind, double penalty, int n = 15) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(6, 3, 0), {2 * n, n, 1}, {1, 1, 1}});
  scene.material = {{200e3, 0.3}, mechanics::Linear{400.0, 300.0}};
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0)};
  scene.tools.push_back(moving_tool("punch", geometry::make_circle({0, 5, 0}, 2.0, false),
                                    Vec3(0, -1, 0), contact::Tresca{0.5, {}}));
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  scene.contact.penalty = penalty;
  scene.stages.push_back({"indent", 0.3, {1}, false});
  scene.increments.first = 0.003;
  scene.increments.max = 0.01;
  return scene;
}

TEST(RoundPunch, TouchesStraightFacesWithBothTheirPoints) {
  // With the sagittas of uneven faces in their gaps every second point would stand off, and quad4
  // would touch over 56 % of the area of quad8. What is left to 100 % is half a face at the end.
  const auto end = [](ElementKind kind, double penalty) {
    const FinishedRun done = run(under_round_punch(kind, penalty));
    EXPECT_EQ(done.status, RunStatus::done);
    return std::array<double, 2>{done.process->view().contact()->state().area,
                                 done.last().loads[0].force[1]};
  };
  const auto [area, force] = end(ElementKind::quad8, 100.0);
  ASSERT_GT(area, 0.5);
  for (const double penalty : {10.0, 100.0, 1e4}) {
    const auto [own_area, own_force] = end(ElementKind::quad4, penalty);
    std::printf("quad4, penalty %-6g area %.4f (quad8 %.4f), force %.1f N (%.1f)\n", penalty,
                own_area, area, own_force, force);
    EXPECT_NEAR(own_force, force, 0.04 * force);
    // Levels are those of the increment before: harder penalties can tell.
    if (penalty <= 100.0) {
      EXPECT_NEAR(own_area, area, 0.15 * area);
    }
  }
}

/// The same with a block of n x n elements over 3 x 3 and n / 2 over its height, in space, under a
/// quarter of a ball.
Scene under_ball(ElementKind kind, int n) {
  Scene scene = under_round_punch(ElementKind::quad8, 100.0);
  scene.part.analysis = Analysis::solid;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(3, 1.5, 3), {n, (n + 1) / 2, n}, {1, 1, 1}});
  scene.part.supports = {held(scene.part.mesh, 0, 0.0), held(scene.part.mesh, 1, 0.0),
                         held(scene.part.mesh, 2, 0.0)};
  scene.tools.clear();
  scene.tools.push_back(moving_tool("ball", geometry::make_sphere({0, 4.5, 0}, 3.0, false),
                                    Vec3(0, -1, 0), contact::Tresca{0.5, {}}));
  scene.part.contact_faces = free_faces(scene.part.mesh, scene.part.analysis);
  scene.stages.front().end = 0.12;
  return scene;
}

/// Root mean square of the pressure's oscillation, but at the end of the contact, over that of
/// the pressure. (C.45)
double oscillation_of(const contact::ContactTerm& term,
                      const contact::ContactSurface& surface,
                      std::span<const double> x) {
  std::vector<contact::PointHistory> history(surface.n_points());
  const std::vector<contact::PointResult> results = contact::point_results(term);
  std::vector<char> lying(as_size(surface.n_faces()), 0);
  for (std::size_t k = 0; k < results.size(); ++k)
    if (results[k].pressure > 0.0) {
      history[k].pressure = results[k].pressure;
      history[k].normal = Vec3::UnitY();
      lying[k / as_size(surface.points())] = 1;
    }
  std::vector<double> areas(history.size());
  surface.areas(x, areas);
  std::vector<Vec3> places(history.size());
  surface.positions(x, places);
  const contact::SmoothedPressure smoothed =
      contact::smoothed_pressure(surface, lying, history, places, areas);
  const std::vector<double> oscillation = contact::pressure_oscillation(smoothed, history);
  double pressed = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < oscillation.size(); ++k) {
    sum += oscillation[k] * oscillation[k];
    pressed += smoothed.mean[k] > 0.0 ? history[k].pressure * history[k].pressure : 0.0;
  }
  EXPECT_GT(pressed, 0.0);
  return std::sqrt(sum / pressed);
}

/// How a round tool lies on the body at last.
struct RoundPunchEnd {
  double oscillation = 0.0;
  double area = 0.0;
};

RoundPunchEnd end_of(Scene scene) {
  const ElementKind kind = scene.part.mesh.kind;
  const contact::Form form = scene.contact.form;
  const FinishedRun done = run(std::move(scene));
  EXPECT_EQ(done.status, RunStatus::done);
  const Run& process = *done.process;
  const RoundPunchEnd end{
      oscillation_of(*process.contact(), *process.model.surface, process.positions()),
      process.contact()->state().area};
  fmt::print(
      "{}, {}: oscillation {:.3f}, area {:.4f}, force {:.1f} N, {} increments, {} iterations\n",
      mechanics::name(kind), form == contact::Form::mixed ? "mixed" : "compatible", end.oscillation,
      end.area, done.last().loads[0].force[1], process.state.increment,
      process.state.counters.iterations);
  // Under the ball, whose contact grows by whole faces of a coarse mesh, 0.6 % with and without.
  EXPECT_LT(process.state.energy.error(), kind == ElementKind::tet10 ? 1e-2 : 5e-3);
  return end;
}

RoundPunchEnd round_punch_end(ElementKind kind, contact::Form form, int n) {
  Scene scene = under_round_punch(kind, 100.0, n);
  scene.contact.form = form;
  return end_of(std::move(scene));
}

TEST(RoundPunch, PressesAtAllPointsOfQuadraticFaces) {
  // Without (C.45) the compatible form touches with 80 % of the area, oscillation 0.58.
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::tri6}) {
    const double area = round_punch_end(kind, contact::Form::mixed, 15).area;
    const RoundPunchEnd end = round_punch_end(kind, contact::Form::compatible, 15);
    EXPECT_NEAR(end.area, area, 0.1 * area);
    EXPECT_LT(end.oscillation, 0.5);
  }
}

TEST(RoundPunchLong, PressesAlikeAtBothPointsOfFineTriangles) {
  EXPECT_LT(round_punch_end(ElementKind::tri6, contact::Form::mixed, 30).oscillation, 0.2);
}

TEST(RoundPunchLong, PressesMoreAlikeAtThePointsOfTetrahedra) {
  // Without (C.45) 0.57 and 0.55.
  for (const contact::Form form : {contact::Form::mixed, contact::Form::compatible}) {
    Scene scene = under_ball(ElementKind::tet10, 12);
    scene.contact.form = form;
    EXPECT_LT(end_of(std::move(scene)).oscillation, 0.45);
  }
}

TEST(PunchLong, FRM_07_three_meshes_lead_to_the_limit) {
  EXPECT_LT(check_limit("quad8, nodes", ElementKind::quad8, Punch::nodes, {}), slow);
}

TEST(PunchLong, FRM_07_three_meshes_lead_to_the_limit_by_contact) {
  for (const bool rough : {true, false}) {
    const auto friction = rough ? contact::Friction(contact::Sticking{}) : contact::Frictionless{};
    const std::string name = rough ? "quad8, rough" : "quad8, smooth";
    EXPECT_LT(check_limit(name, ElementKind::quad8, Punch::sharp, friction), slow) << name;
  }
}

// Their growth to 0.05 is not gated, VALIDATION's bound being that of quad8: 3.5 % of quad4 (2.8 %
// for n = 32) and 4.2 % of tri6 on the finest mesh, whose elements are hardly larger than the
// penetration then.
TEST(PunchLong, FRM_07_other_elements_lead_to_the_same_limit) {
  for (const ElementKind kind : {ElementKind::tri6, ElementKind::quad4}) {
    const std::string name(mechanics::name(kind));
    check_limit(name + ", nodes", kind, Punch::nodes, {});
    check_limit(name + ", rough", kind, Punch::sharp, contact::Sticking{});
  }
}

} // namespace
} // namespace billet::process::forming_punch_test
