// The process window of runs whose pressure, sliding and strain are known in closed form.

#include "process/loop/process.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::process::process_window_test {
namespace {

using contact::WindowQuantity;
using support::show;

TEST(ProcessWindowOfARun, IsThatOfUniformUpsetting) {
  // A bar upset without friction by 20 % at 1 mm/s: strain e = ln(h0 / h), rate v / h, pressure
  // tau(e) / J, a point at radius r slides by v r / (2 h) a second. Weighted with the area, which
  // grows as 1 / h, over time. Plastic quantities lack the elastic part, tau / E = 0.4 %.
  constexpr double h0 = 15.0, h1 = 12.0, radius = 10.0;
  Scene scene = billet_scene(ElementKind::quad8, 4, 4, contact::Frictionless{}, 0.2);
  scene.increments.max = 0.02;
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  double weight = 0.0, pressure = 0.0, speed = 0.0, rate = 0.0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double h = h0 - (h0 - h1) * (i + 0.5) / n;
    const double tau = (700.0 + 300.0 * std::log(h0 / h)) / (1.0 + 300.0 / 200e3);
    const double r = radius * std::sqrt(h0 / h);
    weight += 1.0 / h;
    pressure += tau / h;
    speed += 2.0 / 3.0 * r / (2.0 * h) / h; // the mean of r over a circle is 2/3 of its radius
    rate += 1.0 / h / h;
  }
  const contact::Window window = done.process->view().state.record.window.tool(0);
  const auto& p = window[WindowQuantity::pressure];
  show("WINDOW", "mean pressure [MPa]", p.mean, pressure / weight);
  show("WINDOW", "mean sliding speed [mm/s]", window[WindowQuantity::speed].mean, speed / weight);
  show("WINDOW", "mean strain rate [1/s]", window[WindowQuantity::strain_rate].mean, rate / weight);
  show("WINDOW", "last strain [-]", window[WindowQuantity::strain].last_mean, std::log(h0 / h1));
  show("WINDOW", "contact time [s]", window.contact_time, h0 - h1);
  EXPECT_NEAR(p.mean, pressure / weight, 0.01 * p.mean); // the elastic start
  EXPECT_NEAR(window[WindowQuantity::speed].mean, speed / weight, 0.01 * speed / weight);
  EXPECT_NEAR(window[WindowQuantity::strain_rate].mean, rate / weight, 0.02 * rate / weight);
  EXPECT_NEAR(window[WindowQuantity::strain].last_mean, std::log(h0 / h1),
              0.02 * std::log(h0 / h1));
  EXPECT_NEAR(window.contact_time, h0 - h1, 1e-9);
  // A point at the rim has slid to r sqrt(h0 / h1); the outermost contact point is just inside.
  const double rim = radius * (std::sqrt(h0 / h1) - 1.0);
  const double most = window[WindowQuantity::sliding].highest;
  show("WINDOW", "longest way [mm], that of the rim", most, rim);
  EXPECT_LT(most, rim);
  EXPECT_GT(most, 0.9 * rim);
  EXPECT_EQ(done.process->view().state.record.window.total()[WindowQuantity::pressure].mean,
            p.mean);
}

TEST(ProcessWindowOfARun, IsThatOfABlockThatSlides) {
  // A stiff block is pressed by 100 MPa and then pushed over a floor by 2 mm in 4 s.
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh =
      mechanics::box_mesh({ElementKind::quad4, Vec3(0, 0, 0), Vec3(4, 1, 0), {8, 2, 1}, {1, 1, 1}});
  scene.material = elastic_body(200e3, 0.0);
  scene.part.supports.push_back(
      {nodes_at(scene.part.mesh, 1, 1.0), 0, TimeFunction({{0.0, 0.0}, {1.0, 0.0}, {5.0, 2.0}})});
  scene.part.loads.emplace_back(
      PressureOn{faces_on(scene.part.mesh, 1, 1.0), TimeFunction({{0.0, 0.0}, {1.0, 100.0}})});
  contact::Tool floor =
      moving_tool("floor", geometry::make_plane({0, 0, 0}, {0, 1, 0}), Vec3::Zero());
  floor.friction = contact::Coulomb{0.1};
  scene.tools.push_back(std::move(floor));
  scene.touch = {0};
  scene.part.contact_faces = faces_on(scene.part.mesh, 1, 0.0);
  scene.stages.push_back({"slide", 5.0, {1}, false});
  scene.landing_times = {1.0};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::done);
  const contact::Window window = done.process->view().state.record.window.total();
  show("WINDOW", "mean pressure [MPa]", window[WindowQuantity::pressure].mean, 90.0);
  show("WINDOW", "mean sliding speed [mm/s]", window[WindowQuantity::speed].mean, 0.4);
  show("WINDOW", "sliding distance [mm]", window[WindowQuantity::sliding].last_mean, 2.0);
  show("WINDOW", "mean area [mm^2 per mm]", window.mean_area, 4.0);
  EXPECT_NEAR(window[WindowQuantity::pressure].mean, 90.0, 0.1);
  EXPECT_NEAR(window[WindowQuantity::speed].mean, 0.4, 1e-3); // stick takes 0.1 um
  EXPECT_NEAR(window[WindowQuantity::sliding].last_mean, 2.0, 2e-3);
  EXPECT_NEAR(window.mean_area, 4.0, 1e-3);
  EXPECT_EQ(window[WindowQuantity::strain].highest, 0.0);
}

} // namespace
} // namespace billet::process::process_window_test
