// Measures of shapes that are known: before the run, and after upsetting without friction.

#include "process/loop/process.h"
#include "process/measures/shape_measures.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace billet::process::shape_measures_test {
namespace {

using MeasureKind = Measure::Kind;

std::vector<Measure> all_of(const Vec3& axis) {
  std::vector<Measure> measures;
  for (const MeasureKind kind :
       {MeasureKind::equator_radius, MeasureKind::contact_radius, MeasureKind::barrelling,
        MeasureKind::bore, MeasureKind::height, MeasureKind::reach})
    measures.push_back({.name = "", .kind = kind, .axis = axis, .direction = axis});
  return measures;
}

TEST(ShapeMeasures, OfACylinderAreItsRadiusAndHeight) {
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::tri6}) {
    Upsetting u = bar_upsetting(ElementKind::quad8);
    u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3(5, 15, 0), {2, 3, 1}, {1, 1, 1}});
    Scene scene = upsetting_scene(std::move(u));
    scene.measures = all_of(Vec3::UnitY());
    const Process process(std::move(scene));
    const std::vector<double> found = measured(process.view());
    const std::vector<double> expected{5.0, 5.0, 1.0, 0.0, 15.0, 15.0};
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-12) << mechanics::name(kind) << " " << i;
  }
}

TEST(ShapeMeasures, OfARingHaveABore) {
  Upsetting u = bar_upsetting(ElementKind::quad8);
  u.mesh =
      mechanics::box_mesh({ElementKind::quad8, Vec3(3, 0, 0), Vec3(6, 4, 0), {2, 2, 1}, {1, 1, 1}});
  u.height = 4.0;
  Scene scene = upsetting_scene(std::move(u));
  std::erase_if(scene.part.supports, [](const Support& support) { return support.component == 0; });
  scene.measures = all_of(Vec3::UnitY());
  const Process process(std::move(scene));
  EXPECT_NEAR(measured(process.view())[3], 3.0, 1e-12);
}

TEST(ShapeMeasures, OfAQuarterOfABarInSpaceAreThoseOfItsCorner) {
  Scene scene = upsetting_scene(bar_upsetting(ElementKind::hex20));
  scene.measures = all_of(Vec3::UnitZ());
  const Process process(std::move(scene));
  const std::vector<double> found = measured(process.view());
  EXPECT_NEAR(found[0], 5.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(found[1], 5.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(found[4], 15.0, 1e-12);
}

TEST(ShapeMeasures, FollowAPartThatIsUpsetWithoutFriction) {
  Upsetting u = bar_upsetting(ElementKind::quad8);
  u.reduction = 0.3;
  Scene scene = upsetting_scene(std::move(u));
  scene.measures = all_of(Vec3::UnitY());
  Process process(std::move(scene));
  ASSERT_EQ(process.run({}), RunStatus::done);
  const std::vector<double> found = measured(process.view());
  const double radius = 5.0 / std::sqrt(0.7); // but for a per mille of elastic volume
  EXPECT_NEAR(found[0], radius, 2e-3 * radius);
  EXPECT_NEAR(found[2], 1.0, 1e-6);
  EXPECT_NEAR(found[4], 0.7 * 15.0, 1e-3);
}

TEST(ShapeMeasures, CountWhatLiesWithinABoxOnly) {
  Scene scene = upsetting_scene(bar_upsetting(ElementKind::quad8));
  scene.measures = {
      {.name = "low", .kind = MeasureKind::reach, .within = Box{{0, 0, 0}, {9, 7, 0}}},
      {.name = "none", .kind = MeasureKind::height, .within = Box{{6, 0, 0}, {9, 7, 0}}}};
  const Process process(std::move(scene));
  const std::vector<double> found = measured(process.view());
  EXPECT_NEAR(found[0], 7.0, 1e-12); // the side goes on beyond the box
  EXPECT_TRUE(std::isnan(found[1]));
}

TEST(ShapeMeasures, FillABoxAsFarAsToolsLeaveIt) {
  Scene scene = upsetting_scene(bar_upsetting(ElementKind::quad8)); // the die is at y = 15
  scene.measures = {
      {.name = "open", .kind = MeasureKind::filling, .within = Box{{0, 0, 0}, {10, 15, 0}}},
      {.name = "with the die", .kind = MeasureKind::filling, .within = Box{{0, 0, 0}, {5, 20, 0}}},
      {.name = "half", .kind = MeasureKind::filling, .within = Box{{2.5, 5, 0}, {7.5, 10, 0}}}};
  const Process process(std::move(scene));
  const std::vector<double> found = measured(process.view());
  EXPECT_NEAR(found[0], 0.25, 1.5e-3); // of the full turn
  EXPECT_NEAR(found[1], 1.0, 1e-12);
  EXPECT_NEAR(found[2], (25.0 - 6.25) / (56.25 - 6.25), 1.5e-3);
}

TEST(ShapeMeasures, FillABoxWhereverItsWallsAre) {
  for (const ElementKind kind : {ElementKind::quad8, ElementKind::hex8}) {
    Scene scene = upsetting_scene(bar_upsetting(kind));
    const bool solid = kind == ElementKind::hex8;
    const Vec3 rest = solid ? Vec3(0, 4, 12) : Vec3(0, 12, 0);
    for (int i = 0; i < 20; ++i)
      scene.measures.push_back({.name = std::to_string(i),
                                .kind = MeasureKind::filling,
                                .within = Box{{0, 0, 0}, rest + Vec3(5.0 + 0.237 * i, 0, 0)}});
    const Process process(std::move(scene));
    const std::vector<double> found = measured(process.view());
    for (int i = 0; i < 20; ++i) {
      const double share = 5.0 / (5.0 + 0.237 * i);
      EXPECT_NEAR(found[static_cast<std::size_t>(i)], solid ? share : share * share, 1.5e-3) << i;
    }
  }
}

} // namespace
} // namespace billet::process::shape_measures_test
